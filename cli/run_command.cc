// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "cli/option_values.h"
#include "cli/register_arguments.h"
#include "cli/register_stages.h"
#include "cli/stage_keys.h"
#include "cli/texture_stages.h"
#include "cli/warnings_last.h"
#include "report/report.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/registration_io.h"
#include "viewer/overlay.h"

#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  CommonOptions common;
  RegisterArguments registering;
  BakeArguments baking;
  int num_stills = 4;
  StageOptions options;
};

// What the files of each stage depend on (StageKey).
struct StageKeys {
  std::string registration;
  std::string texture;
  std::string tiles;
  std::string stills;
};

// Everything that goes wrong once the tags are corrected is told, and costs no more than its own
// stage: what the others make is there.
class Attempts {
 public:
  void Try(const char* stage, const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& error) {
      failures_.push_back(std::string(stage) + ": " + error.what());
      std::fprintf(stderr, "groundglass: %s\n", failures_.back().c_str());
    }
  }
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  std::vector<std::string> failures_;
};

// Faces, masks and pairs that are wrong are told before the work begins.
void CheckNarrowing(const RunArguments& arguments, const Scene& scene) {
  std::vector<BakePhotograph> photographs;
  for (const Photograph& photograph : scene.photographs) {
    BakePhotograph& bake = photographs.emplace_back();
    bake.name = photograph.name;
    bake.image_file = photograph.image_file;
    bake.camera.width_px = photograph.size.width;
    bake.camera.height_px = photograph.size.height;
  }
  NarrowPhotographs(arguments.baking, scene, photographs);
  if (photographs.empty()) {
    throw Error(
        "option --exclude: it leaves no photograph for the texture; register corrects tags "
        "alone");
  }
}

// Keeps what earlier runs left for the same keys, removes what they left for others.
OutputStages OpenStages(const fs::path& out, const Manifest& manifest, const StageKeys& keys) {
  OutputStages stages(out, manifest);
  stages.KeepOnly(kRegisterStage, keys.registration);
  stages.KeepOnly(kOverlayStage, keys.registration);
  stages.KeepOnly(kTextureStage, keys.texture);
  stages.KeepOnly(kTilesStage, keys.tiles);
  stages.KeepOnly(kStillsStage, keys.stills);
  // It tells of all the others, and is always made again.
  stages.KeepOnly(kReportStage, "");
  stages.Write();
  return stages;
}

// They are taken on the way from one photograph's viewpoint to the next, so it takes two.
std::string WhyNoStills(const std::vector<BakePhotograph>& photographs, const fs::path& out) {
  return "no pictures from new viewpoints: they are drawn on the way from one photograph's "
         "viewpoint "
         "to the next, and only " +
         photographs.front().name + " has a camera; groundglass render " + out.string() +
         " --view FILE.view -o still.png draws one from wherever you like";
}

void PrintPlaces(const fs::path& out, const ImageSize& stills) {
  const std::pair<const char*, const char*> places[] = {{"corrected tags", "views"},
                                                        {"overlays", "overlays"},
                                                        {"textured model", "model.glb"},
                                                        {"new viewpoints", "renders"},
                                                        {"the whole story", "report.html"}};
  std::printf("\n");
  for (const auto& [what, name] : places) {
    std::error_code error;
    if (!fs::exists(out / name, error) || fs::is_empty(out / name, error)) continue;
    const bool is_stills = std::string_view(name) == "renders" && stills.width > 0;
    const std::string size =
        " (" + std::to_string(stills.width) + " x " + std::to_string(stills.height) + " pixels)";
    std::printf("%-16s %s%s\n", what, (out / name).string().c_str(), is_stills ? size.c_str() : "");
  }
}

