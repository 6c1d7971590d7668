// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>
#include <string_view>

namespace groundglass {

// Text as it stands in XML, in attributes too: & < > " are escaped. Of bytes below 32, which XML
// has none of but three, tabs and line ends stay.
inline std::string XmlEscaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\n' || c == '\r') {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace groundglass
