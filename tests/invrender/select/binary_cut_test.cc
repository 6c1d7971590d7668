// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/binary_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace groundglass {
namespace {

TEST(BinaryCut, ANodeAloneTakesWhatCostsLess) {
  BinaryCut cut(2);
  cut.AddCosts(0, 1, 2);
  cut.AddCosts(1, 2, 1);
  cut.Solve();
  EXPECT_FALSE(cut.IsOne(0));
  EXPECT_TRUE(cut.IsOne(1));
}

TEST(BinaryCut, ANodeFollowsItsNeighbourWhereDifferingCostsMore) {
  for (const double differing : {0.9, 1.1}) {
    BinaryCut cut(2);
    cut.AddCosts(0, 0, 1);
    cut.AddCosts(1, 5, 0);
    cut.AddPairCosts(0, 1, 0, differing, differing);
    cut.Solve();
    EXPECT_EQ(cut.IsOne(0), differing > 1);
    EXPECT_TRUE(cut.IsOne(1));
  }
}

// Nine nodes in a square, all 512 ways tried.
TEST(BinaryCut, CostsNoMoreThanAnyOtherWay) {
  constexpr int kSide = 3;
  constexpr int kNodes = kSide * kSide;
  struct Pair {
    int node;
    int other;
    double both_zero;
    double other_one;
    double node_one;
  };
  std::mt19937 random(1988);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::array<std::array<double, 2>, kNodes> costs;
    for (auto& [zero, one] : costs) {
      zero = uniform(random);
      one = uniform(random);
    }
    std::vector<Pair> pairs;
    const auto add = [&](int node, int other) {
      const double first = uniform(random);
      const double second = uniform(random);
      pairs.push_back({node, other, (first + second) * uniform(random), first, second});
    };
    for (int node = 0; node < kNodes; ++node) {
      if (node % kSide + 1 < kSide) add(node, node + 1);
      if (node + kSide < kNodes) add(node, node + kSide);
    }
    const auto energy = [&](auto&& is_one) {
      double sum = 0;
      for (int node = 0; node < kNodes; ++node) sum += costs[node][is_one(node) ? 1 : 0];
      for (const Pair& pair : pairs) {
        const bool node_one = is_one(pair.node);
        const bool other_one = is_one(pair.other);
        if (!node_one) sum += other_one ? pair.other_one : pair.both_zero;
        if (node_one && !other_one) sum += pair.node_one;
      }
      return sum;
    };
    BinaryCut cut(kNodes);
    for (int node = 0; node < kNodes; ++node) cut.AddCosts(node, costs[node][0], costs[node][1]);
    for (const Pair& pair : pairs) {
      cut.AddPairCosts(pair.node, pair.other, pair.both_zero, pair.other_one, pair.node_one);
    }
    cut.Solve();
    double least = 1e300;
    for (int way = 0; way < 1 << kNodes; ++way) {
      least = std::min(least, energy([way](int node) { return (way >> node & 1) != 0; }));
    }
    EXPECT_NEAR(energy([&](int node) { return cut.IsOne(node); }), least, 1e-9) << trial;
  }
}

}  // namespace
}  // namespace groundglass
