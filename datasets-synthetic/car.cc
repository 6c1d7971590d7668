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
struct Car {
  WorldBuilder& builder;
  Eigen::Vector3d origin;
  Eigen::Vector3d along, right;
  Rgb paint = Rgb::Zero();

  Eigen::Vector3d At(double x, double side, double z) const {
    return origin + x * along + side * right + z * Eigen::Vector3d::UnitZ();
  }
  void Add(const std::vector<Eigen::Vector3d>& corners, Material material, const Rgb& color) const {
    builder.AddPolygon(corners, material, color, "car", kCar);
  }
};

Car DrawCar(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed) {
  Draws draws(seed);
  const double heading = draws.Angle();
  const Eigen::Vector3d along(std::cos(heading), std::sin(heading), 0);
  const Rgb paints[6] = {{0.3f, 0.03f, 0.03f},
                         {0.03f, 0.06f, 0.2f},
                         {0.45f, 0.45f, 0.44f},
                         {0.04f, 0.04f, 0.045f},
                         {0.25f, 0.2f, 0.1f},
                         {0.06f, 0.13f, 0.09f}};
  return {.builder = builder,
          .origin = foot,
          .along = along,
          .right = along.cross(Eigen::Vector3d::UnitZ()),
          .paint = paints[static_cast<int>(draws.Uniform(0, 6)) % 6]};
}

// The side's outline, counterclockwise seen from the right, with the wheels' openings.
std::vector<Eigen::Vector2d> SideOutline() {
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

void AddBody(const Car& car) {
  const std::vector<Eigen::Vector2d> outline = SideOutline();
  std::vector<Eigen::Vector3d> right_side;
  std::vector<Eigen::Vector3d> left_side;
  for (const Eigen::Vector2d& p : outline) {
    right_side.push_back(car.At(p.x(), kHalfWidth, p.y()));
    left_side.insert(left_side.begin(), car.At(p.x(), -kHalfWidth, p.y()));
  }
  car.Add(right_side, Material::kPaint, car.paint);
  car.Add(left_side, Material::kPaint, car.paint);
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    // Below the sills it is black.
    const bool is_under = std::max(a.y(), b.y()) < 2.4 && std::abs(a.x()) < 7.45;
    car.Add({car.At(a.x(), kHalfWidth, a.y()),
             car.At(a.x(), -kHalfWidth, a.y()),
             car.At(b.x(), -kHalfWidth, b.y()),
             car.At(b.x(), kHalfWidth, b.y())},
            is_under ? Material::kEven : Material::kPaint,
            is_under ? Rgb(0.01f, 0.01f, 0.01f) : car.paint);
  }
}

// The cabin leans in on all sides. A place at its end: `up` from 0 at the belt to 1 at the roof.
struct CabinCorner {
  double x, half_width, z;
};

CabinCorner CornerBetween(double low_x, double high_x, double up) {
  return {std::lerp(low_x, high_x, up),
          std::lerp(kHalfWidth - 0.2, kRoofHalfWidth, up),
          std::lerp(kBelt, kRoof, up)};
}
CabinCorner FrontOfCabin(double up) { return CornerBetween(3.3, 1.0, up); }
CabinCorner BackOfCabin(double up) { return CornerBetween(-5.2, -3.7, up); }

const Rgb kPane(0.02f, 0.023f, 0.025f);
const Rgb kSeal(0.015f, 0.015f, 0.015f);

// Its pillars are painted, the windows lie on them.
void AddCabinSide(const Car& car, double side) {
  // Between two shares of the cabin's length at each height.
  const auto add = [&](double from,
                       double to,
                       double low,
                       double high,
                       double out,
                       Material material,
                       const Rgb& color) {
    const auto place = [&](double along, double up) {
      const CabinCorner back = BackOfCabin(up);
      return car.At(
          std::lerp(back.x, FrontOfCabin(up).x, along), side * (back.half_width + out), back.z);
    };
    std::vector<Eigen::Vector3d> corners = {
        place(from, low), place(to, low), place(to, high), place(from, high)};
    if (side < 0) std::reverse(corners.begin(), corners.end());
    car.Add(corners, material, color);
  };
  add(0, 1, 0, 1, 0, Material::kPaint, car.paint);
  add(0.09, 0.93, 0.06, 0.84, 0.01, Material::kEven, kSeal);
  add(0.12, 0.47, 0.1, 0.8, 0.02, Material::kGlass, kPane);
  add(0.51, 0.9, 0.1, 0.8, 0.02, Material::kGlass, kPane);
}

