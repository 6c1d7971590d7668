// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"
#include "cli/commands.h"
#include "cli/job_printer.h"
#include "cli/json_output.h"
#include "cli/model_arguments.h"
#include "cli/option_values.h"
#include "cli/register_arguments.h"
#include "cli/warnings_last.h"
#include "invrender/bake_output.h"
#include "pipeline/photograph_selection.h"
#include "pipeline/register_stages.h"
#include "pipeline/stage_keys.h"
#include "pipeline/texture_stages.h"
#include "scene/advice/advice.h"
#include "scene/assumed_unit.h"
#include "scene/error.h"
#include "scene/formats/model_io.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/pose_check.h"
#include "scene/formats/registration_io.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct InvrenderArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  std::filesystem::path scene_folder;
  std::filesystem::path out_folder;
  std::optional<std::filesystem::path> views_folder;
  std::optional<std::filesystem::path> model_file;
  std::optional<std::filesystem::path> earlier_model_file;
  BakeArguments bake;
  std::vector<const CLI::Option*> texture_options;
  std::vector<const CLI::Option*> tile_options;
};

// The photographs with their cameras. Verdicts count where `register` left them beside the views.
std::vector<BakePhotograph> Select(const InvrenderArguments& arguments, const Scene& scene) {
  std::vector<BakePhotograph> photographs = SelectPhotographs(scene);
  if (arguments.views_folder && scene.camera_files.empty()) {
    const std::filesystem::path folder = std::filesystem::absolute(*arguments.views_folder);
    for (const std::filesystem::path& beside : {folder, folder.lexically_normal() / ".."}) {
      const std::filesystem::path verdicts = beside / "registration.json";
      if (!std::filesystem::exists(verdicts)) continue;
      photographs = SelectPhotographs(
          scene, ReadRegistrations(verdicts), arguments.bake.selection.accepted_only);
      break;
    }
  }
  return photographs;
}

// Photographs that cannot be used, with the reason.
std::vector<std::string> DescribeUnreadable(const Scene& scene) {
  std::vector<std::string> lines;
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    for (const std::string& reason : unreadable.reasons) {
      lines.push_back(unreadable.photograph.name + " is unreadable: " + reason);
    }
  }
  return lines;
}

// Every number of a camera, exactly.
std::string DescribeCamera(const Camera& camera) {
  std::string text;
  const auto add = [&](double number) { text += " " + FormatNumber(number); };
  for (const double number : {static_cast<double>(camera.width_px),
                              static_cast<double>(camera.height_px),
                              camera.focal_x_px,
                              camera.focal_y_px,
                              camera.center_x_px,
                              camera.center_y_px,
                              camera.k1,
                              camera.k2,
                              camera.k3,
                              camera.p1,
                              camera.p2}) {
    add(number);
  }
  for (const double number : camera.cam_from_world.rotation.reshaped()) add(number);
  for (const double number : camera.cam_from_world.translation) add(number);
  return text;
}

// What the texture depends on; the cameras count as they are, wherever they come from.
StageInputs ReadInputs(const InvrenderArguments& arguments,
                       const Scene& scene,
                       const std::vector<BakePhotograph>& photographs) {
  StageInputs inputs = ReadTextureInputs(scene, ReadOptionTexts(arguments.texture_options));
  const StageInputs scene_inputs = ReadRegistrationInputs(scene, {});
  inputs.sha256_of_inputs.insert(scene_inputs.sha256_of_inputs.begin(),
                                 scene_inputs.sha256_of_inputs.end());
  std::string cameras;
  for (const BakePhotograph& photograph : photographs) {
    cameras += photograph.name + DescribeCamera(photograph.camera) + "\n";
  }
  inputs.sha256_of_inputs["cameras"] = HashText(cameras);
  return inputs;
}

