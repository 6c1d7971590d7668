// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluders.h"

#include "datasets-synthetic/lettering.h"
#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Draws that follow one another from one seed.
class Draws {
 public:
  explicit Draws(uint64_t seed) : seed_(seed) {}
  double Uniform(double low, double high) { return low + (high - low) * UniformOf(Next()); }
  double Normal() { return NormalOf(Next()); }
  Eigen::Vector3d Direction() {
    const Eigen::Vector3d v(Normal(), Normal(), Normal());
    return v.normalized();
  }
  // A whole number with this mean, at most 1 away from it.
  int Count(double mean) { return static_cast<int>(std::floor(mean + Uniform(0, 1))); }

 private:
  uint64_t Next() { return HashOf(seed_, count_++); }
  uint64_t seed_;
  uint64_t count_ = 0;
};

Eigen::Vector3d OnGround(const Eigen::Vector2d& place, double height = 0) {
  return {place.x(), place.y(), height};
}

void AddBall(WorldBuilder& builder,
             const Eigen::Vector3d& center,
             double radius,
             const Rgb& color,
             const std::string& name,
             int code) {
  constexpr int kRings = 6;
  constexpr int kSides = 10;
  const auto height = [&](int i) { return -radius * std::cos(std::numbers::pi * i / kRings); };
  const auto width = [&](int i) {
    return std::max(0.01, radius * std::sin(std::numbers::pi * i / kRings));
  };
  for (int i = 0; i < kRings; ++i) {
    builder.AddTaperedColumn(center + Eigen::Vector3d(0, 0, height(i)),
                             center + Eigen::Vector3d(0, 0, height(i + 1)),
                             width(i),
                             width(i + 1),
                             kSides,
                             Material::kPlain,
                             color,
                             name,
                             code);
  }
}

// A trunk that forks into limbs, each with clumps of leaves about its end.
void AddTree(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed) {
  Draws draws(seed);
  const Rgb bark(0.13f, 0.1f, 0.075f);
  const double height = draws.Uniform(24, 36);
  const double fork = height * draws.Uniform(0.28, 0.36);
  const Eigen::Vector3d fork_point =
      OnGround(place, fork) + Eigen::Vector3d(draws.Normal(), draws.Normal(), 0) * 0.4;
  builder.AddTaperedColumn(
      OnGround(place, -0.6), fork_point, 0.75, 0.5, 8, Material::kBark, bark, "trunk", kTree);
  constexpr int kLimbs = 9;
  for (int limb = 0; limb < kLimbs; ++limb) {
    const double angle = kTurn * (limb + draws.Uniform(0, 0.7)) / kLimbs;
    const double reach = height * draws.Uniform(0.1, 0.3);
    const Eigen::Vector3d tip = OnGround(place, height * draws.Uniform(0.55, 0.92)) +
                                reach * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    builder.AddTaperedColumn(fork_point, tip, 0.3, 0.08, 5, Material::kBark, bark, "limb", kTree);
    const double clump = height * draws.Uniform(0.1, 0.15);
    constexpr int kLeaves = 330;
    for (int leaf = 0; leaf < kLeaves; ++leaf) {
      const Eigen::Vector3d center =
          tip + clump * std::cbrt(draws.Uniform(0.15, 1)) *
                    draws.Direction().cwiseProduct(Eigen::Vector3d(1, 1, 0.75));
      const Eigen::Vector3d normal = (draws.Direction() + Eigen::Vector3d(0, 0, 0.6)).normalized();
      const Eigen::Vector3d along = normal.unitOrthogonal() * draws.Uniform(0.35, 0.7);
      const Eigen::Vector3d across = normal.cross(along) * 0.55;
      const auto shade = static_cast<float>(draws.Uniform(0.6, 1.25));
      builder.AddPolygon({center - along, center - across, center + along, center + across},
                         Material::kPlain,
                         shade * Rgb(0.085f, 0.14f, 0.035f),
                         "leaf",
                         kTree);
    }
  }
}

