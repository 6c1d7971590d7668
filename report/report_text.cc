// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace groundglass {
namespace {

std::string FormatDecimals(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  // A number that rounds to nothing has no sign.
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !is_zero ? "\u2212" : "") + text;
}

// Decimals that show `digits` significant digits of a number.
int DecimalsFor(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return std::clamp(digits - 1 - exponent, 0, 6);
}

}  // namespace

std::string FormatRounded(double value, double sigma) {
  return FormatDecimals(value, sigma > 0 ? DecimalsFor(sigma, 2) : DecimalsFor(value, 4));
}

std::string FormatSigma(double sigma) { return FormatDecimals(sigma, DecimalsFor(sigma, 2)); }

std::string FormatShare(double share) {
  if (share <= 0) return "0 %";
  if (share >= 1) return "100 %";
  if (share < 0.01) return "< 1 %";
  if (share > 0.99) return "> 99 %";
  return FormatDecimals(100 * share, 0) + " %";
}

std::string Plural(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string EncodeForAddress(const std::string& name) {
  std::string address;
  for (const unsigned char c : name) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
        std::string_view("-._~").find(static_cast<char>(c)) != std::string_view::npos;
    if (is_plain) {
      address += static_cast<char>(c);
    } else {
      address += fmt::format("%{:02X}", c);
    }
  }
  return address;
}

kainjow::mustache::data TextListData(const std::vector<std::string>& texts) {
  kainjow::mustache::list entries;
  for (const std::string& text : texts) {
    kainjow::mustache::data entry;
    entry["text"] = text;
    entry["is_later"] = !entries.empty();
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace groundglass
