// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/bindings.h"

#include <array>

namespace groundglass {
namespace {

using enum BindingPlace;
using enum Action;

constexpr auto kBindings = std::to_array<Binding>({
    {kEverywhere, kHelp, "F1", "these keys"},
    {kEverywhere, kLookMode, "F2", "Look: move around the model"},
    {kEverywhere, kTagMode, "F3", "Tag: find a photograph's camera"},
    {kEverywhere, kAskMode, "F4", "Ask: what is where, and who shows it"},
    {kEverywhere, kMaskMode, "F5", "Mask: paint over what is not to be looked at"},
    {kEverywhere, kUndo, "Ctrl+Z", "undo, for the photograph that is shown; in Mask its mask"},
    {kEverywhere, kRedo, "Ctrl+Y Ctrl+Shift+Z", "redo"},
    {kEverywhere, kSave, "Ctrl+S", "save the photograph's view file and pins; in Mask its mask"},
    {kEverywhere, kQuit, "Ctrl+Q", "close the window"},
    {kEverywhere, kCancel, "Escape", "stop an alignment; else let go, then leave the photograph"},
    {kEverywhere, kHidePanels, "F11", "hide the panels, or show them"},
    {kEverywhere, kScreenshot, "F12", "a picture of the window, into the folder it was started in"},
    {kEverywhere, kLargerText, "Ctrl+= Ctrl+Shift+=", "larger text"},
    {kEverywhere, kSmallerText, "Ctrl+-", "smaller text"},
    {kEverywhere, kUsualText, "Ctrl+0", "text as it was"},
    {kEverywhere, kNextPhotograph, "Alt+Right", "next photograph"},
    {kEverywhere, kPreviousPhotograph, "Alt+Left", "photograph before"},
    {kEverywhere, kNextWithoutTag, "N", "next photograph without a tag"},
    {kLook, kWire, "1", "wire, hidden lines removed"},
    {kLook, kShaded, "2", "shaded"},
    {kLook, kTextured, "3", "textured"},
    {kLook, kNumbers, "4", "face numbers"},
    {kLook, kCoverage, "5", "coverage: how many photographs show each place"},
    {kLook, kProvenance, "6", "provenance: which photograph each texel comes from"},
    {kLook, kTexelSize, "7", "texel size; without a texture, the finest photograph's pixel"},
    {kLook, kUncertainty, "8", "uncertainty: how sure photographs are of each place"},
    {kLook, kTiles1988, "9", "tiles of the database of 1988"},
    {kLook, kEllipsoids, "E", "95 % ellipsoids of where cameras stood, on or off"},
    {kLook, kKeyframe, "K", "a keyframe from here, into flight/"},
    {kLook, kPlay, "Shift+K", "play the flight through the keyframes, or stop"},
    {kLook, kRemoveKeyframe, "Ctrl+K", "take the last keyframe back"},
    {kLook, kEdges, "O", "edges over the faces, on or off"},
    {kLook, kStations, "P", "photographs at their stations, on or off"},
    {kLook, kFrame, "F", "look at the face that was picked"},
    {kLook, kHome, "Home", "the whole model"},
    {kLook, kBack, "Backspace", "view before"},
    {kLook, kWalk, "G", "walk: eye height, ground and stairs followed"},
    {kLook, kTowards, "PageUp", "nearer"},
    {kLook, kAway, "PageDown", "farther"},
    {kLook, kNudge, "Left Right Up Down", "turn about the model; walking: step and turn"},
    {kLook, kFlyIn, "Return", "fly into the photograph that is chosen"},
    {kPhotograph, kFadeMore, ".", "more of the model"},
    {kPhotograph, kFadeLess, ",", "more of the photograph"},
    {kPhotograph, kPhotographAlone, "B", "the photograph alone, as long as it is held"},
    {kPhotograph, kWipe, "V", "wipe between photograph and model at the cursor, on or off"},
    {kPhotograph, kZoom, "Z", "fit, 100 %, 400 %"},
    {kPhotograph, kWritten, "C", "edges as written too, on or off"},
    {kTag, kNextCorner, "Tab", "next corner that is seen"},
    {kTag, kPreviousCorner, "Shift+Tab", "corner before"},
    {kTag, kTake, "Return", "take the corner; then let it go"},
    {kTag,
     kNudge,
     "Left Right Up Down Shift+Left Shift+Right Shift+Up Shift+Down Ctrl+Left Ctrl+Right Ctrl+Up "
     "Ctrl+Down",
     "the pin by 0.1 px of the photograph; Shift: 1; Ctrl: 10"},
    {kTag, kUsePin, "U", "the pin is used, check only, off"},
    {kTag, kLoupe, "L", "the loupe always, or while a pin is moved"},
    {kTag, kRemovePin, "Delete", "remove the pin"},
    {kTag, kStandHere, "H", "it stood where you looked from last"},
    {kTag, kCropped, "X", "the picture was cut: its middle is unknown, or known again"},
    {kTag, kAlign, "A", "align: registration from here"},
    {kTag, kAccept, "Ctrl+Return", "take what was found"},
    {kTag, kSnap, "S", "the pin onto the photograph's corner or edge within 3 px"},
    {kTag, kRival, "R", "the rival of a camera in review, on or off"},
    {kTag, kNotebook, "Ctrl+Home", "back to the notebook: the tag as it was written"},
    {kTag, kOverrule, "Ctrl+Shift+Return", "take it against the verdict"},
    {kAsk, kCopyCsv, "Ctrl+C", "copy the answer as CSV"},
    {kMask, kBrushLarger, "]", "a larger brush"},
    {kMask, kBrushSmaller, "[", "a smaller brush"},
    {kMask, kEraserLarger, "Shift+]", "a larger eraser"},
    {kMask, kEraserSmaller, "Shift+[", "a smaller eraser"},
});

bool HasKey(std::string_view keys, std::string_view key) {
  for (size_t start = 0; start < keys.size();) {
    const size_t end = std::min(keys.find(' ', start), keys.size());
    if (keys.substr(start, end - start) == key) return true;
    start = end + 1;
  }
  return false;
}

const Binding* Find(const std::string& text, std::span<const BindingPlace> places) {
  // The narrower place, which stands later, decides.
  for (size_t i = places.size(); i > 0; --i) {
    for (const Binding& binding : kBindings) {
      if (binding.place == places[i - 1] && HasKey(binding.keys, text)) return &binding;
    }
  }
  return nullptr;
}

bool IsLetterOrDigit(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

// Whether a key's place may say what the key itself does not.
bool GoesByPlace(const KeyPress& press) {
  if (press.key.empty() || press.place.empty()) return false;
  const bool is_beyond_ascii = static_cast<unsigned char>(press.key[0]) >= 0x80;
  if (is_beyond_ascii) return true;
  // A sign stands in for another sign or a digit, and for no letter: Ctrl+' is not Ctrl+Q.
  const bool is_sign = press.key.size() == 1 && !IsLetterOrDigit(press.key[0]);
  const bool is_letters_place = press.place[0] >= 'A' && press.place[0] <= 'Z';
  return is_sign && press.place.size() == 1 && !is_letters_place;
}

}  // namespace

std::string_view WindowModeName(WindowMode mode) {
  constexpr std::array<std::string_view, 4> kNames = {"Look", "Tag", "Ask", "Mask"};
  return kNames[static_cast<size_t>(mode)];
}

std::string_view BindingPlaceName(BindingPlace place) {
  constexpr std::array<std::string_view, 6> kNames = {
      "Everywhere", "Look", "In a photograph", "Tag", "Ask", "Mask"};
  return kNames[static_cast<size_t>(place)];
}

std::span<const Binding> Bindings() { return kBindings; }

std::string KeyPress::Text() const {
  return std::string(ctrl ? "Ctrl+" : "") + (alt ? "Alt+" : "") + (shift ? "Shift+" : "") + key;
}

const Binding* FindBinding(const KeyPress& press, std::span<const BindingPlace> places) {
  const Binding* binding = Find(press.Text(), places);
  if (binding != nullptr || !GoesByPlace(press)) return binding;
  KeyPress at_place = press;
  at_place.key = press.place;
  return Find(at_place.Text(), places);
}

bool IsForText(const KeyPress& press) {
  if (press.key == "Escape" || press.key == "Pause") return false;
  const bool is_function =
      press.key.size() > 1 && press.key[0] == 'F' && press.key[1] >= '1' && press.key[1] <= '9';
  if (is_function) return false;
  constexpr std::array<BindingPlace, 1> kAnywhere = {BindingPlace::kEverywhere};
  const Binding* binding = FindBinding(press, kAnywhere);
  return binding == nullptr ||
         (binding->action != Action::kSave && binding->action != Action::kQuit);
}

FlyWay FlyWayOf(std::string_view places_held) {
  const auto axis = [&](char plus, char minus) {
    const auto is_held = [&](char place) {
      return places_held.find(place) != std::string_view::npos ? 1 : 0;
    };
    return is_held(plus) - is_held(minus);
  };
  return {axis('W', 'S'), axis('D', 'A'), axis('E', 'Q')};
}

std::string FormatBindings() {
  std::string text = "| where | keys | what |\n|---|---|---|\n";
  for (const Binding& binding : kBindings) {
    text += "| " + std::string(BindingPlaceName(binding.place)) + " | " +
            std::string(binding.keys) + " | " + std::string(binding.does) + " |\n";
  }
  return text;
}

}  // namespace groundglass
