// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"

#include "scene/check_option.h"

namespace groundglass {

void BakeStages::Check(const std::string& path) const {
  const auto check = [&](const auto& stage, const char* name) {
    if (!stage) throw OptionError(path + name, "must be a function");
  };
  check(estimate_colour, "estimate_colour");
  check(measure_sharpness, "measure_sharpness");
  check(measure_consistency, "measure_consistency");
  check(choose_blocks, "choose_blocks");
  check(smooth_seams, "smooth_seams");
  check(smooth_grain, "smooth_grain");
  check(fill_gaps, "fill_gaps");
}

void BakeOptions::Check() const {
  charts.Check("charts.");
  photos.Check("photos.");
  pages.Check("pages.");
  memory.Check("memory.");
  blocks.Check("blocks.");
  patches.Check("patches.");
  sharpness.Check("sharpness.");
  grain.Check("grain.");
  colour.Check("colour.");
  consistency.Check("consistency.");
  seams.Check("seams.");
  blend.Check("blend.");
  dilate.Check("dilate.");
  fill.Check("fill.");
  coverage.Check("coverage.");
  earlier_model.Check("earlier_model.");
  stages.Check("stages.");
}

}  // namespace groundglass
