// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A camera that was found, and the tag that it was found from.
struct CorrectedTag {
  const CameraPrior* written = nullptr;  // the prior from the tag as it was written
  CameraParameters parameters = CameraParameters::Zero();
  const CameraCovariance* covariance = nullptr;  // of the parameters
};
// How many times larger the errors of tags' positions and directions are than they claim: from the
// median, over the cameras, of the squared change in sigmas for each number that the photograph
// tells. Nothing without a camera.
std::optional<double> MeasureOverclaim(const std::vector<CorrectedTag>& cameras);

// The same for the photographs of a common solution, where it is known better: 1 where the claims
// hold or too few photographs tell.
double OverclaimOfSet(const std::vector<CorrectedTag>& cameras, const OverclaimOptions& options);

// Standard deviations in a notebook are guesses, and whoever guessed too low did so on every page:
// the photographs together tell. How many times larger the errors of positions and directions are
// than the tags claim: from the median, over the photographs that are clearly placed by themselves,
// of the squared change in sigmas for each number that the photograph tells. Nothing where the
// claims hold, or too few photographs tell.
std::optional<double> FindOverclaim(const std::vector<PhotographAlignment>& alignments,
                                    const OverclaimOptions& options);

// For a person.
std::string DescribeOverclaim(double overclaim);

}  // namespace groundglass
