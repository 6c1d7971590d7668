// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/synth.h"

#include "datasets-synthetic/surface_truth.h"
#include "evaluate/evaluate.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> ReadFolder(const fs::path& folder) {
  std::map<std::string, std::string> bytes_of_name;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    bytes_of_name[fs::relative(entry.path(), folder).string()] = bytes.str();
  }
  return bytes_of_name;
}

SynthRecipe SmallRecipe() {
  SynthRecipe recipe = PresetRecipe("wiesner");
  recipe.width_px = 120;
  recipe.height_px = 80;
  recipe.num_views = 5;
  recipe.surface_texel = 0.5;
  return recipe;
}

TEST(Synth, SameRecipeGivesSameBytesWhateverTheThreads) {
  const TemporaryFolder folder;
  {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    WriteSyntheticScene(SmallRecipe(), folder / "one");
  }
  WriteSyntheticScene(SmallRecipe(), folder / "many");
  const auto one = ReadFolder(folder / "one");
  const auto many = ReadFolder(folder / "many");
  ASSERT_EQ(one.size(), many.size());
  for (const auto& [name, bytes] : one) EXPECT_TRUE(many.at(name) == bytes) << name;

  // What it wrote is a scene as the formats page lays it out, and its truth.
  const Scene scene = ReadScene(folder / "one");
  EXPECT_EQ(scene.photographs.size(), 5u);
  EXPECT_TRUE(scene.warnings.empty());
  const Truth truth = ReadTruth(folder / "one" / "truth");
  EXPECT_EQ(truth.cameras.size(), 5u);
  EXPECT_EQ(truth.novel_views.size(), 3u);
  const Evaluation tags = Evaluate(folder / "one", truth, scene.model);
  EXPECT_GT(tags.all.mean_px, 0.3);
  EXPECT_LT(tags.all.mean_px, 4);  // at 120 px wide

  EXPECT_EQ(ReadCharts(truth.surfaces_folder).size(), scene.model.faces.size());

  // The thesis' own figures, comments aside.
  const ViewTag s5 = ReadView(folder / "one" / "views/s5.view");
  EXPECT_EQ(s5.position_in_site, Eigen::Vector3d(232, -104, 4.5));
  EXPECT_EQ(s5.lookat_in_site, Eigen::Vector3d(104, -2, 33.1));
  EXPECT_EQ(s5.view_angle_deg, 58);
  EXPECT_EQ(s5.aspect, 1.5);

  EXPECT_THAT([&] { WriteSyntheticScene(SmallRecipe(), folder / "one"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("not empty")));
}

// Video frames and mounts have cameras and masks of the picture as written.
TEST(Synth, HardAndVideoPresetsAreScenesToo) {
  const TemporaryFolder folder;
  SynthRecipe recipe = PresetRecipe("hard");
  recipe.width_px = 120;
  recipe.height_px = 80;
  recipe.num_views = 2;
  recipe.surface_texel = 1;
  recipe.photo.ntsc = true;
  WriteSyntheticScene(recipe, folder / "hard");
  const Scene scene = ReadScene(folder / "hard");
  EXPECT_EQ(scene.photographs.front().size.width, 640);
  const Truth truth = ReadTruth(folder / "hard" / "truth");
  EXPECT_EQ(truth.cameras.front().camera.width_px, 640);
  EXPECT_NEAR(truth.cameras.front().camera.k1, -0.03, 1e-9);
  const Image16 masks = ReadLabels(folder / "hard" / "truth/masks_occ/s1.png");
  EXPECT_EQ(masks.width, 640);
  int num_mount = 0;
  for (const uint16_t label : masks.values) num_mount += label == kMount;
  EXPECT_GT(num_mount, 0);
}

class EachPreset : public testing::TestWithParam<std::string> {};

TEST_P(EachPreset, IsAValidSceneWithAllItsTruth) {
  const TemporaryFolder folder;
  SynthRecipe recipe = PresetRecipe(GetParam());
  recipe.width_px = 96;
  recipe.height_px = 64;
  recipe.num_views = 3;
  recipe.surface_texel = 1;
  const SynthSummary summary = WriteSyntheticScene(recipe, folder / "scene");
  const SceneCheck check = CheckScene(folder / "scene");
  EXPECT_THAT(check.faults, testing::IsEmpty());
  EXPECT_THAT(check.scene.warnings, testing::IsEmpty());
  EXPECT_EQ(check.scene.photographs.size(), 3u);
  EXPECT_EQ(static_cast<int>(check.scene.model.faces.size()), summary.num_faces);
  const Truth truth = ReadTruth(folder / "scene" / "truth");
  EXPECT_EQ(truth.cameras.size(), 3u);
  EXPECT_FALSE(truth.novel_views.empty());
  EXPECT_EQ(static_cast<int>(ReadCharts(truth.surfaces_folder).size()), summary.num_faces);
  for (const fs::path& masks : {truth.masks_model_folder, truth.masks_occ_folder}) {
    const Image16 labels = ReadLabels(masks / "s1.png");
    EXPECT_EQ(labels.width, truth.cameras.front().camera.width_px);
    EXPECT_GT(std::count_if(labels.values.begin(),
                            labels.values.end(),
                            [&](int label) { return label > 0 && label <= summary.num_faces; }),
              96 * 64 / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         EachPreset,
                         testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const SynthPreset& preset : ListSynthPresets()) {
                             names.push_back(preset.name);
                           }
                           return names;
                         }()),
                         [](const auto& test) { return test.param; });

