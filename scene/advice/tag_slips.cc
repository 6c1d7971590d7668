// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/tag_slips.h"

#include "scene/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// The decimal point one place to the right, or to the left.
template <TagKey kKey>
void TimesTen(ViewTag& tag) {
  SetTagValue(tag, kKey, 10 * GetTagValue(tag, kKey));
}
template <TagKey kKey>
void TenthOf(ViewTag& tag) {
  SetTagValue(tag, kKey, GetTagValue(tag, kKey) / 10);
}

// A slide lies a few per cent of its frame off; a picture that was cut may lie farther off.
void TakeShiftsAsPerCent(ViewTag& tag) {
  constexpr double kMoreThanAnySlide = 0.2;
  if (std::max(std::abs(tag.shift_x), std::abs(tag.shift_y)) < kMoreThanAnySlide) return;
  tag.shift_x /= 100;
  tag.shift_y /= 100;
}

}  // namespace

const std::array<TagSlip, 28> kTagSlips = {{
    {"x and y exchanged, and i and j",
     [](ViewTag& tag) {
       std::swap(tag.position_in_site.x(), tag.position_in_site.y());
       std::swap(tag.lookat_in_site.x(), tag.lookat_in_site.y());
     }},
    {"x and y exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site.x(), tag.position_in_site.y()); }},
    {"i and j exchanged",
     [](ViewTag& tag) { std::swap(tag.lookat_in_site.x(), tag.lookat_in_site.y()); }},
    {"the sign of y changed (it counts south)",
     [](ViewTag& tag) { tag.position_in_site.y() *= -1; }},
    {"the sign of j changed (it counts south)", [](ViewTag& tag) { tag.lookat_in_site.y() *= -1; }},
    {"the sign of x changed", [](ViewTag& tag) { tag.position_in_site.x() *= -1; }},
    {"the signs of y and j changed (they count south)",
     [](ViewTag& tag) {
       tag.position_in_site.y() *= -1;
       tag.lookat_in_site.y() *= -1;
     }},
    {"the camera and the point looked at exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site, tag.lookat_in_site); }},
    {"the sign of i changed", [](ViewTag& tag) { tag.lookat_in_site.x() *= -1; }},
    {"the sign of k changed", [](ViewTag& tag) { tag.lookat_in_site.z() *= -1; }},
    {"the sign of z changed", [](ViewTag& tag) { tag.position_in_site.z() *= -1; }},
    {"y and z exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site.y(), tag.position_in_site.z()); }},
    {"j and k exchanged",
     [](ViewTag& tag) { std::swap(tag.lookat_in_site.y(), tag.lookat_in_site.z()); }},
    {"a tenth of x", TenthOf<TagKey::kX>},
    {"a tenth of y", TenthOf<TagKey::kY>},
    {"a tenth of z", TenthOf<TagKey::kZ>},
    {"a tenth of i", TenthOf<TagKey::kI>},
    {"a tenth of j", TenthOf<TagKey::kJ>},
    {"a tenth of k", TenthOf<TagKey::kK>},
    {"ten times x", TimesTen<TagKey::kX>},
    {"ten times y", TimesTen<TagKey::kY>},
    {"ten times z", TimesTen<TagKey::kZ>},
    {"ten times i", TimesTen<TagKey::kI>},
    {"ten times j", TimesTen<TagKey::kJ>},
    {"ten times k", TimesTen<TagKey::kK>},
    {"a tenth of v", TenthOf<TagKey::kV>},
    {"ten times v", TimesTen<TagKey::kV>},
    {"shift_x and shift_y in per cent", TakeShiftsAsPerCent},
}};

namespace {

// The numbers that are written down for each photograph; the picture itself tells a.
constexpr std::array<TagKey, 7> kWrittenKeys = {
    TagKey::kX, TagKey::kY, TagKey::kZ, TagKey::kI, TagKey::kJ, TagKey::kK, TagKey::kV};

// Nobody writes more by hand: longer ones were computed.
constexpr std::ptrdiff_t kMostDigits = 10;

bool IsWrittenDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// True if it is added.
bool AddIfValid(const std::string& slip,
                const ViewTag& meant,
                const ViewTag& tag,
                std::vector<MeantTag>& found) {
  if (meant == tag || FindTagFault(meant)) return false;
  MeantTag& added = found.emplace_back(MeantTag{slip, meant, false, {}});
  for (int key = 0; key < kNumTagKeys; ++key) {
    added.is_changed[static_cast<size_t>(key)] =
        GetTagValue(meant, static_cast<TagKey>(key)) != GetTagValue(tag, static_cast<TagKey>(key));
  }
  return true;
}

// The tag with this number as it is spelled here.
void AddSpelled(const std::string& digits,
                const char* slip,
                TagKey key,
                const ViewTag& tag,
                std::vector<MeantTag>& found) {
  const std::optional<double> value = ParseNumber(digits);
  if (!value) return;
  ViewTag meant = tag;
  SetTagValue(meant, key, *value);
  const std::string name(kTagKeyNames[static_cast<size_t>(key)]);
  if (AddIfValid(name + " " + FormatNumber(*value) + " (" + slip + ")", meant, tag, found)) {
    found.back().is_of_digits = true;
  }
}

}  // namespace

std::vector<MeantTag> FindMeantTags(const ViewTag& tag) {
  std::vector<MeantTag> found;
  for (const TagSlip& slip : kTagSlips) {
    ViewTag meant = tag;
    slip.correct(meant);
    AddIfValid(slip.name, meant, tag, found);
  }
  for (const TagKey key : kWrittenKeys) {
    const std::string digits = FormatNumber(GetTagValue(tag, key));
    if (std::count_if(digits.begin(), digits.end(), IsWrittenDigit) > kMostDigits) continue;
    for (size_t i = 0; i < digits.size(); ++i) {
      if (!IsWrittenDigit(digits[i])) continue;
      const size_t next = i + 1 < digits.size() && digits[i + 1] == '.' ? i + 2 : i + 1;
      if (next < digits.size() && IsWrittenDigit(digits[next])) {
        std::string meant = digits;
        std::swap(meant[i], meant[next]);
        AddSpelled(meant, "two digits exchanged", key, tag, found);
      }
    }
  }
  for (const TagKey key : kWrittenKeys) {
    const std::string digits = FormatNumber(GetTagValue(tag, key));
    if (std::count_if(digits.begin(), digits.end(), IsWrittenDigit) > kMostDigits) continue;
    for (size_t i = 0; i < digits.size(); ++i) {
      std::string meant = digits;
      if (IsWrittenDigit(digits[i])) AddSpelled(meant.erase(i, 1), "a digit less", key, tag, found);
    }
  }
  return found;
}

std::vector<MeantTag> FindMeantTagsByDigits(const ViewTag& tag) {
  std::vector<MeantTag> found;
  for (const TagKey key : kWrittenKeys) {
    const std::string digits = FormatNumber(GetTagValue(tag, key));
    if (std::count_if(digits.begin(), digits.end(), IsWrittenDigit) > kMostDigits) continue;
    for (size_t i = digits[0] == '-' ? 1 : 0; i <= digits.size(); ++i) {
      for (char digit = '0'; digit <= '9'; ++digit) {
        std::string meant = digits;
        AddSpelled(meant.insert(i, 1, digit), "a digit more", key, tag, found);
        if (i == digits.size() || !IsWrittenDigit(digits[i])) continue;
        meant = digits;
        meant[i] = digit;
        AddSpelled(meant, "another digit", key, tag, found);
      }
    }
  }
  return found;
}

}  // namespace groundglass
