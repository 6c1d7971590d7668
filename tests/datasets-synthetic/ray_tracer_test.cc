// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/ray_tracer.h"

#include "scene/view_tag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A line fitted to points by least squares: value = offset + slope * at.
struct Line {
  double offset = 0;
  double slope = 0;
};

Line FitLine(const std::vector<double>& at, const std::vector<double>& value) {
  Eigen::MatrixXd system(at.size(), 2);
  Eigen::VectorXd right(at.size());
  for (size_t i = 0; i < at.size(); ++i) {
    system.row(static_cast<Eigen::Index>(i)) << 1, at[i];
    right[static_cast<Eigen::Index>(i)] = value[i];
  }
  const Eigen::Vector2d solution = system.colPivHouseholderQr().solve(right);
  return {solution[0], solution[1]};
}

// How much of each pixel a dark square covers, from brightness alone.
double CoverageAt(const ImageF& picture, int x, int y) {
  const float dark = *picture.At(picture.width / 2, picture.height / 2);
  const float bright = *picture.At(1, 1);
  return (bright - *picture.At(x, y)) / (bright - dark);
}

Daylight EvenSky() {
  Daylight light = MakeOvercast(1);
  light.zenith = light.horizon = Rgb(10, 10, 10);
  light.cloud_cover = 0;
  return light;
}

// A black square against a bright sky: its borders are found in the picture by adding up the
// coverage of rows and columns, and its corners where their lines meet.
TEST(RenderRadiance, PutsCornersWhereTheCameraProjectsThem) {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  const std::vector<Eigen::Vector3d> corners = {
      {-20, 100, -10}, {20, 100, -10}, {20, 100, 18}, {-20, 100, 18}};
  builder.AddPolygon(corners, Material::kPlain, Rgb::Zero(), "square");
  ViewTag tag;
  tag.position_in_site = {11, 3, 1};
  tag.lookat_in_site = {0, -100, 5};
  tag.roll_deg = 3;
  tag.shift_x = 0.013;
  tag.view_angle_deg = 40;
  tag.aspect = 1.25;
  const Camera camera = CameraFromTag(tag, 250, 200);
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, Eigen::Vector3d::Zero(), 1);
  const ImageF picture = RenderRadiance({world, visibility, sky_map, EvenSky()}, camera, 9);

  std::vector<Eigen::Vector2d> projected;
  for (const Eigen::Vector3d& corner : corners) projected.push_back(*Project(camera, corner));
  const double low_y = std::max(projected[2].y(), projected[3].y()) + 4;
  const double high_y = std::min(projected[0].y(), projected[1].y()) - 4;
  const double low_x = std::max(projected[0].x(), projected[3].x()) + 4;
  const double high_x = std::min(projected[1].x(), projected[2].x()) - 4;
  const int middle_x = static_cast<int>((low_x + high_x) / 2);
  const int middle_y = static_cast<int>((low_y + high_y) / 2);

  std::vector<double> rows, left, right, columns, top, bottom;
  for (int y = static_cast<int>(low_y); y < static_cast<int>(high_y); ++y) {
    double to_left = 0;
    double to_right = 0;
    for (int x = 0; x < picture.width; ++x) {
      (x < middle_x ? to_left : to_right) += CoverageAt(picture, x, y);
    }
    rows.push_back(y + 0.5);
    left.push_back(middle_x - to_left);
    right.push_back(middle_x + to_right);
  }
  for (int x = static_cast<int>(low_x); x < static_cast<int>(high_x); ++x) {
    double up = 0;
    double down = 0;
    for (int y = 0; y < picture.height; ++y) {
      (y < middle_y ? up : down) += CoverageAt(picture, x, y);
    }
    columns.push_back(x + 0.5);
    top.push_back(middle_y - up);
    bottom.push_back(middle_y + down);
  }
  const auto meet = [](const Line& x_of_y, const Line& y_of_x) -> Eigen::Vector2d {
    const double y =
        (y_of_x.offset + y_of_x.slope * x_of_y.offset) / (1 - y_of_x.slope * x_of_y.slope);
    return {x_of_y.offset + x_of_y.slope * y, y};
  };
  const Line left_line = FitLine(rows, left);
  const Line right_line = FitLine(rows, right);
  const Line top_line = FitLine(columns, top);
  const Line bottom_line = FitLine(columns, bottom);
  EXPECT_LT((meet(left_line, bottom_line) - projected[0]).norm(), 0.1);
  EXPECT_LT((meet(right_line, bottom_line) - projected[1]).norm(), 0.1);
  EXPECT_LT((meet(right_line, top_line) - projected[2]).norm(), 0.1);
  EXPECT_LT((meet(left_line, top_line) - projected[3]).norm(), 0.1);
}

// A wall 10 ft high throws a shadow 10 ft long when the sun stands 45 degrees high behind it.
TEST(RenderRadiance, ShadowsAreAsLongAsTheSunSays) {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  builder.AddPolygon({{-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}},
                     Material::kPlain,
                     Rgb(0.5f, 0.5f, 0.5f),
                     "ground");
  builder.AddPolygon({{-50, 0, 0}, {50, 0, 0}, {50, 0, 10}, {-50, 0, 10}},
                     Material::kPlain,
                     Rgb(0.5f, 0.5f, 0.5f),
                     "wall");
  // Looked at from above, a little off the vertical that a tag cannot have.
  ViewTag tag;
  tag.position_in_site = {0, -10, 60};
  tag.lookat_in_site = {0, -10.01, 0};
  tag.view_angle_deg = 60;
  const Camera camera = CameraFromTag(tag, 300, 200);
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, Eigen::Vector3d::Zero(), 1);
  const Daylight sun_in_the_south = MakeSunny(180, 45, 3);
  const ImageF picture = RenderRadiance({world, visibility, sky_map, sun_in_the_south}, camera, 9);
  const auto brightness = [&](double north) {
    const Eigen::Vector2d at = *Project(camera, {2, north, 0});
    return *picture.At(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  EXPECT_LT(brightness(9.5), 0.6 * brightness(10.5));
  EXPECT_NEAR(brightness(10.7), brightness(20), 0.1 * brightness(20));
}

}  // namespace
}  // namespace groundglass
