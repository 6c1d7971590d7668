// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluder_shapes.h"
#include "datasets-synthetic/occluders.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kAxle = 4.7;       // of both wheels from the car's middle
constexpr double kTyre = 1.05;      // radius
constexpr double kArch = 1.28;      // radius of the opening in the body
constexpr double kHalfWidth = 2.8;  // of the body
constexpr double kRoofHalfWidth = 2.1;
constexpr double kBelt = 3.05;  // height where the windows begin
constexpr double kRoof = 4.7;

// A saloon of the eighties, drawn in feet: along the car, to its right, and up.
class Car {
 public:
  Car(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed)
      : builder_(builder), origin_(foot) {
    Draws draws(seed);
    const double heading = draws.Angle();
    along_ = {std::cos(heading), std::sin(heading), 0};
    right_ = along_.cross(Eigen::Vector3d::UnitZ());
    const Rgb paints[6] = {{0.3f, 0.03f, 0.03f},
                           {0.03f, 0.06f, 0.2f},
                           {0.45f, 0.45f, 0.44f},
                           {0.04f, 0.04f, 0.045f},
                           {0.25f, 0.2f, 0.1f},
                           {0.06f, 0.13f, 0.09f}};
    paint_ = paints[static_cast<int>(draws.Uniform(0, 6)) % 6];
  }

  void Add() {
    builder_.AddContactShadow({.center = origin_.head<2>(),
                               .along = along_.head<2>(),
                               .half_length = 7,
                               .half_width = 2.4,
                               .reach = 2.2,
                               .strength = 0.85});
    AddBody();
    AddCabin();
    AddTrim();
    for (const double axle : {-kAxle, kAxle}) {
      for (const double side : {-1.0, 1.0}) AddWheel(axle, side);
    }
  }

 private:
  Eigen::Vector3d At(double x, double side, double z) const {
    return origin_ + x * along_ + side * right_ + z * Eigen::Vector3d::UnitZ();
  }
  void Polygon(const std::vector<Eigen::Vector3d>& corners, Material material, const Rgb& color) {
    builder_.AddPolygon(corners, material, color, "car", kCar);
  }