// The windscreen (`facing` 1) or the rear window (-1).
void AddCabinEnd(const Car& car, CabinCorner (*corner)(double up), double facing) {
  const auto add =
      [&](double half, double low, double high, double out, Material material, const Rgb& color) {
        const auto place = [&](double across, double up) {
          const CabinCorner at = corner(up);
          return car.At(at.x + facing * out, across * facing * at.half_width, at.z + 0.5 * out);
        };
        car.Add({place(half, low), place(-half, low), place(-half, high), place(half, high)},
                material,
                color);
      };
  add(1, 0, 1, 0, Material::kPaint, car.paint);
  add(0.92, 0.04, 0.9, 0.015, Material::kEven, kSeal);
  add(0.88, 0.08, 0.86, 0.03, Material::kGlass, kPane);
}

void AddCabin(const Car& car) {
  for (const double side : {-1.0, 1.0}) AddCabinSide(car, side);
  AddCabinEnd(car, FrontOfCabin, 1.0);
  AddCabinEnd(car, BackOfCabin, -1.0);
  const auto roof = [&](const CabinCorner& at, double side) {
    return car.At(at.x, side * at.half_width, at.z);
  };
  car.Add({roof(BackOfCabin(1), 1),
           roof(FrontOfCabin(1), 1),
           roof(FrontOfCabin(1), -1),
           roof(BackOfCabin(1), -1)},
          Material::kPaint,
          car.paint);
}

// An upright panel on the nose (`facing` 1) or the tail (-1), between two sides.
void AddEndPanel(const Car& car,
                 double facing,
                 double from,
                 double to,
                 double low,
                 double high,
                 double out,
                 Material material,
                 const Rgb& color) {
  const double x = facing * (7.6 + out);
  std::vector<Eigen::Vector3d> corners = {
      car.At(x, from, low), car.At(x, to, low), car.At(x, to, high), car.At(x, from, high)};
  if (facing > 0) std::reverse(corners.begin(), corners.end());
  car.Add(corners, material, color);
}

const Rgb kRubber(0.03f, 0.03f, 0.03f);

// Bumper, lamps and plate of the nose (`facing` 1) or the tail (-1).
void AddEndTrim(const Car& car, double facing) {
  // The bumper, a bar that stands out.
  const double tip = facing * 8.0;
  const double base = facing * 7.5;
  const auto bar = [&](const std::vector<Eigen::Vector3d>& corners) {
    car.Add(corners, Material::kPlain, kRubber);
  };
  bar({car.At(tip, -2.75, 1.25),
       car.At(tip, 2.75, 1.25),
       car.At(tip, 2.75, 1.8),
       car.At(tip, -2.75, 1.8)});
  bar({car.At(base, -2.8, 1.8),
       car.At(base, 2.8, 1.8),
       car.At(tip, 2.75, 1.8),
       car.At(tip, -2.75, 1.8)});
  bar({car.At(base, -2.8, 1.25),
       car.At(base, 2.8, 1.25),
       car.At(tip, 2.75, 1.25),
       car.At(tip, -2.75, 1.25)});
  for (const double side : {-1.0, 1.0}) {
    bar({car.At(base, side * 2.8, 1.25),
         car.At(tip, side * 2.75, 1.25),
         car.At(tip, side * 2.75, 1.8),
         car.At(base, side * 2.8, 1.8)});
    // Lamps: white in front, red behind.
    const Rgb lamp = facing > 0 ? Rgb(0.7f, 0.7f, 0.65f) : Rgb(0.35f, 0.02f, 0.02f);
    AddEndPanel(car,
                facing,
                side * 1.55,
                side * 2.6,
                1.95,
                facing > 0 ? 2.4 : 2.6,
                0.02,
                facing > 0 ? Material::kPaint : Material::kPlain,
                lamp);
  }
  AddEndPanel(car, facing, -0.55, 0.55, 1.35, 1.68, 0.42, Material::kPlain, Rgb(0.6f, 0.6f, 0.5f));
  if (facing > 0) AddEndPanel(car, facing, -1.4, 1.4, 1.95, 2.4, 0.02, Material::kEven, kRubber);
}

