// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "invrender/bake_output.h"
#include "scene/output_folder.h"
#include "scene/registration_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

struct InvrenderArguments {
  CommonOptions common;
  std::filesystem::path scene_folder;
  std::filesystem::path out_folder;
  std::optional<std::filesystem::path> views_folder;
  std::optional<std::filesystem::path> model_file;
  std::vector<std::string> exclude;
  bool accepted_only = false;
  bool no_colour = false;
  bool no_consensus = false;
  BakeOptions options;
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
            ? SelectPhotographs(scene, ReadRegistrations(verdicts), arguments.accepted_only)
            : SelectPhotographs(scene, ReadCameras(scene, folder));
  }
  std::erase_if(photographs, [&](const BakePhotograph& photograph) {
    return std::find(arguments.exclude.begin(), arguments.exclude.end(), photograph.name) !=
           arguments.exclude.end();
  });
  return photographs;
}

Manifest Describe(const InvrenderArguments& arguments,
                  const Scene& scene,
                  const std::vector<BakePhotograph>& photographs) {
  Manifest manifest;
  manifest.version = GROUNDGLASS_VERSION;
  manifest.command = "invrender";
  manifest.seed = arguments.common.seed;
  manifest.options = {{"texel_size", std::to_string(arguments.options.texel_size)},
                      {"max_texture", std::to_string(arguments.options.max_page_texels)},
                      {"match_colour", arguments.options.match_colour ? "yes" : "no"},
                      {"reject_occluders", arguments.options.reject_occluders ? "yes" : "no"}};
  manifest.sha256_of_inputs[scene.model_file.filename().string()] = HashFile(scene.model_file);
  for (const BakePhotograph& photograph : photographs) {
    for (const auto& file :
         {std::optional(photograph.image_file), photograph.mask_file, photograph.faces_file}) {
      if (!file) continue;
      manifest.sha256_of_inputs[file->lexically_relative(scene.folder).generic_string()] =
          HashFile(*file);
    }
  }
  return manifest;
}

void PrintSummary(const BakeResult& result, size_t num_photographs, bool as_json) {
  long num_texels = 0;
  int num_bare = 0;
  for (const FaceCoverage& face : result.coverage.faces) {
    num_texels += face.num_covered_texels;
    num_bare += face.num_covered_texels == 0 ? 1 : 0;
  }
  if (as_json) {
    const nlohmann::ordered_json json = {{"photographs", num_photographs},
                                         {"faces", result.coverage.faces.size()},
                                         {"faces_without_texture", num_bare},
                                         {"covered_share", result.coverage.CoveredShare()},
                                         {"covered_texels", num_texels},
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
}

int RunInvrender(const InvrenderArguments& arguments) {
  arguments.options.Check();
  SceneOptions scene_options;
  scene_options.model_file = arguments.model_file;
  scene_options.model.unit = arguments.common.unit;
  const Scene scene = ReadScene(arguments.scene_folder, scene_options);
  for (const std::string& warning : scene.warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
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
  const BakeResult result = BakeTextures(
      scene.model, photographs, arguments.options, MakeProgress(arguments.common, "texture"));
  WriteBake(result, arguments.out_folder);
  WriteFaceMasks(
      scene.model, photographs, arguments.out_folder, MakeProgress(arguments.common, "masks"));
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
  command
      ->add_option("--texel-size",
                   arguments->options.texel_size,
                   "side of a texel, model's unit; 0: as fine as the photographs, face by face")
      ->capture_default_str();
  command
      ->add_option("--max-texture",
                   arguments->options.max_page_texels,
                   "texels along a side of the largest page")
      ->capture_default_str();
  command->add_option("--exclude", arguments->exclude, "photographs to leave out, by name");
  command->add_flag("--accepted-only", arguments->accepted_only, "leave out those in review");
  command->add_flag("--no-colour",
                    arguments->no_colour,
                    "keep the photographs' own exposure, white balance and light");
  command->add_flag("--no-consensus",
                    arguments->no_consensus,
                    "keep what only one photograph shows: trees, cars, shadows");
  AddCommonOptions(command, arguments->common);
  command->callback([arguments, &exit_status] {
    arguments->options.match_colour = !arguments->no_colour;
    arguments->options.reject_occluders = !arguments->no_consensus;
    exit_status = RunWithThreads(arguments->common, [&] { return RunInvrender(*arguments); });
  });
}

}  // namespace groundglass
