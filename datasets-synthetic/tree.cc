// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluder_shapes.h"
#include "datasets-synthetic/occluders.h"

#include <algorithm>

namespace groundglass {
namespace {

// Grows branches that fork three times and carry leaves along their last two forks.
class TreeGrower {
 public:
  TreeGrower(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed)
      : builder_(builder), place_(place), draws_(seed) {
    height_ = draws_.Uniform(25, 37);
    green_ = Rgb(0.085f, 0.14f, 0.035f) * static_cast<float>(draws_.Uniform(0.85, 1.15));
    green_[0] *= static_cast<float>(draws_.Uniform(0.85, 1.35));
  }

  void Grow() {
    // The crown keeps some of the sky from the ground beneath, the trunk more at its foot.
    builder_.AddContactShadow({.center = place_, .reach = 0.4 * height_, .strength = 0.45});
    builder_.AddContactShadow(
        {.center = place_, .half_length = 0.6, .half_width = 0.6, .reach = 1.5, .strength = 0.4});
    const Eigen::Vector3d lean =
        (Eigen::Vector3d::UnitZ() + 0.04 * Eigen::Vector3d(draws_.Normal(), draws_.Normal(), 0))
            .normalized();
    const double fork = height_ * draws_.Uniform(0.24, 0.32);
    const Eigen::Vector3d foot(place_.x(), place_.y(), -0.6);
    const double radius = height_ * 0.024;
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
    const auto ring = [&](double up, double width) {
      return Ring{foot + up * lean, width * x, width * y};
    };
    // Roots spread where the trunk meets the ground.
    AddLoft(builder_,
            {ring(0, 1.9 * radius),
             ring(0.8, 1.45 * radius),
             ring(1.8, 1.1 * radius),
             ring(fork * 0.6, radius),
             ring(fork + 1.2, 0.8 * radius)},
            10,
            bark_);
    // Limbs leave the trunk one above the other, and it ends in one of them.
    constexpr int kLimbs = 7;
    for (int i = 0; i < kLimbs; ++i) {
      const double angle = 2.4 * i + draws_.Uniform(-0.3, 0.3);
      const double steepness = 0.45 + 0.16 * i;
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), steepness);
      const Eigen::Vector3d start = ring(fork + 0.06 * height_ * i, 0).center;
      Branch(start, out.normalized(), height_ * draws_.Uniform(0.19, 0.25), 0.42 * radius, 0);
    }
    builder_.AddTaperedColumn(ring(fork, 0).center,
                              ring(fork + 0.06 * height_ * kLimbs, 0).center,
                              0.8 * radius,
                              0.2 * radius,
                              7,
                              bark_.material,
                              bark_.color,
                              bark_.name,
                              bark_.mask_code);
  }

 private:
  // How far out in the crown a place is: 0 at its heart, 1 at its rim.
  double Outwardness(const Eigen::Vector3d& at) const {
    const Eigen::Vector3d heart(place_.x(), place_.y(), 0.62 * height_);
    const Eigen::Vector3d offset =
        (at - heart).cwiseQuotient(Eigen::Vector3d(0.36 * height_, 0.36 * height_, 0.42 * height_));
    return std::clamp(offset.norm() + 0.35 * offset.z(), 0.0, 1.0);
  }

  void Branch(const Eigen::Vector3d& start,
              const Eigen::Vector3d& direction,
              double length,
              double radius,
              int level) {
    // Branches bend upwards on their way.
    const Eigen::Vector3d middle = start + 0.5 * length * direction;
    const Eigen::Vector3d bent =
        (direction + 0.15 * draws_.Direction() + Eigen::Vector3d(0, 0, 0.15)).normalized();
    const Eigen::Vector3d tip = middle + 0.5 * length * bent;
    const int num_sides = level == 0 ? 6 : 4;
    const auto piece =
        [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double thick, double thin) {
          builder_.AddTaperedColumn(from,
                                    to,
                                    thick,
                                    thin,
                                    num_sides,
                                    bark_.material,
                                    bark_.color,
                                    bark_.name,
                                    bark_.mask_code);
        };
    piece(start, middle, radius, 0.8 * radius);
    piece(middle, tip, 0.8 * radius, 0.5 * radius);
    constexpr int kLastLevel = 2;
    if (level >= kLastLevel - 1) AddLeaves(middle, tip, level == kLastLevel ? 44 : 24);
    if (level == kLastLevel) return;
    constexpr int kForks = 4;
    for (int i = 0; i < kForks; ++i) {
      const double turn = draws_.Uniform(0.35, 0.75);
      const Eigen::Vector3d aside = (draws_.Direction() + Eigen::Vector3d(0, 0, 0.2)).normalized();
      const Eigen::Vector3d next = (std::cos(turn) * bent + std::sin(turn) * aside).normalized();
      const Eigen::Vector3d from = middle + draws_.Uniform(0.3, 1.0) * (tip - middle);
      Branch(from, next, length * draws_.Uniform(0.5, 0.75), 0.45 * radius, level + 1);
    }
  }

  // Leaves about a twig, each a diamond; those within the crown get less light.
  void AddLeaves(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int count) {
    const double spread = 0.055 * height_;
    const double hue = draws_.Uniform(0.85, 1.2);
    for (int leaf = 0; leaf < count; ++leaf) {
      const Eigen::Vector3d center = from + draws_.Uniform(0.1, 1.15) * (to - from) +
                                     spread * std::cbrt(draws_.Uniform(0, 1)) * draws_.Direction();
      const Eigen::Vector3d normal = (draws_.Direction() + Eigen::Vector3d(0, 0, 0.8)).normalized();
      const Eigen::Vector3d along = normal.unitOrthogonal() * draws_.Uniform(0.28, 0.58);
      const Eigen::Vector3d across = normal.cross(along) * draws_.Uniform(0.45, 0.7);
      const double light = 0.35 + 0.75 * Outwardness(center);
      Rgb color = green_ * static_cast<float>(light * draws_.Uniform(0.7, 1.25));
      color[0] *= static_cast<float>(hue);
      builder_.AddPolygon({center - along, center - across, center + along, center + across},
                          Material::kPlain,
                          color,
                          "leaf",
                          kTree);
    }
  }

  WorldBuilder& builder_;
  Eigen::Vector2d place_;
  Draws draws_;
  double height_ = 30;
  Rgb green_ = Rgb::Zero();
  const Finish bark_{Material::kBark, Rgb(0.13f, 0.1f, 0.075f), "branch", kTree};
};

}  // namespace

void AddTree(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed) {
  TreeGrower(builder, place, seed).Grow();
}

}  // namespace groundglass
