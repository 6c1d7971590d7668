// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/model_arguments.h"

#include "cli/commands.h"
#include "cli/option_range.h"
#include "scene/advice/advice.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace groundglass {

ModelOptions ModelArguments::Options() const {
  if (frame == "site" && up == "y") {
    throw CLI::ValidationError("--frame", "site has z up; it cannot go with --up y");
  }
  ModelOptions options;
  options.unit = unit;
  options.sigma = sigma;
  options.flip_faces = flip_faces;
  if (up == "z") options.mesh_axes = MeshAxes::kZUp;
  if (frame == "world") options.mesh_axes = MeshAxes::kWorld;
  if (frame == "site") options.mesh_axes = MeshAxes::kSite;
  if (up == "y") options.mesh_axes = MeshAxes::kYUp;
  return options;
}

void AddModelOptions(CLI::App* command, ModelArguments& arguments) {
  const std::string group = "How the model is read, where its file does not say or is wrong";
  AddChoice(command, "--up", {"y", "z"}, "the axis that is up", arguments.up)->group(group);
  AddChoice(command,
            "--frame",
            {"world", "site"},
            "where y points: world (right-handed): north; site (left-handed, as .osu): south",
            arguments.frame)
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--unit",
          [&arguments](const std::string& unit) {
            arguments.unit = FindUnit(unit);
            if (!arguments.unit) {
              throw CLI::ValidationError("--unit", unit + " is not one of " + UnitNames());
            }
          },
          "of the model's lengths and of the tags': " + UnitNames())
      ->group(group);
  command
      ->add_option_function<double>(
          "--sigma-model",
          [&arguments](double sigma) { arguments.sigma = sigma; },
          "how far the model's edges may lie off, one standard deviation, model's unit")
      ->check(Above(0))
      ->group(group);
  command
      ->add_flag("--flip-faces",
                 arguments.flip_faces,
                 "the fronts of the model's faces are on their other side")
      ->group(group);
}

std::optional<std::string> DescribeOtherModels(const std::filesystem::path& folder,
                                               const std::filesystem::path& model_file) {
  constexpr std::array kExtensions = {".osu", ".obj", ".ply", ".stl", ".gltf", ".glb"};
  std::vector<std::string> others;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::filesystem::path& file = entry.path();
    const std::string extension = LowerCase(file.extension().string());
    if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) continue;
    if (!entry.is_regular_file(failure) || file.filename() == model_file.filename()) continue;
    others.push_back(file.filename().string());
  }
  if (others.empty()) return std::nullopt;
  std::sort(others.begin(), others.end());
  std::string list;
  for (const std::string& other : others) list += (list.empty() ? "" : ", ") + other;
  return folder.string() + ": the model that is read is " + model_file.filename().string() + "; " +
         list + " beside it " + (others.size() == 1 ? "is" : "are") +
         " not (--model FILE chooses another)";
}

std::string DescribeTolerance(const PolygonModel& model, const ModelArguments& arguments) {
  return "edges may lie " + FormatLength(ModelSigma(model), model.unit) + " off, " +
         (arguments.sigma ? "as --sigma-model says"
          : model.sigma   ? "as the model says"
                          : "by default; --sigma-model says otherwise");
}

}  // namespace groundglass
