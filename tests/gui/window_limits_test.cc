// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/view_io.h"
#include "tests/gui/brick_window.h"
#include "tests/gui/desktop.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Holds the eye to one number that keys change: presses `more` or `less` until it is as near to
// zero as they bring it. off: of the eye's position.
void Steer(WindowUnderTest& window,
           const char* more,
           const char* less,
           const std::function<double(const Eigen::Vector3d& eye)>& off) {
  const auto now = [&] {
    const nlohmann::json state = window.Fence();
    const auto& eye = state["eye"];
    return off({eye[0].get<double>(), eye[1].get<double>(), eye[2].get<double>()});
  };
  constexpr int kMostPresses = 40;
  double before = now();
  for (int i = 0; i < kMostPresses; ++i) {
    window.Key(before < 0 ? more : less);
    const double after = now();
    if (std::abs(after) >= std::abs(before)) return;
    before = after;
  }
}

TEST(Window, APhotographWithoutATagIsPlacedPinnedAndSavedWithNoMouse) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {"s5"});
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  const Camera truth = TrueCamera("s5");
  const Eigen::Vector3d middle = ComputeBounds(model).Center();
  const Eigen::Vector3d stood = truth.PositionInWorld() - middle;
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  // Around the model until one looks from where the photographer stood, then as near.
  const auto turned = [&](const Eigen::Vector3d& eye) {
    const Eigen::Vector2d at = (eye - middle).head<2>();
    return std::atan2(stood.x() * at.y() - stood.y() * at.x(), stood.head<2>().dot(at));
  };
  const auto farther = [&](const Eigen::Vector3d& eye) {
    return (eye - middle).norm() - stood.norm();
  };
  Steer(window, "Left", "Right", turned);
  Steer(window, "Right", "Left", turned);
  Steer(window, "PageDown", "PageUp", farther);
  window.Key("F3");
  window.Key("H");
  nlohmann::json state = window.Fence();
  ASSERT_TRUE(state.contains("found")) << state["message"];
  std::vector<int> pinned;
  for (int i = 0; i < 8; ++i) {
    const int point = ChooseCorner(state, model, truth, pinned);
    ASSERT_GE(point, 0);
    pinned.push_back(point);
    for (size_t j = 0; state["armed"] != point; ++j) {
      ASSERT_LE(j, model.points_in_world.size());
      window.Key("Tab");
      state = window.Fence();
    }
    Eigen::Vector2d seen = Eigen::Vector2d::Zero();
    for (const auto& corner : state["corners"]) {
      if (corner[0] == point) seen = {corner[1].get<double>(), corner[2].get<double>()};
    }
    const auto& place = state["place"];
    const Eigen::Vector2d at =
        (seen - Eigen::Vector2d(place[1].get<double>(), place[2].get<double>())) /
        place[0].get<double>();
    window.Key("Return");
    window.Fence();
    const Eigen::Vector2d by = *Project(truth, model.points_in_world[point]) - at;
    for (const auto& [axis, more, less] : {std::tuple{0, "Right", "Left"}, {1, "Down", "Up"}}) {
      const long px = std::lround(by[axis]);
      const std::string key = px > 0 ? more : less;
      for (long k = 0; k < std::abs(px) / 10; ++k) window.Key("Ctrl+" + key);
      for (long k = 0; k < std::abs(px) % 10; ++k) window.Key("Shift+" + key);
      window.Fence();
    }
    window.Key("Return");
    state = window.Fence();
  }
  EXPECT_EQ(state["pins"], 8);
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_FALSE(state["unsaved"].get<bool>()) << state["message"];
  window.Key("Ctrl+Q");
  EXPECT_EQ(window.Wait(), 0);
  const ViewTag saved = ReadView(folder / "hall/views/s5.view");
  const double error_px = VertexErrorPx(model, truth, CameraFromTag(saved, 1200, 800));
  RecordProperty("vertex_error_px", std::to_string(error_px));
  EXPECT_LT(error_px, 4) << "eight pins by whole pixels";
}