// 16 bits hold more greys than 8, and the truth knows which tags are wrong.
TEST(Synth, SixteenBitScansAndBlundersAreInTheScene) {
  const TemporaryFolder folder;
  SynthRecipe recipe = SmallRecipe();
  recipe.photo.bits = 16;
  recipe.notebook.blunders = 3;
  recipe.photo.light = "so";
  const SynthSummary summary = WriteSyntheticScene(recipe, folder / "scene");
  EXPECT_EQ(summary.num_blunders, 3);
  EXPECT_LT(summary.mean_tag_error_px, 4);  // of the two others, at 120 px wide
  const ImageF radiance = ReadRadiance(folder / "scene/images/s2.tif");
  const std::set<float> reds(radiance.values.begin(), radiance.values.end());
  EXPECT_GT(reds.size(), 2000u);
  EXPECT_TRUE(CheckScene(folder / "scene").faults.empty());
  std::ifstream in(folder / "scene/truth/truth.json");
  std::ostringstream json;
  json << in.rdbuf();
  for (const char* part : {"\"blunder\": \"swapped coordinates\"",
                           "\"blunder\": \"wrong sign\"",
                           "\"blunder\": \"wrong photograph\"",
                           "\"blunder\": \"none\"",
                           "\"kind\": \"sun\"",
                           "\"kind\": \"overcast\""}) {
    EXPECT_THAT(json.str(), testing::HasSubstr(part));
  }
}

TEST(Recipe, ReadsBackAsWrittenAndOverridesSingleFields) {
  SynthRecipe recipe = PresetRecipe("pure");
  ApplyRecipeJson(R"({"seed": 7, "photo": {"grain": 0.05}})", "r.json", recipe);
  EXPECT_EQ(recipe.seed, 7u);
  EXPECT_EQ(recipe.photo.grain, 0.05);
  EXPECT_EQ(recipe.slide.sigma_shift, 0);
  SynthRecipe copy = PresetRecipe("wiesner");
  ApplyRecipeJson(FormatRecipe(recipe), "copy.json", copy);
  copy.preset = recipe.preset;
  EXPECT_EQ(FormatRecipe(copy), FormatRecipe(recipe));
}

TEST(Recipe, WrongFieldsAreErrorsThatNameThem) {
  SynthRecipe recipe = PresetRecipe("wiesner");
  EXPECT_THAT([&] { ApplyRecipeJson(R"({"photo": {"gain": 1}})", "r.json", recipe); },
              testing::ThrowsMessage<Error>("r.json: unknown recipe field photo/gain"));
  EXPECT_THAT([&] { ApplyRecipeJson(R"({"photo": {"grain": "much"}})", "r.json", recipe); },
              testing::ThrowsMessage<Error>(
                  "r.json: recipe field photo/grain is not of the kind expected"));
  EXPECT_THAT([] { PresetRecipe("louvre"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("there are wiesner, pure")));
  recipe.slide.sigma_shift = -1;
  EXPECT_THAT([&] { recipe.Check(); },
              testing::ThrowsMessage<Error>("recipe field slide/sigma_shift must not be negative"));
}

}  // namespace
}  // namespace groundglass
