// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/model_errors.h"

#include "scene/check_option.h"
#include "scene/face_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace groundglass {
namespace {

struct OffLine {
  int edge = -1;
  ModelError error;
};

std::string NameOfLine(const PolygonModel& model, const ModelEdge& edge) {
  std::string name = NameOfFace(model, edge.first_face);
  if (edge.second_face >= 0) name += " / " + NameOfFace(model, edge.second_face);
  return name;
}

// Whether two edges lie in one plane, or are drawn onto it.
bool ShareAGroup(int first, int second, const EdgeGroups& groups) {
  for (const EdgeGroupPart& part : groups.of_edge[first]) {
    for (const EdgeGroupPart& other : groups.of_edge[second]) {
      if (part.group == other.group) return true;
    }
  }
  return false;
}

// Each line followed by those that are off as one with it.
std::vector<ModelError> GatherLines(std::vector<OffLine>& lines,
                                    const EdgeGroups& groups,
                                    const ModelErrorOptions& options) {
  std::vector<ModelError> gathered;
  std::vector<bool> is_told(lines.size(), false);
  for (size_t i = 0; i < lines.size(); ++i) {
    if (is_told[i]) continue;
    const Eigen::Vector3d offset_in_world = lines[i].error.offset_in_world;
    const double near = options.same_offset_share * offset_in_world.norm();
    gathered.push_back(std::move(lines[i].error));
    for (size_t j = i + 1; j < lines.size(); ++j) {
      ModelError& other = lines[j].error;
      if (is_told[j] || !ShareAGroup(lines[i].edge, lines[j].edge, groups)) continue;
      if ((other.offset_in_world - offset_in_world).norm() >= near) continue;
      is_told[j] = true;
      other.with_the_one_before = true;
      gathered.push_back(std::move(other));
    }
  }
  return gathered;
}

}  // namespace

void ModelErrorOptions::Check(const std::string& path) const {
  CheckFromTo(min_photographs, 1, 1000000, path + "min_photographs");
  CheckAtLeast(min_sigmas, 0, path + "min_sigmas");
  CheckAtLeast(min_offset_sigmas, 0, path + "min_offset_sigmas");
  CheckFromTo(same_offset_share, 0, 1, path + "same_offset_share");
}

std::vector<ModelError> FindModelErrors(const EdgeModel& edge_model,
                                        const std::vector<EdgeDisplacement>& displacements,
                                        const std::vector<std::string>& names,
                                        const ModelErrorOptions& options) {
  const double min_offset = options.min_offset_sigmas * edge_model.sigma;
  std::vector<OffLine> lines;
  for (const EdgeDisplacement& found : displacements) {
    const Eigen::Vector3d offset = (found.start_in_world + found.end_in_world) / 2;
    const double length = offset.norm();
    if (static_cast<int>(found.photographs.size()) < options.min_photographs) continue;
    if (length < min_offset) continue;
    const Eigen::Vector3d direction = offset / length;
    const double sigma = std::sqrt(direction.dot(found.covariance * direction));
    if (length < options.min_sigmas * sigma) continue;
    const ModelEdge& edge = edge_model.edges[found.edge];
    ModelError error{NameOfLine(edge_model.model, edge),
                     edge.start_in_world,
                     edge.end_in_world,
                     offset,
                     sigma,
                     {}};
    for (const int photograph : found.photographs) error.photographs.push_back(names[photograph]);
    lines.push_back({found.edge, std::move(error)});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const OffLine& a, const OffLine& b) {
    return a.error.offset_in_world.squaredNorm() > b.error.offset_in_world.squaredNorm();
  });
  return GatherLines(lines, edge_model.groups, options);
}

}  // namespace groundglass
