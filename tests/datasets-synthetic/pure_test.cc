// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/synth.h"
#include "evaluate/truth.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/visibility.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Brightness at a point of the image, linear between the pixels' centres.
double BrightnessAt(const ImageF& radiance, const Eigen::Vector2d& at_px) {
  const double x = at_px.x() - 0.5;
  const double y = at_px.y() - 0.5;
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const auto sum = [&](int column, int row) {
    const float* pixel = radiance.At(column, row);
    return static_cast<double>(pixel[0] + pixel[1] + pixel[2]);
  };
  return std::lerp(std::lerp(sum(x0, y0), sum(x0 + 1, y0), x - x0),
                   std::lerp(sum(x0, y0 + 1), sum(x0 + 1, y0 + 1), x - x0),
                   y - y0);
}

// How far from a projected edge, along its normal, the picture has its step from one face to
// another: from brightness alone, by adding up how much of a stretch across it is of the first
// kind. Nothing where there is no clean step between `face` (from 1) and one other.
std::optional<double> StepOffset(const ImageF& radiance,
                                 const Image16& labels,
                                 int face,
                                 const Eigen::Vector2d& at_px,
                                 const Eigen::Vector2d& normal) {
  constexpr double kReach = 3;
  constexpr double kStep = 0.1;
  std::set<int> labels_before, labels_after;
  std::vector<double> profile;
  std::vector<double> before, after;
  for (int i = 0; i <= 60; ++i) {
    const double s = -kReach + kStep * i;
    const Eigen::Vector2d place = at_px + s * normal;
    if (place.x() < 1 || place.y() < 1 || place.x() > radiance.width - 2 ||
        place.y() > radiance.height - 2) {
      return std::nullopt;
    }
    const int label = *labels.At(static_cast<int>(place.x()), static_cast<int>(place.y()));
    if (s < -1.2) labels_before.insert(label);
    if (s > 1.2) labels_after.insert(label);
    profile.push_back(BrightnessAt(radiance, place));
    if (s < -1.7) before.push_back(profile.back());
    if (s > 1.7) after.push_back(profile.back());
  }
  if (labels_before.size() != 1 || labels_after.size() != 1) return std::nullopt;
  if (labels_before == labels_after) return std::nullopt;
  if (!labels_before.contains(face) && !labels_after.contains(face)) return std::nullopt;
  const auto [low_before, high_before] = std::minmax_element(before.begin(), before.end());
  const auto [low_after, high_after] = std::minmax_element(after.begin(), after.end());
  const double from = (*low_before + *high_before) / 2;
  const double to = (*low_after + *high_after) / 2;
  const double unevenness = std::max(*high_before - *low_before, *high_after - *low_after);
  if (std::abs(to - from) < 0.1 || unevenness > 0.03 * std::abs(to - from)) return std::nullopt;
  double first_share = 0;
  for (size_t i = 0; i < profile.size(); ++i) {
    const double weight = i == 0 || i + 1 == profile.size() ? 0.5 : 1;
    first_share += weight * kStep * (to - profile[i]) / (to - from);
  }
  return first_share - kReach;
}

// The whole promise of `pure`: where the true camera projects the model's edges, there the picture
// has them, with nothing beside them that pulls.
TEST(Pure, EdgesLieInThePictureWhereTheTrueCameraProjectsThem) {
  const TemporaryFolder folder;
  SynthRecipe recipe = PresetRecipe("pure");
  recipe.width_px = 480;
  recipe.height_px = 320;
  recipe.num_views = 4;
  recipe.photo.bits = 16;
  recipe.surface_texel = 1;
  WriteSyntheticScene(recipe, folder / "pure");
  const Truth truth = ReadTruth(folder / "pure" / "truth");
  const PolygonModel model = ReadOsu(folder / "pure" / "model.osu").model;
  const Visibility visibility(model);
  int num_steps = 0;
  double sum_squares = 0;
  for (const NamedCamera& view : truth.cameras) {
    const ImageF radiance = ReadRadiance(folder / "pure/images" / (view.name + ".tif"));
    const Image16 labels = ReadLabels(truth.masks_model_folder / (view.name + ".png"));
    int num_here = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (size_t index = 0; index < model.faces.size(); ++index) {
      const Face& face = model.faces[index];
      for (size_t i = 0; i < face.points.size(); ++i) {
        const Eigen::Vector3d& a = model.points_in_world[face.points[i]];
        const Eigen::Vector3d& b = model.points_in_world[face.points[(i + 1) % face.points.size()]];
        for (int part = 1; part < 10; ++part) {
          const Eigen::Vector3d place = a + 0.1 * part * (b - a);
          const auto at_px = Project(view.camera, place);
          const auto next_px = Project(view.camera, place + 1e-3 * (b - a));
          if (!visibility.IsClear(view.camera.PositionInWorld(), place, 0.05)) continue;
          if (!at_px || !next_px || (*next_px - *at_px).norm() < 1e-6) continue;
          const Eigen::Vector2d along = (*next_px - *at_px).normalized();
          const Eigen::Vector2d normal(-along.y(), along.x());
          const auto offset =
              StepOffset(radiance, labels, static_cast<int>(index) + 1, *at_px, normal);
          if (!offset) continue;
          sum_squares += *offset * *offset;
          sum += *offset * normal;
          ++num_here;
        }
      }
    }
    ASSERT_GT(num_here, 50) << view.name;
    num_steps += num_here;
    EXPECT_LT((sum / num_here).norm(), 0.02) << view.name;
  }
  EXPECT_LT(std::sqrt(sum_squares / num_steps), 0.1);
  RecordProperty("rms_px", std::to_string(std::sqrt(sum_squares / num_steps)));
}

}  // namespace
}  // namespace groundglass
