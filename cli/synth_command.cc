// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "datasets-synthetic/random/draw_recipe.h"
#include "datasets-synthetic/synth.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace groundglass {
namespace {

struct SynthArguments {
  CommonOptions common;
  std::string preset;
  std::string out;
  std::string size;
  std::string recipe_file;
  int num_views = -1;
  int num_blunders = -1;
  int num_april_tags = -1;
  std::string pictures;  // folder for --list
  bool list = false;
};

void ParseSize(const std::string& size, SynthRecipe& recipe) {
  char rest = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &recipe.width_px, &recipe.height_px, &rest) != 2) {
    throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, as 1500x1000, not " + size);
  }
}

// The presets, and a picture of each in a folder if one is named.
void PrintPresets(const CommonOptions& common, const std::filesystem::path& pictures) {
  nlohmann::ordered_json presets = nlohmann::ordered_json::array();
  for (const SynthPreset& preset : ListSynthPresets()) {
    if (!common.json) {
      std::printf("%-10s %s\n", preset.name.c_str(), preset.description.c_str());
    }
    presets.push_back({{"name", preset.name}, {"description", preset.description}});
    if (pictures.empty() || common.dry_run) continue;
    SynthRecipe recipe = PresetRecipe(preset.name);
    recipe.width_px = 480;
    recipe.height_px = 320;
    const std::filesystem::path file = pictures / (preset.name + ".jpg");
    WriteSrgb8(file, RenderPresetPicture(recipe));
    if (!common.json) std::printf("%-10s %s\n", "", file.c_str());
    presets.back()["picture"] = file.string();
  }
  if (common.json) PrintJson({{"presets", presets}});
}

int RunSynth(const SynthArguments& arguments, bool has_seed) {
  SynthRecipe recipe = PresetRecipe(arguments.preset);
  const std::string overrides =
      arguments.recipe_file.empty() ? "{}" : ReadTextFile(arguments.recipe_file);
  ApplyRecipeJson(overrides, arguments.recipe_file, recipe);
  if (recipe.preset == "random") {
    // Everything is drawn from the seed before anything else is overridden.
    recipe = DrawRandomRecipe(has_seed ? arguments.common.seed : recipe.seed);
    ApplyRecipeJson(overrides, arguments.recipe_file, recipe);
  }
  if (!arguments.size.empty()) ParseSize(arguments.size, recipe);
  if (arguments.num_views >= 0) recipe.num_views = arguments.num_views;
  if (arguments.num_blunders >= 0) recipe.notebook.blunders = arguments.num_blunders;
  if (arguments.num_april_tags >= 0) recipe.april_tags.count = arguments.num_april_tags;
  if (has_seed) recipe.seed = arguments.common.seed;
  recipe.Check();
  if (arguments.common.dry_run) {
    std::fputs(FormatRecipe(recipe).c_str(), stdout);
    return kExitDone;
  }
  const SynthSummary summary =
      WriteSyntheticScene(recipe, arguments.out, MakeProgress(arguments.common, "photographs"));
  if (arguments.common.json) {
    const nlohmann::ordered_json json = {{"scene", arguments.out},
                                         {"faces", summary.num_faces},
                                         {"photographs", summary.num_photographs},
                                         {"novel_views", summary.num_novel_views},
                                         {"april_tags", summary.num_april_tags},
                                         {"blunders", summary.num_blunders},
                                         {"mean_tag_error_px", summary.mean_tag_error_px}};
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    std::printf("%s: %d faces, %d photographs, %d novel views; hand tags %.1f px off on average\n",
                arguments.out.c_str(),
                summary.num_faces,
                summary.num_photographs,
                summary.num_novel_views,
                summary.mean_tag_error_px);
    if (recipe.april_tags.count > 0) {
      std::printf("%d of %d AprilTags hang on its walls, surveyed in apriltags.csv\n",
                  summary.num_april_tags,
                  recipe.april_tags.count);
    }
  }
  return kExitDone;
}

}  // namespace

void AddSynthCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<SynthArguments>();
  CLI::App* command = app.add_subcommand("synth", kSynthSummary);
  command->add_option("preset", arguments->preset, "which scene; --list shows them");
  command->add_option("-o,--out", arguments->out, "the scene folder to make");
  command->add_option("--size", arguments->size, "of the photographs, as 1500x1000");
  command->add_option("--views", arguments->num_views, "how many of the planned views; 0 for all")
      ->check(AtLeast(0));
  command->add_option("--recipe", arguments->recipe_file, "JSON file that overrides the preset");
  command
      ->add_option("--blunders",
                   arguments->num_blunders,
                   "tags that hold a blunder: swapped coordinates, a wrong sign, another "
                   "photograph's numbers")
      ->check(AtLeast(0));
  command
      ->add_option("--april-tags",
                   arguments->num_april_tags,
                   "AprilTags on the building's walls, surveyed in apriltags.csv")
      ->check(AtLeast(0));
  command->add_flag("--list", arguments->list, "list the presets");
  command->add_option(
      "--pictures", arguments->pictures, "with --list: a picture of each preset into this folder");
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass synth wiesner -o wiesner");
  command->callback([command, arguments, &exit_status] {
    if (arguments->list) {
      exit_status = RunWithThreads(arguments->common, [&] {
        PrintPresets(arguments->common, arguments->pictures);
        return kExitDone;
      });
      return;
    }
    if (arguments->preset.empty()) throw CLI::RequiredError("preset");
    if (arguments->out.empty() && !arguments->common.dry_run) throw CLI::RequiredError("--out");
    exit_status = RunWithThreads(
        arguments->common, [&] { return RunSynth(*arguments, command->count("--seed") > 0); });
  });
}

}  // namespace groundglass
