// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/planned_scene.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/random/random_building.h"
#include "datasets-synthetic/relief.h"

namespace groundglass {
namespace {

Subject MakeSubject(const SynthRecipe& recipe) {
  if (recipe.building == "brick") return MakeBrickHall(recipe.seed);
  if (recipe.building == "random") return MakeRandomBuilding(recipe);
  if (recipe.building == "cityblock") return MakeCityBlock(recipe.seed, recipe.num_faces);
  return MakeWiesner(recipe.seed);
}

// Sandstone about the brick hall's windows, tiles' white elsewhere.
Rgb RevealColor(const SynthRecipe& recipe) {
  return recipe.building == "brick" ? Rgb(0.45f, 0.4f, 0.31f) : Rgb(0.6f, 0.6f, 0.58f);
}

void BlunderInNotebook(const SynthRecipe& recipe, std::vector<PhotographPlan>& photographs) {
  const uint64_t seed = SeedFor(recipe.seed, "blunders");
  const std::vector<Blunder> blunders =
      DrawBlunders(static_cast<int>(photographs.size()), recipe.notebook.blunders, seed);
  std::vector<ViewTag> tags;
  for (const PhotographPlan& plan : photographs) tags.push_back(plan.entry.measured);
  CommitBlunders(blunders, seed, tags);
  for (size_t i = 0; i < photographs.size(); ++i) {
    photographs[i].entry.measured = tags[i];
    photographs[i].blunder = blunders[i];
  }
}

}  // namespace

PlannedScene PlanScene(const SynthRecipe& recipe) {
  Subject subject = MakeSubject(recipe);
  PlannedScene planned;
  if (subject.drawn_model) {
    planned.model = std::move(subject.drawn_model->model);
    planned.exact_model = std::move(subject.drawn_model->exact_model);
    planned.model_flaws = std::move(subject.drawn_model->flaws);
  } else {
    planned.model = subject.world.Model();
  }
  planned.built = subject.built.value_or(ComputeBounds(planned.model));
  planned.world = std::move(subject.world);
  planned.novel_views = std::move(subject.novel_views);
  // A random building has its windows' depth already.
  if (!subject.drawn_model) {
    AddRelief(recipe.relief, RevealColor(recipe), recipe.seed, planned.world);
  }
  if (recipe.is_plain) PaintPlainly(recipe.seed, planned.world);
  if (recipe.num_views > 0 && recipe.num_views < static_cast<int>(subject.views.size())) {
    subject.views.resize(recipe.num_views);
  }
  for (size_t i = 0; i < subject.views.size(); ++i) {
    planned.photographs.push_back(PlanPhotograph(subject.views[i], recipe, static_cast<int>(i)));
  }
  BlunderInNotebook(recipe, planned.photographs);
  planned.wall_tags = HangWallTags(recipe, planned.photographs, planned.world);
  return planned;
}

}  // namespace groundglass
