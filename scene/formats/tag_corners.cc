// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tag_corners.h"

#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace groundglass {
namespace {

constexpr std::array<const char*, 10> kColumns = {
    "photograph", "id", "corner", "x_px", "y_px", "sigma_px", "x", "y", "z", "sigma"};
constexpr size_t kFirstNumber = 1;

}  // namespace

std::vector<SeenTagCorner> ReadTagCorners(const std::filesystem::path& file) {
  const CsvTable table(file);
  if (!std::equal(table.header().begin(), table.header().end(), kColumns.begin(), kColumns.end())) {
    throw Error(file,
                table.header_line(),
                "expected the columns photograph,id,corner,x_px,y_px,sigma_px,x,y,z,sigma; write "
                "it anew with `groundglass calibrate tags`");
  }
  std::vector<SeenTagCorner> corners;
  for (const CsvRow& row : table.rows()) {
    std::array<double, kColumns.size()> numbers = {};
    for (size_t i = kFirstNumber; i < kColumns.size(); ++i) {
      const std::optional<double> number = table.Number(row.fields[i]);
      if (!number || !std::isfinite(*number)) {
        throw Error(file,
                    row.line,
                    std::string(kColumns[i]) + ": " + Quote(row.fields[i]) + " is not a number");
      }
      numbers[i] = *number;
    }
    const auto& [name, id, corner, x_px, y_px, sigma_px, x, y, z, sigma] = numbers;
    if (!(id >= 0 && id < 1e6 && corner >= 1 && corner <= 4 && corner == std::floor(corner))) {
      throw Error(file, row.line, "id must be a whole number, and corner 1, 2, 3 or 4");
    }
    if (!(sigma_px > 0) || !(sigma > 0)) {
      throw Error(file, row.line, "sigma_px and sigma: a standard deviation must be above 0");
    }
    corners.push_back({row.fields[0],
                       static_cast<int>(id),
                       static_cast<int>(corner) - 1,
                       {x_px, y_px},
                       sigma_px,
                       WorldFromSite({x, y, z}),
                       sigma});
  }
  return corners;
}

std::string FormatTagCorners(const std::vector<SeenTagCorner>& corners) {
  std::string text =
      "% Corners of AprilTags as `groundglass calibrate tags` found them; register holds cameras "
      "by them.\n";
  for (size_t i = 0; i < kColumns.size(); ++i)
    text += (i == 0 ? "" : ",") + std::string(kColumns[i]);
  text += "\n";
  for (const SeenTagCorner& corner : corners) {
    const Eigen::Vector3d at = SiteFromWorld(corner.surveyed_in_world);
    const bool needs_quotes = corner.photograph.find_first_of(",;\"%") != std::string::npos;
    text +=
        fmt::format("{0}{1}{0},{2},{3},{4:.3f},{5:.3f},{6:.3f},{7:.5f},{8:.5f},{9:.5f},{10:.4g}\n",
                    needs_quotes ? "\"" : "",
                    corner.photograph,
                    corner.april_tag,
                    corner.corner + 1,
                    corner.image_px.x(),
                    corner.image_px.y(),
                    corner.sigma_px,
                    at.x(),
                    at.y(),
                    at.z(),
                    corner.survey_sigma);
  }
  return text;
}

std::string CountTagCorners(const std::vector<SeenTagCorner>& corners) {
  std::set<int> tags;
  for (const SeenTagCorner& corner : corners) tags.insert(corner.april_tag);
  return fmt::format("{} corner{} of {} AprilTag{}",
                     corners.size(),
                     corners.size() == 1 ? "" : "s",
                     tags.size(),
                     tags.size() == 1 ? "" : "s");
}

}  // namespace groundglass
