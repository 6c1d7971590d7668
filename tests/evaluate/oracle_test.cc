// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/oracle.h"

#include "datasets-synthetic/occluders.h"
#include "evaluate/evaluate.h"
#include "invrender/photos/face_mask.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/srgb.h"
#include "scene/visibility.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// A wall from (0, 0) to (24, 12) and a post before its middle.
struct PostedWall {
  TemporaryFolder folder;
  PolygonModel model;
  int wall = AddWall(model, 0, 24, 0, 12);
  int post = AddWall(model, 11, 13, 0, 12, -5);

  OraclePhotograph Photograph(const std::string& name, const Camera& camera, const Paint& paint) {
    return {PhotographPainted(model, camera, paint, folder.path(), name).image_file, camera, {}};
  }
};

Image8 Srgb8(const ImageF& radiance) {
  Image8 srgb8(radiance.width, radiance.height, 3);
  for (size_t i = 0; i < radiance.values.size(); ++i) {
    srgb8.values[i] = static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(radiance.values[i])));
  }
  return srgb8;
}

TEST(Oracle, FindsTheTruthAgainWherePhotographsShowIt) {
  PostedWall scene;
  const Paint waves = [](int, const Eigen::Vector3d& point) { return Waves(point); };
  const std::vector<OraclePhotograph> photographs = {
      scene.Photograph("a", LookAt({4, -22, 5}, {10, 0, 6}, 480, 320, 330), waves),
      scene.Photograph("b", LookAt({20, -22, 7}, {14, 0, 6}, 480, 320, 330), waves)};
  const Camera novel = LookAt({12, -28, 6}, {12, 0, 6}, 400, 260, 330);
  const Image8 truth = Srgb8(TakePhotograph(scene.model, novel, waves));
  const OraclePicture oracle = RenderOracle(scene.model, photographs, std::vector{novel})[0];
  const Image16 labels = MakeFaceMask(scene.model, Visibility(scene.model), novel);
  const PictureErrors errors = ComparePictures(truth, oracle.srgb8, labels, oracle.covered);
  EXPECT_EQ(errors.coverage, 1);
  EXPECT_GT(errors.psnr_db, 38);
  EXPECT_GT(errors.ssim, 0.98);
  for (const double gain : errors.gain) EXPECT_NEAR(gain, 1, 0.003);
  // Away from the post's outline, where photographs' pixels mix post and wall, codes are right.
  for (const int x : {60, 120, 330}) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(oracle.srgb8.At(x, 130)[c], truth.At(x, 130)[c], 1);
  }
}

// Each photograph sees the scene in one grey of its own, which tells who was asked.
TEST(Oracle, AsksTheSharpestOfThosePhotographsThatSeeTheVeryPlace) {
  PostedWall scene;
  const auto grey = [](float value) {
    return [value](int, const Eigen::Vector3d&) { return Eigen::Array3f::Constant(value).eval(); };
  };
  // The near one stands square before the post; the far one to the left sees behind it.
  const Camera near = LookAt({12, -18, 6}, {12, 0, 6}, 480, 320, 330);
  const Camera far = LookAt({-8, -26, 6}, {12, 0, 6}, 480, 320, 330);
  std::vector<OraclePhotograph> photographs = {scene.Photograph("near", near, grey(0.2f)),
                                               scene.Photograph("far", far, grey(0.6f))};
  const Camera novel = LookAt({0, -30, 6}, {12, 0, 6}, 400, 260, 330);
  const auto code_at = [&](const OraclePicture& oracle, const Eigen::Vector3d& point) {
    const Eigen::Vector2d px = *Project(novel, point);
    return static_cast<int>(*oracle.srgb8.At(static_cast<int>(px.x()), static_cast<int>(px.y())));
  };
  const auto code_of = [](float value) {
    return static_cast<int>(std::lround(255 * SrgbFromLinear(value)));
  };
  const OraclePicture both = RenderOracle(scene.model, photographs, std::vector{novel})[0];
  EXPECT_NEAR(code_at(both, {6, 0, 6}), code_of(0.2f), 1);
  EXPECT_NEAR(code_at(both, {12, -5, 6}), code_of(0.2f), 1);  // the post itself
  EXPECT_NEAR(code_at(both, {11, 0, 6}), code_of(0.6f), 1);   // behind it, for the near one
  photographs.pop_back();
  const OraclePicture alone = RenderOracle(scene.model, photographs, std::vector{novel})[0];
  const Eigen::Vector2d hidden = *Project(novel, {11, 0, 6});
  EXPECT_EQ(*alone.covered.At(static_cast<int>(hidden.x()), static_cast<int>(hidden.y())), 0);
  EXPECT_NEAR(code_at(alone, {6, 0, 6}), code_of(0.2f), 1);

  // The mount of the near slide is not the wall.
  Image16 codes(480, 320, 1);
  for (int y = 0; y < 320; ++y) {
    for (int x = 0; x < 240; ++x) *codes.At(x, y) = kMount;
  }
  photographs[0].occlusion_mask_file = scene.folder / "occ.png";
  WriteLabels(*photographs[0].occlusion_mask_file, codes);
  const OraclePicture mounted = RenderOracle(scene.model, photographs, std::vector{novel})[0];
  const Eigen::Vector2d left = *Project(novel, {6, 0, 6});
  EXPECT_EQ(*mounted.covered.At(static_cast<int>(left.x()), static_cast<int>(left.y())), 0);
  EXPECT_NEAR(code_at(mounted, {20, 0, 6}), code_of(0.2f), 1);
}

