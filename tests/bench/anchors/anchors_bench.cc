// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "tests/bench/anchors/castle.h"
#include "tests/bench/anchors/trackers.h"

#include <opencv2/core.hpp>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <tuple>

// Peers on ViSP's own sequence, all from the same starts: how many end near the truth, how near,
// and at what cost. Each family's best setting for each cell is its bar.
//   anchors_bench [STARTS_PER_CELL [CASTLE_SIMU_FOLDER]]

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

Cell Measure(const Castle& castle,
             const std::vector<PerturbedStart>& starts,
             const Method& method) {
  Cell cell;
  std::vector<double> errors_px;
  std::vector<double> times_ms;
  for (const PerturbedStart& start : starts) {
    const Camera truth = CameraFromTag(castle.frames[start.frame].tag, 640, 480);
    const double before_ms = ProcessCpuMs();
    const Method::Found found = method.align(castle, start);
    times_ms.push_back(ProcessCpuMs() - before_ms);
    errors_px.push_back(VertexErrorPx(castle.model, truth, found.camera));
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

int Run(int num_starts, const std::filesystem::path& folder) {
  const Castle castle = ReadCastle(folder);
  std::vector<std::vector<PerturbedStart>> starts;
  for (const double error_px : kCellsPx) {
    starts.push_back(MakeStarts(castle, error_px, num_starts, 1988));
  }
  std::vector<Method> methods = GroundglassMethods();
  for (const Method& method : VispMethods()) methods.push_back(method);
  for (const Method& method : OpenCvMethods()) methods.push_back(method);

  std::printf("%zu faces, ", castle.model.faces.size());
  std::printf("%d starts a cell; share within 3 px / within 1 px / median px / CPU ms\n",
              num_starts);
  std::printf("| %-11s | %-32s |", "method", "setting");
  for (const double error_px : kCellsPx) std::printf(" %20.0f px |", error_px);
  std::printf("\n");
  std::map<std::string, std::vector<Cell>> best_of_family;
  for (const Method& method : methods) {
    std::printf("| %-11s | %-32s |", method.family.c_str(), method.setting.c_str());
    std::vector<Cell>& best = best_of_family[method.family];
    best.resize(std::size(kCellsPx));
    for (size_t i = 0; i < std::size(kCellsPx); ++i) {
      const Cell cell = Measure(castle, starts[i], method);
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
  std::printf("\nThe best setting for each cell: share within 3 px (within 1 px)\n");
  for (const auto& [family, cells] : best_of_family) {
    std::printf("| %-11s |", family.c_str());
    for (const Cell& cell : cells) {
      std::printf(
          " %3.0f %% (%3.0f %%) |", 100 * cell.share_within_3_px, 100 * cell.share_within_1_px);
    }
    std::printf(" median %.2f px from %.0f px | %.0f ms |\n",
                cells[0].median_px,
                kCellsPx[0],
                cells[0].cpu_ms);
  }
  for (size_t i = 0; i < std::size(kCellsPx); ++i) {
    const Cell& cell = best_of_family["Groundglass"][i];
    std::printf("Groundglass from %.0f px: %d of %d accepted, %d of them beyond 3 px\n",
                kCellsPx[i],
                cell.num_accepted,
                num_starts,
                cell.num_wrong_accepted);
  }
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    return groundglass::Run(
        argc > 1 ? std::max(2, std::atoi(argv[1])) : 50,
        argc > 2 ? argv[2] : "/usr/share/visp-images-data/ViSP-images/mbt-depth/Castle-simu");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "anchors_bench: %s\n", error.what());
    return 1;
  }
}
