// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

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
