// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/edge_samples.h"
#include "register/joint/joint_refinement.h"
#include "register/refine/group_profile.h"
#include "register/register_options.h"
#include "scene/formats/lens.h"
#include "scene/image.h"
#include "scene/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A photograph as it is registered.
struct PhotographInput {
  std::string name;
  Image8 grey8;   // 1 channel
  Image8 ignore;  // same size, non-zero where it is no evidence; may be empty
  ViewTag measured;
  std::optional<Lens> lens;
  std::vector<NamedTag> other_tags = {};  // of the scene's other photographs
  // Whether it is asked for groups of edges elsewhere (FindDisplacedGroups), which takes a third
  // longer.
  bool asks_for_groups = false;
};

// A photograph that was aligned by itself, with what refining it together with others needs. Its
// verdict does not heed yet how certain the camera is (FinishVerdict).
struct PhotographAlignment {
  Registration registration = {};
  // As it was found; empty where the photograph was rejected, or a person pointed at places.
  AlignedPhotograph aligned = {};
  // Of a photograph in `review`, as its second-best camera has it; nothing if there is
  // none.
  std::optional<AlignedPhotograph> second_best = {};
  // What edges, tag and reading say for its best camera in all, nats; 0 where nothing was found.
  double total_nats = 0;
  // How it would suit groups of edges elsewhere, if that was asked; not of one that was rejected.
  std::vector<GroupProfile> group_profiles = {};
  // Whether edges alone tell its camera from all others, with its tag as it was written.
  bool is_clear = false;
  // Between the parts of the model's drawing, at the camera that was found last, in pixels of the
  // picture in which it was registered.
  std::optional<EdgeConflict> conflict = {};
  // Why options.keep_folder does not have what it should; empty if it has.
  std::string keep_fault = {};
};

// Corrects one photograph's tag against the model's edges. Not converging is a result (verdict,
// reasons), not an error. Throws Error for options out of range.
PhotographAlignment AlignPhotograph(const PhotographInput& photograph,
                                    const EdgeModel& edge_model,
                                    const RegisterOptions& options);

// The last word on a photograph: `review` where it stays uncertain, and what a person decides.
void FinishVerdict(const RegisterOptions& options, PhotographAlignment& alignment);

}  // namespace groundglass
