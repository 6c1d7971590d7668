// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace groundglass {

// How far the model's edges may lie off what was built, one standard deviation, in the model's
// unit: what the model or an option says (PolygonModel::sigma), else DefaultModelSigma.
double ModelSigma(const PolygonModel& model);

// 0.03 m for a building. Below 15 m across (the bounding box's diagonal) it grows with the power
// 5/4 of the size: 18 mm at 10 m, 1 mm at 1 m; but it is no less than 0.3 mm, or 0.2 % of the size
// if that is less still. A model whose unit nobody says and that would be more than a kilometre
// across is hardly in feet: 0.1 % of its size.
double DefaultModelSigma(const PolygonModel& model);

// So many decimals tell a length of this model to a tenth of what is known of a model of its size:
// 2 of a building in metres or feet, 0 in millimetres, 4 of a maquette in metres.
int LengthDecimals(const PolygonModel& model);

// How large the model is beside a building, for lengths that are measured on the spot: 1 from 15 m
// across, below that in proportion.
double ModelScale(const PolygonModel& model);

// Takes the rest of a comment "sigma: 0.1", a length in the model's unit, which must be known by
// now. Throws Error naming file and line unless it is a length above 0.
void ReadSigmaComment(std::string_view rest,
                      const std::filesystem::path& file,
                      int line,
                      PolygonModel& model);

// "0.0984 ft, by default ('% sigma:' in the model or --sigma-model says another)", for a summary.
std::string DescribeModelSigma(const PolygonModel& model);

}  // namespace groundglass
