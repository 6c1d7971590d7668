// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// The whole lens: a barrel, and a decentred one, that moves the picture's corners by tens of
// pixels. The photograph is cast ray by ray, so the texture must fall where the paint is.
TEST(BakeTextures, AWholeLensPutsTheTextureInPlace) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 40, 0, 25);
  Camera camera = LookAt({18, -25, 10}, {20, 0, 12}, 320, 240, 250);
  camera.k1 = -0.12;
  camera.k2 = 0.03;
  camera.k3 = -0.01;
  camera.p1 = 0.012;
  camera.p2 = -0.02;
  const auto waves = [](int, const Eigen::Vector3d& point) { return Waves(point); };
  BakeOptions options;
  options.match_colour = false;
  options.reject_occluders = false;
  const auto rms_with = [&](const Camera& assumed) {
    BakePhotograph photograph = PhotographPainted(model, camera, waves, folder.path(), "s1");
    photograph.camera = assumed;
    const BakeResult result = BakeTextures(model, std::vector{photograph}, options);
    double sum = 0;
    int count = 0;
    for (const PlacedTexel& texel : TexelsOf(result.model, wall)) {
      if (texel.source == 0 || texel.texels_from_border < 5) continue;
      const Eigen::Array3f error = texel.radiance - Waves(texel.point_in_world);
      sum += (error * error).sum() / 3;
      ++count;
    }
    EXPECT_GT(count, 10000);
    return std::sqrt(sum / count);
  };
  EXPECT_LT(rms_with(camera), 0.006);
  // What leaving out the tangential terms would do.
  Camera without = camera;
  without.p1 = without.p2 = 0;
  EXPECT_GT(rms_with(without), 0.05);
}

}  // namespace
}  // namespace groundglass
