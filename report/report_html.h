// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <string>

namespace groundglass {

// Text with &, <, > and quotes made safe for HTML.
std::string EscapeHtml(const std::string& text);

// A number as people write it: as many decimals as its standard deviation gives sense to (two
// digits of the deviation), four significant digits if that is not known (0). True minus sign.
std::string FormatRounded(double value, double sigma = 0);
// The deviation itself, to two digits.
std::string FormatSigma(double sigma);
// "87 %"; "< 1 %" and "> 99 %" rather than a false 0 or 100.
std::string FormatShare(double share);

// A table's cell around HTML: text, or a number.
inline std::string TextCell(const std::string& html) { return "<td>" + html + "</td>"; }
inline std::string NumberCell(const std::string& html) {
  return "<td class=\"n\">" + html + "</td>";
}
// "1 face", "3 faces".
inline std::string Plural(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string EncodeBase64(const std::string& bytes);

// The picture made no wider than width_px.
Image8 ShrunkPicture(const Image8& srgb8, int width_px);
// An <img> that holds the picture itself, as JPEG.
std::string EmbeddedPicture(const Image8& srgb8, const std::string& description);

}  // namespace groundglass
