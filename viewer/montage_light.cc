// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/montage_light.h"

#include "scene/check_option.h"
#include "scene/srgb.h"
#include "scene/weighted_quantile.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

double LumaOf(const Eigen::Vector3d& colour) {
  return kLumaWeights[0] * colour[0] + kLumaWeights[1] * colour[1] + kLumaWeights[2] * colour[2];
}

// A face's ratio of what is seen to what is reflected, and how much it counts.
struct Ratio {
  Eigen::Vector3d normal_in_world;
  Eigen::Vector3d value;
  double weight = 0;
};

// The median of each channel.
Eigen::Vector3d MedianRatio(const std::vector<Ratio>& ratios) {
  Eigen::Vector3d median;
  for (int c = 0; c < 3; ++c) {
    std::vector<WeightedValue<double>> values;
    for (const Ratio& ratio : ratios) values.push_back({ratio.value[c], ratio.weight});
    median[c] = WeightedMedian(values, 1.0);
  }
  return median;
}

using Reference = std::optional<Eigen::Vector3d> FaceSighting::*;

std::vector<Ratio> RatiosTo(const std::vector<FaceSighting>& faces, Reference reference) {
  std::vector<Ratio> ratios;
  for (const FaceSighting& face : faces) {
    const std::optional<Eigen::Vector3d>& known = face.*reference;
    // What reflects next to nothing tells next to nothing.
    if (!known || known->minCoeff() < 0.004) continue;
    ratios.push_back({face.normal_in_world,
                      face.seen.cwiseQuotient(*known),
                      static_cast<double>(face.num_pixels)});
  }
  return ratios;
}

// The photograph's cast against the texture, of luma 1; none without a texture.
Eigen::Vector3d CastAgainstTexture(const std::vector<FaceSighting>& faces) {
  const std::vector<Ratio> ratios = RatiosTo(faces, &FaceSighting::on_texture);
  if (ratios.empty()) return Eigen::Vector3d::Ones();
  const Eigen::Vector3d cast = MedianRatio(ratios);
  return cast / LumaOf(cast);
}

// Faces whose colours nobody knows are taken as grey, and for now as white.
std::vector<Ratio> RatiosToWhite(const std::vector<FaceSighting>& faces) {
  const Eigen::Vector3d cast = CastAgainstTexture(faces);
  std::vector<Ratio> ratios;
  for (const FaceSighting& face : faces) {
    ratios.push_back(
        {face.normal_in_world, cast * LumaOf(face.seen), static_cast<double>(face.num_pixels)});
  }
  return ratios;
}

// The material of each face, from 0: those of one colour, the largest face's first.
std::vector<int> FindMaterials(const std::vector<FaceSighting>& faces, double same_material) {
  const auto hue = [](const Eigen::Vector3d& value) {
    return Eigen::Vector2d(std::log(value[0] / value[1]), std::log(value[2] / value[1]));
  };
  std::vector<size_t> order(faces.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return faces[a].num_pixels > faces[b].num_pixels;
  });
  std::vector<Eigen::Vector2d> hues;
  std::vector<int> materials(faces.size());
  for (const size_t i : order) {
    const Eigen::Vector2d own = hue(faces[i].seen);
    const auto found = std::find_if(hues.begin(), hues.end(), [&](const Eigen::Vector2d& other) {
      return (own - other).norm() < same_material;
    });
    materials[i] = static_cast<int>(found - hues.begin());
    if (found == hues.end()) hues.push_back(own);
  }
  return materials;
}

// What light faces reflect in `light`, in which nothing is known to be white yet.
double BrightLevel(const std::vector<Ratio>& ratios, const MontageLight& light, double share) {
  std::vector<WeightedValue<double>> levels;
  for (const Ratio& ratio : ratios) {
    levels.push_back({LumaOf(ratio.value) / LumaOf(light.On(ratio.normal_in_world)), ratio.weight});
  }
  return WeightedQuantile(levels, share, 1.0);
}

