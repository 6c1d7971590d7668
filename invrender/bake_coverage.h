// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/compose/chart_pixels.h"
#include "invrender/inputs/bake_photograph.h"
#include "invrender/inputs/coverage_options.h"
#include "scene/coverage.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <vector>

namespace groundglass {

// How much of each face a bake covered, and by what: begun with nothing, each chart's added when it
// is composed, ended when all are. Charts that have no face in common may be added side by side.

Coverage StartCoverage(const PolygonModel& model,
                       const std::vector<Chart>& charts,
                       const std::vector<int>& chart_of_face);

// How many texels of each face have their centre in it (or, for slivers, touch it), and how many
// of those are covered.
void CountTexels(const Chart& chart,
                 const ChartTexels& texels,
                 const ChartPixels& pixels,
                 Coverage& coverage);

// Who covered them. Reorders the sources' footprints.
void AddSources(const std::vector<BakePhotograph>& photographs,
                ChartPixels& pixels,
                Coverage& coverage);

// Areas, and where to stand for what is missing.
void FinishCoverage(const PolygonModel& model,
                    const Visibility& visibility,
                    const CoverageOptions& options,
                    Coverage& coverage);

}  // namespace groundglass
