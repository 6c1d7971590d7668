// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "session/mask_flood.h"
#include "tests/gui/brick_window.h"
#include "tests/gui/desktop.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Window, EscapeStopsAnAlignmentAtOnceAndChangesNothing) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("F3");
  window.Fence();
  window.Key("A");
  window.Key("Escape");
  const nlohmann::json state = window.Fence();
  EXPECT_THAT(state["message"].get<std::string>(), HasSubstr("stopped: s5 is as it was"));
  EXPECT_EQ(state["verdict"], "");
  EXPECT_EQ(state["undo_depth"], 0);
  EXPECT_EQ(state["mode"], "Tag") << "Escape stopped the alignment and did nothing else";
}

TEST(Window, AnOutputFolderStartsFromWhatWasFoundAndUndoGivesTheNotebookBack) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const ViewTag written = ReadView(folder / "hall/views/s5.view");
  Registration found;
  found.name = "s5";
  found.width_px = 1200;
  found.height_px = 800;
  found.verdict = Verdict::kAccepted;
  found.measured = found.corrected = written;
  found.corrected.position_in_site.x() += 0.25;
  found.covariance = 1e-4 * CameraCovariance::Identity();
  folder.Write("out/registration.json", FormatRegistrations({found}));
  const Desktop desktop(1280, 900);
  std::vector<std::string> arguments = With(kSmallWindow, folder / "out");
  arguments.insert(arguments.end(), {"--scene", (folder / "hall").string()});
  WindowUnderTest window(desktop, arguments, folder.path());
  window.Key("F3");
  nlohmann::json state = window.Fence();
  const auto east = [&] {
    return ParseView(state["found"].get<std::string>(), "found").position_in_site.x();
  };
  EXPECT_DOUBLE_EQ(east(), written.position_in_site.x() + 0.25);
  EXPECT_EQ(state["verdict"], "accepted");
  EXPECT_FALSE(state["unsaved"].get<bool>());
  window.Key("Ctrl+Z");
  state = window.Fence();
  EXPECT_EQ(ParseView(state["found"].get<std::string>(), "found"), written);
  window.Key("Ctrl+Y");
  window.Key("Ctrl+Home");
  state = window.Fence();
  EXPECT_EQ(ParseView(state["found"].get<std::string>(), "found"), written);
  EXPECT_FALSE(state["unsaved"].get<bool>());
  // Nothing to ask about.
  window.Key("Ctrl+Q");
  EXPECT_EQ(window.Wait(), 0);
}

int CountPixels(const Image8& picture, const std::array<int, 3>& colour) {
  int count = 0;
  for (size_t i = 0; i + 2 < picture.values.size(); i += 3) {
    bool is_alike = true;
    for (size_t c = 0; c < 3; ++c) {
      is_alike = is_alike && std::abs(picture.values[i + c] - colour[c]) <= 12;
    }
    count += is_alike;
  }
  return count;
}

TEST(Window, AnOutputFolderKnowsTheRivalOfAPhotographInReview) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s4", "s5"}, {});
  std::vector<Registration> found;
  for (const std::string name : {"s4", "s5"}) {
    Registration& registration = found.emplace_back();
    registration.name = name;
    registration.width_px = 1200;
    registration.height_px = 800;
    registration.measured = registration.corrected =
        ReadView(folder / "hall/views" / (name + ".view"));
    registration.covariance = 1e-4 * CameraCovariance::Identity();
    registration.verdict = name == "s5" ? Verdict::kReview : Verdict::kAccepted;
  }
  found[1].reasons = {"another camera 40.0 px away fits almost as well (margin 9 nats)"};
  found[1].margin_nats = 9;
  found[1].rival = found[1].corrected;
  found[1].rival->lookat_in_site.z() += 5;
  folder.Write("out/registration.json", FormatRegistrations(found));
  const Desktop desktop(1280, 900);
  std::vector<std::string> arguments = With(kSmallWindow, folder / "out");
  arguments.insert(arguments.end(), {"--scene", (folder / "hall").string()});
  WindowUnderTest window(desktop, arguments, folder.path());
  constexpr std::array<int, 3> kPurple = {204, 121, 167};
  window.Key("F3");
  window.Key("R");
  nlohmann::json state = window.Fence();
  ASSERT_EQ(state["photograph"], "s4");
  EXPECT_THAT(state["message"].get<std::string>(),
              HasSubstr("only a camera in review has a rival"));
  window.Key("Alt+Right");
  state = window.Fence();
  ASSERT_EQ(state["verdict"], "review");
  EXPECT_LT(CountPixels(window.Picture(), kPurple), 20);
  window.Key("R");
  state = window.Fence();
  EXPECT_GT(CountPixels(window.Picture(), kPurple), 400) << state["message"];
  EXPECT_FALSE(state["unsaved"].get<bool>()) << "looking changes nothing";
  window.Key("R");
  window.Fence();
  EXPECT_LT(CountPixels(window.Picture(), kPurple), 20);
}

