// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/view_io.h"
#include "session/bindings.h"
#include "tests/gui/brick_window.h"
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

// What became of a photograph without a tag that a person placed, pinned, aligned and saved.
struct Placed {
  nlohmann::json pinned;   // what the window said before it aligned
  nlohmann::json aligned;  // and after
  nlohmann::json saved;
  int num_pins = 0;
};

// With the mouse on the plan, a few feet off as a person remembers it; then pins on corners.
Placed PlaceFromNothing(const fs::path& scene,
                        const fs::path& work,
                        const PolygonModel& model,
                        const Camera& truth,
                        bool is_cropped,
                        int num_pins) {
  Placed placed;
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, scene), work);
  window.Key("F3");
  const nlohmann::json state = window.Fence();
  const Eigen::Vector3d stood = truth.PositionInWorld() + Eigen::Vector3d(4, -5, 0);
  const Eigen::Vector3d looked = truth.PositionInWorld() + 40 * truth.ForwardInWorld();
  window.Drag(OnPlan(state, stood), OnPlan(state, looked));
  window.Fence();
  if (is_cropped) window.Key("X");
  placed.num_pins = PinCorners(window, model, truth, num_pins);
  placed.pinned = window.Fence();
  window.Key("A");
  placed.aligned = window.Fence();
  window.Key("Ctrl+S");
  placed.saved = window.Fence();
  window.Key("Ctrl+Q");
  EXPECT_EQ(window.Wait(), 0);
  return placed;
}

TEST(Window, ASlideIsPlacedPinnedAlignedAndSavedFromNothing) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {"s5"});
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  const Camera truth = TrueCamera("s5");
  const Placed placed = PlaceFromNothing(folder / "hall", folder.path(), model, truth, false, 8);
  EXPECT_EQ(placed.num_pins, 8);
  EXPECT_EQ(placed.pinned["pins"], 8) << placed.pinned["message"];
  const ViewTag pinned = ParseView(placed.pinned["found"].get<std::string>(), "found");
  EXPECT_LT(VertexErrorPx(model, truth, CameraFromTag(pinned, 1200, 800)), 4);
  EXPECT_EQ(placed.aligned["verdict"], "accepted") << placed.aligned["message"];
  EXPECT_FALSE(placed.saved["unsaved"].get<bool>()) << placed.saved["message"];
  const ViewTag saved = ReadView(folder / "hall/views/s5.view");
  const double error_px = VertexErrorPx(model, truth, CameraFromTag(saved, 1200, 800));
  RecordProperty("vertex_error_px", std::to_string(error_px));
  EXPECT_LT(error_px, 0.5);
  EXPECT_TRUE(saved.sigmas.position);
}

TEST(Window, APictureThatWasCutAndWhoseLensNobodyKnowsIsPlacedFromNothing) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {});
  // The right third and a strip above are gone: the middle is a quarter of the width off.
  const Image8 whole = ReadSrgb8(kBrick / "images/s5.jpg");
  Image8 cut(820, 640, 3);
  for (int y = 0; y < cut.height; ++y) {
    std::copy_n(whole.At(0, y + 100), 3 * cut.width, cut.At(0, y));
  }
  WriteSrgb8(folder / "hall/images/s5.png", cut);
  Camera truth = TrueCamera("s5");
  truth.width_px = cut.width;
  truth.height_px = cut.height;
  truth.center_y_px -= 100;
  const PolygonModel model = ReadModel(kBrick / "model.osu").model;
  const Placed placed = PlaceFromNothing(folder / "hall", folder.path(), model, truth, true, 10);
  EXPECT_GE(placed.num_pins, 8);
  EXPECT_EQ(placed.aligned["verdict"], "accepted") << placed.aligned["message"];
  const ViewTag saved = ReadView(folder / "hall/views/s5.view");
  const double error_px = VertexErrorPx(model, truth, CameraFromTag(saved, cut.width, cut.height));
  RecordProperty("vertex_error_px", std::to_string(error_px));
  EXPECT_LT(error_px, 0.5);
}

