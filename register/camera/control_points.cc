// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/control_points.h"

#include "scene/building_bounds.h"
#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace groundglass {
namespace {

bool AreOnOneLine(const std::vector<ControlPoint>& points, const std::string& photograph) {
  constexpr double kThinShare = 1e-3;  // of the line's length, across it
  std::vector<Eigen::Vector3d> places;
  for (const ControlPoint& point : points) {
    if (point.photograph == photograph) places.push_back(point.point_in_world);
  }
  if (places.size() < 3) return false;
  const auto distance = [&](const Eigen::Vector3d& place) { return (place - places[0]).norm(); };
  const Eigen::Vector3d along = *std::ranges::max_element(places, {}, distance) - places[0];
  return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3d& place) {
    return along.cross(place - places[0]).norm() <= kThinShare * along.squaredNorm();
  });
}

}  // namespace

std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& file) {
  constexpr std::array<const char*, 6> kNumbers = {"x_px", "y_px", "x", "y", "z", "sigma_px"};
  const std::string text = ReadTextFile(file);
  std::vector<ControlPoint> points;
  struct Count {
    int first_line = 0;
    int points = 0;
    std::set<std::array<double, 3>> places;
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
    count.places.insert({numbers[2], numbers[3], numbers[4]});
  }
  if (points.empty()) throw Error(file, "there is no point in it");
  for (const auto& [photograph, count] : count_of_photograph) {
    if (count.points < 3) {
      throw Error(file,
                  count.first_line,
                  "photograph " + Quote(photograph) + " has " + std::to_string(count.points) +
                      (count.points == 1 ? " point" : " points") + "; three or more are needed");
    }
    if (count.places.size() < 3) {
      throw Error(file,
                  count.first_line,
                  "photograph " + Quote(photograph) + " has points at " +
                      std::to_string(count.places.size()) +
                      (count.places.size() == 1 ? " place" : " places") +
                      " of the model; three or more are needed");
    }
  }
  return points;
}

void CheckControlPoints(const std::filesystem::path& file,
                        const std::vector<ControlPoint>& points,
                        const Scene& scene) {
  constexpr double kFrames = 0.5;
  constexpr double kModels = 100;
  const Box bounds = ComputeBuildingBounds(scene.model);
  for (const ControlPoint& point : points) {
    const std::string of = "a point of " + Quote(point.photograph);
    if ((point.point_in_world - bounds.Center()).norm() > kModels * bounds.Diagonal()) {
      const Eigen::Vector3d in_site = SiteFromWorld(point.point_in_world);
      throw Error(file,
                  of + " is at " + FormatNumber(in_site.x()) + " " +
                      FormatNumber(in_site.y() + 0.0) + " " + FormatNumber(in_site.z()) +
                      ", far from the model; expected a place of it, in its own numbers");
    }
    const auto photograph = std::find_if(
        scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& one) {
          return one.name == point.photograph;
        });
    if (photograph == scene.photographs.end()) continue;
    const Eigen::Vector2d size(photograph->size.width, photograph->size.height);
    if ((point.image_px.array() < -kFrames * size.array()).any() ||
        (point.image_px.array() > (1 + kFrames) * size.array()).any()) {
      throw Error(file,
                  of + " is at " + FormatNumber(point.image_px.x()) + " " +
                      FormatNumber(point.image_px.y()) + " pixels, outside its picture of " +
                      FormatNumber(size.x()) + " x " + FormatNumber(size.y()));
    }
  }
}

std::vector<std::string> DescribeThinControlPoints(const std::filesystem::path& file,
                                                   const std::vector<ControlPoint>& points) {
  std::set<std::string> names;
  for (const ControlPoint& point : points) names.insert(point.photograph);
  std::vector<std::string> warnings;
  for (const std::string& name : names) {
    if (!AreOnOneLine(points, name)) continue;
    warnings.push_back(Error(file,
                             "the points of " + Quote(name) +
                                 " lie on one line, about which only the tag holds its camera; add "
                                 "one beside it")
                           .what());
  }
  return warnings;
}

}  // namespace groundglass
