// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/view_io.h"
#include "session/bindings.h"
#include "tests/gui/desktop.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kBrick = fs::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
const std::vector<std::string> kSmall = {"--width", "1100", "--height", "760"};

// The brick scene's model and these photographs, tagged or not.
void MakeScene(const fs::path& folder,
               const std::vector<std::string>& tagged,
               const std::vector<std::string>& untagged) {
  fs::create_directories(folder / "images");
  fs::create_directories(folder / "views");
  fs::copy(kBrick / "model.osu", folder / "model.osu");
  const auto copy_image = [&](const std::string& name) {
    fs::copy(kBrick / "images" / (name + ".jpg"), folder / "images" / (name + ".jpg"));
  };
  for (const std::string& name : untagged) copy_image(name);
  for (const std::string& name : tagged) {
    copy_image(name);
    fs::copy(kBrick / "views" / (name + ".view"), folder / "views" / (name + ".view"));
  }
}

std::vector<std::string> With(const std::vector<std::string>& options, const fs::path& folder) {
  std::vector<std::string> arguments = options;
  arguments.push_back(folder.string());
  return arguments;
}

Camera TrueCamera(const std::string& name) {
  for (const NamedCamera& image : ReadColmapModel(kBrick / "truth" / "cameras")) {
    if (fs::path(image.name).stem() == name) return image.camera;
  }
  throw std::runtime_error("no truth of " + name);
}

Eigen::Vector2d PaneCorner(const nlohmann::json& state) {
  return {state["pane"][0].get<double>(), state["pane"][1].get<double>()};
}

// From a photograph's pixels to the window's.
Eigen::Vector2d InWindow(const nlohmann::json& state, const Eigen::Vector2d& photograph_px) {
  const auto& place = state["place"];
  return PaneCorner(state) + Eigen::Vector2d(place[1].get<double>(), place[2].get<double>()) +
         place[0].get<double>() * photograph_px - Eigen::Vector2d(0.5, 0.5);
}

Eigen::Vector2d OnPlan(const nlohmann::json& state, const Eigen::Vector3d& point_in_world) {
  const auto& plan = state["plan"];
  const auto& middle = state["plan_middle"];
  const double scale = plan[2].get<double>();
  return {middle[0].get<double>() + (point_in_world.x() - plan[0].get<double>()) * scale,
          middle[1].get<double>() - (point_in_world.y() - plan[1].get<double>()) * scale};
}

// The mean distance between the model's points as both cameras see them, of those that both do.
double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : model.points_in_world) {
    const auto at = Project(truth, point);
    const auto found_at = Project(found, point);
    if (!at || !found_at || !IsInsideFrame(truth, *at)) continue;
    sum += (*at - *found_at).norm();
    ++count;
  }
  return sum / count;
}

// Of the corners that are seen and that the truth shows too: one that stands apart, so that nobody
// could take it for another, as far as can be from those that are pinned. -1: none is left.
int ChooseCorner(const nlohmann::json& state,
                 const PolygonModel& model,
                 const Camera& truth,
                 const std::vector<int>& pinned) {
  constexpr double kApartPx = 26;
  int best = -1;
  double best_px = -1;
  for (const auto& corner : state["corners"]) {
    const int point = corner[0].get<int>();
    const Eigen::Vector2d seen(corner[1].get<double>(), corner[2].get<double>());
    const auto at = Project(truth, model.points_in_world[point]);
    if (!at || !IsInsideFrame(truth, *at)) continue;
    if (std::count(pinned.begin(), pinned.end(), point) > 0) continue;
    bool is_apart = true;
    for (const auto& other : state["corners"]) {
      const Eigen::Vector2d other_seen(other[1].get<double>(), other[2].get<double>());
      if (other[0] != corner[0] && (other_seen - seen).norm() < kApartPx) is_apart = false;
    }
    double nearest_px = (*at - Eigen::Vector2d(truth.width_px, truth.height_px) / 2).norm();
    if (!pinned.empty()) nearest_px = 1e9;
    for (const int other : pinned) {
      const Eigen::Vector2d other_at = *Project(truth, model.points_in_world[other]);
      nearest_px = std::min(nearest_px, (other_at - *at).norm());
      const Eigen::Vector2d pin = InWindow(state, other_at) - PaneCorner(state);
      if ((pin - seen).norm() < kApartPx) is_apart = false;
    }
    if (!is_apart || nearest_px <= best_px) continue;
    best = point;
    best_px = nearest_px;
  }
  return best;
}