// average and direction of MontageLight, as (average, direction), from ratios that the gain has
// been taken out of: seen / gain = average + direction . normal, each weighted as the logarithm of
// what is seen would be, and less the farther it is off (Cauchy).
Eigen::Vector4d FitDirection(const std::vector<Ratio>& ratios,
                             const Eigen::Vector3d& gain,
                             const MontageLightOptions& options) {
  constexpr int kRounds = 20;
  double most = 0;
  for (const Ratio& ratio : ratios) most = std::max(most, ratio.weight);
  const Eigen::Vector4d expected(1, 0, 0, options.expected_from_above);
  Eigen::Vector4d light = expected;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (int k = 1; k < 4; ++k) {
      const double weight = 1 / (options.direction_sigma * options.direction_sigma);
      normal(k, k) += weight;
      right[k] += weight * expected[k] * light[0];
    }
    for (const Ratio& ratio : ratios) {
      Eigen::Vector4d row;
      row << 1, ratio.normal_in_world;
      const double seen = LumaOf(ratio.value) / LumaOf(gain);
      const double scale = options.face_sigma * std::max(row.dot(light), options.least_share);
      const double off = (row.dot(light) - seen) / scale;
      const double weight = std::sqrt(ratio.weight / most) / (1 + off * off) / (scale * scale);
      normal += weight * row * row.transpose();
      right += weight * seen * row;
    }
    light = normal.ldlt().solve(right);
  }
  return light;
}

// Divides what each face shows by what its material reflects, in the light so far: the mean of its
// faces, held to that of all as long as they are few.
std::vector<Ratio> WithoutMaterials(const std::vector<Ratio>& ratios,
                                    const std::vector<int>& materials,
                                    const MontageLight& light,
                                    const MontageLightOptions& options) {
  const int num_materials = *std::max_element(materials.begin(), materials.end()) + 1;
  const double held = std::pow(options.face_sigma / options.material_sigma, 2);
  std::vector<double> sums(num_materials, 0);
  std::vector<double> counts(num_materials, held);
  for (size_t i = 0; i < ratios.size(); ++i) {
    sums[materials[i]] +=
        std::log(LumaOf(ratios[i].value) / LumaOf(light.On(ratios[i].normal_in_world)));
    counts[materials[i]] += 1;
  }
  std::vector<Ratio> without = ratios;
  for (size_t i = 0; i < ratios.size(); ++i) {
    without[i].value /= std::exp(sums[materials[i]] / counts[materials[i]]);
  }
  return without;
}

}  // namespace

void MontageLightOptions::Check() const {
  CheckAtLeast(least_pixels, 1, "montage light options: least_pixels");
  CheckFromTo(border_px, 0, 100, "montage light options: border_px");
  CheckAbove(least_in_design, 0, "montage light options: least_in_design");
  CheckFromTo(darkest_code, 1, 254, "montage light options: darkest_code");
  CheckFromTo(brightest_code, 1, 255, "montage light options: brightest_code");
  CheckFromTo(bright_share, 0, 1, "montage light options: bright_share");
  CheckFromTo(bright_albedo, 0.01, 1, "montage light options: bright_albedo");
  CheckAbove(same_material, 0, "montage light options: same_material");
  CheckAbove(material_sigma, 0, "montage light options: material_sigma");
  CheckAbove(face_sigma, 0, "montage light options: face_sigma");
  CheckFromTo(expected_from_above, -1, 1, "montage light options: expected_from_above");
  CheckAbove(direction_sigma, 0, "montage light options: direction_sigma");
  CheckFromTo(least_share, 0.01, 1, "montage light options: least_share");
}

Eigen::Vector3d MontageLight::On(const Eigen::Vector3d& normal_in_world) const {
  return gain * std::max(average + direction_in_world.dot(normal_in_world), least_share * average);
}

MontageLight FitMontageLight(const std::vector<FaceSighting>& faces,
                             const MontageLightOptions& options) {
  options.Check();
  MontageLight light;
  light.least_share = options.least_share;
  light.direction_in_world.z() = options.expected_from_above;
  std::vector<Ratio> ratios = RatiosTo(faces, &FaceSighting::in_design);
  light.source = LightSource::kDesign;
  if (ratios.empty()) {
    ratios = RatiosToWhite(faces);
    light.source = LightSource::kBuilding;
  }
  light.num_faces = static_cast<int>(ratios.size());
  if (ratios.empty()) {
    light.source = LightSource::kAssumed;
    return light;
  }
  light.gain = MedianRatio(ratios);
  const auto fit = [&](const std::vector<Ratio>& of) {
    const Eigen::Vector4d fitted = FitDirection(of, light.gain, options);
    light.average = fitted[0];
    light.direction_in_world = fitted.tail<3>();
  };
  if (light.source == LightSource::kDesign) {
    fit(ratios);
    return light;
  }
  constexpr int kRounds = 12;
  const std::vector<int> materials = FindMaterials(faces, options.same_material);
  for (int round = 0; round < kRounds; ++round) {
    fit(WithoutMaterials(ratios, materials, light, options));
  }
  light.gain *= BrightLevel(ratios, light, options.bright_share) / options.bright_albedo;
  return light;
}

}  // namespace groundglass
