// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/view_tag.h"

#include <cmath>
#include <cstdio>

// The camera of Thorman's s5.view (1988, Figure 2) stands where the notebook says.
int main() {
  groundglass::ViewTag tag;
  tag.position_in_site = {232, -104, 4.5};
  tag.lookat_in_site = {104, -2, 33.1};
  const groundglass::Camera camera = groundglass::CameraFromTag(tag, 1500, 1000);
  const Eigen::Vector3d position = groundglass::SiteFromWorld(camera.PositionInWorld());
  std::printf("camera at %g %g %g\n", position.x(), position.y(), position.z());
  return (position - tag.position_in_site).norm() < 1e-9 ? 0 : 1;
}