TEST(Oracle, APhotographThatDoesNotFitItsCameraIsAnError) {
  PostedWall scene;
  const Paint waves = [](int, const Eigen::Vector3d& point) { return Waves(point); };
  std::vector<OraclePhotograph> photographs = {
      scene.Photograph("a", LookAt({4, -22, 5}, {10, 0, 6}, 48, 32, 33), waves)};
  photographs[0].camera.width_px = 50;
  EXPECT_THAT(ThrownMessage([&] {
                RenderOracle(scene.model, photographs, std::vector{photographs[0].camera});
              }),
              testing::HasSubstr("is 48x32 px, but its true camera is for 50x32"));
}

// An untextured model, judged by the brick scene's novel views.
Evaluation EvaluateNothing(const Truth& truth) {
  const TemporaryFolder folder;
  TexturedModel untextured;
  untextured.model = ReadModel(kBrick / "model.osu").model;
  untextured.faces.resize(untextured.model.faces.size());
  WriteGlb(folder / "model.glb", untextured);
  EvaluateOptions options;
  options.render = [](const TexturedModel&, const Camera& camera) {
    return Image8(camera.width_px, camera.height_px, 3, 128);
  };
  return Evaluate(folder.path(), truth, untextured.model, options);
}

TEST(Oracle, StandsBesideEachNovelViewInTableAndJson) {
  Truth truth = ReadTruth(kBrick / "truth");
  truth.novel_views.resize(1);
  const Evaluation evaluation = EvaluateNothing(truth);
  ASSERT_EQ(evaluation.novel_views.size(), 1u);
  ASSERT_TRUE(evaluation.novel_views[0].oracle);
  EXPECT_GT(evaluation.novel_views[0].oracle->coverage, 0.98);
  EXPECT_GT(evaluation.novel_views[0].oracle->psnr_db, evaluation.novel_views[0].errors.psnr_db);
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  EXPECT_THAT(FormatEvaluationTable(evaluation, model), testing::HasSubstr("; oracle "));
  EXPECT_THAT(FormatEvaluationJson(evaluation, model), testing::HasSubstr("\"oracle\": {"));
}

TEST(Oracle, WithoutPhotographsBesideTheTruthTheReasonIsTold) {
  const TemporaryFolder folder;
  Truth truth = ReadTruth(kBrick / "truth");
  truth.novel_views.resize(1);
  truth.folder = folder / "truth";
  const Evaluation evaluation = EvaluateNothing(truth);
  ASSERT_EQ(evaluation.novel_views.size(), 1u);
  EXPECT_FALSE(evaluation.novel_views[0].oracle);
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  EXPECT_THAT(FormatEvaluationTable(evaluation, model),
              testing::HasSubstr("has no photograph called s1"));
  EXPECT_THAT(FormatEvaluationJson(evaluation, model), testing::HasSubstr("why_no_oracle"));
}

}  // namespace
}  // namespace groundglass
