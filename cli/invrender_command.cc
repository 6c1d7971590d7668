// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"
#include "cli/commands.h"
#include "cli/model_arguments.h"
#include "cli/warnings_last.h"
#include "scene/advice.h"
#include "scene/model_io.h"
#include "scene/output_folder.h"
#include "scene/registration_io.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

struct InvrenderArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  std::filesystem::path scene_folder;
  std::filesystem::path out_folder;
  std::optional<std::filesystem::path> views_folder;
  std::optional<std::filesystem::path> model_file;
  std::optional<std::filesystem::path> earlier_model_file;
  BakeArguments bake;
};

// The photographs with their cameras. Verdicts count where `register` left them beside the views.
std::vector<BakePhotograph> Select(const InvrenderArguments& arguments, const Scene& scene) {
  std::vector<BakePhotograph> photographs;
  if (!arguments.views_folder) {
    std::vector<NamedCamera> cameras;
    for (const Photograph& photograph : scene.photographs) {
      cameras.push_back(
          {photograph.name,
           CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height)});
    }
    photographs = SelectPhotographs(scene, cameras);
  } else {
    const std::filesystem::path folder = std::filesystem::absolute(*arguments.views_folder);
    const std::filesystem::path verdicts = folder.lexically_normal() / ".." / "registration.json";
    const bool is_colmap = std::filesystem::exists(folder / "images.txt");
    photographs =
        !is_colmap && std::filesystem::exists(verdicts)
            ? SelectPhotographs(scene, ReadRegistrations(verdicts), arguments.bake.accepted_only)
            : SelectPhotographs(scene, ReadCameras(scene, folder));
  }
  NarrowPhotographs(arguments.bake, scene, photographs);
  return photographs;
}

Manifest Describe(const InvrenderArguments& arguments,
                  const Scene& scene,
                  const std::vector<BakePhotograph>& photographs) {
  Manifest manifest;
  manifest.version = GROUNDGLASS_VERSION;
  manifest.command = "invrender";
  manifest.seed = arguments.common.seed;
  DescribeBake(arguments.bake, manifest);
  manifest.sha256_of_inputs[scene.model_file.filename().string()] = HashFile(scene.model_file);
  for (const BakePhotograph& photograph : photographs) {
    for (const auto& file :
         {std::optional(photograph.image_file), photograph.mask_file, photograph.faces_file}) {
      if (!file) continue;
      manifest.sha256_of_inputs[file->lexically_relative(scene.folder).generic_string()] =
          HashFile(*file);
    }
  }
  if (arguments.earlier_model_file) {
    manifest.sha256_of_inputs["--as-photographed/" +
                              arguments.earlier_model_file->filename().string()] =
        HashFile(*arguments.earlier_model_file);
  }
  const std::filesystem::path pairs = scene.folder / "pairs.csv";
  if (std::filesystem::exists(pairs)) manifest.sha256_of_inputs["pairs.csv"] = HashFile(pairs);
  return manifest;
}

void PrintSummary(const BakeResult& result, size_t num_photographs, bool as_json) {
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
                                         {"pages", result.model.pages.size()}};
    std::printf("%s\n", json.dump(2).c_str());
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
  if (result.texel_scale > 1) {
    std::printf("texels are %.2f times as long as the photographs allow, to stay within --memory\n",
                result.texel_scale);
  }
}

int RunInvrender(const InvrenderArguments& arguments) {
  arguments.bake.options.Check();
  SceneOptions scene_options;
  scene_options.model_file = arguments.model_file;
  scene_options.model = arguments.model_arguments.Options();
  Scene scene = ReadScene(arguments.scene_folder, scene_options);
  // Cameras from elsewhere have no tags to be odd.
  if (!arguments.views_folder) {
    for (const Advice& advice : FindOddities(scene, scene_options.model)) {
      scene.warnings.push_back(FormatAdvice(advice));
    }
  }
  const WarningsLast warnings(scene.warnings, arguments.common.quiet);
  const std::vector<BakePhotograph> photographs = Select(arguments, scene);
  if (arguments.common.dry_run) {
    std::printf("would texture %zu faces from %zu photographs into %s\n",
                scene.model.faces.size(),
                photographs.size(),
                arguments.out_folder.string().c_str());
    return kExitDone;
  }
  PrepareOutputFolder(arguments.out_folder);
  WriteManifest(arguments.out_folder, Describe(arguments, scene, photographs));
  TuneFreedMemory(arguments.bake);
  BakeOptions options = arguments.bake.Options();
  options.on_face_mask = FaceMaskWriter(arguments.out_folder);
  if (arguments.earlier_model_file) {
    options.as_photographed = ReadModel(*arguments.earlier_model_file, scene_options.model).model;
  }
  const BakeResult result =
      BakeTextures(scene.model, photographs, options, MakeProgress(arguments.common, "texture"));
  WriteBake(result, arguments.out_folder, "." + arguments.bake.format);
  WriteTilesIfAsked(arguments.bake, scene.model, photographs, arguments.out_folder);
  PrintSummary(result, photographs.size(), arguments.common.json);
  return kExitDone;
}

}  // namespace

void AddInvrenderCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<InvrenderArguments>();
  CLI::App* command = app.add_subcommand(
      "invrender", "Turn photographs with known cameras into the model's texture");
  command->add_option("scene", arguments->scene_folder, "scene folder")->required();
  command->add_option("-o,--out", arguments->out_folder, "where to write the textured model")
      ->required();
  command->add_option("--views",
                      arguments->views_folder,
                      ".view files or a COLMAP text model in place of the scene's own tags; "
                      "verdicts in a registration.json beside it are heeded");
  command->add_option("--model", arguments->model_file, "in place of the one in the scene folder");
  command->add_option("--as-photographed",
                      arguments->earlier_model_file,
                      "the model as it was when the photographs were taken, if the building has "
                      "changed since: what both have is textured");
  AddBakeArguments(command, arguments->bake, "--only,--only-faces");
  for (const char* tiles : {"--tiles", "--tile-record"}) {
    command->get_option("--as-photographed")->excludes(command->get_option(tiles));
  }
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(command, "groundglass invrender hall --views hall-out/views -o hall-textured");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return RunInvrender(*arguments); });
  });
}

}  // namespace groundglass
