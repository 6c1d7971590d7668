// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// window_bench [PHOTOGRAPHS]: how long the window takes from a move of the mouse to the frame that
// shows it, with so many photographs, while their thumbnails are being made and after.
#include "tests/gui/brick_window.h"
#include "tests/gui/desktop.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Turns the model to and fro for some seconds, as a hand does.
void Turn(WindowUnderTest& window, const char* when) {
  nlohmann::json before = window.Fence();
  const Eigen::Vector2d middle =
      PaneCorner(before) +
      Eigen::Vector2d(before["pane"][2].get<double>() / 2, before["pane"][3].get<double>() / 2);
  window.MoveTo(middle);
  before = window.Fence();
  window.Button(1, true);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; std::chrono::steady_clock::now() - start < 6s; ++i) {
    window.MoveTo(middle + Eigen::Vector2d(120 * std::sin(0.05 * i), 30 * std::sin(0.03 * i)));
    std::this_thread::sleep_for(16ms);
  }
  window.Button(1, false);
  const nlohmann::json after = window.Fence();
  std::vector<double> answers_ms = after["answers_ms"].get<std::vector<double>>();
  std::sort(answers_ms.begin(), answers_ms.end());
  if (answers_ms.empty()) return;
  const auto at = [&](double share) {
    return answers_ms[static_cast<size_t>(share * static_cast<double>(answers_ms.size() - 1))];
  };
  std::printf(
      "%-24s %4zu pictures; ms to the answer: median %.0f, 95%% %.0f, longest %.0f, %td above 100; "
      "longest turn of the window %.0f ms; thumbnails %d to %d\n",
      when,
      answers_ms.size(),
      at(0.5),
      at(0.95),
      answers_ms.back(),
      answers_ms.end() - std::upper_bound(answers_ms.begin(), answers_ms.end(), 100.0),
      after["longest_turn_ms"].get<double>(),
      before["thumbnails"].get<int>(),
      after["thumbnails"].get<int>());
  std::fflush(stdout);
}

int Run(int num_photographs) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  for (int i = 1; i < num_photographs; ++i) {
    const std::string name = "p" + std::to_string(i);
    fs::create_hard_link(folder / "hall/images/s5.jpg", folder / ("hall/images/" + name + ".jpg"));
    fs::create_hard_link(folder / "hall/views/s5.view", folder / ("hall/views/" + name + ".view"));
  }
  const Desktop desktop(1600, 1100);
  WindowUnderTest window(desktop, {(folder / "hall").string()}, folder.path());
  Turn(window, "thumbnails are pending");
  while (window.Fence()["thumbnails"] != num_photographs) std::this_thread::sleep_for(500ms);
  Turn(window, "all are there");
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) { return groundglass::Run(argc > 1 ? std::atoi(argv[1]) : 500); }
