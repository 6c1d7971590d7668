// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/evaluate.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/textured_model_io.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace groundglass {
namespace {

PolygonModel BrickModel() { return ReadOsu(kBrick / "model.osu").model; }

TEST(Evaluate, TheTruthHasNoError) {
  const Truth truth = ReadTruth(kBrick / "truth");
  const Evaluation evaluation = Evaluate(kBrick / "truth" / "cameras", truth, BrickModel());
  EXPECT_EQ(evaluation.all.count, 12);
  EXPECT_LT(evaluation.all.max_px, 1e-9);
  EXPECT_EQ(evaluation.num_wrong_accepted, 0);
}

// The brick scene's README, whose figures come from another program.
TEST(Evaluate, TheBrickHandTagsAreSixteenPointEightPixelsOff) {
  const Truth truth = ReadTruth(kBrick / "truth");
  const Evaluation evaluation = Evaluate(kBrick, truth, BrickModel());
  EXPECT_EQ(evaluation.photographs.front().name, "s1");
  EXPECT_EQ(evaluation.photographs.back().name, "s12");
  EXPECT_NEAR(evaluation.all.mean_px, 16.81, 0.05);
  EXPECT_NEAR(evaluation.all.median_px, 16.48, 0.05);
  EXPECT_NEAR(evaluation.photographs.front().errors.vertex.mean_px, 6.44, 0.05);
  EXPECT_NEAR(evaluation.photographs.front().errors.vertex.max_px, 11.75, 0.05);
  EXPECT_THAT(FormatEvaluationTable(evaluation, BrickModel()), testing::HasSubstr("mean 16.8"));
}

TEST(Evaluate, ATrueCameraWithoutAFoundOneIsListed) {
  Truth truth = ReadTruth(kBrick / "truth");
  truth.cameras.push_back({"s99", truth.cameras.front().camera});
  EXPECT_THAT(Evaluate(kBrick, truth, BrickModel()).missing, testing::ElementsAre("s99"));
}

TEST(Evaluate, AFolderWithoutCamerasIsAnError) {
  const Truth truth = ReadTruth(kBrick / "truth");
  EXPECT_THAT([&] { ReadFoundCameras(kBrick / "images", truth); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("no cameras here; expected")));
}

TEST(Evaluate, AMaskOfAnotherSizeIsNamed) {
  const TemporaryFolder folder;
  std::filesystem::copy(kBrick / "truth" / "cameras", folder.path());
  std::filesystem::create_directories(folder / "faces");
  WriteLabels(folder / "faces" / "s1.png", Image16(6, 4, 1));
  EXPECT_THAT([&] { Evaluate(folder.path(), ReadTruth(kBrick / "truth"), BrickModel()); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr("s1.png"),
                                 testing::HasSubstr("is 6 x 4 pixels, and its truth 1200"))));
}

// A textured model whose cameras are kept elsewhere; without texture it covers nothing.
TEST(Evaluate, AModelAloneIsJudgedByItsNovelViews) {
  const TemporaryFolder folder;
  TexturedModel untextured;
  untextured.model = BrickModel();
  untextured.faces.resize(untextured.model.faces.size());
  WriteGlb(folder / "model.glb", untextured);
  EvaluateOptions options;
  options.render = [](const TexturedModel&, const Camera& camera) {
    return Image8(camera.width_px, camera.height_px, 3, 128);
  };
  const Evaluation evaluation =
      Evaluate(folder.path(), ReadTruth(kBrick / "truth"), BrickModel(), options);
  EXPECT_TRUE(evaluation.photographs.empty());
  ASSERT_EQ(evaluation.novel_views.size(), 3u);
  EXPECT_EQ(evaluation.novel_views[0].errors.coverage, 0);
  EXPECT_LT(evaluation.novel_views[0].errors.psnr_db, 20);
  const std::string table = FormatEvaluationTable(evaluation, BrickModel());
  EXPECT_THAT(table, testing::HasSubstr("novel view n1"));
  EXPECT_THAT(table, testing::Not(testing::HasSubstr("vertex")));
}

TEST(CoveredPixels, ProvenanceSaysWhichHalfOfAWallIsTextured) {
  TexturedModel model;
  model.model.points_in_world = {{-5, 20, -5}, {5, 20, -5}, {5, 20, 5}, {-5, 20, 5}};
  model.model.faces = {{{0, 1, 2, 3}, "wall"}};
  model.faces = {{0, {{10, 30}, {30, 30}, {30, 10}, {10, 10}}}};
  model.pages = {{Image8(40, 40, 3), Image16(40, 40, 1)}};
  for (int y = 0; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) *model.pages[0].provenance.At(x, y) = 1;
  }
  ViewTag tag;
  tag.lookat_in_site = {0, -20, 0};
  tag.view_angle_deg = 90;
  const Image8 covered = CoveredPixels(model, CameraFromTag(tag, 600, 400));
  EXPECT_EQ(*covered.At(290, 200), 0);    // the wall's west half, just left of the centre
  EXPECT_EQ(*covered.At(310, 200), 255);  // its east half
  EXPECT_EQ(*covered.At(310, 120), 0);    // above the wall: 75 px is its half height
}

}  // namespace
}  // namespace groundglass
