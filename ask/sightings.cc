// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/sightings.h"

#include "register/register.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/ignore_mask.h"
#include "scene/least_norm.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

std::string OneDecimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

// The face of the place that looks most towards the camera: a corner belongs to several.
int FaceTowards(const Survey& survey, const Place& place, const Eigen::Vector3d& camera_in_world) {
  int best_face = -1;
  double best = -2;
  for (const int face : place.faces) {
    const double cosine =
        ComputeFacePlane(survey.model, face)
            .normal_in_world.dot((camera_in_world - place.point_in_world).normalized());
    if (cosine > best) {
      best = cosine;
      best_face = face;
    }
  }
  return best_face;
}

// Larger singular value first.
std::array<double, 2> SingularValues(const Eigen::Matrix2d& matrix) {
  // Of (a b; c d), half the lengths of (a + d, c - b) and (a - d, c + b), added and subtracted.
  const double turned = std::hypot(matrix(0, 0) + matrix(1, 1), matrix(1, 0) - matrix(0, 1)) / 2;
  const double mirrored = std::hypot(matrix(0, 0) - matrix(1, 1), matrix(1, 0) + matrix(0, 1)) / 2;
  return {turned + mirrored, std::abs(turned - mirrored)};
}

void Set(Sighting& sighting, SightingState state, const std::string& reason) {
  sighting.state = state;
  sighting.reason = reason;
}

// Pixels and their deviations, as far as the lens shows the place.
void FillFigures(const SurveyPhotograph& photograph,
                 const Place& place,
                 const Eigen::Vector3d& normal,
                 Sighting& sighting) {
  const auto projected = ParameterProjection(ParametersFromTag(photograph.tag),
                                             TagDistortion(photograph.tag),
                                             photograph.width_px,
                                             photograph.height_px)
                             .Project(place.point_in_world);
  if (!projected) return;
  const Eigen::Matrix<double, 2, 3> image_by_point = -projected->jacobian.leftCols<3>();
  const Eigen::Matrix2d from_camera =
      projected->jacobian * photograph.covariance * projected->jacobian.transpose();
  const Eigen::Matrix2d from_place =
      image_by_point * place.Covariance() * image_by_point.transpose();
  sighting.camera_sigma_px = std::sqrt(SingularValues(from_camera)[0]);
  sighting.place_sigma_px = std::sqrt(SingularValues(from_place)[0]);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  const std::array<double, 2> px_per_unit = SingularValues(image_by_point * axes);
  sighting.pixel_size = {1 / std::max(px_per_unit[1], 1e-12), 1 / std::max(px_per_unit[0], 1e-12)};
}

}  // namespace

std::string_view SightingStateName(SightingState state) {
  switch (state) {
    case SightingState::kShown:
      return "shown";
    case SightingState::kGrazing:
      return "grazing";
    case SightingState::kOutside:
      return "outside";
    case SightingState::kBehind:
      return "behind";
    case SightingState::kBackFace:
      return "back";
    case SightingState::kHidden:
      return "hidden";
    case SightingState::kMasked:
      return "masked";
  }
  return "";
}

void SightingOptions::Check() const {
  CheckFromTo(min_angle_deg, 0, 90, "sighting options: min_angle_deg");
}

bool SurveyMasks::Ignores(int photograph, const Eigen::Vector2d& image_px) {
  const SurveyPhotograph& of = survey_.photographs[photograph];
  if (!of.mask_file) return false;
  auto mask = masks_.find(photograph);
  if (mask == masks_.end()) {
    const ImageSize size = {of.width_px, of.height_px};
    mask = masks_.emplace(photograph, ReadIgnoreMask(*of.mask_file, size)).first;
  }
  const Image8& ignore = mask->second;
  const int x = std::clamp(static_cast<int>(image_px.x()), 0, ignore.width - 1);
  const int y = std::clamp(static_cast<int>(image_px.y()), 0, ignore.height - 1);
  return *ignore.At(x, y) != 0;
}