void AddLamp(WorldBuilder& builder, const Eigen::Vector2d& place) {
  const Rgb iron(0.05f, 0.055f, 0.055f);
  builder.AddTaperedColumn(OnGround(place, -0.6),
                           OnGround(place, 1.2),
                           0.5,
                           0.4,
                           10,
                           Material::kPlain,
                           iron,
                           "lamp foot",
                           kLamp);
  builder.AddTaperedColumn(OnGround(place, 1.2),
                           OnGround(place, 13.4),
                           0.26,
                           0.19,
                           10,
                           Material::kPlain,
                           iron,
                           "lamp post",
                           kLamp);
  AddBall(builder, OnGround(place, 14.2), 0.95, Rgb(0.8f, 0.8f, 0.77f), "lamp globe", kLamp);
}

void AddSign(WorldBuilder& builder,
             const Eigen::Vector2d& place,
             const Eigen::Vector2d& toward,
             int number) {
  const Eigen::Vector2d facing = (toward - place).normalized();
  const Eigen::Vector2d along(-facing.y(), facing.x());
  const Eigen::Vector2d left = place - 3.5 * along;
  const Eigen::Vector2d right = place + 3.5 * along;
  const Rgb paint = number % 2 == 0 ? Rgb(0.03f, 0.08f, 0.25f) : Rgb(0.25f, 0.04f, 0.04f);
  const char* text[3] = {"VISITORS >", "NO PARKING", "DELIVERIES"};
  for (const bool is_front : {true, false}) {
    const Eigen::Vector2d offset = facing * (is_front ? 0.1 : -0.1);
    const Eigen::Vector2d from = (is_front ? left : right) + offset;
    const Eigen::Vector2d to = (is_front ? right : left) + offset;
    const int face = builder.AddPolygon(
        {OnGround(from, 3.2), OnGround(to, 3.2), OnGround(to, 6.4), OnGround(from, 6.4)},
        Material::kPlain,
        paint,
        "sign",
        kSign);
    if (!is_front) continue;
    Surface& surface = builder.SurfaceOf(face);
    surface.decals.push_back(MakeDecal(MakeLettering(text[number % 3], Rgb(0.75f, 0.75f, 0.7f)),
                                       surface.low_u + 0.4,
                                       4.1,
                                       surface.high_u - 0.4,
                                       5.5));
  }
  for (const Eigen::Vector2d& post : {left, right}) {
    builder.AddTaperedColumn(OnGround(post, -0.6),
                             OnGround(post, 6.6),
                             0.17,
                             0.17,
                             8,
                             Material::kPlain,
                             Rgb(0.1f, 0.1f, 0.1f),
                             "sign post",
                             kSign);
  }
}

// A side view's outline drawn out to a width: `profile` runs counterclockwise seen from the car's
// right, in feet along and up.
void AddExtruded(WorldBuilder& builder,
                 const Eigen::Vector3d& origin,
                 const Eigen::Vector3d& along,
                 const std::vector<Eigen::Vector2d>& profile,
                 double half_width,
                 const Rgb& color,
                 const std::string& name) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = along.cross(up);
  const auto at = [&](const Eigen::Vector2d& p, double side) -> Eigen::Vector3d {
    return origin + p.x() * along + p.y() * up + side * half_width * right;
  };
  std::vector<Eigen::Vector3d> right_side;
  std::vector<Eigen::Vector3d> left_side;
  for (const Eigen::Vector2d& p : profile) {
    right_side.push_back(at(p, 1));
    left_side.insert(left_side.begin(), at(p, -1));
  }
  builder.AddPolygon(right_side, Material::kPlain, color, name, kCar);
  builder.AddPolygon(left_side, Material::kPlain, color, name, kCar);
  for (size_t i = 0; i < profile.size(); ++i) {
    const Eigen::Vector2d& a = profile[i];
    const Eigen::Vector2d& b = profile[(i + 1) % profile.size()];
    builder.AddPolygon(
        {at(a, 1), at(a, -1), at(b, -1), at(b, 1)}, Material::kPlain, color, name, kCar);
  }
}

