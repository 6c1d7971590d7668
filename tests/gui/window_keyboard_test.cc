// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/gui/brick_window.h"
#include "tests/gui/desktop.h"
#include "tests/support/temporary_folder.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

namespace groundglass {
namespace {

Eigen::Vector3d EyeOf(const nlohmann::json& state) {
  return {
      state["eye"][0].get<double>(), state["eye"][1].get<double>(), state["eye"][2].get<double>()};
}

// How far the eye goes while the key at this place is held: longer each time, until it has moved.
Eigen::Vector3d FlyBy(WindowUnderTest& window, char place) {
  const Eigen::Vector3d start = EyeOf(window.Fence());
  for (int hold_ms = 100; hold_ms <= 3200; hold_ms *= 2) {
    window.Place(place, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(hold_ms));
    window.Place(place, false);
    Eigen::Vector3d way = EyeOf(window.Fence()) - start;
    if (way.norm() > 1e-3) return way;
  }
  return Eigen::Vector3d::Zero();
}

// AZERTY: A and Q, Z and W have changed places, and digits lie behind Shift.
class WindowWithAFrenchKeyboard : public testing::Test {
 protected:
  void SetUp() override {
    if (!Desktop::HasLayouts()) GTEST_SKIP() << "setxkbmap is not there";
    MakeScene(folder_ / "hall", {"s5"}, {});
    desktop_ = std::make_unique<Desktop>(1280, 900, "fr");
    window_ = std::make_unique<WindowUnderTest>(
        *desktop_, With(kSmallWindow, folder_ / "hall"), folder_.path());
  }

  const TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<WindowUnderTest> window_;
};

TEST_F(WindowWithAFrenchKeyboard, LettersAreWhatIsWrittenOnThem) {
  window_->Key("F3");
  window_->Key("Tab");
  window_->Fence();
  window_->Key("Return");
  ASSERT_EQ(window_->Fence()["pins"], 1);
  window_->Key("Ctrl+Z");
  EXPECT_EQ(window_->Fence()["pins"], 0);
  window_->Key("A");
  nlohmann::json state = window_->Fence();
  EXPECT_NE(state["verdict"], "") << state["message"];
  // The key where a QWERTY keyboard has A is Q here, which means nothing by itself.
  window_->Key("Ctrl+Z");
  ASSERT_EQ(window_->Fence()["verdict"], "");
  window_->Place('A', true);
  window_->Place('A', false);
  ASSERT_EQ(window_->Fence()["verdict"], "");
  window_->Key("Ctrl+Q");
  EXPECT_EQ(window_->Wait(), 0);
}

TEST_F(WindowWithAFrenchKeyboard, KeysThatFlyGoByTheirPlace) {
  const nlohmann::json state = window_->Fence();
  window_->MoveTo(PaneCorner(state) + Eigen::Vector2d(200, 200));
  window_->Button(3, true);
  // Z is forward and Q to the left, as the hand lies.
  const Eigen::Vector3d forward = FlyBy(*window_, 'W');
  ASSERT_GT(forward.norm(), 0);
  const Eigen::Vector3d left = FlyBy(*window_, 'A');
  window_->Button(3, false);
  ASSERT_GT(left.norm(), 0);
  EXPECT_NEAR(left.z(), 0, 1e-6);
  const Eigen::Vector2d expected = Eigen::Vector2d(-forward.y(), forward.x()).normalized();
  EXPECT_NEAR(expected.dot(left.head<2>().normalized()), 1, 1e-6);
}

TEST_F(WindowWithAFrenchKeyboard, DigitsAndSignsAreWhereAQwertyKeyboardHasThem) {
  window_->Place('5', true);  // ( here
  window_->Place('5', false);
  EXPECT_EQ(window_->Fence()["map"], "photographs that show it");
  window_->Key("F5");
  const double before = window_->Fence()["brush_px"].get<double>();
  window_->Place(']', true);  // $ here
  window_->Place(']', false);
  EXPECT_GT(window_->Fence()["brush_px"].get<double>(), before);
}

}  // namespace
}  // namespace groundglass
