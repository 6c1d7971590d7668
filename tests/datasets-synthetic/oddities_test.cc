// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// No preset is odd: warnings that cry wolf are worse than none.
#include "datasets-synthetic/planned_scene.h"
#include "datasets-synthetic/synth.h"
#include "scene/advice/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(FindOddities, AreNoneInAnyPreset) {
  for (const SynthPreset& preset : ListSynthPresets()) {
    const SynthRecipe recipe = PresetRecipe(preset.name);
    const PlannedScene planned = PlanScene(recipe);
    Scene scene;
    scene.folder = preset.name;
    scene.model_file = scene.folder / "model.osu";
    scene.model = planned.model;
    for (const PhotographPlan& plan : planned.photographs) {
      Photograph& photograph = scene.photographs.emplace_back();
      photograph.name = plan.name;
      photograph.tag = plan.entry.measured;
      photograph.size = {recipe.width_px, recipe.height_px};
      photograph.view_file = scene.folder / "views" / (plan.name + ".view");
    }
    std::vector<std::string> lines;
    for (const Advice& advice : FindOddities(scene, {}, false)) {
      lines.push_back(FormatAdvice(advice));
    }
    EXPECT_THAT(lines, testing::IsEmpty()) << preset.name;
  }
}

}  // namespace
}  // namespace groundglass
