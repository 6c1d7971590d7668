// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluder_shapes.h"
#include "datasets-synthetic/occluders.h"

#include <algorithm>

namespace groundglass {
namespace {

constexpr int kSides = 12;

// Someone in mid-step, built in feet for a height of 6 and then scaled.
class Figure {
 public:
  Figure(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed)
      : builder_(builder), foot_(foot), draws_(seed) {
    const double heading = draws_.Angle();
    ahead_ = {std::cos(heading), std::sin(heading), 0};
    aside_ = {-ahead_.y(), ahead_.x(), 0};
    size_ = draws_.Uniform(0.88, 1.05);
    girth_ = draws_.Uniform(0.92, 1.15);
  }

  void Add() {
    builder_.AddContactShadow({.center = foot_.head<2>(),
                               .half_length = 0.3,
                               .half_width = 0.3,
                               .reach = 1.3,
                               .strength = 0.55});
    const Rgb coat = Cloth();
    const Rgb below = 0.5f * Cloth();
    const Rgb shoes(0.03f, 0.025f, 0.02f);
    const Rgb skins[3] = {{0.42f, 0.27f, 0.2f}, {0.24f, 0.14f, 0.09f}, {0.1f, 0.06f, 0.045f}};
    const Rgb skin = skins[static_cast<int>(draws_.Uniform(0, 3)) % 3];
    const Rgb hairs[3] = {{0.03f, 0.025f, 0.02f}, {0.12f, 0.08f, 0.05f}, {0.3f, 0.27f, 0.22f}};
    const Rgb hair = hairs[static_cast<int>(draws_.Uniform(0, 3)) % 3];
    const bool has_long_coat = draws_.Chance(0.3);
    const bool has_skirt = !has_long_coat && draws_.Chance(0.25);
    const double stride = draws_.Chance(0.7) ? draws_.Uniform(0.35, 0.8) : draws_.Uniform(0, 0.1);
    // A skirt or a long coat keeps the thighs together, well within it.
    const bool is_draped = has_skirt || has_long_coat;
    const double knee_stride = is_draped ? std::min(stride, 0.2) : stride;
    const double hip_side = is_draped ? 0.19 : 0.27;
    const double thigh = is_draped ? 0.26 : 0.36;

    for (const double side : {-1.0, 1.0}) {
      const double step = side * stride;
      const Eigen::Vector3d hip = At(0, hip_side * side, 3.05);
      const Eigen::Vector3d knee =
          At(0.55 * side * knee_stride + 0.12, (hip_side - 0.01) * side, 1.65);
      const Eigen::Vector3d ankle = At(1.1 * step - 0.06, 0.24 * side, step < 0 ? 0.42 : 0.28);
      Limb(hip, knee, thigh, 0.7 * thigh, has_skirt ? skin : below);
      Limb(knee, ankle, 0.7 * thigh, 0.15, has_skirt ? skin : below);
      // A shoe, whose heel has left the ground behind.
      Egg(ankle + size_ * (0.2 * ahead_ - Eigen::Vector3d(0, 0, 0.13)), 0.45, 0.17, 0.15, shoes);
      // Arms swing against the legs.
      const double swing = -0.6 * step;
      const Eigen::Vector3d shoulder = At(0, 0.58 * side * girth_, 4.64);
      const Eigen::Vector3d elbow = At(0.6 * swing - 0.05, 0.82 * side * girth_, 3.75);
      const Eigen::Vector3d wrist = At(1.3 * swing + 0.2, 0.78 * side * girth_, 2.98);
      Limb(shoulder, elbow, 0.21, 0.17, coat);
      Limb(elbow, wrist, 0.17, 0.12, coat);
      Egg(wrist - size_ * Eigen::Vector3d(0, 0, 0.17), 0.12, 0.08, 0.22, skin);
      Egg(shoulder, 0.21, 0.2, 0.2, coat);
    }
    // The trunk, from hips to neck: height, half depth and half width.
    Trunk({{2.75, 0.36, 0.46},
           {3.1, 0.4, 0.53},
           {3.7, 0.36, 0.47},
           {4.3, 0.41, 0.56},
           {4.66, 0.35, 0.62},
           {4.92, 0.24, 0.42},
           {5.05, 0.16, 0.2}},
          coat);
    if (has_long_coat) Trunk({{1.65, 0.62, 0.64}, {2.4, 0.52, 0.59}, {3.2, 0.42, 0.54}}, coat);
    if (has_skirt) Trunk({{1.7, 0.62, 0.62}, {2.5, 0.5, 0.58}, {3.2, 0.42, 0.54}}, below);
    Limb(At(0, 0, 4.95), At(0.06, 0, 5.3), 0.18, 0.16, skin);
    Egg(At(0.08, 0, 5.55), 0.33, 0.27, 0.42, skin);
    Egg(At(0.02, 0, 5.66), 0.35, 0.3, 0.35, hair);
    if (draws_.Chance(0.35)) AddBag();
  }

