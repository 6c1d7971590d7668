// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_template.h"

#include "scene/frames.h"
#include "scene/text.h"

#include <cmath>
#include <filesystem>

namespace groundglass {

double ViewAngleDegFromFocalLength(double focal_length_mm, double aspect) {
  const double half_diagonal_mm = std::hypot(36.0, 24.0) / 2;
  const double half_width_mm = half_diagonal_mm * aspect / std::hypot(aspect, 1.0);
  return DegreesFromRadians(2 * std::atan(half_width_mm / focal_length_mm));
}

std::string FormatViewTemplate(const std::string& image_name,
                               const ImageSize& size,
                               LengthUnit unit,
                               const std::optional<double>& view_angle_deg,
                               const std::string& how_known) {
  const double aspect = static_cast<double>(size.width) / size.height;
  const std::string stem = std::filesystem::path(image_name).stem().string();
  const bool is_upright = size.height > size.width;
  const std::string angle =
      view_angle_deg ? FormatNumber(std::round(100 * *view_angle_deg) / 100) : "?";
  return "% File: " + stem +
         ".view\n"
         "% What was written down when " +
         image_name +
         " was taken: a number in place of each ?\n"
         "% x east, y SOUTH, z up, from the model's origin, in the model's unit (" +
         UnitName(unit) +
         ").\n"
         "% docs/tutorial.md tells how to find them.\n"
         "\n"
         "% Where the camera stood.\n"
         "x ?   % east\n"
         "y ?   % south: north of the origin it is below 0\n"
         "z ?   % up: the camera itself, not the ground under it\n"
         "\n"
         "% A point of the building in the middle of the picture.\n"
         "i ?   % east\n"
         "j ?   % south\n"
         "k ?   % up\n"
         "\n"
         "a " +
         FormatNumber(std::round(1e6 * aspect) / 1e6) +
         "   % width / height of the whole frame; here of the picture's " +
         std::to_string(size.width) + " x " + std::to_string(size.height) +
         " pixels\n"
         "v " +
         angle + "   % angle from the left edge to the right one, degrees: 2 atan(" +
         (is_upright ? "12" : "18") + " / f) of a 35 mm frame that " +
         (is_upright ? "stands" : "lies") + ", f in mm" +
         (how_known.empty() ? "" : "; here from " + how_known) +
         "\n"
         "\n"
         "% If you know how far off the above may be (one standard deviation):\n"
         "% sigma_position 0.5\n"
         "% sigma_lookat 1\n";
}

}  // namespace groundglass
