// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/inputs/page_options.h"
#include "invrender/photos/prepared_photo.h"

#include <vector>

namespace groundglass {

// Gives each chart that some photograph shows the texel size that keeps most of what the best
// photograph of each place resolves; options.texel_size overrules. Charts that no page would hold
// get coarser texels. Charts that no photograph shows keep texel_size 0.
void ChooseTexelSizes(const PolygonModel& model,
                      const std::vector<PreparedPhoto>& photos,
                      const PageOptions& options,
                      std::vector<Chart>& charts);

}  // namespace groundglass
