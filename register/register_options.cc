// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_options.h"

#include "scene/check_option.h"

namespace groundglass {

void DisplacedGroupOptions::Check(const std::string& path) const {
  profile.Check(path + "profile.");
  CheckAtLeast(least_offset_sigmas, 0, path + "least_offset_sigmas");
  CheckAtLeast(least_suspicion_nats, 0, path + "least_suspicion_nats");
  CheckAtLeast(least_photographs, 1, path + "least_photographs");
  CheckFromTo(most_trials, 0, 100, path + "most_trials");
  CheckAbove(most_nats_of_photograph, 0, path + "most_nats_of_photograph");
  CheckAtLeast(least_nats_of_photograph, 0, path + "least_nats_of_photograph");
  CheckAtLeast(least_gain_nats, 0, path + "least_gain_nats");
  CheckAbove(doubtful_nats, 0, path + "doubtful_nats");
}

void RegisterOptions::Check() const {
  const std::string path = "registration options: ";
  prior.Check();
  solutions.Check(path + "solutions.");
  readings.Check(path + "readings.");
  overclaim.Check(path + "overclaim.");
  displaced.Check(path + "displaced.");
  ties.Check(path + "ties.");
  colmap.Check(path + "colmap.");
  tie_support.Check(path + "tie_support.");
  joint.Check(path + "joint.");
  model_errors.Check(path + "model_errors.");
  conflict.Check(path + "conflict.");
  verdict.Check(path + "verdict.");
  overrule.Check();
  CheckFromTo(num_tie_rounds, 1, 100, path + "num_tie_rounds");
  CheckFromTo(max_width_px, 64, 100000, path + "max_width_px");
  for (const ControlPoint& point : control_points) {
    const std::string of = path + "control_points of " + point.photograph + ": ";
    // A sum is finite if its terms are.
    CheckFinite(point.image_px.sum(), of + "image_px");
    CheckFinite(point.point_in_world.sum(), of + "point_in_world");
    CheckAbove(point.sigma_px, 0, of + "sigma_px");
  }
}

}  // namespace groundglass