void AddCar(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed) {
  Draws draws(seed);
  const double heading = draws.Uniform(0, kTurn);
  const Eigen::Vector3d along(std::cos(heading), std::sin(heading), 0);
  const Rgb paints[5] = {{0.3f, 0.03f, 0.03f},
                         {0.03f, 0.06f, 0.2f},
                         {0.45f, 0.45f, 0.44f},
                         {0.04f, 0.04f, 0.045f},
                         {0.25f, 0.2f, 0.1f}};
  const Rgb paint = paints[static_cast<int>(draws.Uniform(0, 5)) % 5];
  const Eigen::Vector3d origin = OnGround(place);
  AddExtruded(builder,
              origin,
              along,
              {{-7.5, 1}, {7.4, 1}, {7.6, 2.1}, {7.2, 2.7}, {3.2, 3}, {-6.2, 3.1}, {-7.5, 2.8}},
              2.8,
              paint,
              "car body");
  AddExtruded(builder,
              origin,
              along,
              {{-5.4, 3.05}, {3.1, 3}, {1.1, 4.55}, {-3.9, 4.6}},
              2.45,
              Rgb(0.03f, 0.035f, 0.04f),
              "car windows");
  AddExtruded(builder,
              origin,
              along,
              {{-3.9, 4.6}, {1.1, 4.55}, {0.9, 4.75}, {-3.7, 4.8}},
              2.45,
              paint,
              "car roof");
  const Eigen::Vector3d right = along.cross(Eigen::Vector3d::UnitZ());
  for (const double axle : {-4.7, 4.7}) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d hub = origin + axle * along + side * 2.5 * right;
      const Eigen::Vector3d middle = hub + Eigen::Vector3d(0, 0, 1.05);
      const Eigen::Vector3d outside = middle + side * 0.35 * right;
      builder.AddTaperedColumn(middle - side * 0.3 * right,
                               outside,
                               1.05,
                               1.05,
                               14,
                               Material::kPlain,
                               Rgb(0.02f, 0.02f, 0.02f),
                               "tyre",
                               kCar);
      builder.AddTaperedColumn(outside,
                               outside + side * 0.02 * right,
                               1.05,
                               0.62,
                               14,
                               Material::kPlain,
                               Rgb(0.02f, 0.02f, 0.02f),
                               "tyre",
                               kCar);
      builder.AddTaperedColumn(outside + side * 0.02 * right,
                               outside + side * 0.05 * right,
                               0.62,
                               0.01,
                               14,
                               Material::kPlain,
                               Rgb(0.35f, 0.35f, 0.36f),
                               "hub",
                               kCar);
    }
  }
}

void AddPerson(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed) {
  Draws draws(seed);
  const double heading = draws.Uniform(0, kTurn);
  const Eigen::Vector3d ahead(std::cos(heading), std::sin(heading), 0);
  const Eigen::Vector3d aside(-ahead.y(), ahead.x(), 0);
  const double size = draws.Uniform(0.9, 1.07);
  // Cloth is mostly dull: a grey with a little colour.
  const auto cloth = [&] {
    const double grey = draws.Uniform(0.02, 0.22);
    const Rgb tint(static_cast<float>(draws.Uniform(0.7, 1.5)),
                   static_cast<float>(draws.Uniform(0.7, 1.2)),
                   static_cast<float>(draws.Uniform(0.7, 1.5)));
    return Rgb(static_cast<float>(grey) * tint);
  };
  const Rgb coat = cloth();
  const Rgb trousers = 0.4f * cloth();
  const Rgb skin(0.4f, 0.26f, 0.19f);
  const double stride = draws.Uniform(-0.8, 0.8);
  const auto at = [&](double forward, double side, double up) -> Eigen::Vector3d {
    return OnGround(place) +
           size * (forward * ahead + side * aside + up * Eigen::Vector3d::UnitZ());
  };
  const auto part = [&](const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to,
                        double from_radius,
                        double to_radius,
                        const Rgb& color) {
    builder.AddTaperedColumn(from,
                             to,
                             size * from_radius,
                             size * to_radius,
                             9,
                             Material::kPlain,
                             color,
                             "person",
                             kPerson);
  };
  for (const double side : {-1.0, 1.0}) {
    part(at(side * stride, side * 0.3, 0), at(0, side * 0.25, 2.8), 0.22, 0.34, trousers);
    part(at(-side * stride * 0.8, side * 0.75, 2.9), at(0, side * 0.62, 4.75), 0.13, 0.2, coat);
  }
  part(at(0, 0, 2.6), at(0, 0, 3.6), 0.55, 0.5, coat);
  part(at(0, 0, 3.6), at(0, 0, 4.8), 0.5, 0.62, coat);
  part(at(0, 0, 4.8), at(0, 0, 5.05), 0.62, 0.2, coat);
  const Rgb hair = draws.Uniform(0, 1) < 0.7 ? Rgb(0.04f, 0.03f, 0.025f) : Rgb(0.2f, 0.15f, 0.1f);
  AddBall(builder, at(0.06, 0, 5.38), size * 0.34, skin, "head", kPerson);
  AddBall(builder, at(-0.06, 0, 5.5), size * 0.34, hair, "hair", kPerson);
}

