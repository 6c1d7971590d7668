// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace groundglass {

enum class WindowMode { kLook, kTag, kAsk, kMask };
std::string_view WindowModeName(WindowMode mode);

// Everything that a key does in the window.
enum class Action {
  kHelp,
  kLookMode,
  kTagMode,
  kAskMode,
  kMaskMode,
  kUndo,
  kRedo,
  kSave,
  kQuit,
  kCancel,
  kScreenshot,
  kLargerText,
  kSmallerText,
  kUsualText,
  kNextPhotograph,
  kPreviousPhotograph,
  kNextWithoutTag,
  kHidePanels,
  kWire,
  kShaded,
  kTextured,
  kNumbers,
  kCoverage,
  kProvenance,
  kTexelSize,
  kUncertainty,
  kTiles1988,
  kEllipsoids,
  kKeyframe,
  kPlay,
  kRemoveKeyframe,
  kEdges,
  kStations,
  kPlan,
  kWritten,
  kFrame,
  kHome,
  kBack,
  kWalk,
  kFlyIn,
  kTowards,
  kAway,
  kFadeMore,
  kFadeLess,
  kPhotographAlone,
  kWipe,
  kZoom,
  kNextCorner,
  kPreviousCorner,
  kTake,
  kUsePin,
  kLoupe,
  kRemovePin,
  kStandHere,
  kCropped,
  kAlign,
  kAccept,
  kOverrule,
  kNotebook,
  kSnap,
  kRival,
  kNudge,
  kCopyCsv,
  kBrushLarger,
  kBrushSmaller,
  kEraserLarger,
  kEraserSmaller,
};

// Where a binding holds.
enum class BindingPlace { kEverywhere, kLook, kPhotograph, kTag, kAsk, kMask };
std::string_view BindingPlaceName(BindingPlace place);

// One table for input, F1 and the documentation.
struct Binding {
  BindingPlace place;
  Action action;
  std::string_view keys;  // as a person writes them: "Ctrl+Shift+Z", "Left"; several with blanks
  std::string_view does;
};
std::span<const Binding> Bindings();

// A key that was pressed, as the table writes it.
struct KeyPress {
  std::string key;  // what is written on it: "A", "Left", "F1"
  bool shift = false;
  bool ctrl = false;
  bool alt = false;
  // What a QWERTY keyboard of the United States has where it is; empty: the same.
  std::string place = {};

  std::string Text() const;
};
// The binding that this press means here; null if none does. Places are those that hold at once.
// Keys go by what is written on them, since letters stand for words. Where that means nothing, and
// is neither a letter from A to Z nor a digit, the key's place counts: digits and brackets that a
// layout has behind Shift or AltGr (AZERTY, QWERTZ) are where others have them, and so are the
// letters of keyboards that have no Latin ones.
const Binding* FindBinding(const KeyPress& press, std::span<const BindingPlace> places);

// Whether a text field that is being typed into keeps a press to itself: all but keys of functions,
// Escape, and Ctrl with what is not text's own (saving, closing).
bool IsForText(const KeyPress& press);

// Keys that fly, by their place alone, for there the hand looks for them: W A S D Q E, which are
// Z Q S D A E on AZERTY and , A O E ' . on Dvorak.
inline constexpr std::string_view kFlyPlaces = "WASDQE";
struct FlyWay {
  int forward = 0;
  int right = 0;
  int up = 0;

  bool operator==(const FlyWay&) const = default;
};
// Where keys that are held at these places lead; of two that oppose each other, nowhere.
FlyWay FlyWayOf(std::string_view places_held);

// The table as the documentation has it.
std::string FormatBindings();

}  // namespace groundglass
