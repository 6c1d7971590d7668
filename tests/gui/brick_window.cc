// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/gui/brick_window.h"

#include "scene/formats/colmap_io.h"

#include <algorithm>
#include <stdexcept>

namespace groundglass {

namespace fs = std::filesystem;

void MakeScene(const fs::path& folder,
               const std::vector<std::string>& tagged,
               const std::vector<std::string>& untagged) {
  fs::create_directories(folder / "images");
  fs::create_directories(folder / "views");
  fs::copy(kBrick / "model.osu", folder / "model.osu");
  const auto copy_image = [&](const std::string& name) {
    fs::copy(kBrick / "images" / (name + ".jpg"), folder / "images" / (name + ".jpg"));
  };
  for (const std::string& name : untagged) copy_image(name);
  for (const std::string& name : tagged) {
    copy_image(name);
    fs::copy(kBrick / "views" / (name + ".view"), folder / "views" / (name + ".view"));
  }
}

std::vector<std::string> With(const std::vector<std::string>& options, const fs::path& folder) {
  std::vector<std::string> arguments = options;
  arguments.push_back(folder.string());
  return arguments;
}

Camera TrueCamera(const std::string& name) {
  for (const NamedCamera& image : ReadColmapModel(kBrick / "truth" / "cameras")) {
    if (fs::path(image.name).stem() == name) return image.camera;
  }
  throw std::runtime_error("no truth of " + name);
}

Eigen::Vector2d PaneCorner(const nlohmann::json& state) {
  return {state["pane"][0].get<double>(), state["pane"][1].get<double>()};
}

Eigen::Vector2d InWindow(const nlohmann::json& state, const Eigen::Vector2d& photograph_px) {
  const auto& place = state["place"];
  return PaneCorner(state) + Eigen::Vector2d(place[1].get<double>(), place[2].get<double>()) +
         place[0].get<double>() * photograph_px - Eigen::Vector2d(0.5, 0.5);
}

Eigen::Vector2d OnPlan(const nlohmann::json& state, const Eigen::Vector3d& point_in_world) {
  const auto& plan = state["plan"];
  const auto& middle = state["plan_middle"];
  const double scale = plan[2].get<double>();
  return {middle[0].get<double>() + (point_in_world.x() - plan[0].get<double>()) * scale,
          middle[1].get<double>() - (point_in_world.y() - plan[1].get<double>()) * scale};
}

double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : model.points_in_world) {
    const auto at = Project(truth, point);
    const auto found_at = Project(found, point);
    if (!at || !found_at || !IsInsideFrame(truth, *at)) continue;
    sum += (*at - *found_at).norm();
    ++count;
  }
  return sum / count;
}

int ChooseCorner(const nlohmann::json& state,
                 const PolygonModel& model,
                 const Camera& truth,
                 const std::vector<int>& pinned) {
  constexpr double kApartPx = 26;
  int best = -1;
  double best_px = -1;
  for (const auto& corner : state["corners"]) {
    const int point = corner[0].get<int>();
    const Eigen::Vector2d seen(corner[1].get<double>(), corner[2].get<double>());
    const auto at = Project(truth, model.points_in_world[point]);
    if (!at || !IsInsideFrame(truth, *at)) continue;
    if (std::count(pinned.begin(), pinned.end(), point) > 0) continue;
    bool is_apart = true;
    for (const auto& other : state["corners"]) {
      const Eigen::Vector2d other_seen(other[1].get<double>(), other[2].get<double>());
      if (other[0] != corner[0] && (other_seen - seen).norm() < kApartPx) is_apart = false;
    }
    double nearest_px = (*at - Eigen::Vector2d(truth.width_px, truth.height_px) / 2).norm();
    if (!pinned.empty()) nearest_px = 1e9;
    for (const int other : pinned) {
      const Eigen::Vector2d other_at = *Project(truth, model.points_in_world[other]);
      nearest_px = std::min(nearest_px, (other_at - *at).norm());
      const Eigen::Vector2d pin = InWindow(state, other_at) - PaneCorner(state);
      if ((pin - seen).norm() < kApartPx) is_apart = false;
    }
    if (!is_apart || nearest_px <= best_px) continue;
    best = point;
    best_px = nearest_px;
  }
  return best;
}

int PinCorners(WindowUnderTest& window,
               const PolygonModel& model,
               const Camera& truth,
               int num_pins) {
  std::vector<int> pinned;
  while (static_cast<int>(pinned.size()) < num_pins) {
    const nlohmann::json state = window.Fence();
    const int point = ChooseCorner(state, model, truth, pinned);
    if (point < 0) break;
    pinned.push_back(point);
    for (const auto& corner : state["corners"]) {
      if (corner[0].get<int>() != point) continue;
      const Eigen::Vector2d seen =
          PaneCorner(state) + Eigen::Vector2d(corner[1].get<double>(), corner[2].get<double>());
      const Eigen::Vector2d to = InWindow(state, *Project(truth, model.points_in_world[point]));
      // What lies where it belongs already is clicked, and clicked again where it is.
      if ((to - seen).norm() < 6) {
        window.Click(seen);
        window.Click(to);
      } else {
        window.Drag(seen, to);
      }
      break;
    }
  }
  return static_cast<int>(pinned.size());
}

}  // namespace groundglass
