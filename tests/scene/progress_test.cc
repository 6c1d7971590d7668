// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace groundglass {
namespace {

TEST(ProgressCounter, CountsEveryStepOnceFromManyThreads) {
  std::vector<int> told;
  const Progress progress = [&](int done, int total, const std::string& what) {
    told.push_back(done);
    EXPECT_EQ(total, 40);
    EXPECT_EQ(what, "step");
  };
  ProgressCounter counter(progress, 40);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&] {
      for (int step = 0; step < 10; ++step) counter.Tell("step");
    });
  }
  for (std::thread& thread : threads) thread.join();
  ASSERT_EQ(told.size(), 40u);
  for (int step = 0; step < 40; ++step) EXPECT_EQ(told[static_cast<size_t>(step)], step + 1);
}

TEST(ProgressCounter, NobodyNeedListen) {
  const Progress nobody;
  ProgressCounter(nobody, 1).Tell("step");
}

}  // namespace
}  // namespace groundglass
