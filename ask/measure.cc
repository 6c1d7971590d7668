// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/measure.h"

#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// value: of what is measured; gradients: its derivative by each place.
Measure WithDeviation(double value,
                      const std::vector<const Place*>& places,
                      const std::vector<Eigen::Vector3d>& gradients) {
  struct Share {
    Eigen::VectorXd gradient;
    Eigen::MatrixXd covariance;
  };
  std::map<std::pair<ErrorKind, int>, Share> shares;
  for (size_t i = 0; i < places.size(); ++i) {
    for (const ErrorSource& source : places[i]->sources) {
      const Eigen::VectorXd gradient = source.derivative.transpose() * gradients[i];
      Share& share = shares[{source.kind, source.index}];
      if (share.gradient.size() == 0) {
        share = {gradient, source.covariance};
      } else {
        share.gradient += gradient;
      }
    }
  }
  std::map<ErrorKind, double> variances;
  for (const auto& [source, share] : shares) {
    variances[source.first] += share.gradient.dot(share.covariance * share.gradient);
  }
  Measure measure;
  measure.value = value;
  measure.camera_sigma = std::sqrt(variances[ErrorKind::kCamera]);
  measure.pixel_sigma = std::sqrt(variances[ErrorKind::kPixel]);
  measure.model_sigma = std::sqrt(variances[ErrorKind::kModel]);
  measure.sigma = std::sqrt(variances[ErrorKind::kCamera] + variances[ErrorKind::kPixel] +
                            variances[ErrorKind::kModel]);
  return measure;
}

}  // namespace

Measure MeasureDistance(const Place& from, const Place& to) {
  const Eigen::Vector3d along = to.point_in_world - from.point_in_world;
  const double length = along.norm();
  // Two points at one place have no direction; any will do, since none is likelier.
  const Eigen::Vector3d unit =
      length > 0 ? Eigen::Vector3d(along / length) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  return WithDeviation(length, {&from, &to}, {-unit, unit});
}

Measure MeasureArea(const Place& a, const Place& b, const Place& c) {
  const Eigen::Vector3d doubled =
      (b.point_in_world - a.point_in_world).cross(c.point_in_world - a.point_in_world);
  const double area = doubled.norm() / 2;
  const Eigen::Vector3d half_normal =
      area > 0 ? Eigen::Vector3d(doubled / (4 * area)) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  // d |doubled| / 2 by a corner is the opposite side turned by a quarter in the plane, halved.
  return WithDeviation(area,
                       {&a, &b, &c},
                       {(b.point_in_world - c.point_in_world).cross(half_normal),
                        (c.point_in_world - a.point_in_world).cross(half_normal),
                        (a.point_in_world - b.point_in_world).cross(half_normal)});
}

}  // namespace groundglass
