// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/svg.h"

#include "scene/formats/xml_text.h"

#include <fmt/format.h>

namespace groundglass {

std::string SvgHead(double width, double height, double title_left, const std::string& title) {
  std::string svg;
  svg += fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
      "height=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n",
      width,
      height,
      width,
      height);
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"26\" font-size=\"16\">{}</text>\n", title_left, XmlEscaped(title));
  return svg;
}

}  // namespace groundglass