bool IsFree(const OccluderSite& site, const Eigen::Vector2d& place, double clearance) {
  const Eigen::Vector2d nearest = place.cwiseMax(site.low).cwiseMin(site.high);
  if ((place - nearest).norm() < clearance) return false;
  for (const Eigen::Vector3d& camera : site.camera_positions) {
    if ((place - camera.head<2>()).norm() < 22) return false;
  }
  return true;
}

// A free place around the building, between `low` and `high` of the plaza's radius from its centre.
Eigen::Vector2d PlaceAround(const OccluderSite& site, Draws& draws, double low, double high) {
  const Eigen::Vector2d center = (site.low + site.high) / 2;
  Eigen::Vector2d place = center;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const double angle = draws.Uniform(0, kTurn);
    place = center + site.radius * draws.Uniform(low, high) *
                         Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (IsFree(site, place, 22)) break;
  }
  return place;
}

}  // namespace

const std::vector<std::pair<int, std::string>>& OccluderNames() {
  static const std::vector<std::pair<int, std::string>> kNames = {{kPerson, "person"},
                                                                  {kTree, "tree"},
                                                                  {kSign, "sign"},
                                                                  {kLamp, "lamp"},
                                                                  {kCar, "car"},
                                                                  {kMount, "slide mount"}};
  return kNames;
}

void AddStandingOccluders(WorldBuilder& builder,
                          const OccluderSite& site,
                          const OccluderCounts& counts,
                          uint64_t seed) {
  const Eigen::Vector2d center = (site.low + site.high) / 2;
  Draws draws(SeedFor(seed, "standing"));
  for (int i = 0; i < counts.trees; ++i) {
    AddTree(builder, PlaceAround(site, draws, 0.72, 1.05), SeedFor(seed, "tree", i));
  }
  for (int i = 0; i < counts.lamps; ++i) AddLamp(builder, PlaceAround(site, draws, 0.6, 0.95));
  for (int i = 0; i < counts.signs; ++i) {
    const Eigen::Vector2d place = PlaceAround(site, draws, 0.75, 0.95);
    AddSign(builder, place, 2 * place - center, i);
  }
}

void AddPassingOccluders(WorldBuilder& builder,
                         const OccluderSite& site,
                         const Eigen::Vector3d& camera_position,
                         const Eigen::Vector3d& camera_forward,
                         const OccluderCounts& counts,
                         uint64_t seed) {
  Draws draws(SeedFor(seed, "passing"));
  const Eigen::Vector2d ahead = camera_forward.head<2>().normalized();
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  const auto place_before_camera = [&](double near, double far) {
    Eigen::Vector2d place = camera_position.head<2>();
    for (int attempt = 0; attempt < 40; ++attempt) {
      const double distance = draws.Uniform(near, far);
      place = camera_position.head<2>() + distance * (ahead + draws.Uniform(-0.5, 0.5) * aside);
      if (IsFree(site, place, 6)) return std::make_pair(place, true);
    }
    return std::make_pair(place, false);
  };
  const int num_cars = draws.Count(counts.cars);
  const int num_people = draws.Count(counts.people);
  for (int i = 0; i < num_cars; ++i) {
    const auto [place, is_free] = place_before_camera(50, 150);
    if (is_free) AddCar(builder, place, SeedFor(seed, "car", i));
  }
  for (int i = 0; i < num_people; ++i) {
    const auto [place, is_free] = place_before_camera(45, 160);
    if (is_free) AddPerson(builder, place, SeedFor(seed, "person", i));
  }
}

}  // namespace groundglass
