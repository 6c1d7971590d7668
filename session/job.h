// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>
#include <vector>

namespace groundglass {

// Work on a thread of its own, for one who must not wait. To be used by one thread; the destructor
// waits for what still runs.
template <typename Result>
class Job {
 public:
  // on_done is called from the job's thread. Of one that runs nothing will come.
  void Start(std::function<Result()> work, std::function<void()> on_done) {
    Drop();
    running_ = std::async(std::launch::async,
                          [work = std::move(work), on_done = std::move(on_done)]() -> Result {
                            struct Tell {
                              const std::function<void()>& tell;
                              ~Tell() {
                                if (tell) tell();
                              }
                            } const when_done{on_done};
                            return work();
                          });
  }
  // Returns at once: from here on nothing runs as far as anybody sees, and nothing will come of it.
  void Drop() {
    std::erase_if(dropped_, [](const auto& job) { return IsDone(job); });
    if (running_.valid()) dropped_.push_back(std::move(running_));
  }
  bool IsRunning() const { return running_.valid(); }
  // The result once it is there. Throws what the work threw.
  std::optional<Result> Take() {
    if (!running_.valid() || !IsDone(running_)) return std::nullopt;
    return running_.get();
  }
  // Waits for it; nothing if nothing runs.
  std::optional<Result> Wait() {
    if (!running_.valid()) return std::nullopt;
    return running_.get();
  }

 private:
  static bool IsDone(const std::future<Result>& job) {
    return job.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  std::future<Result> running_;
  std::vector<std::future<Result>> dropped_;  // until their threads end
};

}  // namespace groundglass
