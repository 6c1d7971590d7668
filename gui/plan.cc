// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "scene/symmetric_eigen.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr ImU32 kPaper = IM_COL32(32, 34, 38, 255);
constexpr ImU32 kWalls = IM_COL32(150, 150, 155, 255);
constexpr ImU32 kStation = IM_COL32(86, 180, 233, 255);
constexpr ImU32 kChosen = IM_COL32(240, 228, 66, 255);
constexpr ImU32 kEye = IM_COL32(255, 255, 255, 255);

ImVec2 OnScreen(const PlanFrame& frame, const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector2d px = frame.OnScreen(point_in_world);
  return {static_cast<float>(px.x()), static_cast<float>(px.y())};
}

void DrawStation(ImDrawList& list, const PlanFrame& frame, const Camera& camera, ImU32 colour) {
  const Eigen::Vector3d apex = camera.PositionInWorld();
  const double length = 18 / frame.px_per_unit;
  const double middle_px = camera.height_px / 2.0;
  const auto edge = [&](double x_px) {
    const Eigen::Vector2d flat = UnprojectToWorld(camera, {x_px, middle_px}).head<2>();
    const Eigen::Vector2d along = flat.normalized() * length;
    return OnScreen(frame, apex + Eigen::Vector3d(along.x(), along.y(), 0));
  };
  const ImVec2 from = OnScreen(frame, apex);
  list.AddTriangle(from, edge(0), edge(camera.width_px), colour, 1.5f);
  list.AddCircleFilled(from, 3, colour, 8);
}

}  // namespace

// The model and room around it to stand in, whatever the tags say, so that it does not move while
// one is made.
PlanFrame App::MakePlanFrame() const {
  Box box = ComputeBounds(session_.model());
  const double room = 0.6 * box.Diagonal();
  box.min.array() -= room;
  box.max.array() += room;
  for (const Photograph& photograph : document_.opened.scene.photographs) {
    const Eigen::Vector3d at = WorldFromSite(photograph.tag.position_in_site);
    // A slip of the pen must not make the model a dot.
    if ((at - box.Center()).norm() > 3 * box.Diagonal()) continue;
    box.min = box.min.cwiseMin(at);
    box.max = box.max.cwiseMax(at);
  }
  PlanFrame frame;
  frame.middle = box.Center().head<2>();
  const Eigen::Vector2d size = (box.max - box.min).head<2>();
  frame.px_per_unit = 0.95 * std::min(plan_.width / size.x(), plan_.height / size.y());
  frame.screen_middle = {plan_.x + plan_.width / 2.0, plan_.y + plan_.height / 2.0};
  return frame;
}

void App::DrawPlan() {
  if (plan_.height < 40) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner(static_cast<float>(plan_.x), static_cast<float>(plan_.y));
  const ImVec2 far_corner(static_cast<float>(plan_.x + plan_.width),
                          static_cast<float>(plan_.y + plan_.height));
  list.AddRectFilled(corner, far_corner, kPaper);
  list.PushClipRect(corner, far_corner);
  const PlanFrame frame = MakePlanFrame();
  for (const ModelEdge& edge : edges_) {
    list.AddLine(OnScreen(frame, edge.start_in_world), OnScreen(frame, edge.end_in_world), kWalls);
  }
  for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
    if (const auto camera = BelievedCamera(i)) {
      DrawStation(list, frame, *camera, i == photograph_ ? kChosen : kStation);
    }
  }
  if (photograph_ >= 0 && session_.Solution(photograph_)) {
    // One standard deviation of where it stood.
    const PinSolution& solution = *session_.Solution(photograph_);
    const SymmetricEigen axes = DecomposeSymmetric(solution.covariance.topLeftCorner<2, 2>());
    std::vector<ImVec2> ring;
    for (int i = 0; i < 32; ++i) {
      const double angle = 2 * M_PI * i / 32;
      const Eigen::Vector2d by = axes.vectors * (axes.values.cwiseMax(0).cwiseSqrt().asDiagonal() *
                                                 Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      ring.push_back(
          OnScreen(frame, solution.parameters.head<3>() + Eigen::Vector3d(by.x(), by.y(), 0)));
    }
    list.AddPolyline(ring.data(), 32, kChosen, ImDrawFlags_Closed, 1);
  }
  if (!IsInside()) DrawStation(list, frame, eye_.InFrame(600, 400), kEye);
  if (gesture_ == Gesture::kRough) {
    list.AddLine(OnScreen(frame, rough_start_), OnScreen(frame, rough_end_), kChosen, 2);
  }
  list.PopClipRect();
}

// Where a person stands who stands there.
Eigen::Vector3d App::OnPlan(int x, int y) const {
  const double ground = ComputeBounds(session_.model()).min.z();
  const double eye_height = NavigatorOptions().eye_height_m / MetresPerUnit(session_.model().unit);
  return MakePlanFrame().InWorld({x + 0.5, y + 0.5}, ground + eye_height);
}

void App::PressOnPlan(int x, int y) {
  gesture_ = Gesture::kRough;
  rough_start_ = rough_end_ = OnPlan(x, y);
}

void App::ReleaseOnPlan() {
  constexpr double kLeastDragPx = 6;
  constexpr double kPointReachPx = 8;
  const PlanFrame frame = MakePlanFrame();
  const Eigen::Vector2d at = frame.OnScreen(rough_end_);
  if ((at - frame.OnScreen(rough_start_)).norm() > kLeastDragPx) {
    if (mode_ != WindowMode::kTag || photograph_ < 0) return;
    // People tilt their cameras a little upwards at a building, and no higher than its middle.
    constexpr double kTilt = 0.15;
    const double distance = (rough_end_ - rough_start_).head<2>().norm();
    const double middle = ComputeBounds(session_.model()).Center().z();
    rough_end_.z() =
        std::max(rough_start_.z(), std::min(middle, rough_start_.z() + kTilt * distance));
    StandThere(rough_start_, rough_end_);
    return;
  }
  for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
    const std::optional<Camera> camera = BelievedCamera(i);
    if (!camera || (frame.OnScreen(camera->PositionInWorld()) - at).norm() > kPointReachPx)
      continue;
    Choose(i, IsInside());
    return;
  }
}

}  // namespace groundglass
