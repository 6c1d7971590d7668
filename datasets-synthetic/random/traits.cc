// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/traits.h"

#include "scene/check_option.h"
#include "scene/error.h"

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

void CheckOneOf(const std::string& value,
                const std::vector<std::string>& known,
                const std::string& field) {
  if (std::find(known.begin(), known.end(), value) != known.end()) return;
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "" : ", ") + word;
  throw Error("recipe field random/" + field + " must be one of " + list + ", not " + value);
}

}  // namespace

void RandomTraits::Check() const {
  CheckOneOf(plan, {"rectangle", "L", "T", "U", "courtyard", "tower", "wings"}, "plan");
  CheckOneOf(roof, {"flat", "gabled", "hipped", "mono"}, "roof");
  CheckOneOf(cladding, {"brick", "stone", "plaster", "tile", "concrete", "glass"}, "cladding");
  CheckOneOf(windows, {"grid", "pairs", "bands", "irregular", "single"}, "windows");
  CheckOneOf(neighbours, {"none", "left", "right", "both"}, "neighbours");
  CheckOneOf(ground, {"paving", "grass", "asphalt"}, "ground");
  CheckOneOf(model.detail, {"massing", "openings", "recesses", "mullions"}, "model/detail");
  CheckFromTo(width, 20, 400, "recipe field random/width");
  CheckFromTo(depth, 20, 400, "recipe field random/depth");
  CheckFromTo(storeys, 1, 30, "recipe field random/storeys");
  CheckFromTo(storey_height, 8, 20, "recipe field random/storey_height");
  CheckFromTo(setbacks, 0, 3, "recipe field random/setbacks");
  CheckFromTo(corner_radius, 0, 15, "recipe field random/corner_radius");
  CheckFromTo(pitch, 0.1, 2, "recipe field random/pitch");
  CheckFromTo(overhang, 0, 4, "recipe field random/overhang");
  CheckFromTo(parapet, 0, 6, "recipe field random/parapet");
  CheckFromTo(chimneys, 0, 4, "recipe field random/chimneys");
  CheckFromTo(dormers, 0, 6, "recipe field random/dormers");
  CheckFromTo(bay, 4, 40, "recipe field random/bay");
  CheckFromTo(window_width, 1, 30, "recipe field random/window_width");
  CheckFromTo(window_height, 1, 15, "recipe field random/window_height");
  CheckFromTo(blind_share, 0, 1, "recipe field random/blind_share");
  CheckFromTo(recess, 0, 1.5, "recipe field random/recess");
  CheckFromTo(cornice, 0, 3, "recipe field random/cornice");
  CheckFromTo(steps, 0, 8, "recipe field random/steps");
  CheckFromTo(view_angle_low_deg, 10, 110, "recipe field random/view_angle_low_deg");
  CheckFromTo(
      view_angle_high_deg, view_angle_low_deg, 110, "recipe field random/view_angle_high_deg");
  CheckFromTo(model.sigma, 0, 1, "recipe field random/model/sigma");
  CheckFromTo(model.wall_off, -3, 3, "recipe field random/model/wall_off");
  CheckFromTo(model.eaves_off, -3, 3, "recipe field random/model/eaves_off");
  CheckFromTo(model.windows_off, -3, 3, "recipe field random/model/windows_off");
}

}  // namespace groundglass
