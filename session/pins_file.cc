// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/pins_file.h"

#include "scene/error.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

constexpr size_t kPointNumbers = 6;  // x_px y_px x y z sigma_px
constexpr size_t kLineNumbers = 11;  // two image points, two points, sigma_px

// The words of a line that is one of ours: kind ("" for a plain point), photograph, numbers.
struct PinLine {
  std::string kind;
  std::string photograph;
  std::vector<std::string_view> numbers;
};

std::optional<PinLine> WordsOf(const TextLine& line, std::string_view text) {
  PinLine words;
  if (!line.tokens.empty()) {
    words.photograph = line.tokens[0].text;
    for (size_t i = 1; i < line.tokens.size(); ++i) words.numbers.push_back(line.tokens[i].text);
    return words;
  }
  if (!line.has_comment) return std::nullopt;
  const size_t mark = text.find('%', line.offset);
  const auto split = SplitLines(text.substr(mark + 1, line.offset + line.size - mark - 1));
  if (split.empty() || split[0].tokens.size() < 2) return std::nullopt;
  const std::vector<TextToken>& tokens = split[0].tokens;
  words.kind = tokens[0].text;
  constexpr std::array<std::string_view, 4> kKinds = {"check", "off", "few", "line"};
  if (std::find(kKinds.begin(), kKinds.end(), words.kind) == kKinds.end()) return std::nullopt;
  words.photograph = tokens[1].text;
  for (size_t i = 2; i < tokens.size(); ++i) words.numbers.push_back(tokens[i].text);
  const size_t expected = words.kind == "line" ? kLineNumbers + 1 : kPointNumbers;
  // A person's comment may begin with such a word too.
  if (words.numbers.size() != expected) return std::nullopt;
  return words;
}

PinUse UseOf(std::string_view word) {
  return word == "check" ? PinUse::kCheck : word == "off" ? PinUse::kOff : PinUse::kUsed;
}

std::string_view UseWord(PinUse use) {
  return use == PinUse::kCheck ? "check" : use == PinUse::kOff ? "off" : "used";
}

std::vector<double> Numbers(const std::vector<std::string_view>& words,
                            size_t count,
                            size_t num_words,
                            const std::filesystem::path& name,
                            int line) {
  std::vector<double> numbers;
  for (size_t i = 0; i < std::min(count, words.size()); ++i) {
    const std::optional<double> number = ParseNumber(words[i]);
    if (!number || !std::isfinite(*number)) {
      throw Error(name, line, Quote(words[i]) + " is not a finite number");
    }
    numbers.push_back(*number);
  }
  if (words.size() != num_words) {
    throw Error(name, line, "expected 7 words, photograph x_px y_px x y z sigma_px");
  }
  if (!(numbers.back() > 0)) {
    throw Error(name, line, "sigma_px: a standard deviation must be above 0");
  }
  return numbers;
}

std::string Words(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += "  " + FormatNumber(number);
  return text;
}

// -0 is what the mirror makes of a 0.
Eigen::Vector3d CleanSite(const Eigen::Vector3d& point_in_world) {
  return SiteFromWorld(point_in_world).array() + 0.0;
}

std::string FormatPoint(const std::string& photograph, const PointPin& pin, bool are_few) {
  const Eigen::Vector3d site = CleanSite(pin.point_in_world);
  std::string start;
  if (pin.use != PinUse::kUsed) {
    start = "% " + std::string(UseWord(pin.use)) + " ";
  } else if (are_few) {
    start = "% few ";
  }
  return start + photograph +
         Words({pin.image_px.x(), pin.image_px.y(), site.x(), site.y(), site.z(), pin.sigma_px}) +
         "\n";
}

std::string FormatLine(const std::string& photograph, const LinePin& pin) {
  const Eigen::Vector3d start = CleanSite(pin.start_in_world);
  const Eigen::Vector3d end = CleanSite(pin.end_in_world);
  return "% line " + photograph +
         Words({pin.first_px.x(),
                pin.first_px.y(),
                pin.second_px.x(),
                pin.second_px.y(),
                start.x(),
                start.y(),
                start.z(),
                end.x(),
                end.y(),
                end.z(),
                pin.sigma_px}) +
         "  " + std::string(UseWord(pin.use)) + "\n";
}

}  // namespace

std::map<std::string, Pins> ParsePins(const std::string& text, const std::filesystem::path& name) {
  std::map<std::string, Pins> pins_of;
  for (const TextLine& line : SplitLines(text)) {
    const std::optional<PinLine> words = WordsOf(line, text);
    if (!words) continue;
    Pins& pins = pins_of[words->photograph];
    if (words->kind == "line") {
      const std::vector<double> n =
          Numbers(words->numbers, kLineNumbers, kLineNumbers + 1, name, line.number);
      pins.lines.push_back({WorldFromSite({n[4], n[5], n[6]}),
                            WorldFromSite({n[7], n[8], n[9]}),
                            {n[0], n[1]},
                            {n[2], n[3]},
                            n[10],
                            UseOf(words->numbers.back())});
      continue;
    }
    const std::vector<double> n =
        Numbers(words->numbers, kPointNumbers, kPointNumbers, name, line.number);
    pins.points.push_back(
        {WorldFromSite({n[2], n[3], n[4]}), {n[0], n[1]}, n[5], UseOf(words->kind)});
  }
  return pins_of;
}

std::string ReplacePins(const std::string& text, const std::string& photograph, const Pins& pins) {
  std::string kept;
  size_t place = std::string::npos;  // where the photograph's lines were
  size_t start = 0;
  const std::vector<TextLine> lines = SplitLines(text);
  for (size_t i = 0; i < lines.size(); ++i) {
    const std::optional<PinLine> words = WordsOf(lines[i], text);
    const size_t end = i + 1 < lines.size() ? lines[i + 1].offset : text.size();
    if (words && words->photograph == photograph) {
      place = std::min(place, kept.size());
    } else {
      kept += text.substr(start, end - start);
    }
    start = end;
  }
  if (!kept.empty() && kept.back() != '\n') kept += '\n';
  place = std::min(place, kept.size());
  const bool are_few = std::count_if(pins.points.begin(), pins.points.end(), [](const auto& pin) {
                         return pin.use == PinUse::kUsed;
                       }) < 3;
  std::string block;
  for (const PointPin& pin : pins.points) block += FormatPoint(photograph, pin, are_few);
  for (const LinePin& pin : pins.lines) block += FormatLine(photograph, pin);
  kept.insert(place, block);
  return TrimBlanks(kept).empty() || kept.find_first_not_of(" \t\r\n") == std::string::npos ? ""
                                                                                            : kept;
}

}  // namespace groundglass