void AddSideTrim(const Car& car, double side) {
  const auto strip = [&](double from, double to, double low, double high, const Rgb& color) {
    const double out = side * (kHalfWidth + 0.015);
    car.Add({car.At(from, out, low),
             car.At(to, out, low),
             car.At(to, out, high),
             car.At(from, out, high)},
            Material::kPlain,
            color);
  };
  // A rubbing strip between the wheels, the gaps of two doors, and their handles.
  strip(-3.3, 3.3, 1.75, 1.88, kRubber);
  for (const double gap : {-3.05, -0.55, 2.4}) strip(gap, gap + 0.05, 1.15, 3.0, {0, 0, 0});
  for (const double handle : {-2.85, -0.3}) strip(handle, handle + 0.5, 2.6, 2.72, kRubber);
}

// Slots around the hub of a wheel whose axle points `out`.
void AddHubSlots(const Car& car, const Eigen::Vector3d& middle, const Eigen::Vector3d& out) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  constexpr int kSlots = 8;
  for (int i = 0; i < kSlots; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSlots;
    const Eigen::Vector3d spoke = std::cos(angle) * out.cross(up) + std::sin(angle) * up;
    const Eigen::Vector3d across = spoke.cross(out);
    const Eigen::Vector3d hole = middle + 0.275 * out + 0.47 * spoke;
    car.builder.AddPolygon({hole - 0.08 * spoke - 0.07 * across,
                            hole - 0.08 * spoke + 0.07 * across,
                            hole + 0.1 * spoke + 0.1 * across,
                            hole + 0.1 * spoke - 0.1 * across},
                           Material::kEven,
                           Rgb(0.01f, 0.01f, 0.01f),
                           "hub",
                           kCar);
  }
}

void AddWheel(const Car& car, double axle, double side) {
  const Eigen::Vector3d middle = car.At(axle, side * 2.5, kTyre);
  const Finish rubber{Material::kPlain, Rgb(0.02f, 0.02f, 0.02f), "tyre", kCar};
  const Finish metal{Material::kPaint, Rgb(0.35f, 0.35f, 0.36f), "hub", kCar};
  const Eigen::Vector3d out = side * car.right;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const auto ring = [&](double outwards, double radius) {
    return Ring{middle + outwards * out, radius * out.cross(up), -radius * up};
  };
  AddLoft(car.builder,
          {ring(-0.5, 0.9), ring(-0.4, kTyre), ring(0.2, kTyre), ring(0.28, 0.97), ring(0.28, 0.7)},
          20,
          rubber);
  AddLoft(
      car.builder, {ring(0.28, 0.7), ring(0.24, 0.66), ring(0.26, 0.3), ring(0.3, 0)}, 20, metal);
  AddHubSlots(car, middle, out);
}

}  // namespace

void AddCar(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed) {
  const Car car = DrawCar(builder, foot, seed);
  builder.AddContactShadow({.center = car.origin.head<2>(),
                            .along = car.along.head<2>(),
                            .half_length = 7,
                            .half_width = 2.4,
                            .reach = 2.2,
                            .strength = 0.85});
  AddBody(car);
  AddCabin(car);
  for (const double facing : {-1.0, 1.0}) AddEndTrim(car, facing);
  for (const double side : {-1.0, 1.0}) AddSideTrim(car, side);
  for (const double axle : {-kAxle, kAxle}) {
    for (const double side : {-1.0, 1.0}) AddWheel(car, axle, side);
  }
}

}  // namespace groundglass
