// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/random_building.h"

#include "datasets-synthetic/planned_scene.h"
#include "datasets-synthetic/random/draw_recipe.h"
#include "datasets-synthetic/synth.h"
#include "scene/advice/advice.h"
#include "scene/check_face.h"
#include "scene/error.h"
#include "scene/formats/osu_io.h"
#include "scene/visibility.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kNumSeeds = 40;

std::string ReadBytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

// What a camera's grid of rays meets: own faces from the front, from the back, and how near.
struct Sight {
  int num_front = 0;
  int num_back = 0;
  std::set<std::string> backs;
  double nearest = 1e30;
};
Sight LookThrough(const Camera& camera,
                  const PolygonModel& model,
                  const Visibility& visibility,
                  int num_faces) {
  Sight sight;
  for (int y = 10; y < camera.height_px; y += 20) {
    for (int x = 10; x < camera.width_px; x += 20) {
      const auto hit = visibility.FirstHit(camera.PositionInWorld(),
                                           UnprojectToWorld(camera, Eigen::Vector2d(x, y)));
      if (!hit || hit->face >= num_faces) continue;
      ++(hit->is_front ? sight.num_front : sight.num_back);
      if (!hit->is_front) sight.backs.insert(model.faces[hit->face].name);
      sight.nearest = std::min(sight.nearest, hit->distance);
    }
  }
  return sight;
}

// Whether the triangles that stand for a face cover it.
double UncoveredArea(const PolygonModel& model, int face) {
  double area = ComputeFaceArea(model, face);
  for (const auto& [a, b, c] : TriangulateFace(model, face)) {
    const Eigen::Vector3d& origin = model.points_in_world[a];
    area -= (model.points_in_world[b] - origin).cross(model.points_in_world[c] - origin).norm() / 2;
  }
  return area;
}

TEST(RandomBuilding, SoundModelsThatFaceOutwardsInFrontOfEachCamera) {
  std::set<std::string> plans, roofs, details;
  for (uint64_t seed = 1; seed <= kNumSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SynthRecipe recipe = DrawRandomRecipe(seed);
    recipe.Check();
    plans.insert(recipe.random.plan);
    roofs.insert(recipe.random.roof);
    details.insert(recipe.random.model.detail);
    const PlannedScene planned = PlanScene(recipe);
    for (const PolygonModel* model :
         {&planned.model, &*planned.exact_model, &planned.world.geometry}) {
      for (int face = 0; face < static_cast<int>(model->faces.size()); ++face) {
        const FaceCheck check = CheckFace(*model, face);
        EXPECT_EQ(check.fault, "") << DescribeFace(*model, face);
        EXPECT_EQ(check.warning, "") << DescribeFace(*model, face);
        EXPECT_NEAR(UncoveredArea(*model, face), 0, 1e-3) << DescribeFace(*model, face);
      }
    }
    ASSERT_EQ(planned.photographs.size(), 8u);
    const Visibility world(planned.world.geometry);
    const Visibility model(planned.model);
    for (const PhotographPlan& plan : planned.photographs) {
      SCOPED_TRACE(plan.name);
      const Sight in_world =
          LookThrough(plan.camera, planned.world.geometry, world, planned.world.num_model_faces);
      EXPECT_GT(in_world.num_front, 32 * 21 / 12);
      EXPECT_THAT(in_world.backs, testing::IsEmpty());
      EXPECT_GT(in_world.nearest, 5);
      const Sight on_model = LookThrough(
          plan.camera, planned.model, model, static_cast<int>(planned.model.faces.size()));
      EXPECT_GT(on_model.num_front, 32 * 21 / 12);
      EXPECT_LE(on_model.num_back, 3)  // where an error opens a slit
          << testing::PrintToString(on_model.backs);
    }
  }
  EXPECT_EQ(plans.size(), 7u);
  EXPECT_EQ(roofs.size(), 4u);
  EXPECT_EQ(details.size(), 4u);
}

TEST(RandomBuilding, HasNothingOddAboutIt) {
  for (uint64_t seed = 1; seed <= kNumSeeds / 2; ++seed) {
    const PlannedScene planned = PlanScene(DrawRandomRecipe(seed));
    Scene scene;
    scene.folder = "random";
    scene.model_file = scene.folder / "model.osu";
    scene.model = planned.model;
    for (const PhotographPlan& plan : planned.photographs) {
      Photograph& photograph = scene.photographs.emplace_back();
      photograph.name = plan.name;
      photograph.tag = plan.entry.measured;
      photograph.size = {640, 427};
      photograph.view_file = scene.folder / "views" / (plan.name + ".view");
    }
    std::vector<std::string> lines;
    for (const Advice& advice : FindOddities(scene, {}, false)) {
      lines.push_back(FormatAdvice(advice));
    }
    EXPECT_THAT(lines, testing::IsEmpty()) << "seed " << seed;
  }
}

