// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "tests/bench/anchors/anchor_set.h"
#include "tests/bench/anchors/castle.h"
#include "tests/bench/anchors/cube.h"
#include "tests/bench/anchors/facade.h"
#include "tests/bench/anchors/trackers.h"

#include <opencv2/core.hpp>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>

// Peers on three objects, all from the same starts: how many end near the truth, how near, and at
// what cost. Each family's best setting for each cell is its bar.
//   anchors_bench [--ours] [STARTS_PER_CELL [SET...]]    SET: castle, facade, relief, cube; or all
// --ours: Groundglass alone, which takes a tenth of the time.
// ViSP's pictures are looked for where VISP_INPUT_IMAGE_PATH says, as ViSP's own programs do.

namespace groundglass {
namespace {

constexpr double kCellsPx[] = {5, 10, 20, 40};

double ProcessCpuMs() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

struct Cell {
  double share_within_3_px = 0;
  double share_within_1_px = 0;
  double median_px = 0;
  double cpu_ms = 0;
  int num_accepted = 0;
  int num_wrong_accepted = 0;  // accepted beyond 3 px
};

Cell Measure(const AnchorSet& set,
             const std::vector<PerturbedStart>& starts,
             const Method& method) {
  Cell cell;
  std::vector<double> errors_px;
  std::vector<double> times_ms;
  for (const PerturbedStart& start : starts) {
    const Camera truth = TrueCamera(set.frames[start.frame]);
    const double before_ms = ProcessCpuMs();
    const Method::Found found = method.align(start);
    times_ms.push_back(ProcessCpuMs() - before_ms);
    errors_px.push_back(VertexErrorPx(set.model, truth, found.camera));
    const double share = 1.0 / static_cast<double>(starts.size());
    if (errors_px.back() < 3) cell.share_within_3_px += share;
    if (errors_px.back() < 1) cell.share_within_1_px += share;
    cell.num_accepted += found.is_accepted;
    cell.num_wrong_accepted += found.is_accepted && !(errors_px.back() < 3);
  }
  cell.median_px = Median(errors_px);
  cell.cpu_ms = Median(times_ms);
  return cell;
}

using Cells = std::vector<Cell>;

// All settings on one set, printed as a table; returns each family's best setting for each cell.
std::map<std::string, Cells> MeasureSet(const AnchorSet& set, int num_starts, bool only_ours) {
  std::vector<std::vector<PerturbedStart>> starts;
  for (const double error_px : kCellsPx) {
    starts.push_back(MakeStarts(set, error_px, num_starts, 1988));
  }
  std::vector<Method> methods = GroundglassMethods(set);
  if (!only_ours) {
    for (const Method& method : VispMethods(set)) methods.push_back(method);
    for (const Method& method : OpenCvMethods(set)) methods.push_back(method);
  }

  std::printf("\n%s: %zu faces, %zu frames of %d x %d, ",
              set.name.c_str(),
              set.model.faces.size(),
              set.frames.size(),
              set.frames[0].grey8.width,
              set.frames[0].grey8.height);
  std::printf("%d starts a cell; within 3 px %% / within 1 px %% / median px / CPU ms\n",
              num_starts);
  std::printf("| %-11s | %-32s |", "method", "setting");
  for (const double error_px : kCellsPx) std::printf(" %20.0f px |", error_px);
  std::printf("\n|---|---|---|---|---|---|\n");
  std::map<std::string, Cells> best_of_family;
  for (const Method& method : methods) {
    std::printf("| %-11s | %-32s |", method.family.c_str(), method.setting.c_str());
    Cells& best = best_of_family[method.family];
    best.resize(std::size(kCellsPx));
    for (size_t i = 0; i < std::size(kCellsPx); ++i) {
      const Cell cell = Measure(set, starts[i], method);
      std::printf(" %3.0f / %3.0f / %5.2f / %4.0f |",
                  100 * cell.share_within_3_px,
                  100 * cell.share_within_1_px,
                  std::min(cell.median_px, 99.99),
                  cell.cpu_ms);
      std::fflush(stdout);
      const auto rank = [](const Cell& c) {
        return std::tuple(c.share_within_3_px, c.share_within_1_px, -c.median_px);
      };
      if (best[i].cpu_ms == 0 || rank(cell) > rank(best[i])) best[i] = cell;
    }
    std::printf("\n");
  }
  for (size_t i = 0; i < std::size(kCellsPx); ++i) {
    const Cell& cell = best_of_family["Groundglass"][i];
    std::printf("Groundglass from %.0f px: %d of %d accepted, %d of them beyond 3 px\n",
                kCellsPx[i],
                cell.num_accepted,
                num_starts,
                cell.num_wrong_accepted);
  }
  return best_of_family;
}

// The head table: every family's best setting for each cell of each set.
void PrintHeads(const std::vector<std::pair<std::string, std::map<std::string, Cells>>>& sets) {
  std::printf(
      "\nThe best setting for each cell: share within 3 px (within 1 px); median and CPU of the "
      "first cell's best, CPU of the last's\n| set | method |");
  for (const double error_px : kCellsPx) std::printf(" %.0f px |", error_px);
  std::printf(
      " median from %.0f px | CPU from %.0f px; %.0f px |\n|---|---|---|---|---|---|---|---|\n",
      kCellsPx[0],
      kCellsPx[0],
      kCellsPx[std::size(kCellsPx) - 1]);
  for (const auto& [set, families] : sets) {
    for (const auto& [family, cells] : families) {
      std::printf("| %s | %s |", set.c_str(), family.c_str());
      for (const Cell& cell : cells) {
        std::printf(
            " %.0f %% (%.0f %%) |", 100 * cell.share_within_3_px, 100 * cell.share_within_1_px);
      }
      std::printf(" %.2f px | %.0f ms; %.0f ms |\n",
                  cells[0].median_px,
                  cells[0].cpu_ms,
                  cells.back().cpu_ms);
    }
  }
}

AnchorSet MakeSet(const std::string& name) {
  const char* images = std::getenv("VISP_INPUT_IMAGE_PATH");
  const std::filesystem::path folder =
      std::filesystem::path(images ? images : "/usr/share/visp-images-data") / "ViSP-images";
  if (name == "castle") return ReadCastle(folder / "mbt-depth" / "Castle-simu");
  if (name == "facade") return MakeFacade(0);
  if (name == "relief") return MakeFacade(1);
  if (name == "cube") {
    Cube cube = ReadCube(folder / "mbt");
    std::printf("\ncube: two references differ by %.2f px on average\n", cube.reference_spread_px);
    return std::move(cube.set);
  }
  throw Error("no set is called " + name + "; there are castle, facade, relief and cube");
}

int Run(int num_starts, const std::vector<std::string>& names, bool only_ours) {
  std::vector<std::pair<std::string, std::map<std::string, Cells>>> heads;
  for (const std::string& name : names) {
    const AnchorSet set = MakeSet(name);
    heads.emplace_back(set.name, MeasureSet(set, num_starts, only_ours));
  }
  PrintHeads(heads);
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool only_ours = std::erase(arguments, "--ours") > 0;
    std::vector<std::string> names(arguments.begin() + (arguments.empty() ? 0 : 1),
                                   arguments.end());
    if (names.empty()) names = {"castle", "facade", "relief", "cube"};
    const int num_starts = arguments.empty() ? 50 : std::max(2, std::atoi(arguments[0].c_str()));
    return groundglass::Run(num_starts, names, only_ours);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "anchors_bench: %s\n", error.what());
    return 1;
  }
}
