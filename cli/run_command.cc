// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/register_arguments.h"
#include "cli/warnings_last.h"
#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/image_io.h"
#include "scene/registration_io.h"
#include "scene/textured_model_io.h"
#include "viewer/camera_path.h"
#include "viewer/renderer.h"
#include "viewer/report.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace groundglass {
namespace {

struct RunArguments {
  CommonOptions common;
  RegisterArguments registering;
  BakeArguments baking;
  int num_stills = 4;
};

// Stills from where nobody stood: along the flight through the photographs' viewpoints, midway
// between them.
void RenderStills(const std::filesystem::path& out,
                  const TexturedModel& model,
                  const std::vector<Registration>& registrations,
                  int num_stills,
                  const Progress& progress) {
  std::vector<Camera> cameras;
  for (const Registration& registration : registrations) {
    if (registration.verdict != Verdict::kRejected) {
      cameras.push_back(registration.CorrectedCamera());
    }
  }
  if (cameras.size() < 2 || num_stills < 1) return;
  // Twice as many frames as stills: every second one, from the first, lies between viewpoints.
  const std::vector<Camera> flight = MakeFlight(model.model, cameras, 2 * num_stills + 1);
  Renderer renderer(model);
  RenderOptions options;
  options.background = Background::kSky;
  options.supersampling = 2;
  for (int still = 0; still < num_stills; ++still) {
    const std::string name = "still_" + std::to_string(still + 1) + ".jpg";
    WriteSrgb8(out / "renders" / name, renderer.Render(flight[2 * still + 1], options));
    if (progress) progress(still + 1, num_stills, name);
  }
}

// What makes a finished stage worth keeping: the same inputs, options and program as now.
bool CanResume(const std::filesystem::path& out, const Manifest& manifest) {
  return HasManifest(out, manifest) && std::filesystem::exists(out / "registration.json");
}

// Where to look, for what there is to look at.
void PrintWhatIsThere(const std::filesystem::path& out) {
  constexpr std::array<std::array<const char*, 2>, 5> kPlaces = {{
      {"corrected tags", "views"},
      {"overlays", "overlays"},
      {"textured model", "model.glb"},
      {"new viewpoints", "renders"},
      {"the whole story", "report.html"},
  }};
  for (const auto& [title, name] : kPlaces) {
    const std::filesystem::path place = out / name;
    std::error_code error;
    if (!std::filesystem::exists(place, error) || std::filesystem::is_empty(place, error)) continue;
    std::printf("%-16s %s\n", title, place.string().c_str());
  }
}

int Run(const RunArguments& arguments) {
  const RegisterArguments& registering = arguments.registering;
  const CommonOptions& common = arguments.common;
  const std::filesystem::path& out = registering.out_folder;
  registering.options.Check();
  arguments.baking.options.Check();
  const Scene scene = ReadSceneForCommand(registering, common);
  const WarningsLast warnings(scene.warnings, common.quiet);
  Manifest manifest = DescribeInputs("run", scene, registering, common);
  DescribeBake(arguments.baking, manifest);
  if (common.dry_run) {
    std::printf("would register %zu photographs, bake %zu faces and write %s\n",
                scene.photographs.size(),
                scene.model.faces.size(),
                out.string().c_str());
    return kExitDone;
  }
  PrepareOutputFolder(out);
  RegisteredScene registered;
  const std::vector<Registration>& registrations = registered.registrations;
  if (CanResume(out, manifest)) {
    registered = {ReadRegistrations(out / "registration.json"),
                  ReadModelErrors(out / "registration.json")};
    if (!common.quiet) std::fprintf(stderr, "keeping the tags that are there already\n");
  } else {
    // What another run left would be taken for this one's if it were stopped half way.
    for (const char* stale : {"registration.json", "coverage.json", "report.html"}) {
      std::filesystem::remove(out / stale);
    }
    WriteManifest(out, manifest);
    registered = RegisterAndWrite(scene, registering, common);
  }
  if (!common.json) {
    std::fputs(FormatModelSummary(scene.model, registering.model_arguments).c_str(), stdout);
    PrintRegistrations(registrations);
    PrintModelErrors(registered.model_errors, scene.model.unit);
  }

  std::vector<BakePhotograph> photographs =
      SelectPhotographs(scene, registrations, arguments.baking.accepted_only);
  NarrowPhotographs(arguments.baking, scene, photographs);
  if (photographs.empty()) {
    std::fprintf(stderr,
                 "groundglass: no photograph could be registered, so nothing is textured\n");
  } else if (!std::filesystem::exists(out / "coverage.json")) {
    TuneFreedMemory(arguments.baking);
    BakeOptions options = arguments.baking.Options();
    options.on_face_mask = FaceMaskWriter(out);
    const BakeResult bake =
        BakeTextures(scene.model, photographs, options, MakeProgress(common, "texturing"));
    RenderStills(
        out, bake.model, registrations, arguments.num_stills, MakeProgress(common, "rendering"));
    WriteBake(bake, out, "." + arguments.baking.format);
    WriteTilesIfAsked(arguments.baking, scene.model, photographs, out);
    if (!common.json) {
      std::printf("texture covers %.1f %% of the model's surface\n",
                  100 * bake.coverage.CoveredShare());
    }
  }
  WriteFileAtomically(out / "report.html", FormatReport(out, &scene));

  if (common.json) {
    PrintRegistrationsJson(registered, scene.warnings);
  } else {
    PrintVerdictCounts(registrations, scene.warnings.size());
    PrintWhatIsThere(out);
  }
  return ExitStatusOf(registrations);
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "The main job: correct the tags, texture the model, report what was found");
  AddRegisterArguments(command, arguments->registering);
  AddBakeArguments(command, arguments->baking);
  command->add_option("--stills", arguments->num_stills, "pictures from new viewpoints")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass run hall -o hall-out");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return Run(*arguments); });
  });
}

}  // namespace groundglass