// Drags corners to where the truth has them, by the whole pixels of the window.
int PinCorners(WindowUnderTest& window,
               const PolygonModel& model,
               const Camera& truth,
               int num_pins) {
  std::vector<int> pinned;
  while (static_cast<int>(pinned.size()) < num_pins) {
    const nlohmann::json state = window.Fence();
    const int point = ChooseCorner(state, model, truth, pinned);
    if (point < 0) break;
    pinned.push_back(point);
    for (const auto& corner : state["corners"]) {
      if (corner[0].get<int>() != point) continue;
      const Eigen::Vector2d seen =
          PaneCorner(state) + Eigen::Vector2d(corner[1].get<double>(), corner[2].get<double>());
      const Eigen::Vector2d to = InWindow(state, *Project(truth, model.points_in_world[point]));
      // What lies where it belongs already is clicked, and clicked again where it is.
      if ((to - seen).norm() < 6) {
        window.Click(seen);
        window.Click(to);
      } else {
        window.Drag(seen, to);
      }
      break;
    }
  }
  return static_cast<int>(pinned.size());
}

TEST(Window, ASlideIsPlacedPinnedAlignedAndSavedFromNothing) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {"s5"});
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  const Camera truth = TrueCamera("s5");
  const Desktop desktop(1280, 900);
  {
    WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
    window.Key("F3");
    nlohmann::json state = window.Fence();
    ASSERT_EQ(state["mode"], "Tag");
    ASSERT_EQ(state["photograph"], "s5");
    // As a person remembers it: feet off.
    const Eigen::Vector3d stood = truth.PositionInWorld() + Eigen::Vector3d(4, -5, 0);
    const Eigen::Vector3d looked = truth.PositionInWorld() + 40 * truth.ForwardInWorld();
    window.Drag(OnPlan(state, stood), OnPlan(state, looked));
    state = window.Fence();
    ASSERT_TRUE(state.contains("found")) << state;
    EXPECT_EQ(PinCorners(window, model, truth, 8), 8);
    state = window.Fence();
    EXPECT_EQ(state["pins"], 8) << state["message"];
    const ViewTag pinned = ParseView(state["found"].get<std::string>(), "found");
    EXPECT_LT(VertexErrorPx(model, truth, CameraFromTag(pinned, 1200, 800)), 4);
    window.Key("A");
    state = window.Fence();
    EXPECT_EQ(state["verdict"], "accepted") << state["message"];
    window.Key("Ctrl+S");
    state = window.Fence();
    EXPECT_FALSE(state["unsaved"].get<bool>()) << state["message"];
    window.Key("Ctrl+Q");
    EXPECT_EQ(window.Wait(), 0);
  }
  const ViewTag saved = ReadView(folder / "hall/views/s5.view");
  const double error_px = VertexErrorPx(model, truth, CameraFromTag(saved, 1200, 800));
  RecordProperty("vertex_error_px", std::to_string(error_px));
  EXPECT_LT(error_px, 0.5);
  EXPECT_TRUE(saved.sigmas.position);
}

