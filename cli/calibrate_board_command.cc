// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_board.h"
#include "cli/calibrate_parts.h"
#include "cli/json_output.h"
#include "cli/printed_zero.h"
#include "cli/register_arguments.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/lens.h"
#include "scene/progress.h"

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

struct BoardArguments {
  CommonOptions common;
  std::vector<std::filesystem::path> photographs;
  std::filesystem::path lens_file;
  std::filesystem::path print_file;
  std::string camera;
  std::optional<std::filesystem::path> target_file;
  Board board;
  BoardOptions options;
};

int PrintBoard(const BoardArguments& arguments) {
  arguments.board.Check();
  if (arguments.common.dry_run) {
    return TellDryRun(arguments.common,
                      "draw the board into " + arguments.print_file.string(),
                      {{"board", arguments.print_file.string()}});
  }
  WriteSrgb8(arguments.print_file, DrawBoard(arguments.board));
  if (arguments.common.json) {
    PrintJson({{"board", arguments.print_file.string()}});
    return kExitDone;
  }
  std::printf(
      "%s: print it without margins or fitting, mount it flat, and measure a black\n"
      "square's edge (--tag-size) and the white between two (--gap).\n",
      arguments.print_file.c_str());
  return kExitDone;
}

nlohmann::ordered_json JsonFromResult(const BoardResult& result) {
  nlohmann::ordered_json json;
  const Lens& lens = result.lens;
  json["lens"] = {{"camera", lens.name},
                  {"v", lens.view_angle_deg},
                  {"sigma_v", lens.sigma_view_angle_deg},
                  {"a", lens.aspect},
                  {"sigma_a", lens.sigma_aspect},
                  {"shift_x", lens.shift_x},
                  {"sigma_shift_x", lens.sigma_shift_x},
                  {"shift_y", lens.shift_y},
                  {"sigma_shift_y", lens.sigma_shift_y},
                  {"k1", lens.k1},
                  {"sigma_k1", lens.sigma_k1},
                  {"k2", lens.k2},
                  {"sigma_k2", lens.sigma_k2}};
  json["corners"] = result.num_corners;
  json["rms_px"] = result.rms_px;
  if (!result.layout.empty()) json["layout"] = result.layout;
  json["remarks"] = result.remarks;
  json["photographs"] = nlohmann::ordered_json::array();
  for (const BoardSighting& sighting : result.photographs) {
    json["photographs"].push_back(
        {{"name", sighting.name}, {"tags", sighting.num_april_tags}, {"rms_px", sighting.rms_px}});
  }
  return json;
}

void PrintResult(const BoardResult& result) {
  for (const BoardSighting& sighting : result.photographs) {
    if (sighting.num_april_tags == 0) {
      std::printf("%s: too little of the board, left out\n", sighting.name.c_str());
    } else {
      std::printf("%s: %d tags, %.3f px\n",
                  sighting.name.c_str(),
                  sighting.num_april_tags,
                  sighting.rms_px);
    }
  }
  if (!result.layout.empty()) std::printf("board: %s\n", result.layout.c_str());
  const Lens& lens = result.lens;
  std::printf("%d corners, %.3f px\n", result.num_corners, result.rms_px);
  std::printf("v        %10.4f +- %.4f degrees\n", lens.view_angle_deg, lens.sigma_view_angle_deg);
  std::printf("a        %10.5f +- %.5f\n", lens.aspect, lens.sigma_aspect);
  std::printf(
      "shift_x  %10.5f +- %.5f of the width\n", ZeroIfRounded(lens.shift_x, 5), lens.sigma_shift_x);
  std::printf(
      "shift_y  %10.5f +- %.5f of the width\n", ZeroIfRounded(lens.shift_y, 5), lens.sigma_shift_y);
  std::printf("k1       %10.5f +- %.5f\n", ZeroIfRounded(lens.k1, 5), lens.sigma_k1);
  if (lens.sigma_k2 > 0)
    std::printf("k2       %10.5f +- %.5f\n", ZeroIfRounded(lens.k2, 5), lens.sigma_k2);
}

