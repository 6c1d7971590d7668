// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/montage_arguments.h"

#include "cli/option_range.h"

namespace groundglass {

void AddMontageOptions(CLI::App* command, MontageArguments& arguments) {
  const std::string group = "A design in a photograph (montage)";
  CLI::Option* over =
      command
          ->add_option("--over",
                       arguments.photograph,
                       "the photograph, by name or file; MODEL is an output folder or a scene")
          ->group(group);
  CLI::Option* model =
      command->add_option("--model", arguments.design, "the design: any model file, in colours")
          ->group(group);
  over->needs(model);
  model->needs(over);
  const auto with_over = [&](CLI::Option* option) { option->group(group)->needs(over); };
  with_over(command->add_option(
      "--scene", arguments.scene, "where the photographs and masks of an output folder are"));
  with_over(command->add_flag("--new-parts",
                              arguments.montage.new_parts_only,
                              "leave out what of the design is the building as it stands"));
  with_over(command
                ->add_option("--exposure",
                             arguments.montage.exposure_stops,
                             "brighter (or darker, below 0) than found, stops")
                ->check(FromTo(-10, 10)));
  with_over(command->add_flag("--no-grain", arguments.no_grain, "smooth, without film grain"));
}

}  // namespace groundglass