Sighting FindSighting(const Survey& survey,
                      const Visibility& visibility,
                      const Place& place,
                      int index,
                      SurveyMasks& masks,
                      const SightingOptions& options) {
  const SurveyPhotograph& photograph = survey.photographs[index];
  const Camera camera = photograph.AsCamera();
  const Eigen::Vector3d camera_in_world = camera.PositionInWorld();
  const Eigen::Vector3d to_camera = (camera_in_world - place.point_in_world).normalized();
  Sighting sighting;
  sighting.photograph = index;
  sighting.distance = (camera_in_world - place.point_in_world).norm();
  sighting.image_px = Project(camera, place.point_in_world);
  if (!sighting.image_px) {
    Set(sighting, SightingState::kBehind, "behind the camera, or beyond what its lens shows");
    return sighting;
  }
  const int face = FaceTowards(survey, place, camera_in_world);
  const Eigen::Vector3d normal =
      face < 0 ? to_camera : ComputeFacePlane(survey.model, face).normal_in_world;
  sighting.angle_deg = DegreesFromRadians(std::asin(std::clamp(normal.dot(to_camera), -1.0, 1.0)));
  FillFigures(photograph, place, normal, sighting);
  if (!IsInsideFrame(camera, *sighting.image_px)) {
    Set(sighting, SightingState::kOutside, "outside of the frame");
  } else if (sighting.angle_deg <= 0) {
    Set(sighting, SightingState::kBackFace, "the camera stands behind the face");
  } else if (!visibility.IsClear(
                 camera_in_world, place.point_in_world, visibility.DefaultTolerance())) {
    const auto hit = visibility.FirstHit(camera_in_world, -to_camera);
    Set(sighting,
        SightingState::kHidden,
        hit ? "hidden by " + DescribeFace(survey.model, hit->face) : "hidden");
  } else if (sighting.angle_deg < options.min_angle_deg) {
    Set(sighting,
        SightingState::kGrazing,
        "seen at " + OneDecimal(sighting.angle_deg) + " degrees from the face only");
  } else if (masks.Ignores(index, *sighting.image_px)) {
    Set(sighting, SightingState::kMasked, "its mask says that something else is seen there");
  }
  return sighting;
}

std::vector<Sighting> FindSightings(const Survey& survey,
                                    const Visibility& visibility,
                                    const Place& place,
                                    const SightingOptions& options) {
  options.Check();
  std::vector<Sighting> sightings;
  SurveyMasks masks(survey);
  for (int i = 0; i < static_cast<int>(survey.photographs.size()); ++i) {
    sightings.push_back(FindSighting(survey, visibility, place, i, masks, options));
  }
  std::stable_sort(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    const bool a_shows = a.state == SightingState::kShown;
    const bool b_shows = b.state == SightingState::kShown;
    if (a_shows != b_shows) return a_shows;
    return a_shows && a.pixel_size[0] * a.pixel_size[1] < b.pixel_size[0] * b.pixel_size[1];
  });
  return sightings;
}

std::optional<std::array<double, 2>> TexelSize(const Survey& survey, int face) {
  if (face < 0 || static_cast<size_t>(face) >= survey.textures.size()) return std::nullopt;
  const FaceTexture& texture = survey.textures[face];
  const std::vector<int>& points = survey.model.faces[face].points;
  if (texture.page < 0 || texture.corners_texel.size() != points.size()) return std::nullopt;
  const Eigen::Vector3d normal = ComputeFacePlane(survey.model, face).normal_in_world;
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d up = normal.cross(across);
  const auto num_corners = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd on_face(num_corners, 3);
  Eigen::MatrixXd on_page(num_corners, 2);
  for (Eigen::Index i = 0; i < num_corners; ++i) {
    const Eigen::Vector3d corner =
        survey.model.points_in_world[points[i]] - survey.model.points_in_world[points[0]];
    on_face.row(i) << corner.dot(across), corner.dot(up), 1;
    on_page.row(i) = texture.corners_texel[i].transpose();
  }
  const Eigen::MatrixXd page_from_face = SolveLeastNorm(on_face, on_page);
  const std::array<double, 2> texels_per_unit = SingularValues(page_from_face.topRows(2));
  if (!(texels_per_unit[1] > 0)) return std::nullopt;
  return std::array<double, 2>{1 / texels_per_unit[1], 1 / texels_per_unit[0]};
}

Image8 CropAround(const Image8& srgb8,
                  const Eigen::Vector2d& image_px,
                  int radius_px,
                  int size_px) {
  Image8 crop(size_px, size_px, 3, 128);
  const double px_per_px = 2.0 * radius_px / size_px;
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      const Eigen::Vector2d at =
          image_px + Eigen::Vector2d(x + 0.5 - size_px / 2.0, y + 0.5 - size_px / 2.0) * px_per_px;
      const int column = static_cast<int>(std::floor(at.x()));
      const int row = static_cast<int>(std::floor(at.y()));
      const bool is_inside = column >= 0 && row >= 0 && column < srgb8.width && row < srgb8.height;
      if (is_inside) std::copy_n(srgb8.At(column, row), 3, crop.At(x, y));
      // A cross with its middle left free, yellow in a dark halo.
      const int from_middle = std::max(std::abs(x - size_px / 2), std::abs(y - size_px / 2));
      const int beside = std::min(std::abs(x - size_px / 2), std::abs(y - size_px / 2));
      if (from_middle < size_px / 16 || from_middle > size_px / 5 || beside > 2) continue;
      const std::array<uint8_t, 3> yellow = {240, 228, 66};
      for (int c = 0; c < 3; ++c) crop.At(x, y)[c] = beside <= size_px / 160 ? yellow[c] : 20;
    }
  }
  return crop;
}

}  // namespace groundglass
