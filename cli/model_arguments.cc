// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/model_arguments.h"

#include "cli/commands.h"
#include "scene/advice.h"
#include "scene/error.h"
#include "scene/model_sigma.h"

namespace groundglass {

ModelOptions ModelArguments::Options() const {
  if (frame == "site" && up == "y") {
    throw Error("--frame site has z up; it cannot go with --up y");
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
      ->check(CLI::PositiveNumber)
      ->group(group);
  command
      ->add_flag("--flip-faces",
                 arguments.flip_faces,
                 "the fronts of the model's faces are on their other side")
      ->group(group);
}

std::string DescribeTolerance(const PolygonModel& model, const ModelArguments& arguments) {
  return "edges may lie " + FormatLength(ModelSigma(model), model.unit) + " off, " +
         (arguments.sigma ? "as --sigma-model says"
          : model.sigma   ? "as the model says"
                          : "by default; --sigma-model says otherwise");
}

}  // namespace groundglass
