// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice_judge.h"

#include "scene/error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace groundglass {

std::vector<double> PictureJudge::Fit(const PolygonModel& model,
                                      const Retag& retag,
                                      double nearness) const {
  const bool is_first = edges_.empty();
  edges_.resize(photographs_.size());
  const Visibility visibility(model);
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  std::vector<double> fits(photographs_.size(), 0.0);
  tbb::parallel_for(size_t{0}, photographs_.size(), [&](size_t i) {
    const Photograph& photograph = *photographs_[i];
    try {
      if (is_first) edges_[i].emplace(ReadGrey8(photograph.image_file));
    } catch (const Error&) {
      // Told by those who read it for its own sake.
    }
    const ViewTag tag = retag ? retag(photograph.tag) : photograph.tag;
    if (!edges_[i] || FindTagFault(tag)) return;
    fits[i] = edges_[i]->Score(model,
                               edges,
                               visibility,
                               CameraFromTag(tag, photograph.size.width, photograph.size.height),
                               nearness);
  });
  return fits;
}

double PictureJudge::Mean(const std::vector<double>& fits) {
  const auto num_known =
      std::count_if(fits.begin(), fits.end(), [](double fit) { return fit > 0; });
  if (num_known == 0) return 0;
  return std::reduce(fits.begin(), fits.end()) / static_cast<double>(num_known);
}

bool PictureJudge::IsClearlyBetter(const std::vector<double>& fits,
                                   const std::vector<double>& others) {
  // Scores of chance differ by less than this, taken over all pictures.
  constexpr double kMeanLead = 1;
  constexpr double kMostPictures = 0.7;
  constexpr int kFewestPictures = 3;
  double sum_of_leads = 0;
  int num_better = 0;
  int total = 0;
  for (size_t i = 0; i < fits.size(); ++i) {
    if (fits[i] == 0 || others[i] == 0) continue;
    const double lead = fits[i] - others[i];
    sum_of_leads += lead;
    num_better += lead > 0 ? 1 : 0;
    ++total;
  }
  return total >= kFewestPictures && num_better >= kMostPictures * total &&
         sum_of_leads > kMeanLead * total;
}

PolygonModel ReadOtherwise(PolygonModel model, const OtherReading& reading) {
  for (Eigen::Vector3d& point : model.points_in_world) {
    point = reading.linear * point + reading.offset;
  }
  const bool is_mirror = reading.linear.determinant() < 0;  // which turns them once
  if (reading.flips_faces == is_mirror) return model;
  for (Face& face : model.faces) std::reverse(face.points.begin(), face.points.end());
  return model;
}

}  // namespace groundglass
