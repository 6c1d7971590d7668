// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/control_points.h"

#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <array>
#include <cmath>
#include <map>

namespace groundglass {

std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& file) {
  constexpr std::array<const char*, 6> kNumbers = {"x_px", "y_px", "x", "y", "z", "sigma_px"};
  const std::string text = ReadTextFile(file);
  std::vector<ControlPoint> points;
  struct Count {
    int first_line = 0;
    int points = 0;
  };
  std::map<std::string, Count> count_of_photograph;
  for (const TextLine& line : SplitLines(text)) {
    if (line.tokens.empty()) continue;
    if (line.tokens.size() != 1 + kNumbers.size()) {
      throw Error(file,
                  line.number,
                  "expected 7 words, photograph x_px y_px x y z sigma_px; found " +
                      std::to_string(line.tokens.size()));
    }
    std::array<double, kNumbers.size()> numbers;
    for (size_t i = 0; i < kNumbers.size(); ++i) {
      const std::string_view word = line.tokens[1 + i].text;
      const std::optional<double> number = ParseNumber(word);
      if (!number || !std::isfinite(*number)) {
        throw Error(file,
                    line.number,
                    std::string(kNumbers[i]) + ": " + Quote(word) + " is not a finite number");
      }
      numbers[i] = *number;
    }
    if (!(numbers[5] > 0)) {
      throw Error(file, line.number, "sigma_px: a standard deviation must be above 0");
    }
    ControlPoint& point = points.emplace_back();
    point.photograph = line.tokens[0].text;
    point.image_px = {numbers[0], numbers[1]};
    point.point_in_world = WorldFromSite({numbers[2], numbers[3], numbers[4]});
    point.sigma_px = numbers[5];
    Count& count = count_of_photograph[point.photograph];
    if (count.points++ == 0) count.first_line = line.number;
  }
  if (points.empty()) throw Error(file, "there is no point in it");
  for (const auto& [photograph, count] : count_of_photograph) {
    if (count.points < 3) {
      throw Error(file,
                  count.first_line,
                  "photograph " + Quote(photograph) + " has " + std::to_string(count.points) +
                      (count.points == 1 ? " point" : " points") + "; three or more are needed");
    }
  }
  return points;
}

}  // namespace groundglass