TEST(Window, TextTwiceAsLargeLeavesPinsWhereTheyArePut) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  std::vector<std::string> arguments = With(kSmallWindow, folder / "hall");
  arguments.insert(arguments.end(), {"--scale", "2"});
  WindowUnderTest window(desktop, arguments, folder.path());
  window.Key("F3");
  nlohmann::json state = window.Fence();
  const auto& corner = state["corners"][state["corners"].size() / 2];
  const Eigen::Vector2d seen =
      PaneCorner(state) + Eigen::Vector2d(corner[1].get<double>(), corner[2].get<double>());
  window.Drag(seen, seen + Eigen::Vector2d(12, 7));
  state = window.Fence();
  EXPECT_EQ(state["pins"], 1);
  // The keys are shown, and go again.
  window.Key("F1");
  EXPECT_TRUE(window.Fence()["covered"].get<bool>());
  window.Key("F1");
  EXPECT_FALSE(window.Fence()["covered"].get<bool>());
  window.Key("Ctrl+0");
  EXPECT_NE(window.Fence()["pane"], state["pane"]) << "text as large as usual";
  window.Key("Ctrl+S");
  EXPECT_FALSE(window.Fence()["unsaved"].get<bool>());
}

TEST(Window, FiveHundredPhotographsAreDrawnMovedAroundAndEntered) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  constexpr int kPhotographs = 500;
  for (int i = 100; i < 100 + kPhotographs; ++i) {
    const std::string name = "p" + std::to_string(i);
    fs::create_hard_link(folder / "hall/images/s5.jpg", folder / ("hall/images/" + name + ".jpg"));
    fs::create_hard_link(folder / "hall/views/s5.view", folder / ("hall/views/" + name + ".view"));
  }
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  nlohmann::json before = window.Fence();
  for (const char* key : {"Right", "PageUp"}) {
    window.Key(key);
    const nlohmann::json after = window.Fence();
    EXPECT_GT(after["pictures"].get<int>(), before["pictures"].get<int>());
    EXPECT_NE(after["eye"], before["eye"]);
    before = after;
  }
  window.Key("F3");
  const nlohmann::json inside = window.Fence();
  EXPECT_TRUE(inside["inside"].get<bool>());
}

TEST(Window, ThumbnailsWaitForTheHandAndComeAllTheSame) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  constexpr int kPhotographs = 30;
  for (int i = 1; i < kPhotographs; ++i) {
    const std::string name = "p" + std::to_string(i);
    fs::create_hard_link(folder / "hall/images/s5.jpg", folder / ("hall/images/" + name + ".jpg"));
  }
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  // Entering one reads it before those that nobody has asked for.
  window.Key("Right");
  window.Key("F3");
  nlohmann::json state = window.Fence();
  EXPECT_TRUE(state["inside"].get<bool>());
  window.Key("F2");
  for (const char* key : {"Right", "Left"}) window.Key(key);
  while (state["thumbnails"] != kPhotographs) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    state = window.Fence();
  }
  EXPECT_EQ(state["thumbnails"], kPhotographs);
}

TEST(Window, AScanOf24MegapixelsIsPinnedInItsOwnPixels) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Image8 slide = ReadSrgb8(kBrick / "images/s5.jpg");
  Image8 scan(6000, 4000, 3);
  for (int y = 0; y < scan.height; ++y) {
    for (int x = 0; x < scan.width; ++x) {
      std::copy_n(slide.At(x / 5, y / 5), 3, scan.At(x, y));
    }
  }
  ImageWriteOptions quick;
  quick.jpeg_quality = 60;
  WriteSrgb8(folder / "hall/images/s5.jpg", scan, quick);
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("F3");
  nlohmann::json state = window.Fence();
  EXPECT_LT(state["place"][0].get<double>(), 0.2) << "all of it is seen";
  window.Key("Tab");
  window.Fence();
  window.Key("Return");
  window.Key("Ctrl+Right");
  window.Fence();
  window.Key("Z");
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_DOUBLE_EQ(state["place"][0].get<double>(), 1);
  EXPECT_EQ(state["pins"], 1);
  EXPECT_FALSE(state["unsaved"].get<bool>()) << state["message"];
}

}  // namespace
}  // namespace groundglass
