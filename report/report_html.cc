// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_html.h"

#include "scene/formats/image_io.h"
#include "scene/reduce.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace groundglass {
namespace {

std::string FormatDecimals(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, std::abs(value));
  // A number that rounds to nothing has no sign.
  const bool is_zero = std::string(text).find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !is_zero ? "\u2212" : "") + std::string(text);
}

// Decimals that show `digits` significant digits of a number.
int DecimalsFor(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return std::clamp(digits - 1 - exponent, 0, 6);
}

}  // namespace

std::string EscapeHtml(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string FormatRounded(double value, double sigma) {
  return FormatDecimals(value, sigma > 0 ? DecimalsFor(sigma, 2) : DecimalsFor(value, 4));
}

std::string FormatSigma(double sigma) { return FormatDecimals(sigma, DecimalsFor(sigma, 2)); }

std::string FormatShare(double share) {
  if (share <= 0) return "0 %";
  if (share >= 1) return "100 %";
  if (share < 0.01) return "&lt; 1 %";
  if (share > 0.99) return "&gt; 99 %";
  return FormatDecimals(100 * share, 0) + " %";
}

std::string EncodeBase64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j) {
      group = group << 8 | (i + j < bytes.size() ? static_cast<uint8_t>(bytes[i + j]) : 0);
    }
    for (size_t j = 0; j < 4; ++j) {
      text += j <= bytes.size() - i ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
  }
  return text;
}

Image8 ShrunkPicture(const Image8& srgb8, int width_px) {
  if (srgb8.width <= width_px) return srgb8;
  const int height_px = std::max(
      1, static_cast<int>(std::lround(static_cast<double>(srgb8.height) * width_px / srgb8.width)));
  return ReducedInLight(srgb8, width_px, height_px);
}

std::string EmbeddedPicture(const Image8& srgb8, const std::string& description) {
  ImageWriteOptions options;
  options.jpeg_quality = 82;
  const std::vector<uint8_t> jpeg = EncodeImage(srgb8, ".jpg", options);
  return "<img loading=\"lazy\" width=\"" + std::to_string(srgb8.width) + "\" height=\"" +
         std::to_string(srgb8.height) + "\" alt=\"" + EscapeHtml(description) +
         "\" src=\"data:image/jpeg;base64," + EncodeBase64(std::string(jpeg.begin(), jpeg.end())) +
         "\">";
}

}  // namespace groundglass
