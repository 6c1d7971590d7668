// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"
#include "scene/frames.h"

#include <cmath>

namespace groundglass {
namespace {

double ToHalfFeet(double length) { return std::round(2 * length) / 2; }

}  // namespace

std::vector<PlannedView> MakeRingOfViews(const Box& bounds,
                                         int count,
                                         double distance,
                                         double start_deg,
                                         double eye_height,
                                         const std::string& prefix,
                                         int first_number) {
  std::vector<PlannedView> views;
  const Eigen::Vector3d center = bounds.Center();
  const Eigen::Vector3d half = (bounds.max - bounds.min) / 2;
  for (int i = 0; i < count; ++i) {
    const double angle = RadiansFromDegrees(start_deg + 360.0 * i / count);
    const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d position(center.x() + (half.x() + distance) * outward.x(),
                                   center.y() + (half.y() + distance) * outward.y(),
                                   eye_height);
    // A point of the near side, a little towards the middle, where it fills the frame.
    const Eigen::Vector3d lookat(center.x() + 0.6 * half.x() * outward.x(),
                                 center.y() + 0.6 * half.y() * outward.y(),
                                 bounds.min.z() + 0.48 * (bounds.max.z() - bounds.min.z()));
    PlannedView view;
    view.name = prefix + std::to_string(first_number + i);
    view.position_in_site = SiteFromWorld(position).unaryExpr(&ToHalfFeet);
    view.lookat_in_site = SiteFromWorld(lookat).unaryExpr(&ToHalfFeet);
    views.push_back(view);
  }
  return views;
}

}  // namespace groundglass
