// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/model_errors.h"

#include "scene/check_option.h"
#include "scene/face_number.h"

#include <algorithm>

namespace groundglass {
void ModelErrorOptions::Check(const std::string& path) const {
  CheckFromTo(min_photographs, 1, 1000000, path + "min_photographs");
  CheckAtLeast(min_sigmas, 0, path + "min_sigmas");
  CheckAtLeast(min_offset_sigmas, 0, path + "min_offset_sigmas");
}

std::vector<ModelError> FindModelErrors(const EdgeModel& edge_model,
                                        const std::vector<EdgeDisplacement>& displacements,
                                        const ModelErrorOptions& options) {
  const PolygonModel& model = edge_model.model;
  const double min_offset = options.min_offset_sigmas * edge_model.sigma;
  std::vector<ModelError> errors;
  for (const EdgeDisplacement& found : displacements) {
    const Eigen::Vector3d offset = (found.start_in_world + found.end_in_world) / 2;
    const double length = offset.norm();
    if (found.num_photographs < options.min_photographs || length < min_offset) continue;
    const Eigen::Vector3d direction = offset / length;
    const double sigma = std::sqrt(direction.dot(found.covariance * direction));
    if (length < options.min_sigmas * sigma) continue;
    const ModelEdge& edge = edge_model.edges[found.edge];
    std::string name = NameOfFace(model, edge.first_face);
    if (edge.second_face >= 0) name += " / " + NameOfFace(model, edge.second_face);
    errors.push_back(
        {name, edge.start_in_world, edge.end_in_world, offset, sigma, found.num_photographs});
  }
  std::stable_sort(errors.begin(), errors.end(), [](const ModelError& a, const ModelError& b) {
    return a.offset_in_world.squaredNorm() > b.offset_in_world.squaredNorm();
  });
  return errors;
}

}  // namespace groundglass