 private:
  struct Slice {
    double height, half_depth, half_width;
  };

  Eigen::Vector3d At(double forward, double side, double up) const {
    return foot_ + size_ * (forward * ahead_ + side * aside_ + up * Eigen::Vector3d::UnitZ());
  }
  Finish Of(const Rgb& color) const { return {Material::kPlain, color, "person", kPerson}; }

  // Cloth is mostly dull: a grey with a little colour.
  Rgb Cloth() {
    const auto grey = static_cast<float>(draws_.Uniform(0.03, 0.24));
    const Rgb tint(static_cast<float>(draws_.Uniform(0.7, 1.5)),
                   static_cast<float>(draws_.Uniform(0.7, 1.2)),
                   static_cast<float>(draws_.Uniform(0.7, 1.5)));
    return grey * tint;
  }
  void Limb(const Eigen::Vector3d& from,
            const Eigen::Vector3d& to,
            double from_radius,
            double to_radius,
            const Rgb& color) {
    builder_.AddTaperedColumn(from,
                              to,
                              size_ * from_radius,
                              size_ * to_radius,
                              kSides,
                              Material::kPlain,
                              color,
                              "person",
                              kPerson);
    Egg(to, to_radius, to_radius, to_radius, color);
  }
  void Egg(const Eigen::Vector3d& center, double ahead, double aside, double up, const Rgb& color) {
    AddEgg(builder_,
           center,
           size_ * ahead * ahead_,
           size_ * aside * aside_,
           size_ * up * Eigen::Vector3d::UnitZ(),
           kSides,
           Of(color));
  }
  void Trunk(const std::vector<Slice>& slices, const Rgb& color) {
    std::vector<Ring> rings;
    for (const Slice& slice : slices) {
      rings.push_back({At(0, 0, slice.height),
                       size_ * girth_ * slice.half_depth * ahead_,
                       size_ * girth_ * slice.half_width * aside_});
    }
    AddLoft(builder_, rings, kSides, Of(color));
  }
  // Slung from a shoulder.
  void AddBag() {
    const Rgb leather = Rgb(0.1f, 0.06f, 0.035f) * static_cast<float>(draws_.Uniform(0.5, 2));
    const Eigen::Vector3d middle = At(-0.1, 0.98, 2.9);
    const Eigen::Vector3d half_up = size_ * 0.45 * Eigen::Vector3d::UnitZ();
    AddLoft(builder_,
            {{middle - half_up, 0 * ahead_, 0 * aside_},
             {middle - half_up, size_ * 0.55 * ahead_, size_ * 0.2 * aside_},
             {middle + half_up, size_ * 0.5 * ahead_, size_ * 0.14 * aside_},
             {middle + half_up, 0 * ahead_, 0 * aside_}},
            kSides,
            Of(leather));
    Limb(At(-0.1, 0.85, 3.3), At(0, 0.55, 4.95), 0.05, 0.05, leather);
  }

  WorldBuilder& builder_;
  Eigen::Vector3d foot_;
  Draws draws_;
  Eigen::Vector3d ahead_, aside_;
  double size_ = 1;
  double girth_ = 1;
};

}  // namespace

void AddPerson(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed) {
  Figure(builder, foot, seed).Add();
}

}  // namespace groundglass
