// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace groundglass {

// How algorithms tell how far they are: `done` of `total` steps, and what the last one was.
// May be called from several threads, one at a time. An empty function is allowed.
using Progress = std::function<void(int done, int total, const std::string& what)>;

// Counts the steps of work that several threads do, and tells of each.
class ProgressCounter {
 public:
  // `progress` must outlive it.
  ProgressCounter(const Progress& progress, int total) : progress_(progress), total_(total) {}
  void Tell(const std::string& what) {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, total_, what);
  }

 private:
  const Progress& progress_;
  int total_;
  int done_ = 0;
  std::mutex mutex_;
};

}  // namespace groundglass
