// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/register/photographs_of_house.h"

#include <string>

namespace groundglass {
namespace {

ViewTag TagAt(double x, double y, double z, double i, double j, double k) {
  ViewTag tag;
  tag.position_in_site = {x, y, z};
  tag.lookat_in_site = {i, j, k};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return tag;
}

}  // namespace

std::vector<ViewTag> TrueTagsOfHouse() {
  return {TagAt(-20, 55, 6, 18, -6, 9),
          TagAt(8, 62, 5, 20, -8, 9),
          TagAt(38, 60, 7, 20, -8, 10),
          TagAt(66, 45, 6, 24, -6, 9)};
}

std::vector<ViewTag> MeasuredTagsOfHouse() {
  std::vector<ViewTag> tags = TrueTagsOfHouse();
  const Eigen::Vector3d errors[] = {
      {0.3, -0.2, 0.1}, {-0.25, 0.3, -0.1}, {0.2, 0.25, 0.05}, {-0.3, -0.1, 0.1}};
  for (size_t i = 0; i < tags.size(); ++i) {
    tags[i].position_in_site += errors[i];
    tags[i].lookat_in_site -= errors[3 - i];
  }
  return tags;
}

std::vector<PhotographAlignment> AlignPhotographsOfHouse(const PolygonModel& built,
                                                         const EdgeModel& edge_model) {
  std::vector<PhotographAlignment> alignments;
  const std::vector<ViewTag> truth = TrueTagsOfHouse();
  const std::vector<ViewTag> measured = MeasuredTagsOfHouse();
  for (size_t i = 0; i < truth.size(); ++i) {
    const Image8 photograph =
        PhotographModel(built, CameraFromTag(truth[i], kPhotoWidth, kPhotoHeight), 2, i + 1);
    alignments.push_back(AlignPhotograph(
        {"s" + std::to_string(i + 1), photograph, {}, measured[i], {}}, edge_model, {}));
  }
  return alignments;
}

double MeanVertexErrorOfHousePx(const PolygonModel& model,
                                const std::vector<PhotographAlignment>& alignments) {
  double sum = 0;
  for (size_t i = 0; i < alignments.size(); ++i) {
    sum += VertexErrorPx(model,
                         CameraFromTag(TrueTagsOfHouse()[i], kPhotoWidth, kPhotoHeight),
                         alignments[i].registration.CorrectedCamera());
  }
  return sum / static_cast<double>(alignments.size());
}

PolygonModel WithAHigherShed(PolygonModel model) {
  for (Eigen::Vector3d& point : model.points_in_world) {
    if (point.z() == 8) point.z() += 0.3;
  }
  return model;
}

}  // namespace groundglass
