// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/charts/charts.h"
#include "invrender/charts/spread_points.h"
#include "invrender/measure/texel_size.h"
#include "invrender/photos/prepared_photo.h"
#include "invrender/plan/memory_plan.h"
#include "scene/error.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
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
  limited.memory.max_memory_mb = 300;
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
  options.pages.texel_size = 0.01;
  options.memory.max_memory_mb = 300;
  const BakeResult result = BakeTextures(corner.model, corner.photographs, options);
  EXPECT_GT(result.texel_scale, 1.2);
  for (const FaceCoverage& face : result.coverage.faces) {
    EXPECT_NEAR(face.texel_size, 0.01 * result.texel_scale, 1e-9);
    EXPECT_GT(face.covered_area, 0.5 * face.area);
  }
  // With more memory, finer texels again.
  options.memory.max_memory_mb = 350;
  EXPECT_LT(BakeTextures(corner.model, corner.photographs, options).texel_scale,
            result.texel_scale - 0.2);
}

TEST(Memory, FarFinerTexelsThanThePhotographsResolveAreTold) {
  const Corner corner;
  EXPECT_THAT(BakeTextures(corner.model, corner.photographs).remarks, testing::IsEmpty());
  BakeOptions options;
  options.pages.texel_size = 0.01;
  EXPECT_THAT(BakeTextures(corner.model, corner.photographs, options).remarks,
              testing::ElementsAre(testing::HasSubstr("as the photographs resolve")));
}

TEST(Memory, ALimitThatNothingCanHoldIsAnError) {
  const Corner corner;
  BakeOptions options;
  options.memory.max_memory_mb = 50;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(corner.model, corner.photographs, options); }),
              testing::MatchesRegex(
                  "these photographs need at least [0-9]+ MB of memory, the limit is 50"));
  options.memory.max_memory_mb = -1;
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(corner.model, corner.photographs, options); }),
              testing::HasSubstr("max_memory_mb"));
}

// The brick scene's cameras, enlarged, with a photograph of nothing that all of them share.
struct LargeBrick {
  static constexpr int kWidth = 2403;  // no multiple of the mask's pixels
  static constexpr int kHeight = 1602;
  TemporaryFolder folder;
  PolygonModel model;
  std::vector<BakePhotograph> photographs;
  BakeOptions options;
  Visibility visibility;
  std::vector<Chart> charts;
  std::vector<int> chart_of_face;
  PhotoCache cache;

  explicit LargeBrick(int num_photographs)
      : model(ReadOsu(Brick() + "/model.osu").model),
        visibility(model),
        charts(MakeCharts(model)),
        chart_of_face(ChartOfFace(charts, model.faces.size())),
        cache({}, 0) {
    options.photos.detect_mount = false;
    WriteSrgb8(folder / "grey.jpg", Image8(kWidth, kHeight, 3, 90));
    const std::vector<NamedCamera> cameras = ReadColmapModel(Brick() + "/truth/cameras");
    for (int i = 0; i < num_photographs; ++i) {
      BakePhotograph& photograph = photographs.emplace_back();
      photograph.name = "s" + std::to_string(i);
      photograph.image_file = folder / "grey.jpg";
      photograph.camera = ResizedCamera(cameras[i % cameras.size()].camera, kWidth, kHeight);
    }
  }
  static std::string Brick() {
    return std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick";
  }
  PreparedPhoto Prepare(int index, const MaskDetail& detail) {
    return PreparePhoto(photographs[index],
                        index,
                        {model, visibility, nullptr, chart_of_face, options.photos, cache},
                        detail);
  }
  std::vector<PreparedPhoto> Survey() {
    std::vector<PreparedPhoto> survey;
    for (size_t i = 0; i < photographs.size(); ++i) {
      survey.push_back(
          Prepare(static_cast<int>(i), {.num_halvings = kSurveyHalvings, .is_survey = true}));
    }
    return survey;
  }
};

TEST(Memory, MasksTakeNoMoreThanASurveyEstimates) {
  LargeBrick brick(2);
  const std::vector<PreparedPhoto> survey = brick.Survey();
  for (int halvings = 0; halvings <= 3; ++halvings) {
    double num_bytes = 0;
    for (int i = 0; i < 2; ++i) {
      num_bytes +=
          static_cast<double>(brick.Prepare(i, {.num_halvings = halvings}).Mask().NumBytes());
    }
    const double estimate = EstimateMaskBytes(survey, halvings);
    EXPECT_LE(num_bytes, estimate) << halvings;
    EXPECT_GE(num_bytes, 0.4 * estimate) << halvings;
    // A pixel takes less than a byte even where it is finest.
    EXPECT_LT(num_bytes, 2.0 * LargeBrick::kWidth * LargeBrick::kHeight);
  }
}

TEST(Memory, CoarseMasksSeeWhatFineOnesSee) {
  LargeBrick brick(1);
  const PreparedPhoto fine = brick.Prepare(0, {});
  for (const int halvings : {1, 2, 3}) {
    const PreparedPhoto coarse = brick.Prepare(0, {.num_halvings = halvings});
    long num_seen = 0;
    long num_different = 0;
    for (size_t i = 0; i < brick.charts.size(); ++i) {
      const ChartInCamera view = fine.View(brick.charts[i], static_cast<int>(i));
      for (const int face : brick.charts[i].faces) {
        for (const Eigen::Vector3d& point : SpreadPoints(brick.model, face)) {
          const Eigen::Vector2d on_plane = brick.charts[i].PlanePoint(point);
          const auto expected = fine.Observe(view, on_plane, face);
          const auto found = coarse.Observe(view, on_plane, face);
          num_seen += expected ? 1 : 0;
          num_different += expected.has_value() != found.has_value() ? 1 : 0;
          if (!expected || !found) continue;
          EXPECT_EQ(found->px_from_unit, expected->px_from_unit);
          EXPECT_LT((found->image_px - expected->image_px).norm(), 0.9);
          // Where the coarse one is sure to be clear of borders, the fine one is.
          if (found->border_px >= 5) {
            EXPECT_GE(expected->border_px, 3);
          }
        }
      }
    }
    EXPECT_GT(num_seen, 500);
    EXPECT_LE(num_different, num_seen / 500) << halvings;
  }
}

TEST(Memory, MasksBecomeCoarserWhereTexelsWouldElseBecomeMuchLarger) {
  LargeBrick brick(60);
  const std::vector<PreparedPhoto> survey = brick.Survey();
  brick.options.pages.texel_size = 0.2;  // so large that only masks and photographs matter
  ChooseTexelSizes(brick.model, survey, brick.options.pages, brick.charts);
  const auto plan = [&](int max_memory_mb) {
    brick.options.memory.max_memory_mb = max_memory_mb;
    return PlanMemory(brick.charts, survey, brick.options.pages, brick.options.memory);
  };
  int limit = 1000;
  ASSERT_EQ(plan(limit).mask_halvings, 0);
  ASSERT_EQ(plan(limit).texel_scale, 1);
  while (plan(limit).mask_halvings == 0) --limit;
  EXPECT_LT(plan(limit).texel_scale, plan(limit + 1).texel_scale);
}

}  // namespace
}  // namespace groundglass
