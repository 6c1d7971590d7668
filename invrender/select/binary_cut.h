// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <memory>

namespace groundglass {

// Gives each of many nodes a 0 or a 1 so that the sum of their costs is least: a minimum cut, after
// Kolmogorov and Zabih (PAMI 2004), found by Boykov and Kolmogorov's maximum flow (PAMI 2004).
class BinaryCut {
 public:
  explicit BinaryCut(int num_nodes);
  ~BinaryCut();
  BinaryCut(const BinaryCut&) = delete;
  BinaryCut& operator=(const BinaryCut&) = delete;

  // What it costs if the node is 0 or 1.
  void AddCosts(int node, double zero, double one);
  // What two nodes cost together: both 0; the other one 1; the node 1. Both 1 costs nothing. The
  // first must be no more than the sum of the other two, or no cut is sure to be the least.
  void AddPairCosts(int node, int other, double both_zero, double other_one, double node_one);

  void Solve();
  bool IsOne(int node) const;  // after Solve

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace groundglass
