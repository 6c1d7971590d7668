// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"
#include "session/job.h"
#include "session/session.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

namespace groundglass {

// What registration says of a photograph from this tag on, three or more of its point pins as
// control points. Nothing if `stop` became true meanwhile: it is looked at between the stages, each
// of which takes a fraction of a second. Throws Error if the photograph or its mask cannot be read.
std::optional<AlignmentNews> AlignFromHere(const SessionPhotograph& photograph,
                                           const ViewTag& tag,
                                           const Pins& pins,
                                           const PolygonModel& model,
                                           const std::atomic<bool>& stop);

// What a registration says, as the session keeps it; the corrected tag with the standard deviations
// that the registration gives it.
AlignmentNews NewsOf(const Registration& registration);

// An alignment on a thread of its own. To be used by one thread; the destructor stops what runs.
class AlignmentJob {
 public:
  AlignmentJob() = default;
  ~AlignmentJob() { Stop(); }
  AlignmentJob(const AlignmentJob&) = delete;
  AlignmentJob& operator=(const AlignmentJob&) = delete;

  // on_done is called from the job's thread. One that runs is stopped first.
  void Start(const SessionPhotograph& photograph,
             const ViewTag& tag,
             const Pins& pins,
             const PolygonModel& model,
             const std::function<void()>& on_done);
  // Returns at once: from here on nothing runs as far as anybody sees, and nothing will come of it.
  void Stop();
  bool IsRunning() const { return job_.IsRunning(); }
  // The news once they are there. Throws what the alignment threw.
  std::optional<AlignmentNews> Take();

 private:
  std::shared_ptr<std::atomic<bool>> stop_;
  Job<std::optional<AlignmentNews>> job_;
};

}  // namespace groundglass