// The photographs that can be read and have the size that most of them have; what is left out is
// told by name.
std::vector<BoardPhotograph> ReadBoardPhotographs(const BoardArguments& arguments,
                                                  std::vector<std::string>& left_out) {
  const Progress progress = MakeProgress(arguments.common, "reading");
  const size_t count = arguments.photographs.size();
  std::vector<BoardPhotograph> photographs(count);
  std::vector<std::string> faults(count);
  ProgressCounter steps(progress, static_cast<int>(count));
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    const std::filesystem::path& file = arguments.photographs[i];
    try {
      photographs[i] = {file.string(), ReadGrey8(file)};
      steps.Tell(file.filename().string());
    } catch (const Error& error) {
      faults[i] = error.what();
    }
  });
  for (const std::string& fault : faults) {
    if (!fault.empty()) left_out.push_back(fault);
  }
  std::erase_if(photographs, [](const auto& one) { return one.srgb_grey.width == 0; });
  std::map<std::pair<int, int>, int> num_of_size;
  const auto size_of = [](const BoardPhotograph& one) {
    return std::pair(one.srgb_grey.width, one.srgb_grey.height);
  };
  for (const BoardPhotograph& photograph : photographs) ++num_of_size[size_of(photograph)];
  const auto usual =
      std::max_element(num_of_size.begin(), num_of_size.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  std::erase_if(photographs, [&](const BoardPhotograph& photograph) {
    const auto [width, height] = size_of(photograph);
    if (std::pair(width, height) == usual->first) return false;
    left_out.push_back(photograph.name + ": " + std::to_string(width) + " x " +
                       std::to_string(height) + " pixels, and the others have " +
                       std::to_string(usual->first.first) + " x " +
                       std::to_string(usual->first.second) +
                       "; photographs of one lens have one size, and are not turned");
    return true;
  });
  return photographs;
}

int CalibrateFromPhotographs(const BoardArguments& arguments) {
  if (arguments.photographs.empty())
    throw CLI::RequiredError("photographs of the board, or --print,");
  if (arguments.lens_file.empty()) throw CLI::RequiredError("-o LENS_FILE");
  if (!arguments.target_file) arguments.board.Check();
  if (arguments.common.dry_run) {
    return TellDryRun(
        arguments.common,
        "calibrate from " + std::to_string(arguments.photographs.size()) +
            " photographs and write " + arguments.lens_file.string(),
        {{"lens", arguments.lens_file.string()}, {"photographs", arguments.photographs.size()}});
  }
  std::vector<std::string> left_out;
  const std::vector<BoardPhotograph> photographs = ReadBoardPhotographs(arguments, left_out);
  if (photographs.empty()) throw Error(left_out.front());
  PrintWarnings(left_out);
  const Board board =
      arguments.target_file ? ReadKalibrTarget(*arguments.target_file) : arguments.board;
  BoardResult result = CalibrateBoard(photographs, board, arguments.options);
  if (result.shows_other_board) {
    throw Error("calibrate board: " + result.remarks.back() + "; no lens is written");
  }
  result.lens.name = arguments.camera;
  WriteFileAtomically(arguments.lens_file, FormatLens(result.lens));
  if (arguments.common.json) {
    std::printf("%s\n", JsonFromResult(result).dump(2).c_str());
  } else {
    PrintResult(result);
    std::printf("%s written\n", arguments.lens_file.c_str());
  }
  for (const std::string& remark : result.remarks) {
    std::fprintf(stderr, "groundglass: %s\n", remark.c_str());
  }
  return left_out.empty() ? kExitDone : kExitNeedsReview;
}

}  // namespace

void AddCalibrateBoard(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<BoardArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "board", "A lens from photographs of a printed AprilTag board, seen from several sides");
  command->add_option("photographs", arguments->photographs, "photographs of the board");
  command->add_option("-o,--out", arguments->lens_file, "the lens file to write");
  command->add_option(
      "--print", arguments->print_file, "draw the board to print, instead of calibrating");
  CLI::Option* target = command->add_option(
      "--target", arguments->target_file, "Kalibr's aprilgrid file, in place of the board's sizes");
  command->add_option("--columns", arguments->board.columns, "tags in a row")
      ->capture_default_str();
  command->add_option("--rows", arguments->board.rows, "tags in a column")->capture_default_str();
  command
      ->add_option(
          "--tag-size", arguments->board.april_tag_size, "a black square's edge, in any unit")
      ->capture_default_str();
  command->add_option("--gap", arguments->board.gap, "white between two squares, same unit")
      ->capture_default_str();
  command->add_option("--first-id", arguments->board.first_id, "lowest number of its tags")
      ->capture_default_str();
  for (const char* size : {"--columns", "--rows", "--tag-size", "--gap", "--first-id", "--print"}) {
    target->excludes(command->get_option(size));
  }
  command->add_flag("--k2", arguments->options.refine_k2, "free k2 as well: for wide lenses");
  command->add_option("--camera", arguments->camera, "the tags' camera name that it serves");
  AddCommonOptions(command, arguments->common);
  AddExample(command,
             "groundglass calibrate board --print board.png\n"
             "  groundglass calibrate board board-1.jpg board-2.jpg board-3.jpg --tag-size 30 "
             "--gap 9 -o my.lens");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->common, [&] {
      return arguments->print_file.empty() ? CalibrateFromPhotographs(*arguments)
                                           : PrintBoard(*arguments);
    });
  });
}

}  // namespace groundglass
