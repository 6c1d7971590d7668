// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/synthetic_world.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace groundglass {

// Draws that follow one another from one seed.
class Draws {
 public:
  explicit Draws(uint64_t seed) : seed_(seed) {}
  double Uniform(double low, double high) { return low + (high - low) * UniformOf(Next()); }
  double Normal() { return NormalOf(Next()); }
  double Angle() { return Uniform(0, 2 * std::numbers::pi); }
  bool Chance(double share) { return Uniform(0, 1) < share; }
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

// A thing's looks and its code in masks_occ.
struct Finish {
  Material material = Material::kPlain;
  Rgb color = Rgb(0.5f, 0.5f, 0.5f);
  std::string name;
  int mask_code = 0;
};

// An oval: `center` + cos(angle) across + sin(angle) other.
struct Ring {
  Eigen::Vector3d center, across, other;
};
// A skin over rings that follow one another from base to top, counterclockwise seen from the top;
// open at its ends. Rings of no width close it.
void AddLoft(WorldBuilder& builder,
             const std::vector<Ring>& rings,
             int num_sides,
             const Finish& finish);

// An egg about a centre with its three half axes.
void AddEgg(WorldBuilder& builder,
            const Eigen::Vector3d& center,
            const Eigen::Vector3d& ahead,
            const Eigen::Vector3d& aside,
            const Eigen::Vector3d& up,
            int num_sides,
            const Finish& finish);

// Things that stand at a place of the plaza, or on their feet wherever the ground is, in `world`,
// feet. Whatever is not said is drawn from the seed.
void AddTree(WorldBuilder& builder, const Eigen::Vector2d& place, uint64_t seed);
void AddLamp(WorldBuilder& builder, const Eigen::Vector2d& place);
// A board that faces `toward`; each number has its own words.
void AddSign(WorldBuilder& builder,
             const Eigen::Vector2d& place,
             const Eigen::Vector2d& toward,
             int number);
void AddCar(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed);
void AddPerson(WorldBuilder& builder, const Eigen::Vector3d& foot, uint64_t seed);

}  // namespace groundglass
