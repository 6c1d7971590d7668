// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice/advice_parts.h"

#include <functional>
#include <vector>

namespace groundglass {

// A tag as it would be under another reading of it; none: as it is.
using Retag = std::function<ViewTag(const ViewTag&)>;

// How a reading of the scene suits its tags.
struct Suitability {
  double implausible_share = 1;
  double plausible_share = 0;
  double median_lookat_error = 1;
  double front_share = 0;
  // Of the tags that are plausible, how nearly each look-at point is met (1: exactly), summed up
  // and divided by the number of all: a vote for each photograph, which a mistyped tag has lost,
  // without a say against the others'.
  double votes = 0;
};
Suitability FindSuitability(const AdviceContext& context,
                            const std::vector<const Photograph*>& photographs,
                            const OtherReading& model,
                            const Retag& retag);
// A few dozen of them, which tell as much as all.
std::vector<const Photograph*> SomePhotographs(const Scene& scene);

}  // namespace groundglass
