// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/elevation_arguments.h"

#include "cli/option_range.h"
#include "scene/text.h"

#include <optional>
#include <string_view>

namespace groundglass {
namespace {

// The numbers of "1:50" or "50".
std::optional<double> ParseScale(std::string_view text) {
  if (text.starts_with("1:")) text.remove_prefix(2);
  const std::optional<double> scale = ParseNumber(text);
  return scale && *scale > 0 && *scale < 1e6 ? scale : std::nullopt;
}

constexpr const char* kToScale = "To scale";

// A number that stays unset where the option is not given.
void AddDepthOption(CLI::App* command,
                    const std::string& name,
                    const std::string& description,
                    std::optional<double>& depth) {
  command
      ->add_option_function<double>(
          name, [&depth](double value) { depth = value; }, description)
      ->group(kToScale);
}

void AddWhatIsDrawn(CLI::App* command, ElevationArguments& arguments) {
  command
      ->add_option("--elevation",
                   arguments.elevation,
                   "square to these faces (names or numbers, with commas between), to the side "
                   "that faces north, east, ...; or 'all' of the model's sides")
      ->group(kToScale);
  command
      ->add_option("--section",
                   arguments.section,
                   "what is behind an upright plane, x,y,x,y (site, left to right as it is seen), "
                   "or below a level one, z=height")
      ->group(kToScale);
  command
      ->add_option("--developed",
                   arguments.developed,
                   "the fronts of a street laid out flat: faces from left to right")
      ->delimiter(',')
      ->group(kToScale);
  command->add_flag("--crop", arguments.drawing.is_cropped, "no more than the named faces")
      ->group(kToScale);
  AddDepthOption(command,
                 "--before",
                 "how far before its plane things are drawn, model's unit; else all",
                 arguments.drawing.before);
  AddDepthOption(command, "--behind", "and how far behind it", arguments.drawing.behind);
}

void AddScaleAndFiles(CLI::App* command, ElevationArguments& arguments) {
  command
      ->add_option_function<std::string>(
          "--scale",
          [&arguments](const std::string& text) {
            const std::optional<double> scale = ParseScale(text);
            if (!scale) throw CLI::ValidationError("--scale", Quote(text) + " is not as 1:50");
            arguments.write.scale = *scale;
          },
          "1:50 if not given")
      ->group(kToScale);
  command->add_option("--dpi", arguments.write.dpi, "pixels an inch on paper")
      ->check(FromTo(10, 2400))
      ->capture_default_str()
      ->group(kToScale);
  command
      ->add_option("--also",
                   arguments.also,
                   "further files beside the first: tif, pdf, svg, dxf, layers (photograph, "
                   "standard deviation and height of each pixel)")
      ->check(CLI::IsMember({"tif", "pdf", "svg", "dxf", "layers"}))
      ->delimiter(',')
      ->group(kToScale);
}

void AddSheetOptions(CLI::App* command, ElevationArguments& arguments) {
  command->add_option("--margin", arguments.margin_mm, "around the drawing, mm on paper")
      ->check(FromTo(0, 1000))
      ->capture_default_str()
      ->group(kToScale);
  command->add_option("--title", arguments.write.title, "of the PDF")->group(kToScale);
  command->add_option("--note", arguments.write.note, "who drew it, when: a line of the PDF")
      ->group(kToScale);
  command
      ->add_flag("!--no-title-block",
                 arguments.write.has_title_block,
                 "the PDF without title, scale bar, north and what is said of accuracy")
      ->group(kToScale);
}

}  // namespace

void AddElevationOptions(CLI::App* command, ElevationArguments& arguments) {
  AddWhatIsDrawn(command, arguments);
  AddScaleAndFiles(command, arguments);
  AddSheetOptions(command, arguments);
}

}  // namespace groundglass
