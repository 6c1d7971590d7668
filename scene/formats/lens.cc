// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/lens.h"

#include "scene/error.h"
#include "scene/formats/foreign_lens.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "scene/view_tag.h"

#include <array>
#include <cmath>
#include <map>

namespace groundglass {
namespace {

struct LensKey {
  std::string_view name;
  double Lens::*member;
  bool is_required;
};
constexpr std::array<LensKey, 15> kLensKeys = {{
    {"v", &Lens::view_angle_deg, true},
    {"sigma_v", &Lens::sigma_view_angle_deg, false},
    {"a", &Lens::aspect, true},
    {"sigma_a", &Lens::sigma_aspect, false},
    {"shift_x", &Lens::shift_x, false},
    {"sigma_shift_x", &Lens::sigma_shift_x, false},
    {"shift_y", &Lens::shift_y, false},
    {"sigma_shift_y", &Lens::sigma_shift_y, false},
    {"k1", &Lens::k1, false},
    {"sigma_k1", &Lens::sigma_k1, false},
    {"k2", &Lens::k2, false},
    {"sigma_k2", &Lens::sigma_k2, false},
    {"k3", &Lens::k3, false},
    {"p1", &Lens::p1, false},
    {"p2", &Lens::p2, false},
}};

const LensKey* FindKey(std::string_view name) {
  for (const LensKey& key : kLensKeys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

}  // namespace

Lens ReadLens(const std::filesystem::path& file) {
  Lens lens;
  const std::string text = ReadTextFile(file);
  // No text has such a byte.
  if (text.find('\0') != std::string::npos) {
    const ImageKind kind = FindImageKind(file);
    throw Error(file,
                (kind.IsImage() ? "a picture" : kind.description) +
                    ", and no lens file; expected what `groundglass calibrate board` writes (v, a, "
                    "...), or a camera of COLMAP, OpenCV, ROS or Kalibr");
  }
  if (const std::optional<Lens> foreign = ReadForeignLens(text, file)) return *foreign;
  std::map<std::string, int> line_of_key;
  std::vector<TextToken> tokens;
  for (const TextLine& line : SplitLines(text)) {
    tokens.insert(tokens.end(), line.tokens.begin(), line.tokens.end());
  }
  for (size_t i = 0; i < tokens.size(); i += 2) {
    const TextToken& word = tokens[i];
    const LensKey* key = FindKey(word.text);
    const std::string key_name = "key " + Quote(word.text);
    if (key == nullptr && word.text != "camera") {
      throw Error(
          file,
          word.line,
          "unknown key " + Quote(word.text) +
              "; a lens has v a shift_x shift_y k1 k2, sigma_ of each, k3 p1 p2, and camera");
    }
    if (i + 1 == tokens.size()) throw Error(file, word.line, key_name + " has no value");
    if (!line_of_key.emplace(word.text, word.line).second) {
      throw Error(file, word.line, key_name + " is repeated");
    }
    const TextToken& value_word = tokens[i + 1];
    if (key == nullptr) {
      lens.name = value_word.text;
      continue;
    }
    const std::optional<double> value = ParseNumber(value_word.text);
    if (!value || !std::isfinite(*value)) {
      throw Error(file, value_word.line, key_name + ": " + WhyNoNumber(value_word.text));
    }
    if (word.text.starts_with("sigma_") && *value < 0) {
      throw Error(file, value_word.line, key_name + ": a standard deviation must not be negative");
    }
    lens.*(key->member) = *value;
  }
  for (const LensKey& key : kLensKeys) {
    if (key.is_required && line_of_key.count(std::string(key.name)) == 0) {
      throw Error(file, "key " + Quote(key.name) + " is missing");
    }
  }
  if (!(lens.view_angle_deg > 0 && lens.view_angle_deg < 180)) {
    throw Error(file, line_of_key["v"], "key 'v': view angle must lie between 0 and 180 degrees");
  }
  if (!(lens.aspect > 0)) {
    throw Error(file, line_of_key["a"], "key 'a': aspect (width / height) must be above 0");
  }
  // At the frame's sides k1 moves a point by this share of its distance from the axis. k1 goes by
  // focal lengths, so that long lenses have large ones.
  constexpr double kMostAtSide = 1;
  const double side = std::tan(lens.view_angle_deg * M_PI / 360);
  if (std::abs(lens.k1) * side * side > kMostAtSide) {
    throw Error(
        file,
        line_of_key["k1"],
        "key 'k1': no lens has a distortion of " + FormatNumber(lens.k1) +
            "; expected one for distances from the axis in focal lengths, -0.1 for a common "
            "wide lens");
  }
  // What no view file may say, no lens file may.
  if (const std::optional<TagFault> fault = FindTagFault(TagOfLens(lens))) {
    throw Error(file, line_of_key[fault->key], "key " + Quote(fault->key) + ": " + fault->message);
  }
  return lens;
}

std::string FormatLens(const Lens& lens) {
  std::string text = "% Lens: what is true of all photographs of one camera.\n";
  if (!lens.name.empty()) {
    if (lens.name.find_first_of(" \t\r\n%") != std::string::npos) {
      throw Error("camera name " + Quote(lens.name) + " must be one word without '%'");
    }
    text += "camera " + lens.name + "\n";
  }
  for (const LensKey& key : kLensKeys) {
    const bool is_rare = key.name == "k3" || key.name == "p1" || key.name == "p2";
    if (is_rare && lens.*(key.member) == 0) continue;
    text += std::string(key.name) + " " + FormatNumber(lens.*(key.member)) + "\n";
  }
  return text;
}

}  // namespace groundglass