TEST(Window, UndoToTheStartGivesTheFirstBytesBackAndAllOfItWorksByKeyboard) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const std::string before = ReadTextFile(folder / "hall/views/s5.view");
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
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
    WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
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
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  EXPECT_TRUE(window.Fence()["left_work"].get<bool>());
  window.Key("Return");
  window.Fence();
  window.Key("F3");
  const nlohmann::json state = window.Fence();
  EXPECT_FALSE(state["left_work"].get<bool>());
  EXPECT_EQ(state["pins"], 1);
  EXPECT_TRUE(state["unsaved"].get<bool>());
}

TEST(Window, APaintedMaskOutlivesAProgramThatIsKilled) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  nlohmann::json painted;
  {
    WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
    window.Key("F5");
    const nlohmann::json state = window.Fence();
    window.Drag(InWindow(state, {300, 300}), InWindow(state, {500, 300}));
    painted = window.Fence();
    ASSERT_GT(painted["masked"], 0);
    // The program is killed here.
  }
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  EXPECT_TRUE(window.Fence()["left_work"].get<bool>());
  window.Key("Return");
  window.Fence();
  window.Key("F5");
  nlohmann::json state = window.Fence();
  EXPECT_EQ(state["masked"], painted["masked"]);
  EXPECT_TRUE(state["mask_unsaved"].get<bool>());
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_FALSE(state["mask_unsaved"].get<bool>()) << state["message"];
  EXPECT_TRUE(fs::exists(folder / "hall/masks/s5.png"));
}

TEST(Window, UnsavedWorkIsKeptOrDiscardedByKeyAlone) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const std::string before = ReadTextFile(folder / "hall/views/s5.view");
  const Desktop desktop(1280, 900);
  {
    WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
    window.Key("F3");
    window.Key("Tab");
    window.Fence();
    window.Key("Return");
    ASSERT_TRUE(window.Fence()["unsaved"].get<bool>());
    window.Key("Ctrl+Q");
    EXPECT_TRUE(window.Fence()["covered"].get<bool>()) << "it asks";
    window.Key("Escape");
    nlohmann::json state = window.Fence();
    EXPECT_FALSE(state["covered"].get<bool>());
    EXPECT_EQ(state["pins"], 1);
    window.Key("Ctrl+Q");
    window.Fence();
    window.Key("Delete");
    EXPECT_EQ(window.Wait(), 0);
  }
  EXPECT_EQ(ReadTextFile(folder / "hall/views/s5.view"), before);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  EXPECT_FALSE(window.Fence()["left_work"].get<bool>());
}

TEST(Window, WhatCannotBeSavedIsToldAndKept) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {}, {"s5"});
  fs::remove_all(folder / "hall/views");
  folder.Write("hall/views", "a file where a folder should be");
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
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
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Fence();
  fs::remove(folder / "hall/images/s5.jpg");
  window.Key("F3");
  window.Key("Alt+Right");
  nlohmann::json state = window.Fence();
  ASSERT_EQ(state["photograph"], "s5");
  // The model still shows where its corners would be: one of them is pinned there.
  window.Key("Tab");
  window.Fence();
  window.Key("Return");
  EXPECT_EQ(window.Fence()["pins"], 1);
  window.Key("A");
  state = window.Fence();
  EXPECT_THAT(state["message"].get<std::string>(), HasSubstr("s5.jpg"));
  EXPECT_EQ(state["pins"], 1);
}

TEST(Window, EveryKeyOfTheTableIsTakenInEveryMode) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(800, 600);
  WindowUnderTest window(
      desktop, With({"--width", "640", "--height", "480"}, folder / "hall"), folder.path());
  for (const char* mode : {"F2", "F3", "F4", "F5"}) {
    for (const Binding& binding : Bindings()) {
      if (binding.action == Action::kQuit || binding.action == Action::kSave ||
          binding.action == Action::kScreenshot || binding.action == Action::kAlign) {
        continue;
      }
      std::istringstream keys{std::string(binding.keys)};
      for (std::string key; keys >> key;) {
        if (key.find_first_of(".,=-[]") != std::string::npos) continue;
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
