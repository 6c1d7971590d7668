// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/invrender.h"
#include "scene/error.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

// Two walls at a corner, seen by four photographs.
struct Corner {
  TemporaryFolder folder;
  PolygonModel model;
  std::vector<BakePhotograph> photographs;

  Corner() {
    AddWall(model, 0, 20, 0, 10);
    AddFace(model, {{20, 0, 0}, {28, 6, 0}, {28, 6, 10}, {20, 0, 10}});
    const Paint waves = [](int, const Eigen::Vector3d& point) { return Waves(point); };
    for (int i = 0; i < 4; ++i) {
      const Camera camera = LookAt({4.0 + 6 * i, -22, 5}, {10.0 + 3 * i, 0, 5}, 320, 240, 260);
      photographs.push_back(
          PhotographPainted(model, camera, waves, folder.path(), "s" + std::to_string(i)));
    }
  }
};

TEST(Memory, ALimitThatSufficesChangesNoTexel) {
  const Corner corner;
  BakeOptions limited;
  limited.max_memory_mb = 300;
  const BakeResult free = BakeTextures(corner.model, corner.photographs);
  const BakeResult bound = BakeTextures(corner.model, corner.photographs, limited);
  EXPECT_EQ(bound.texel_scale, 1);
  ASSERT_EQ(free.model.pages.size(), bound.model.pages.size());
  for (size_t i = 0; i < free.model.pages.size(); ++i) {
    EXPECT_TRUE(free.model.pages[i].srgb8.values == bound.model.pages[i].srgb8.values);
    EXPECT_TRUE(free.model.pages[i].provenance.values == bound.model.pages[i].provenance.values);
  }
  EXPECT_EQ(FormatCoverage(free.coverage), FormatCoverage(bound.coverage));
}

TEST(Memory, WhereThePagesWouldBeTooLargeTexelsAreLarger) {
  const Corner corner;
  BakeOptions options;
  options.texel_size = 0.01;
  options.max_memory_mb = 300;
  const BakeResult result = BakeTextures(corner.model, corner.photographs, options);
  EXPECT_GT(result.texel_scale, 1.2);
  for (const FaceCoverage& face : result.coverage.faces) {
    EXPECT_NEAR(face.texel_size, 0.01 * result.texel_scale, 1e-9);
    EXPECT_GT(face.covered_area, 0.5 * face.area);
  }
  // With more memory, finer texels again.
  options.max_memory_mb = 350;
  EXPECT_LT(BakeTextures(corner.model, corner.photographs, options).texel_scale,
            result.texel_scale - 0.2);
}

TEST(Memory, ALimitThatNothingCanHoldIsAnError) {
  const Corner corner;
  BakeOptions options;
  options.max_memory_mb = 50;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(corner.model, corner.photographs, options); }),
              testing::MatchesRegex(
                  "these photographs need at least [0-9]+ MB of memory, the limit is 50"));
  options.max_memory_mb = -1;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(corner.model, corner.photographs, options); }),
              testing::HasSubstr("max_memory_mb"));
}

}  // namespace
}  // namespace groundglass
