// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/align_photograph.h"
#include "register/joint/joint_refinement.h"
#include "tests/register/house.h"

#include <Eigen/Dense>
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

// The common solution of many photographs: a street of houses, twelve photographs around each, of
// 300 x 200 pixels, each with 100 tie points, one lens for all. What grows with the number of
// photographs is to be seen in the ratios between the lines. All threads' CPU time counts.

namespace groundglass {
namespace {

constexpr int kPhotographsOfHouse = 12;
constexpr int kTiesOfPhotograph = 100;
constexpr double kHouseDistance = 200;

struct Street {
  PolygonModel model;
  std::unique_ptr<EdgeModel> edge_model;
  std::vector<AlignedPhotograph> photographs;
  std::vector<TiePoint> ties;
};

PolygonModel MakeStreet(int num_houses) {
  PolygonModel street;
  for (int house = 0; house < num_houses; ++house) {
    const PolygonModel one = MakeHouse();
    const auto first = static_cast<int>(street.points_in_world.size());
    for (const Eigen::Vector3d& point : one.points_in_world) {
      street.points_in_world.push_back(point + Eigen::Vector3d(kHouseDistance * house, 0, 0));
    }
    for (Face face : one.faces) {
      for (int& point : face.points) point += first;
      street.faces.push_back(std::move(face));
    }
  }
  return street;
}

// Around a house, looking at its middle; `site` counts y southwards.
ViewTag TrueTag(int photograph) {
  const int house = photograph / kPhotographsOfHouse;
  const double turn = 2 * M_PI * (photograph % kPhotographsOfHouse + 0.3) / kPhotographsOfHouse;
  const Eigen::Vector3d middle(20 + kHouseDistance * house, -8, 9);
  ViewTag tag;
  tag.position_in_site = middle + Eigen::Vector3d(58 * std::cos(turn), 58 * std::sin(turn), -3);
  tag.lookat_in_site = middle;
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return tag;
}

// Places on the walls, each seen by the photographs that face it, to a fifth of a pixel.
void AddTies(int house, int num_photographs, Street& street) {
  std::mt19937 random(static_cast<unsigned>(house));
  std::uniform_real_distribution<double> along(0, 1);
  std::normal_distribution<double> error_px(0, 0.2);
  std::vector<int> counts(kPhotographsOfHouse, 0);
  for (int tried = 0; tried < 100 * kTiesOfPhotograph; ++tried) {
    const bool is_south = tried % 2 == 0;
    TiePoint tie;
    tie.face = house * static_cast<int>(MakeHouse().faces.size()) + (is_south ? 0 : 1);
    tie.normal_in_world = {0, is_south ? -1.0 : 1.0, 0};
    tie.point_in_world = {
        kHouseDistance * house + 40 * along(random), is_south ? 0.0 : 20.0, 8 + 8 * along(random)};
    for (int i = 0; i < kPhotographsOfHouse; ++i) {
      const int number = house * kPhotographsOfHouse + i;
      if (number >= num_photographs || counts[i] >= kTiesOfPhotograph) continue;
      const Camera camera = CameraFromTag(TrueTag(number), kSmallWidth, kSmallHeight);
      const Eigen::Vector3d to_camera = camera.PositionInWorld() - tie.point_in_world;
      if (to_camera.normalized().dot(tie.normal_in_world) < 0.3) continue;
      const auto at = Project(camera, tie.point_in_world);
      if (!at || at->x() < 0 || at->y() < 0 || at->x() > kSmallWidth || at->y() > kSmallHeight) {
        continue;
      }
      tie.observations.push_back({number,
                                  *at + Eigen::Vector2d(error_px(random), error_px(random)),
                                  5 * Eigen::Matrix2d::Identity()});
    }
    if (tie.observations.size() < 2) continue;
    for (const TieObservation& seen : tie.observations) {
      ++counts[seen.photograph % kPhotographsOfHouse];
    }
    street.ties.push_back(std::move(tie));
  }
}

const Street& StreetOf(int num_photographs) {
  static std::map<int, Street> streets;
  Street& street = streets[num_photographs];
  if (street.edge_model) return street;
  const int num_houses = (num_photographs + kPhotographsOfHouse - 1) / kPhotographsOfHouse;
  street.model = MakeStreet(num_houses);
  street.edge_model = std::make_unique<EdgeModel>(street.model);
  std::vector<PhotographAlignment> aligned(static_cast<size_t>(num_photographs));
  tbb::parallel_for(0, num_photographs, [&](int i) {
    ViewTag tag = TrueTag(i);
    const Camera camera = CameraFromTag(tag, kSmallWidth, kSmallHeight);
    const Image8 photograph = PhotographModel(street.model, camera, 2, static_cast<uint64_t>(i));
    std::mt19937 random(static_cast<unsigned>(i));
    std::normal_distribution<double> error(0, 0.2);
    for (double& number : tag.position_in_site) number += error(random);
    for (double& number : tag.lookat_in_site) number += error(random);
    aligned[i] =
        AlignPhotograph({"s" + std::to_string(i), photograph, {}, tag, {}}, *street.edge_model, {});
  });
  for (PhotographAlignment& each : aligned) street.photographs.push_back(std::move(each.aligned));
  for (int house = 0; house < num_houses; ++house) AddTies(house, num_photographs, street);
  return street;
}

void BM_RefineTogether(benchmark::State& state) {
  const Street& street = StreetOf(static_cast<int>(state.range(0)));
  const std::vector<int> lenses(street.photographs.size(), 0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RefineTogether(*street.edge_model, street.photographs, lenses, street.ties, {}));
  }
  state.counters["matched"] = static_cast<double>(std::count_if(
      street.photographs.begin(), street.photographs.end(), [](const AlignedPhotograph& each) {
        return !each.found.empty();
      }));
  state.counters["ties"] = static_cast<double>(street.ties.size());
}
BENCHMARK(BM_RefineTogether)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Arg(12)
    ->Arg(48)
    ->Arg(192)
    ->Arg(1000);

}  // namespace
}  // namespace groundglass

BENCHMARK_MAIN();