TEST(Window, WhileTheKeysAreShownSavingSavesAndLettersAreSoughtFor) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("F3");
  const nlohmann::json state = window.Fence();
  const auto& corner = state["corners"][state["corners"].size() / 2];
  const Eigen::Vector2d seen =
      PaneCorner(state) + Eigen::Vector2d(corner[1].get<double>(), corner[2].get<double>());
  window.Drag(seen, seen + Eigen::Vector2d(12, 7));
  ASSERT_TRUE(window.Fence()["unsaved"].get<bool>());
  // At once, before the field of the search has the keyboard: U would take the pin's say away.
  window.Key("F1");
  window.Key("U");
  window.Key("Ctrl+S");
  nlohmann::json saved = window.Fence();
  EXPECT_FALSE(saved["unsaved"].get<bool>()) << saved["message"];
  EXPECT_EQ(saved["undo_depth"], 1);
  EXPECT_TRUE(saved["covered"].get<bool>()) << "the keys are still shown";
  // And once it has it.
  window.Key("Escape");
  window.Fence();
  window.Key("Ctrl+Z");
  window.Fence();
  window.Key("F1");
  ASSERT_TRUE(window.Fence()["unsaved"].get<bool>());
  window.Key("U");
  window.Key("Ctrl+S");
  saved = window.Fence();
  EXPECT_FALSE(saved["unsaved"].get<bool>()) << saved["message"];
  EXPECT_EQ(saved["undo_depth"], 0);
  EXPECT_FALSE(fs::exists(folder / "hall/pins.points"));
}

TEST(Window, FacesAreColouredByWhatPhotographsSayOfThem) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s4", "s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  const std::array<std::pair<const char*, const char*>, 4> maps = {
      {{"5", "photographs that show it"},
       {"6", "shown finest by"},
       {"7", "a pixel of the finest photograph"},
       {"8", "one standard deviation"}}};
  for (const auto& [key, title] : maps) {
    window.Key(key);
    EXPECT_EQ(window.Fence()["map"], title);
  }
  window.Key("9");
  EXPECT_THAT(window.Fence()["message"].get<std::string>(), HasSubstr("--tiles"));
  window.Key("2");
  EXPECT_EQ(window.Fence()["map"], "");
}

TEST(Window, KeyframesAreKeptAsViewFilesAndFlown) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("K");
  const nlohmann::json first = window.Fence();
  EXPECT_EQ(first["keyframes"], 1) << first["message"];
  window.Key("Right");
  window.Key("K");
  const nlohmann::json second = window.Fence();
  window.Key("Home");
  window.Fence();
  window.Key("Shift+K");
  // The fence waits for the end of the flight, which is the second keyframe.
  const nlohmann::json flown = window.Fence();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(flown["eye"][i].get<double>(), second["eye"][i].get<double>(), 1e-6);
  }
  EXPECT_TRUE(fs::exists(folder / "hall/flight/1.view"));
  EXPECT_TRUE(fs::exists(folder / "hall/flight/2.view"));
  // Taken back while it flies through them.
  window.Key("Shift+K");
  window.Key("Ctrl+K");
  EXPECT_EQ(window.Fence()["keyframes"], 1);
  EXPECT_FALSE(fs::exists(folder / "hall/flight/2.view"));
}

