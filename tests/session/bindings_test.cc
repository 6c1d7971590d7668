// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/bindings.h"

#include "scene/formats/view_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace groundglass {
namespace {

TEST(Bindings, NoKeyMeansTwoThingsInOnePlace) {
  std::set<std::string> seen;
  for (const Binding& binding : Bindings()) {
    std::istringstream keys{std::string(binding.keys)};
    for (std::string key; keys >> key;) {
      EXPECT_TRUE(seen.insert(std::string(BindingPlaceName(binding.place)) + key).second) << key;
    }
  }
  const std::array places = {BindingPlace::kEverywhere, BindingPlace::kLook, BindingPlace::kTag};
  EXPECT_EQ(FindBinding({"Return"}, places)->action, Action::kTake);
  EXPECT_EQ(FindBinding({"Z", true, true, false}, places)->action, Action::kRedo);
  EXPECT_EQ(FindBinding({"3"}, places)->action, Action::kTextured);
  EXPECT_EQ(FindBinding({"Q"}, places), nullptr);
}

// A key of some layout: what is written on it, and what QWERTY has there.
KeyPress KeyAt(const std::string& key, const std::string& place) {
  KeyPress press;
  press.key = key;
  press.place = place;
  return press;
}

TEST(Bindings, LettersGoByWhatIsWrittenOnTheirKeysOnAnyKeyboard) {
  const std::array tag = {BindingPlace::kEverywhere, BindingPlace::kTag};
  // AZERTY has A where QWERTY has Q.
  EXPECT_EQ(FindBinding(KeyAt("A", "Q"), tag)->action, Action::kAlign);
  EXPECT_EQ(FindBinding(KeyAt("Q", "A"), tag), nullptr);
  KeyPress undo = KeyAt("Z", "W");
  undo.ctrl = true;
  EXPECT_EQ(FindBinding(undo, tag)->action, Action::kUndo);
  KeyPress not_undo = KeyAt("W", "Z");
  not_undo.ctrl = true;
  EXPECT_EQ(FindBinding(not_undo, tag), nullptr);
  // Dvorak has ' where QWERTY has Q; this must not close the window.
  KeyPress apostrophe = KeyAt("'", "Q");
  apostrophe.ctrl = true;
  EXPECT_EQ(FindBinding(apostrophe, tag), nullptr);
}

TEST(Bindings, DigitsAndSignsThatALayoutHidesAreWhereOthersHaveThem) {
  const std::array look = {BindingPlace::kEverywhere, BindingPlace::kLook};
  EXPECT_EQ(FindBinding(KeyAt("&", "1"), look)->action, Action::kWire);         // AZERTY
  EXPECT_EQ(FindBinding(KeyAt("\u00E9", "2"), look)->action, Action::kShaded);  // e with acute
  const std::array mask = {BindingPlace::kEverywhere, BindingPlace::kMask};
  EXPECT_EQ(FindBinding(KeyAt("\u00FC", "["), mask)->action, Action::kBrushSmaller);  // QWERTZ
  const std::array photograph = {BindingPlace::kEverywhere, BindingPlace::kPhotograph};
  EXPECT_EQ(FindBinding(KeyAt(":", "."), photograph)->action, Action::kFadeMore);
  // What is written counts first: AZERTY's comma is at the place of M.
  EXPECT_EQ(FindBinding(KeyAt(",", "M"), photograph)->action, Action::kFadeLess);
  // Dvorak's W, at the place of the comma, is a letter.
  EXPECT_EQ(FindBinding(KeyAt("W", ","), photograph), nullptr);
  // Keyboards without Latin letters: the place of S.
  KeyPress save = KeyAt("\u044B", "S");
  save.ctrl = true;
  EXPECT_EQ(FindBinding(save, look)->action, Action::kSave);
}

TEST(Bindings, KeysFlyByTheirPlaceAlone) {
  EXPECT_EQ(FlyWayOf("W"), (FlyWay{1, 0, 0}));
  EXPECT_EQ(FlyWayOf("AS"), (FlyWay{-1, -1, 0}));
  EXPECT_EQ(FlyWayOf("DE"), (FlyWay{0, 1, 1}));
  EXPECT_EQ(FlyWayOf("Q"), (FlyWay{0, 0, -1}));
  EXPECT_EQ(FlyWayOf("WS"), FlyWay()) << "they oppose each other";
  EXPECT_EQ(FlyWayOf("ZX"), FlyWay());
  EXPECT_EQ(FlyWayOf(""), FlyWay());
}

TEST(Bindings, ATextFieldLeavesSavingClosingAndFunctionsAlone) {
  const auto with_ctrl = [](const char* key) {
    KeyPress press = KeyAt(key, key);
    press.ctrl = true;
    return press;
  };
  for (const char* key : {"S", "Q"}) EXPECT_FALSE(IsForText(with_ctrl(key))) << key;
  for (const char* key : {"A", "C", "V", "X", "Z", "Y", "Left"}) {
    EXPECT_TRUE(IsForText(with_ctrl(key))) << key;
  }
  for (const char* key : {"F1", "F3", "F12", "Escape", "Pause"}) {
    EXPECT_FALSE(IsForText(KeyAt(key, key))) << key;
  }
  for (const char* key : {"S", "F", "1", "Left", "Backspace", "Return"}) {
    EXPECT_TRUE(IsForText(KeyAt(key, key))) << key;
  }
}

TEST(Bindings, TheDocumentationHasThem) {
  EXPECT_THAT(ReadTextFile(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "docs" / "window.md"),
              testing::HasSubstr(FormatBindings()));
}

}  // namespace
}  // namespace groundglass