TEST(Window, UndoToTheStartGivesTheFirstBytesBackAndAllOfItWorksByKeyboard) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const std::string before = ReadTextFile(folder / "hall/views/s5.view");
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
  window.Key("F3");
  window.Fence();
  // Three corners, each taken where it is seen and nudged.
  for (int i = 1; i <= 3; ++i) {
    for (int j = 0; j < 4 * i; ++j) {
      window.Key("Tab");
      window.Fence();
    }
    window.Key("Return");
    window.Fence();
    window.Key("Shift+Right");
    window.Key("Down");
    window.Fence();
    window.Key("Return");
    window.Fence();
  }
  nlohmann::json state = window.Fence();
  EXPECT_EQ(state["pins"], 3);
  EXPECT_EQ(state["undo_depth"], 6) << "a pin is a step, and a run of nudges another";
  window.Key("Ctrl+S");
  window.Fence();
  EXPECT_NE(ReadTextFile(folder / "hall/views/s5.view"), before);
  EXPECT_TRUE(fs::exists(folder / "hall/pins.points"));
  for (int i = 0; i < 6; ++i) {
    window.Key("Ctrl+Z");
    window.Fence();
  }
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_EQ(state["pins"], 0);
  EXPECT_EQ(ReadTextFile(folder / "hall/views/s5.view"), before);
  EXPECT_FALSE(fs::exists(folder / "hall/pins.points"));
}

TEST(Window, WorkOutlivesADisplayThatGoesInTheMiddleOfADrag) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  {
    Desktop desktop(1280, 900);
    WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
    window.Key("F3");
    const nlohmann::json state = window.Fence();
    const auto& corner = state["corners"][state["corners"].size() / 2];
    const Eigen::Vector2d seen =
        PaneCorner(state) + Eigen::Vector2d(corner[1].get<double>(), corner[2].get<double>());
    window.MoveTo(seen);
    window.Fence();
    window.Button(1, true);
    window.Fence();
    window.MoveTo(seen + Eigen::Vector2d(9, 5));
    window.MoveTo(seen + Eigen::Vector2d(18, 9));
    ASSERT_EQ(window.Fence()["pins"], 1);
    desktop.Kill();
    EXPECT_NE(window.Wait(), 0);
  }
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
  EXPECT_TRUE(window.Fence()["left_work"].get<bool>());
  window.Key("Return");
  window.Fence();
  window.Key("F3");
  const nlohmann::json state = window.Fence();
  EXPECT_FALSE(state["left_work"].get<bool>());
  EXPECT_EQ(state["pins"], 1);
  EXPECT_TRUE(state["unsaved"].get<bool>());
}

TEST(Window, WhatCannotBeSavedIsToldAndKept) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {"s5"});
  fs::remove_all(folder / "hall/views");
  folder.Write("hall/views", "a file where a folder should be");
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
  window.Key("F3");
  window.Fence();
  window.Key("H");
  window.Fence();
  window.Key("Ctrl+S");
  const nlohmann::json state = window.Fence();
  EXPECT_THAT(state["message"].get<std::string>(), HasSubstr("not saved"));
  EXPECT_TRUE(state["unsaved"].get<bool>());
}

TEST(Window, APhotographThatGoesWhileItIsOpenIsToldAndItsPinsStay) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s4", "s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmall, folder / "hall"), folder.path());
  window.Fence();
  fs::remove(folder / "hall/images/s5.jpg");
  window.Key("F3");
  window.Key("Alt+Right");
  window.Fence();
  window.Key("A");
  EXPECT_THAT(window.Fence()["message"].get<std::string>(), HasSubstr("s5.jpg"));
}

TEST(Window, EveryKeyOfTheTableIsTakenInEveryMode) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(800, 600);
  WindowUnderTest window(
      desktop, With({"--width", "640", "--height", "480"}, folder / "hall"), folder.path());
  for (const char* mode : {"F2", "F3", "F4"}) {
    for (const Binding& binding : Bindings()) {
      if (binding.action == Action::kQuit || binding.action == Action::kSave ||
          binding.action == Action::kScreenshot || binding.action == Action::kAlign) {
        continue;
      }
      std::istringstream keys{std::string(binding.keys)};
      for (std::string key; keys >> key;) {
        if (key.find_first_of(".,=-") != std::string::npos) continue;
        window.Key(mode);
        window.Key(key);
      }
    }
    window.Key("Escape");
    window.Fence();
  }
}

}  // namespace
}  // namespace groundglass
