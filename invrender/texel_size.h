// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts.h"
#include "invrender/prepared_photo.h"

#include <vector>

namespace groundglass {

// Points spread over a face, some 28 in each of its triangles.
std::vector<Eigen::Vector3d> SpreadPoints(const PolygonModel& model, int face);

// Gives each chart that some photograph shows the texel size that keeps most of what the best
// photograph of each place resolves; options.texel_size overrules. Charts that no page would hold
// get coarser texels. Charts that no photograph shows keep texel_size 0.
void ChooseTexelSizes(const PolygonModel& model,
                      const std::vector<PreparedPhoto>& photos,
                      const BakeOptions& options,
                      std::vector<Chart>& charts);

}  // namespace groundglass
