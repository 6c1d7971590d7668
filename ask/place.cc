// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/place.h"

#include "register/register.h"
#include "scene/building_bounds.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// The point of a triangle that is nearest: above its inside, or on one of its sides.
Eigen::Vector3d NearestOnTriangle(const std::array<Eigen::Vector3d, 3>& corners,
                                  const Eigen::Vector3d& point) {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  Eigen::Vector3d nearest = corners[0];
  double nearest_distance = (point - nearest).norm();
  bool is_inside = normal.squaredNorm() > 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& start = corners[i];
    const Eigen::Vector3d along = corners[(i + 1) % 3] - start;
    if (normal.cross(along).dot(point - start) < 0) is_inside = false;
    const double share =
        std::clamp((point - start).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
    const Eigen::Vector3d on_side = start + share * along;
    if ((point - on_side).norm() < nearest_distance) {
      nearest = on_side;
      nearest_distance = (point - nearest).norm();
    }
  }
  if (!is_inside) return nearest;
  return point - normal * (normal.dot(point - corners[0]) / normal.squaredNorm());
}

double DistanceFromFace(const PolygonModel& model, int face, const Eigen::Vector3d& point) {
  double distance = 1e300;
  for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
    const Eigen::Vector3d nearest = NearestOnTriangle({model.points_in_world[triangle[0]],
                                                       model.points_in_world[triangle[1]],
                                                       model.points_in_world[triangle[2]]},
                                                      point);
    distance = std::min(distance, (point - nearest).norm());
  }
  return distance;
}

void FindFaces(const PolygonModel& model, double tolerance, Place& place) {
  std::vector<std::pair<double, int>> near;
  place.distance_off_model = 1e300;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const double distance = DistanceFromFace(model, face, place.point_in_world);
    if (distance < place.distance_off_model) {
      place.distance_off_model = distance;
      place.nearest_face = face;
    }
    if (distance <= tolerance) near.push_back({distance, face});
  }
  std::sort(near.begin(), near.end());
  for (const auto& [distance, face] : near) place.faces.push_back(face);
}

double OnFaceTolerance(const PolygonModel& model, const PickOptions& options) {
  return options.on_face_share * ComputeBuildingBounds(model).Diagonal();
}

// Two directions in a plane, at right angles and of unit length.
Eigen::Matrix<double, 3, 2> PlaneAxes(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

std::string At(const Survey& survey, int photograph, const Eigen::Vector2d& image_px) {
  return survey.photographs[photograph].name + " at " + FormatNumber(image_px.x()) + "," +
         FormatNumber(image_px.y());
}

}  // namespace

void PickOptions::Check() const {
  CheckAbove(pointing_sigma_px, 0, "place options: pointing_sigma_px");
  CheckFromTo(on_face_share, 0, 0.1, "place options: on_face_share");
}

Eigen::Matrix3d Place::Covariance() const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ErrorSource& source : sources) {
    sum += source.derivative * source.covariance * source.derivative.transpose();
  }
  return sum;
}

Eigen::Matrix3d Place::Covariance(ErrorKind kind) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ErrorSource& source : sources) {
    if (source.kind != kind) continue;
    sum += source.derivative * source.covariance * source.derivative.transpose();
  }
  return sum;
}

Place PlaceInPhotograph(const Survey& survey,
                        const Visibility& visibility,
                        int photograph,
                        const Eigen::Vector2d& image_px,
                        int index,
                        const PickOptions& options) {
  options.Check();
  const SurveyPhotograph& asked = survey.photographs[photograph];
  const Camera camera = asked.AsCamera();
  if (!IsInsideFrame(camera, image_px)) {
    throw Error(At(survey, photograph, image_px) + ": outside of its " +
                std::to_string(asked.width_px) + " x " + std::to_string(asked.height_px) +
                " pixels");
  }
  const Eigen::Vector3d from = camera.PositionInWorld();
  const Eigen::Vector3d direction = UnprojectToWorld(camera, image_px);
  const std::optional<Visibility::Hit> hit = visibility.FirstHit(from, direction);
  if (!hit) throw Error(At(survey, photograph, image_px) + ": shows nothing of the model");
  if (!hit->is_front) {
    throw Error(At(survey, photograph, image_px) + ": meets the back of " +
                DescribeFace(survey.model, hit->face));
  }
  const FacePlane plane = ComputeFacePlane(survey.model, hit->face);
  Place place;
  place.photograph = photograph;
  place.image_px = image_px;
  place.point_in_world = from + direction * ((plane.offset - plane.normal_in_world.dot(from)) /
                                             plane.normal_in_world.dot(direction));
  place.faces = {hit->face};
  place.nearest_face = hit->face;

  const auto projected =
      ParameterProjection(
          ParametersFromTag(asked.tag), TagDistortion(asked.tag), asked.width_px, asked.height_px)
          .Project(place.point_in_world);
  if (!projected) throw Error(At(survey, photograph, image_px) + ": no lens shows this place");
  // The picture depends on where the point is from the camera alone.
  const Eigen::Matrix<double, 2, 3> image_by_point = -projected->jacobian.leftCols<3>();
  const Eigen::Matrix<double, 3, 2> axes = PlaneAxes(plane.normal_in_world);
  const Eigen::Matrix<double, 3, 2> point_by_image = axes * (image_by_point * axes).inverse();
  const double model_sigma = ModelSigma(survey.model);
  place.sources.push_back(
      {ErrorKind::kCamera, photograph, -point_by_image * projected->jacobian, asked.covariance});
  place.sources.push_back(
      {ErrorKind::kPixel,
       index,
       point_by_image,
       Eigen::Matrix2d::Identity() * options.pointing_sigma_px * options.pointing_sigma_px});
  place.sources.push_back(
      {ErrorKind::kModel,
       hit->face,
       plane.normal_in_world - point_by_image * (image_by_point * plane.normal_in_world),
       Eigen::MatrixXd::Constant(1, 1, model_sigma * model_sigma)});
  return place;
}

Place PlaceOnModel(const Survey& survey,
                   const Eigen::Vector3d& point_in_world,
                   int index,
                   const PickOptions& options) {
  options.Check();
  constexpr double kFarthestInModels = 1e4;
  const Box bounds = ComputeBounds(survey.model);
  if (!((point_in_world - bounds.Center()).norm() <= kFarthestInModels * bounds.Diagonal())) {
    const Eigen::Vector3d middle = SiteFromWorld(bounds.Center());
    throw Error("the point is more than " + FormatNumber(kFarthestInModels) +
                " times the model's size away from it; expected the model's own numbers, about " +
                FormatNumber(std::round(middle.x())) + "," + FormatNumber(std::round(middle.y())) +
                "," + FormatNumber(std::round(middle.z())));
  }
  Place place;
  place.point_in_world = point_in_world;
  FindFaces(survey.model, OnFaceTolerance(survey.model, options), place);
  if (!place.faces.empty()) {
    const double model_sigma = ModelSigma(survey.model);
    place.sources.push_back({ErrorKind::kModel,
                             -1 - index,  // faces count from 0
                             Eigen::Matrix3d::Identity(),
                             Eigen::Matrix3d::Identity() * model_sigma * model_sigma});
  }
  return place;
}

}  // namespace groundglass
