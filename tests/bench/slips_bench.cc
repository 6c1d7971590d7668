// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice.h"
#include "scene/camera.h"
#include "scene/formats/scene_folder.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

// How many slips of typing `check` tells, and how many it names rightly.
//   slips_bench SCENE [EACH [SEED]]
// SCENE: a scene folder with right tags. EACH slips of each kind are drawn (10), one at a time,
// each in one number of one tag; only those that move the model's corners in the picture by 5 % of
// its width or more, since registration mends smaller ones.

namespace groundglass {
namespace {

constexpr std::array<TagKey, 7> kKeys = {
    TagKey::kX, TagKey::kY, TagKey::kZ, TagKey::kI, TagKey::kJ, TagKey::kK, TagKey::kV};
constexpr std::array<const char*, 8> kKinds = {"two digits exchanged",
                                               "decimal point a place to the left",
                                               "decimal point a place to the right",
                                               "decimal point left out",
                                               "a digit left out",
                                               "another digit",
                                               "the other sign",
                                               "two numbers exchanged"};

struct Slip {
  ViewTag tag;
  // One of these in a remedy names it rightly.
  std::vector<std::string> names;
};

size_t Draw(std::mt19937& random, size_t count) { return random() % count; }

std::optional<Slip> DrawSlip(size_t kind, const ViewTag& tag, std::mt19937& random) {
  const TagKey key = kKeys[Draw(random, kKeys.size())];
  const std::string name(kTagKeyNames[static_cast<size_t>(key)]);
  const double value = GetTagValue(tag, key);
  std::string digits = FormatNumber(value);
  const size_t at = Draw(random, digits.size());
  const auto is_digit = [&](size_t i) {
    return i < digits.size() && std::isdigit(static_cast<unsigned char>(digits[i])) != 0;
  };
  Slip slip{tag, {name + " " + digits + " ("}};
  const auto spelled = [&]() -> std::optional<Slip> {
    const std::optional<double> wrong = ParseNumber(digits);
    if (!wrong) return std::nullopt;
    SetTagValue(slip.tag, key, *wrong);
    return slip;
  };
  switch (kind) {
    case 0: {
      const size_t next = at + 1 < digits.size() && digits[at + 1] == '.' ? at + 2 : at + 1;
      if (!is_digit(at) || !is_digit(next)) return std::nullopt;
      std::swap(digits[at], digits[next]);
      return spelled();
    }
    case 1:
      slip.names.push_back("ten times " + name);
      SetTagValue(slip.tag, key, value / 10);
      return slip;
    case 2:
      slip.names.push_back("a tenth of " + name);
      SetTagValue(slip.tag, key, value * 10);
      return slip;
    case 3:
      slip.names.push_back("a tenth of " + name);
      if (digits.find('.') == std::string::npos) return std::nullopt;
      digits.erase(digits.find('.'), 1);
      return spelled();
    case 4:
      if (!is_digit(at)) return std::nullopt;
      digits.erase(at, 1);
      return spelled();
    case 5:
      if (!is_digit(at)) return std::nullopt;
      digits[at] = static_cast<char>('0' + Draw(random, 10));
      return spelled();
    case 6:
      slip.names = {"the sign of " + name};
      if (key == TagKey::kV) return std::nullopt;
      SetTagValue(slip.tag, key, -value);
      return slip;
    default: {
      constexpr std::array<std::pair<TagKey, TagKey>, 4> kPairs = {{{TagKey::kX, TagKey::kY},
                                                                    {TagKey::kI, TagKey::kJ},
                                                                    {TagKey::kY, TagKey::kZ},
                                                                    {TagKey::kJ, TagKey::kK}}};
      const auto [first, second] = kPairs[Draw(random, kPairs.size())];
      slip.names = {std::string(kTagKeyNames[static_cast<size_t>(first)]) + " and " +
                    std::string(kTagKeyNames[static_cast<size_t>(second)]) + " exchanged"};
      SetTagValue(slip.tag, first, GetTagValue(tag, second));
      SetTagValue(slip.tag, second, GetTagValue(tag, first));
      return slip;
    }
  }
}

// How far the model's corners in the frame are moved, as a share of its width; the mean.
double MeanShift(const Scene& scene, const Photograph& photograph, const ViewTag& wrong) {
  constexpr double kMost = 0.5;
  const ImageSize size = photograph.size;
  const Camera right_camera = CameraFromTag(photograph.tag, size.width, size.height);
  const Camera wrong_camera = CameraFromTag(wrong, size.width, size.height);
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& corner : scene.model.points_in_world) {
    const auto right_px = Project(right_camera, corner);
    if (!right_px || right_px->minCoeff() < 0 || right_px->x() > size.width ||
        right_px->y() > size.height) {
      continue;
    }
    const auto wrong_px = Project(wrong_camera, corner);
    sum += wrong_px ? std::min(kMost, (*wrong_px - *right_px).norm() / size.width) : kMost;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

struct Counts {
  int drawn = 0;
  int told = 0;
  int named = 0;
  int others = 0;  // of other tags, or of the whole scene
};

void Count(const Scene& scene, const Photograph& spoiled, const Slip& slip, Counts& counts) {
  bool is_told = false;
  bool is_named = false;
  for (const Advice& advice : FindOddities(scene)) {
    if (advice.subject != spoiled.view_file.string()) {
      ++counts.others;
      std::printf("    other: %s\n", FormatAdvice(advice).c_str());
      continue;
    }
    is_told = true;
    for (const std::string& name : slip.names) {
      is_named = is_named || advice.remedy.find(name) != std::string::npos;
    }
  }
  ++counts.drawn;
  counts.told += is_told ? 1 : 0;
  counts.named += is_named ? 1 : 0;
}

void Measure(const Scene& right, int each, unsigned seed) {
  constexpr double kLeastShift = 0.05;
  Counts sum;
  std::printf("%-36s %6s %6s %14s %6s\n", "slip", "drawn", "told", "named rightly", "others");
  for (size_t kind = 0; kind < kKinds.size(); ++kind) {
    std::mt19937 random(seed + static_cast<unsigned>(kind));
    Counts counts;
    for (int tries = 0; counts.drawn < each && tries < 1000 * each; ++tries) {
      Scene scene = right;
      Photograph& photograph = scene.photographs[Draw(random, scene.photographs.size())];
      const std::optional<Slip> slip = DrawSlip(kind, photograph.tag, random);
      if (!slip || FindTagFault(slip->tag) ||
          MeanShift(right, photograph, slip->tag) < kLeastShift) {
        continue;
      }
      photograph.tag = slip->tag;
      Count(scene, photograph, *slip, counts);
    }
    std::printf("%-36s %6d %6d %14d %6d\n",
                kKinds[kind],
                counts.drawn,
                counts.told,
                counts.named,
                counts.others);
    std::fflush(stdout);
    sum.drawn += counts.drawn;
    sum.told += counts.told;
    sum.named += counts.named;
    sum.others += counts.others;
  }
  std::printf("%-36s %6d %6d %14d %6d\n", "together", sum.drawn, sum.told, sum.named, sum.others);
}

}  // namespace
}  // namespace groundglass

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "slips_bench SCENE [EACH [SEED]]\n");
    return 2;
  }
  const int each = count > 2 ? std::atoi(words[2]) : 10;
  const unsigned seed = count > 3 ? static_cast<unsigned>(std::atoi(words[3])) : 1;
  groundglass::Measure(groundglass::ReadScene(words[1]), each, seed);
  return 0;
}
