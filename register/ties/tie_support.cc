// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/tie_support.h"

#include "register/ties/flat_patch.h"
#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

// Half of what is left of two observations, whitened, after the point between them is placed; the
// prior of its distance from the face included. Nothing where a camera does not see it.
std::optional<double> HalfSquaredRest(const TiePoint& point,
                                      const TieObservation& one,
                                      const TieObservation& other,
                                      const std::vector<TieView>& views,
                                      double relief) {
  Eigen::Matrix<double, 5, 3> by_point;
  Eigen::Matrix<double, 5, 1> rest;
  int row = 0;
  for (const TieObservation* observation : {&one, &other}) {
    const Camera& camera = views[observation->photograph].camera;
    const auto image_px = Project(camera, point.point_in_world);
    const auto image_by_point = ImageByPoint(camera, point.point_in_world);
    if (!image_px || !image_by_point) return std::nullopt;
    rest.segment<2>(row) = observation->root_precision * (*image_px - observation->image_px);
    by_point.middleRows<2>(row) = observation->root_precision * *image_by_point;
    row += 2;
  }
  rest[4] = 0;
  by_point.row(4) = point.normal_in_world.transpose() / relief;
  const Eigen::Matrix3d normal = by_point.transpose() * by_point;
  const Eigen::Vector3d move = normal.ldlt().solve(by_point.transpose() * rest);
  return 0.5 * (rest - by_point * move).squaredNorm();
}

double ShareCounted(int num_matched, const TieSupportOptions& options) {
  return std::min(1.0, static_cast<double>(options.most_matches) / std::max(1, num_matched));
}

}  // namespace

void TieSupportOptions::Check(const std::string& path) const {
  CheckAbove(match_nats, 0, path + "match_nats");
  CheckAtLeast(miss_nats, 0, path + "miss_nats");
  CheckAbove(loss_sigmas, 0, path + "loss_sigmas");
  CheckAbove(relief_sigmas, 0, path + "relief_sigmas");
  CheckFromTo(least_matches_to_join, 1, 1e6, path + "least_matches_to_join");
  CheckFromTo(least_share_to_join, 0, 1, path + "least_share_to_join");
  CheckFromTo(least_agreeing_share_to_join, 0, 1, path + "least_agreeing_share_to_join");
  CheckFromTo(least_share_kept, 0, 1, path + "least_share_kept");
  CheckAtLeast(most_matches, 1, path + "most_matches");
}

double CountedNats(const TieSupport& support, const TieSupportOptions& options) {
  return support.nats * ShareCounted(support.num_matched, options);
}

double CountedLead(const TieSupport& first,
                   const TieSupport& second,
                   const TieSupportOptions& options) {
  return (first.nats - second.nats) *
         ShareCounted(std::max(first.num_matched, second.num_matched), options);
}

bool MayJoin(const TieSupport& support, const TieSupportOptions& options) {
  const bool is_much_found = support.num_matched >= options.least_share_to_join * support.num_tried;
  const bool is_found_in_place =
      support.num_agreeing >= options.least_matches_to_join &&
      support.num_agreeing >= options.least_agreeing_share_to_join * support.num_matched;
  return support.num_matched >= options.least_matches_to_join &&
         (is_much_found || is_found_in_place);
}

TieSupport MeasureTieSupport(int photograph,
                             const TiePoints& ties,
                             const std::vector<TieView>& views,
                             double model_sigma,
                             const TieSupportOptions& options) {
  TieSupport support;
  support.num_tried = ties.counts[photograph].num_tried;
  support.num_matched = ties.counts[photograph].num_matched;
  const double scale = options.loss_sigmas * options.loss_sigmas;
  double match_nats = 0;
  for (const TiePoint& point : ties.points) {
    const auto own = std::find_if(
        point.observations.begin(), point.observations.end(), [&](const TieObservation& seen) {
          return seen.photograph == photograph;
        });
    if (own == point.observations.end()) continue;
    for (const TieObservation& other : point.observations) {
      if (other.photograph == photograph) continue;
      const auto rest =
          HalfSquaredRest(point, *own, other, views, options.relief_sigmas * model_sigma);
      if (!rest) continue;
      const double nats = options.match_nats - 0.5 * scale * std::log1p(2 * *rest / scale);
      support.num_agreeing += nats > 0;
      match_nats += nats;
    }
  }
  support.nats = match_nats - options.miss_nats * (support.num_tried - support.num_matched);
  return support;
}

}  // namespace groundglass
