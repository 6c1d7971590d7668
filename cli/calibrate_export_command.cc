// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/calibrate_parts.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/foreign_lens.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

struct ExportArguments {
  CommonOptions common;
  std::filesystem::path lens_file, out_file;
  std::string format = "groundglass";
  std::string size;
};

// "1500x1000".
std::pair<int, int> ReadPictureSize(const std::string& text) {
  const size_t by = text.find('x');
  if (by != std::string::npos) {
    const auto width = ParseInteger(text.substr(0, by));
    const auto height = ParseInteger(text.substr(by + 1));
    if (width && height && *width > 0 && *height > 0 && *width < 1000000 && *height < 1000000) {
      return {static_cast<int>(*width), static_cast<int>(*height)};
    }
  }
  throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, as in 1500x1000");
}

// Sides that make pixels nearly square only when they are exchanged are those of a picture that was
// turned.
void CheckSides(const Lens& lens, int width, int height) {
  const double sides = static_cast<double>(width) / height;
  const double as_given = std::abs(std::log(lens.aspect / sides));
  const double exchanged = std::abs(std::log(lens.aspect * sides));
  if (as_given < 0.2 || exchanged >= as_given) return;
  throw Error("--size " + std::to_string(width) + "x" + std::to_string(height) +
              ": the lens has a " + FormatNumber(lens.aspect) +
              ", width / height of its frame; is it " + std::to_string(height) + "x" +
              std::to_string(width) + "?");
}

int ExportLens(const ExportArguments& arguments) {
  const Lens lens = ReadLens(arguments.lens_file);
  std::string text;
  if (arguments.format == "groundglass") {
    text = FormatLens(lens);
  } else {
    if (arguments.size.empty()) throw CLI::RequiredError("--size WIDTHxHEIGHT");
    const auto [width, height] = ReadPictureSize(arguments.size);
    CheckSides(lens, width, height);
    const auto name = std::find(kLensFormatNames.begin(), kLensFormatNames.end(), arguments.format);
    text = FormatForeignLens(
        lens, static_cast<LensFormat>(name - kLensFormatNames.begin()), width, height);
  }
  if (!arguments.common.dry_run) WriteFileAtomically(arguments.out_file, text);
  if (!arguments.common.quiet) {
    std::printf(
        "%s%s\n", arguments.common.dry_run ? "would write " : "", arguments.out_file.c_str());
  }
  return kExitDone;
}

}  // namespace

void AddCalibrateExport(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "export", "A lens file as COLMAP, OpenCV, ROS or Kalibr have it, or one of theirs as ours");
  command->add_option("lens", arguments->lens_file, "a lens file, of any of these programs")
      ->required();
  command->add_option("-o,--out", arguments->out_file, "the file to write")->required();
  AddChoice(command,
            "--format",
            {"groundglass", "colmap", "opencv", "ros", "kalibr"},
            "the program that is to read it",
            arguments->format);
  command->add_option("--size", arguments->size, "of the photographs, for other programs' files")
      ->type_name("WxH");
  AddCommonOptions(command, arguments->common);
  AddExample(command,
             "groundglass calibrate export my.lens -o camera_info.yaml --format ros --size "
             "1500x1000");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] { return ExportLens(*arguments); });
  });
}

}  // namespace groundglass
