// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <functional>
#include <string>
#include <vector>

namespace groundglass {

// A set of groups of the model's edges (EdgeGroups) that lies elsewhere than it is drawn.
struct DisplacedGroup {
  int set = -1;
  double offset_units = 0;  // model's unit
  double gain_nats = 0;     // how much more the photographs say for it there
  int num_photographs = 0;  // that say so
};

// A wall or eaves that are drawn far from their place hold each photograph at the same wrong
// camera, where they fit and the rest does not: none of them can know, and together they would
// agree. So groups are moved, those that the photographs' profiles (GroupProfile) speak for most,
// and all photographs aligned anew; where that says more for the photographs together, the group is
// taken to lie there. One after the other; edge_model and alignments are as with all of them, and
// what is claimed for a camera covers the one that it has if another part is the misplaced one.
// align_all: aligns every photograph with edge_model as it stands.
std::vector<DisplacedGroup> FindDisplacedGroups(
    const DisplacedGroupOptions& options,
    const std::function<std::vector<PhotographAlignment>()>& align_all,
    EdgeModel& edge_model,
    std::vector<PhotographAlignment>& alignments);

// For a person.
std::string DescribeDisplacedGroup(const DisplacedGroup& displaced, const EdgeModel& edge_model);

}  // namespace groundglass