TEST(Window, AMaskIsPaintedErasedUndoneAndSaved) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5", "s6"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("F5");
  nlohmann::json state = window.Fence();
  ASSERT_EQ(state["mode"], "Mask");
  EXPECT_EQ(state["masked"], 0);
  window.Drag(InWindow(state, {300, 300}), InWindow(state, {500, 300}));
  state = window.Fence();
  // The brush is 16 px of the window each way.
  const double radius_px = 16 / state["place"][0].get<double>();
  const double expected = 200 * 2 * radius_px + M_PI * radius_px * radius_px;
  EXPECT_NEAR(state["masked"].get<double>(), expected, 0.05 * expected);
  EXPECT_TRUE(state["mask_unsaved"].get<bool>());
  EXPECT_EQ(state["undo_depth"], 0) << "the tag has a history of its own";
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_FALSE(state["mask_unsaved"].get<bool>()) << state["message"];
  const Image8 saved = ReadIgnoreMask(folder / "hall/masks/s5.png", {1200, 800});
  EXPECT_EQ(*saved.At(400, 300), 255);
  EXPECT_EQ(*saved.At(400, 400), 0);
  window.Key("Ctrl+Z");
  state = window.Fence();
  EXPECT_EQ(state["masked"], 0);
  window.Key("Ctrl+S");
  window.Fence();
  EXPECT_FALSE(fs::exists(folder / "hall/masks/s5.png"));
  // A stroke ends where the photograph is left, and does not go on in the next one.
  window.MoveTo(InWindow(state, {300, 300}));
  window.Button(1, true);
  window.MoveTo(InWindow(state, {400, 300}));
  window.Key("Alt+Right");
  window.MoveTo(InWindow(state, {500, 300}));
  window.Button(1, false);
  state = window.Fence();
  EXPECT_EQ(state["photograph"], "s6");
  EXPECT_EQ(state["masked"], 0);
  EXPECT_FALSE(state["mask_unsaved"].get<bool>());
}

TEST(Window, ADoubleClickFillsUpToTheEdgesOfThePicture) {
  const TemporaryFolder folder;
  MakeScene(folder / "hall", {"s5"}, {});
  const Desktop desktop(1280, 900);
  WindowUnderTest window(desktop, With(kSmallWindow, folder / "hall"), folder.path());
  window.Key("F5");
  nlohmann::json state = window.Fence();
  const Eigen::Vector2d at = InWindow(state, {150, 90}).array().round();
  const Eigen::Vector2d origin(state["place"][1].get<double>(), state["place"][2].get<double>());
  const Eigen::Vector2d at_px = (at - PaneCorner(state) + Eigen::Vector2d(0.5, 0.5) - origin) /
                                state["place"][0].get<double>();
  const Image8 flood = FindFlood(ReadSrgb8(folder / "hall/images/s5.jpg"), at_px);
  const auto expected = std::count(flood.values.begin(), flood.values.end(), 255);
  ASSERT_GT(expected, 10000) << "the sky";
  const auto double_click = [&] {
    window.MoveTo(at);
    window.Fence();
    for (const bool is_down : {true, false, true, false}) window.Button(1, is_down);
  };
  // Saved at once: what is still being filled belongs to it.
  double_click();
  window.Key("Ctrl+S");
  state = window.Fence();
  EXPECT_EQ(state["masked"], expected) << state["message"];
  EXPECT_FALSE(state["mask_unsaved"].get<bool>()) << state["message"];
  EXPECT_EQ(ReadIgnoreMask(folder / "hall/masks/s5.png", {1200, 800}).values, flood.values);
  window.Key("Ctrl+Z");
  EXPECT_EQ(window.Fence()["masked"], 0) << "one step, and no dab of the first click";
  // The right button takes away.
  window.Key("Ctrl+Y");
  ASSERT_EQ(window.Fence()["masked"], expected);
  window.Button(3, true);
  window.Button(3, false);
  window.Button(3, true);
  window.Button(3, false);
  state = window.Fence();
  EXPECT_EQ(state["masked"], 0);
  EXPECT_THAT(state["message"].get<std::string>(), HasSubstr("Ctrl+Z takes it back"));
}

}  // namespace
}  // namespace groundglass