void PrintSummary(const BakeResult& result,
                  size_t num_photographs,
                  const std::vector<std::string>& unreadable,
                  bool as_json) {
  long num_texels = 0;
  int num_bare = 0;
  for (const FaceCoverage& face : result.coverage.faces) {
    num_texels += face.num_covered_texels;
    num_bare += face.num_covered_texels == 0 ? 1 : 0;
  }
  std::vector<int> new_faces = result.new_faces;
  for (int& face : new_faces) ++face;  // people count from 1
  if (as_json) {
    const nlohmann::ordered_json json = {{"photographs", num_photographs},
                                         {"faces", result.coverage.faces.size()},
                                         {"faces_without_texture", num_bare},
                                         {"covered_share", result.coverage.CoveredShare()},
                                         {"covered_texels", num_texels},
                                         {"texel_scale", result.texel_scale},
                                         {"new_faces", new_faces},
                                         {"pages", result.model.pages.size()},
                                         {"remarks", result.remarks},
                                         {"unreadable", unreadable}};
    std::printf("%s\n",
                json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
    return;
  }
  std::printf(
      "%zu photographs cover %.1f %% of %zu faces' area (%d faces bare): %.1f Mtexels on %zu "
      "pages\n",
      num_photographs,
      100 * result.coverage.CoveredShare(),
      result.coverage.faces.size(),
      num_bare,
      static_cast<double>(num_texels) / 1e6,
      result.model.pages.size());
  for (const int face : result.new_faces) {
    std::printf("new since the photographs: %s\n", DescribeFace(result.model.model, face).c_str());
  }
}

int RunInvrender(const InvrenderArguments& arguments) {
  arguments.bake.options.Check();
  BakeOptions options = arguments.bake.Options();
  SceneOptions scene_options;
  scene_options.model_file = arguments.model_file;
  scene_options.model = arguments.model_arguments.Options();
  scene_options.views = arguments.views_folder;
  scene_options.exclude = arguments.bake.selection.exclude;
  Scene scene = ReadScene(arguments.scene_folder, scene_options);
  if (!arguments.model_file) {
    const auto others = DescribeOtherModels(scene.folder, scene.model_file);
    if (others) scene.warnings.push_back(*others);
  }
  if (const auto assumed = DescribeAssumedUnit(scene.model_file, scene.model)) {
    scene.warnings.push_back(*assumed);
  }
  // Cameras from elsewhere have no tags to be odd.
  for (const Advice& advice : arguments.views_folder ? FindModelOddities(scene, scene_options.model)
                                                     : FindOddities(scene, scene_options.model)) {
    scene.warnings.push_back(FormatAdvice(advice));
  }
  const WarningsLast warnings(scene.warnings, arguments.common.quiet);
  RequireSoundPoses(scene);
  std::vector<std::string> unreadable = DescribeUnreadable(scene);
  std::vector<BakePhotograph> photographs = Select(arguments, scene);
  const std::vector<std::string> selection_faults =
      NarrowPhotographs(arguments.bake.selection, scene, photographs);
  unreadable.insert(unreadable.end(), selection_faults.begin(), selection_faults.end());
  if (arguments.common.dry_run) {
    return TellDryRun(arguments.common,
                      "texture " + std::to_string(scene.model.faces.size()) + " faces from " +
                          std::to_string(photographs.size()) + " photographs into " +
                          arguments.out_folder.string(),
                      {{"out", arguments.out_folder.string()},
                       {"photographs", photographs.size()},
                       {"faces", scene.model.faces.size()},
                       {"unreadable", unreadable},
                       {"warnings", scene.warnings}});
  }
  const fs::path& out = arguments.out_folder;
  const FolderLock lock = PrepareOutputFolder(out);
  if (arguments.earlier_model_file) {
    ModelReading earlier = ReadModel(*arguments.earlier_model_file, scene_options.model);
    for (const std::string& warning : earlier.warnings) {
      std::fprintf(stderr, "groundglass: %s\n", warning.c_str());
    }
    options.as_photographed = std::move(earlier.model);
  }
  const StageInputs inputs = ReadInputs(arguments, scene, photographs);
  const StageInputs tiles_inputs = ReadStageOptions(ReadOptionTexts(arguments.tile_options));
  const uint64_t seed = arguments.common.seed;
  const std::string key = StageKey(kTextureStage, std::to_string(seed), inputs);
  const JobObserver printer = MakeJobPrinter(arguments.common, options.memory.max_memory_mb);
  TellDamagedManifest(out, printer);
  OutputStages stages(out, MakeManifest("invrender", seed, {inputs, tiles_inputs}));
  // What `register` left beside it stays; what `run` made of another texture does not.
  for (const char* stage : {kTextureStage, kTilesStage, kStillsStage, kReportStage}) {
    stages.KeepOnly(stage, key);
  }
  stages.Write();
  const BakeResult result =
      BakeAndWrite(scene, photographs, options, arguments.bake.format, out, key, stages, printer);
  EnsureTiles(scene,
              photographs,
              arguments.bake.Tiles(),
              out,
              StageKey(kTilesStage, key, tiles_inputs),
              stages,
              printer);
  PrintSummary(result, photographs.size(), unreadable, arguments.common.json);
  PrintWarnings(result.remarks);
  PrintWarnings(unreadable);
  return unreadable.empty() ? kExitDone : kExitNeedsReview;
}

}  // namespace

void AddInvrenderCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<InvrenderArguments>();
  CLI::App* command = app.add_subcommand(
      "invrender", "Turn photographs with known cameras into the model's texture");
  arguments->texture_options = OptionsAddedBy(command, [&] {
    command->add_option("scene", arguments->scene_folder, "scene folder")->required();
    command->add_option("-o,--out", arguments->out_folder, "where to write the textured model")
        ->required();
    command
        ->add_option(
            "--views",
            arguments->views_folder,
            ".view files or a COLMAP model (text, binary, sparse/0) in place of the scene's "
            "own tags; verdicts in a registration.json beside views are heeded")
        ->type_name("FOLDER");
    command->add_option("--model", arguments->model_file, "in place of the one in the scene folder")
        ->type_name("FILE");
    command
        ->add_option("--as-photographed",
                     arguments->earlier_model_file,
                     "the model as it was when the photographs were taken, if the building has "
                     "changed since: what both have is textured")
        ->type_name("FILE");
    AddBakeArguments(command, arguments->bake, "--only,--only-faces");
  });
  arguments->tile_options =
      OptionsAddedBy(command, [&] { AddTileArguments(command, arguments->bake); });
  for (const char* tiles : {"--tiles", "--tile-record"}) {
    command->get_option("--as-photographed")->excludes(command->get_option(tiles));
  }
  const std::vector<const CLI::Option*> common = OptionsAddedBy(command, [&] {
    AddModelOptions(command, arguments->model_arguments);
    AddCommonOptions(command, arguments->common);
  });
  arguments->texture_options.insert(arguments->texture_options.end(), common.begin(), common.end());
  AddExample(command, "groundglass invrender hall --views hall-out/views -o hall-textured");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return RunInvrender(*arguments); });
  });
}

}  // namespace groundglass