TEST(RandomBuilding, SameSeedSameBytesAndAnotherSeedAnotherBuilding) {
  const TemporaryFolder folder;
  const auto write = [&](uint64_t seed, const std::string& name) {
    SynthRecipe recipe = DrawRandomRecipe(seed);
    recipe.width_px = 120;
    recipe.height_px = 80;
    recipe.num_views = 2;
    recipe.surface_texel = 2;
    WriteSyntheticScene(recipe, folder / name);
  };
  write(5, "one");
  write(5, "two");
  write(6, "other");
  for (const char* file : {"model.osu",
                           "recipe.json",
                           "views/s1.view",
                           "images/s2.jpg",
                           "truth/truth.json",
                           "truth/model_exact.osu",
                           "truth/surfaces/page_0.png"}) {
    const std::string bytes = ReadBytes(folder / "one" / file);
    EXPECT_FALSE(bytes.empty()) << file;
    EXPECT_TRUE(bytes == ReadBytes(folder / "two" / file)) << file;
    EXPECT_FALSE(bytes == ReadBytes(folder / "other" / file)) << file;
  }
  // The recipe alone makes the scene again.
  SynthRecipe again = PresetRecipe("random");
  ApplyRecipeJson(ReadBytes(folder / "one/recipe.json"), "recipe.json", again);
  WriteSyntheticScene(again, folder / "again");
  EXPECT_TRUE(ReadBytes(folder / "one/images/s1.jpg") == ReadBytes(folder / "again/images/s1.jpg"));
  EXPECT_TRUE(ReadBytes(folder / "one/model.osu") == ReadBytes(folder / "again/model.osu"));
}

// A digital camera has no mount and no scan: nothing shifts, turns or stretches its pictures.
TEST(RandomBuilding, DigitalPhotographsHaveNoSlidesErrors) {
  int num_digital = 0;
  for (uint64_t seed = 1; seed <= kNumSeeds; ++seed) {
    const SynthRecipe recipe = DrawRandomRecipe(seed);
    if (recipe.slide.sigma_shift != 0) continue;
    ++num_digital;
    EXPECT_EQ(recipe.random.view_angle_low_deg, recipe.random.view_angle_high_deg);
    const PlannedView view{"s1", {0, 100, 5}, {0, 0, 20}, 50, ""};
    for (int index = 0; index < 3; ++index) {
      const PhotographPlan plan = PlanPhotograph(view, recipe, index);
      EXPECT_EQ(plan.camera.center_x_px, 320);
      EXPECT_EQ(plan.camera.center_y_px, 213.5);
      EXPECT_NEAR(plan.camera.focal_x_px, plan.camera.focal_y_px, 1e-9);
      EXPECT_EQ(plan.num_specks + plan.num_scratches, 0);
    }
  }
  EXPECT_GT(num_digital, 10);
  EXPECT_LT(num_digital, 30);
}

// What the model has wrong is known: its points lie where the sigma and the flaws say.
TEST(RandomBuilding, TheModelsErrorsAreThoseOfItsRecipe) {
  SynthRecipe recipe = DrawRandomRecipe(3);
  recipe.random.plan = "rectangle";
  recipe.random.roof = "gabled";
  recipe.random.neighbours = "none";
  recipe.random.model.detail = "massing";
  recipe.random.model.omits = "chimneys dormers steps porch";
  recipe.random.model.windows_off = recipe.random.model.wall_off = 0;
  recipe.random.model.sigma = 0;
  recipe.random.model.eaves_off = 1;
  const PlannedScene off = PlanScene(recipe);
  ASSERT_EQ(off.model_flaws.empty(), false);
  EXPECT_EQ(off.model_flaws[0].what, "eaves off");
  const auto largest = [](const PlannedScene& planned) {
    double error = 0;
    for (size_t i = 0; i < planned.model.points_in_world.size(); ++i) {
      error = std::max(
          error,
          (planned.model.points_in_world[i] - planned.exact_model->points_in_world[i]).norm());
    }
    return error;
  };
  EXPECT_GT(largest(off), 0.9);
  recipe.random.model.eaves_off = 0;
  EXPECT_EQ(largest(PlanScene(recipe)), 0);
  recipe.random.model.sigma = 0.1;
  const double drawn = largest(PlanScene(recipe));
  EXPECT_GT(drawn, 0.05);
  EXPECT_LT(drawn, 0.5);
}

TEST(RandomBuilding, TagsSayWhatTheirWriterThinks) {
  SynthRecipe recipe = DrawRandomRecipe(1);
  const PlannedView view{"s1", {0, 100, 5}, {0, 0, 20}, 50, ""};
  recipe.notebook.stated_scale = 0;
  EXPECT_FALSE(PlanPhotograph(view, recipe, 0).entry.measured.sigmas.position.has_value());
  recipe.notebook.sigma_position = 0.4;
  recipe.notebook.stated_scale = 0.5;
  EXPECT_EQ(PlanPhotograph(view, recipe, 0).entry.measured.sigmas.position, 0.2);
  // Errors grow; what the tag says of them does not.
  const auto error = [&](double scale) {
    recipe.notebook.error_scale = scale;
    recipe.notebook.tape = 0;
    const NotebookEntry entry = PlanPhotograph(view, recipe, 0).entry;
    EXPECT_EQ(entry.measured.sigmas.position, 0.2);
    return (entry.actual.position_in_site - entry.measured.position_in_site).norm();
  };
  EXPECT_NEAR(error(3), 3 * error(1), 1e-9);
}

TEST(RandomTraits, CheckNamesWhatIsWrong) {
  SynthRecipe recipe = DrawRandomRecipe(1);
  recipe.random.plan = "star";
  EXPECT_THAT([&] { recipe.Check(); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("random/plan must be one of")));
  recipe = DrawRandomRecipe(1);
  recipe.random.pitch = 9;
  EXPECT_THAT([&] { recipe.Check(); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("random/pitch")));
}

}  // namespace
}  // namespace groundglass