  // The side's outline, counterclockwise seen from the right, with the wheels' openings.
  static std::vector<Eigen::Vector2d> SideOutline() {
    std::vector<Eigen::Vector2d> outline = {{-7.5, 1.0}};
    for (const double axle : {-kAxle, kAxle}) {
      constexpr int kSteps = 8;
      const double low = std::acos((1.0 - kTyre) / kArch);  // where the arch meets the sill
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = low - 2 * low * i / kSteps;
        outline.emplace_back(axle - kArch * std::sin(angle), kTyre + kArch * std::cos(angle));
      }
    }
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(7.4, 1.0),
                                     {7.6, 1.5},
                                     {7.55, 2.2},
                                     {7.25, 2.65},
                                     {3.4, kBelt},
                                     {-5.3, kBelt},
                                     {-7.2, 2.95},
                                     {-7.55, 2.7},
                                     {-7.6, 1.5}}) {
      outline.push_back(p);
    }
    return outline;
  }

  void AddBody() {
    const std::vector<Eigen::Vector2d> outline = SideOutline();
    std::vector<Eigen::Vector3d> right_side;
    std::vector<Eigen::Vector3d> left_side;
    for (const Eigen::Vector2d& p : outline) {
      right_side.push_back(At(p.x(), kHalfWidth, p.y()));
      left_side.insert(left_side.begin(), At(p.x(), -kHalfWidth, p.y()));
    }
    Polygon(right_side, Material::kPaint, paint_);
    Polygon(left_side, Material::kPaint, paint_);
    for (size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
      // Below the sills it is black.
      const bool is_under = std::max(a.y(), b.y()) < 2.4 && std::abs(a.x()) < 7.45;
      Polygon({At(a.x(), kHalfWidth, a.y()),
               At(a.x(), -kHalfWidth, a.y()),
               At(b.x(), -kHalfWidth, b.y()),
               At(b.x(), kHalfWidth, b.y())},
              is_under ? Material::kEven : Material::kPaint,
              is_under ? Rgb(0.01f, 0.01f, 0.01f) : paint_);
    }
  }

  // The cabin leans in on all sides; its pillars are painted, the windows lie on them.
  void AddCabin() {
    struct Corner {
      double x, half_width, z;
    };
    const double low_front = 3.3;
    const double low_back = -5.2;
    const double high_front = 1.0;
    const double high_back = -3.7;
    const double lower = kHalfWidth - 0.2;
    // Places on the cabin's sides and ends, `up` from 0 at the belt to 1 at the roof.
    const auto front = [&](double up) {
      return Corner{std::lerp(low_front, high_front, up),
                    std::lerp(lower, kRoofHalfWidth, up),
                    std::lerp(kBelt, kRoof, up)};
    };
    const auto back = [&](double up) {
      return Corner{std::lerp(low_back, high_back, up),
                    std::lerp(lower, kRoofHalfWidth, up),
                    std::lerp(kBelt, kRoof, up)};
    };
    const auto at = [&](const Corner& c, double side, double out = 0) {
      return At(c.x, side * (c.half_width + out), c.z);
    };
    const Rgb glass(0.02f, 0.023f, 0.025f);
    const Rgb black(0.015f, 0.015f, 0.015f);
    for (const double side : {-1.0, 1.0}) {
      const auto add =
          [&](std::vector<Eigen::Vector3d> corners, Material material, const Rgb& color) {
            if (side < 0) std::reverse(corners.begin(), corners.end());
            Polygon(corners, material, color);
          };
      add({at(back(0), side), at(front(0), side), at(front(1), side), at(back(1), side)},
          Material::kPaint,
          paint_);
      // A pane between two shares of the cabin's length at each height.
      const auto pane = [&](double from,
                            double to,
                            double low,
                            double high,
                            double out,
                            Material material,
                            const Rgb& color) {
        const auto place = [&](double along, double up) {
          const Corner a = back(up);
          const Corner b = front(up);
          return At(std::lerp(a.x, b.x, along), side * (a.half_width + out), a.z);
        };
        add({place(from, low), place(to, low), place(to, high), place(from, high)},
            material,
            color);
      };
      pane(0.09, 0.93, 0.06, 0.84, 0.01, Material::kEven, black);
      pane(0.12, 0.47, 0.1, 0.8, 0.02, Material::kGlass, glass);
      pane(0.51, 0.9, 0.1, 0.8, 0.02, Material::kGlass, glass);
    }
    // Windscreen, rear window and roof.
    const auto end = [&](const auto& corner, double sign) {
      const auto place = [&](double across, double up, double out) {
        const Corner c = corner(up);
        return At(c.x + sign * out, across * sign * c.half_width, c.z + 0.5 * out);
      };
      const auto quad = [&](double half,
                            double low,
                            double high,
                            double out,
                            Material material,
                            const Rgb& color) {
        Polygon({place(half, low, out),
                 place(-half, low, out),
                 place(-half, high, out),
                 place(half, high, out)},
                material,
                color);
      };
      quad(1, 0, 1, 0, Material::kPaint, paint_);
      quad(0.92, 0.04, 0.9, 0.015, Material::kEven, black);
      quad(0.88, 0.08, 0.86, 0.03, Material::kGlass, glass);
    };
    end(front, 1.0);
    end(back, -1.0);
    Polygon({at(back(1), 1), at(front(1), 1), at(front(1), -1), at(back(1), -1)},
            Material::kPaint,
            paint_);
  }

  // An upright panel on the nose (`facing` 1) or the tail (-1), between two sides.
  void EndPanel(double facing,
                double from,
                double to,
                double low,
                double high,
                double out,
                Material material,
                const Rgb& color) {
    const double x = facing * (7.6 + out);
    std::vector<Eigen::Vector3d> corners = {
        At(x, from, low), At(x, to, low), At(x, to, high), At(x, from, high)};
    if (facing > 0) std::reverse(corners.begin(), corners.end());
    Polygon(corners, material, color);
  }

  void AddTrim() {
    const Rgb rubber(0.03f, 0.03f, 0.03f);
    for (const double facing : {-1.0, 1.0}) {
      // The bumper, a bar that stands out.
      const double tip = facing * 8.0;
      const double base = facing * 7.5;
      const auto bar = [&](std::vector<Eigen::Vector3d> corners) {
        Polygon(corners, Material::kPlain, rubber);
      };
      bar({At(tip, -2.75, 1.25), At(tip, 2.75, 1.25), At(tip, 2.75, 1.8), At(tip, -2.75, 1.8)});
      bar({At(base, -2.8, 1.8), At(base, 2.8, 1.8), At(tip, 2.75, 1.8), At(tip, -2.75, 1.8)});
      bar({At(base, -2.8, 1.25), At(base, 2.8, 1.25), At(tip, 2.75, 1.25), At(tip, -2.75, 1.25)});
      for (const double side : {-1.0, 1.0}) {
        bar({At(base, side * 2.8, 1.25),
             At(tip, side * 2.75, 1.25),
             At(tip, side * 2.75, 1.8),
             At(base, side * 2.8, 1.8)});
        // Lamps: white in front, red behind.
        const Rgb lamp = facing > 0 ? Rgb(0.7f, 0.7f, 0.65f) : Rgb(0.35f, 0.02f, 0.02f);
        EndPanel(facing,
                 side * 1.55,
                 side * 2.6,
                 1.95,
                 facing > 0 ? 2.4 : 2.6,
                 0.02,
                 facing > 0 ? Material::kPaint : Material::kPlain,
                 lamp);
      }
      EndPanel(facing, -0.55, 0.55, 1.35, 1.68, 0.42, Material::kPlain, Rgb(0.6f, 0.6f, 0.5f));
      if (facing > 0) EndPanel(facing, -1.4, 1.4, 1.95, 2.4, 0.02, Material::kEven, rubber);
    }
    for (const double side : {-1.0, 1.0}) {
      const auto strip = [&](double from, double to, double low, double high, const Rgb& color) {
        const double out = side * (kHalfWidth + 0.015);
        Polygon({At(from, out, low), At(to, out, low), At(to, out, high), At(from, out, high)},
                Material::kPlain,
                color);
      };
      // A rubbing strip between the wheels, the gaps of two doors, and their handles.
      strip(-3.3, 3.3, 1.75, 1.88, rubber);
      for (const double gap : {-3.05, -0.55, 2.4}) strip(gap, gap + 0.05, 1.15, 3.0, {0, 0, 0});
      for (const double handle : {-2.85, -0.3}) strip(handle, handle + 0.5, 2.6, 2.72, rubber);
    }
  }

  void AddWheel(double axle, double side) {
    const Eigen::Vector3d middle = At(axle, side * 2.5, kTyre);
    const Finish rubber{Material::kPlain, Rgb(0.02f, 0.02f, 0.02f), "tyre", kCar};
    const Finish metal{Material::kPaint, Rgb(0.35f, 0.35f, 0.36f), "hub", kCar};
    const Finish dark{Material::kEven, Rgb(0.01f, 0.01f, 0.01f), "hub", kCar};
    const Eigen::Vector3d out = side * right_;
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const auto ring = [&](double outwards, double radius) {
      return Ring{middle + outwards * out, radius * out.cross(up), -radius * up};
    };
    AddLoft(
        builder_,
        {ring(-0.5, 0.9), ring(-0.4, kTyre), ring(0.2, kTyre), ring(0.28, 0.97), ring(0.28, 0.7)},
        20,
        rubber);
    AddLoft(
        builder_, {ring(0.28, 0.7), ring(0.24, 0.66), ring(0.26, 0.3), ring(0.3, 0)}, 20, metal);
    // Slots around the hub.
    constexpr int kSlots = 8;
    for (int i = 0; i < kSlots; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSlots;
      const Eigen::Vector3d spoke = std::cos(angle) * out.cross(up) + std::sin(angle) * up;
      const Eigen::Vector3d across = spoke.cross(out);
      const Eigen::Vector3d hole = middle + 0.275 * out + 0.47 * spoke;
      builder_.AddPolygon({hole - 0.08 * spoke - 0.07 * across,
                           hole - 0.08 * spoke + 0.07 * across,
                           hole + 0.1 * spoke + 0.1 * across,
                           hole + 0.1 * spoke - 0.1 * across},
                          dark.material,
                          dark.color,
                          dark.name,
                          dark.mask_code);
    }
  }

  WorldBuilder& builder_;
  Eigen::Vector3d origin_;
  Eigen::Vector3d along_, right_;
  Rgb paint_ = Rgb::Zero();
};

}  // namespace

void AddCar(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed) {
  Car(builder, foot, seed).Add();
}

}  // namespace groundglass