int Run(const RunArguments& arguments) {
  const RegisterArguments& registering = arguments.registering;
  const BakeArguments& baking = arguments.baking;
  const CommonOptions& common = arguments.common;
  const fs::path& out = registering.out_folder;
  registering.options.Check();
  baking.options.Check();
  const BakeOptions bake_options = baking.Options();
  const Scene scene = ReadSceneForCommand(registering, baking.exclude);
  const WarningsLast warnings(scene.warnings, common.quiet);
  CheckNarrowing(arguments, scene);
  if (common.dry_run) {
    return TellDryRun(common,
                      "register " + std::to_string(scene.photographs.size()) +
                          " photographs, bake " + std::to_string(scene.model.faces.size()) +
                          " faces and write " + out.string(),
                      {{"out", out.string()},
                       {"photographs", scene.photographs.size()},
                       {"faces", scene.model.faces.size()},
                       {"warnings", scene.warnings}});
  }
  const FolderLock lock = PrepareOutputFolder(out);
  const StageInputs inputs = ReadRegistrationInputs(scene, arguments.options.registering);
  const StageInputs texture_inputs = ReadTextureInputs(scene, arguments.options.texture);
  const StageInputs tiles_inputs = ReadStageOptions(arguments.options.tiles);
  const StageInputs stills_inputs = ReadStageOptions(arguments.options.stills);
  StageKeys keys;
  keys.registration = RegistrationKey(common, inputs);
  keys.texture = StageKey(kTextureStage, keys.registration, texture_inputs);
  keys.tiles = StageKey(kTilesStage, keys.texture, tiles_inputs);
  keys.stills = StageKey(kStillsStage, keys.texture, stills_inputs);
  OutputStages stages =
      OpenStages(out,
                 MakeManifest("run", common, {inputs, texture_inputs, tiles_inputs, stills_inputs}),
                 keys);

  TellChanged(stages, {kRegisterStage, kOverlayStage, kTextureStage, kStillsStage});
  if (baking.tiles || baking.tile_record) TellChanged(stages, {kTilesStage});
  const RegisteredScene registered =
      EnsureRegistered(scene, registering, common, keys.registration, stages);
  const std::vector<Registration>& registrations = registered.registrations;
  if (!common.json) {
    std::fputs(FormatModelSummary(scene.model, registering.model_arguments).c_str(), stdout);
    PrintRegistrations(registrations);
    PrintModelErrors(registered.model_errors, scene.model.unit);
  }
  Attempts attempts;
  attempts.Try("overlays", [&] {
    EnsureOverlays(scene, registered, registering, common, keys.registration, stages);
  });

  std::vector<BakePhotograph> photographs =
      SelectPhotographs(scene, registrations, baking.accepted_only);
  std::vector<std::string> mask_faults;
  bool is_narrowed = false;
  attempts.Try("texture", [&] {
    mask_faults = NarrowPhotographs(baking, scene, photographs);
    is_narrowed = true;
  });
  ImageSize stills_size;
  std::vector<std::string> remarks;
  if (photographs.empty()) {
    std::fprintf(stderr,
                 "groundglass: no photograph is left to texture with: none of those that are not "
                 "excluded could be registered\n");
  } else if (is_narrowed) {
    attempts.Try("texture", [&] {
      if (stages.IsComplete(kTextureStage, keys.texture)) return;
      const BakeResult bake =
          BakeAndWrite(scene, photographs, baking, bake_options, common, out, keys.texture, stages);
      if (common.json) return;
      std::printf("texture covers %.1f %% of the model's surface\n",
                  100 * bake.coverage.CoveredShare());
    });
    attempts.Try("tiles",
                 [&] { EnsureTiles(scene, photographs, baking, out, keys.tiles, stages); });
    attempts.Try("pictures from new viewpoints", [&] {
      if (!stages.IsComplete(kTextureStage, keys.texture)) return;
      stills_size =
          EnsureStills(registrations, arguments.num_stills, common, out, keys.stills, stages);
      if (stills_size.width == 0 && arguments.num_stills > 0) {
        remarks.push_back(WhyNoStills(photographs, out));
      }
    });
  }
  attempts.Try("report", [&] {
    stages.Begin(kReportStage, keys.registration, {"report.html"});
    WriteFileAtomically(out / "report.html",
                        MakeReport(out, &scene, {.draw_edges = MakeEdgeDrawing(scene.model)}));
    stages.Finish(kReportStage);
  });

  if (common.json) {
    std::vector<std::string> told = scene.warnings;
    told.insert(told.end(), remarks.begin(), remarks.end());
    PrintRegistrationsJson(registered, told, attempts.failures());
  } else {
    PrintVerdictCounts(registrations, scene.warnings.size());
    PrintPlaces(out, stills_size);
    for (const std::string& failure : attempts.failures()) {
      std::printf("NOT FINISHED     %s\n", failure.c_str());
    }
  }
  PrintWarnings(remarks);
  PrintWarnings(registered.warnings);
  PrintWarnings(mask_faults);
  if (!attempts.failures().empty()) return kExitWrongInput;
  return mask_faults.empty() ? ExitStatusOf(registrations) : kExitNeedsReview;
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "The main job: correct the tags, texture the model, report what was found");
  StageOptions& options = arguments->options;
  options.registering =
      OptionsAddedBy(command, [&] { AddRegisterArguments(command, arguments->registering); });
  options.texture = OptionsAddedBy(command, [&] { AddBakeArguments(command, arguments->baking); });
  options.tiles = OptionsAddedBy(command, [&] { AddTileArguments(command, arguments->baking); });
  options.stills = OptionsAddedBy(command, [&] {
    command->add_option("--stills", arguments->num_stills, "pictures from new viewpoints")
        ->capture_default_str()
        ->check(FromTo(0, 100));
  });
  const std::vector<const CLI::Option*> common =
      OptionsAddedBy(command, [&] { AddCommonOptions(command, arguments->common); });
  options.registering.insert(options.registering.end(), common.begin(), common.end());
  AddExample(command, "groundglass run hall -o hall-out");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return Run(*arguments); });
  });
}

}  // namespace groundglass
