// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/check_report.h"
#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "cli/option_range.h"
#include "pipeline/photograph_selection.h"
#include "scene/advice/advice.h"
#include "scene/error.h"
#include "scene/feature_edges.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/input_folders.h"
#include "scene/formats/metadata_lens.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/untagged.h"
#include "scene/formats/view_template.h"
#include "scene/visibility.h"
#include "viewer/overlay.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  std::string scene;
  std::string model;
  std::string output;
  bool with_templates = false;
  std::optional<double> focal_length_mm;
};

// The measured tags' view of the model over each photograph that can be drawn; the others' faults
// are told already. Returns the names of those that were.
std::vector<std::string> DrawMeasuredTags(const Scene& scene, const CheckArguments& arguments) {
  std::vector<std::string> drawn;
  if (scene.model.faces.empty()) return drawn;
  const std::vector<ModelEdge> edges = FindModelEdges(scene.model);
  const Visibility visibility(scene.model);
  const Progress progress = MakeProgress(arguments.common, "overlay");
  int done = 0;
  for (const Photograph& photograph : scene.photographs) {
    const Camera measured =
        CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
    std::optional<Image8> picture;
    try {
      picture = ReadSrgb8(photograph.image_file);
    } catch (const Error&) {
      continue;
    }
    WriteSrgb8(fs::path(arguments.output) / (photograph.name + ".jpg"),
               DrawOverlay(*picture, scene.model, edges, visibility, measured, nullptr));
    drawn.push_back(photograph.name);
    ++done;
    if (progress) progress(done, static_cast<int>(scene.photographs.size()), photograph.name);
  }
  return drawn;
}

// A template for each photograph that has no tag, beside the tags that are there.
int WriteTemplates(const Scene& scene, const CheckArguments& arguments) {
  if (HasTagTable(scene.folder)) {
    throw Error(scene.folder / "tags.csv",
                "this scene has its tags in a table; add a row there for each photograph without "
                "one (image,x,y,z,i,j,k,a,v)");
  }
  if (scene.untagged_images.empty()) {
    throw Error(scene.folder / "images",
                "no photograph here is without a tag, so there is no template to write");
  }
  std::vector<std::string> written;
  for (const fs::path& image : scene.untagged_images) {
    const fs::path file = scene.folder / "views" / (image.stem().string() + ".view");
    if (fs::exists(file)) continue;
    const ImageSize size = ReadImageSize(image);
    MetadataLens lens = FindMetadataLens(ReadPhotographMetadata(image));
    if (arguments.focal_length_mm) {
      const double aspect = static_cast<double>(size.width) / size.height;
      lens = MetadataLens();
      lens.view_angle_deg = ViewAngleDegFromFocalLength(*arguments.focal_length_mm, aspect);
    }
    const std::string text = FormatViewTemplate(image.filename().string(),
                                                size,
                                                scene.model.unit,
                                                lens.view_angle_deg,
                                                lens.view_angle_deg ? lens.how : "");
    if (!arguments.common.dry_run) WriteFileAtomically(file, text);
    written.push_back(file.string());
  }
  if (arguments.common.json) {
    const nlohmann::ordered_json json = {{"templates", written},
                                         {"written", !arguments.common.dry_run}};
    std::printf("%s\n",
                json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
    return kExitDone;
  }
  for (const std::string& file : written) {
    std::printf("%s%s\n", arguments.common.dry_run ? "would write " : "", file.c_str());
  }
  std::printf(
      "Fill in each ? (docs/tutorial.md tells how), then: groundglass check %s -o overlays\n",
      arguments.scene.c_str());
  return kExitDone;
}

int RunCheck(const CheckArguments& arguments) {
  if (!arguments.output.empty()) RefuseAmongInputs(arguments.output);
  SceneOptions options;
  if (!arguments.model.empty()) options.model_file = arguments.model;
  options.model = arguments.model_arguments.Options();
  CheckReport report;
  report.check = CheckScene(arguments.scene, options);
  if (arguments.model.empty()) {
    Scene& scene = report.check.scene;
    const auto others = DescribeOtherModels(arguments.scene, scene.model_file);
    if (others && !scene.model_file.empty()) scene.warnings.push_back(*others);
  }
  for (const std::string& fault : FindPairFaults(report.check.scene)) {
    report.check.faults.push_back(fault);
  }
  if (arguments.with_templates) return WriteTemplates(report.check.scene, arguments);
  report.oddities = FindOddities(report.check.scene, options.model);
  // Overlays show best where a tag is off, and what is at fault with the others.
  if (!arguments.output.empty() && !arguments.common.dry_run) {
    try {
      report.overlays = DrawMeasuredTags(report.check.scene, arguments);
    } catch (const Error& error) {  // what was found is told all the same
      report.check.faults.push_back(std::string("overlays are not whole: ") + error.what());
    }
  }
  std::fputs(arguments.common.json
                 ? FormatCheckReportJson(report, arguments.model_arguments).c_str()
                 : FormatCheckReport(report, arguments.model_arguments).c_str(),
             stdout);
  if (!report.overlays.empty() && !arguments.common.json) {
    std::printf("%zu overlays in %s\n", report.overlays.size(), arguments.output.c_str());
  } else if (!arguments.output.empty() && !arguments.common.dry_run && !arguments.common.json) {
    std::printf("no overlays: no photograph can be drawn\n");
  }
  return report.check.faults.empty() ? kExitDone : kExitWrongInput;
}

}  // namespace

void AddCheckCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Read everything of a scene and tell all that is wrong with it, in one go");
  command->add_option("scene", arguments->scene, "the scene folder")->required();
  command->add_option("--model", arguments->model, "this model in place of the folder's");
  command->add_option(
      "-o,--out", arguments->output, "draw the measured tags over the photographs into here");
  CLI::Option* with_templates = command->add_flag(
      "--template",
      arguments->with_templates,
      "write views/NAME.view, to be filled in, for each photograph without a tag");
  command
      ->add_option_function<double>(
          "--focal-length",
          [raw = arguments.get()](double millimetres) { raw->focal_length_mm = millimetres; },
          "of the templates' lens, mm as for a 35 mm frame: fills in the view angle")
      ->check(FromTo(1, 10000))
      ->needs(with_templates);
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass check hall -o hall-check");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [arguments] { return RunCheck(*arguments); });
  });
}

}  // namespace groundglass
