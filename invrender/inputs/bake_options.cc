// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/inputs/bake_options.h"

#include "scene/check_option.h"
#include "scene/error.h"

namespace groundglass {

void BlockOptions::Check(const std::string& path) const {
  CheckFromTo(black, 1e-6, 0.5, path + "black");
  CheckFromTo(burnt, 0.5, 1, path + "burnt");
  CheckAtLeast(clear_px, 0, path + "clear_px");
}

void SharpnessOptions::Check(const std::string& path) const {
  CheckFromTo(alike, 0, 1, path + "alike");
  CheckAbove(ordinary_blur_px2, 0, path + "ordinary_blur_px2");
  CheckAbove(ordinary_weight, 0, path + "ordinary_weight");
  CheckAtLeast(least_blur_px2, 0, path + "least_blur_px2");
  CheckAtLeast(doubtful, 1, path + "doubtful");
  CheckAbove(certain, doubtful, path + "certain");
  CheckAbove(detail_floor, 0, path + "detail_floor");
}

void GrainOptions::Check(const std::string& path) const {
  CheckFromTo(grain_agreement, -1, 1, path + "grain_agreement");
  CheckAbove(detail_agreement, grain_agreement, path + "detail_agreement");
  CheckFromTo(calm_one_in, 1, 1000, path + "calm_one_in");
  CheckAbove(few_patches, 0, path + "few_patches");
  CheckFromTo(fewest_patches, 1, 1e6, path + "fewest_patches");
  CheckFromTo(calm_quantile, 0, 0.999, path + "calm_quantile");
  CheckAbove(prior_patches, 0, path + "prior_patches");
  CheckFromTo(dark, 0.001, 1, path + "dark");
  CheckFromTo(vignetting_at, 0, 1, path + "vignetting_at");
}

void ColourOptions::Check(const std::string& path) const {
  CheckAbove(even_light, 0, path + "even_light");
  CheckFromTo(fewest_shared, 1, 1e6, path + "fewest_shared");
  CheckFromTo(enough_for_pairs, 1, 1e9, path + "enough_for_pairs");
  CheckFromTo(enough_of_pair, 1, 1e9, path + "enough_of_pair");
  CheckFromTo(most_shared, 1, 2e9, path + "most_shared");
  CheckAbove(vignetting_scale, 0, path + "vignetting_scale");
  CheckFromTo(vignetting_rounds, 1, 100, path + "vignetting_rounds");
  CheckAbove(vignetting_prior, 0, path + "vignetting_prior");
  CheckAtLeast(many_blocks, 0, path + "many_blocks");
  for (const double scale : gain_scales) CheckAbove(scale, 0, path + "gain_scales");
  CheckAbove(gain_prior, 0, path + "gain_prior");
  CheckFromTo(light_rounds, 0, 100, path + "light_rounds");
  CheckAtLeast(few_blocks, 0, path + "few_blocks");
  CheckFromTo(enough_for_light, 1, 1e9, path + "enough_for_light");
  CheckAbove(most_uneven, 0, path + "most_uneven");
}

void HistogramOptions::Check(const std::string& path) const {
  CheckFromTo(bins_per_unit, 0.5, 64, path + "bins_per_unit");
  CheckAbove(fewest_counts, 0, path + "fewest_counts");
  CheckFromTo(ordinary_share, 1e-6, 1, path + "ordinary_share");
  CheckFromTo(unseen_share, 1e-12, 1, path + "unseen_share");
  CheckAtLeast(max_negative_log_likelihood, 0, path + "max_negative_log_likelihood");
}

void ConsistencyOptions::Check(const std::string& path) const {
  CheckAbove(ordinary_difference, 0, path + "ordinary_difference");
  CheckAbove(max_inconsistency, 0, path + "max_inconsistency");
  CheckAbove(agreeing, 0, path + "agreeing");
  CheckAtLeast(histogram_weight, 0, path + "histogram_weight");
  CheckAtLeast(blur_weight, 0, path + "blur_weight");
  CheckAbove(vote_unevenness, 0, path + "vote_unevenness");
  CheckAtLeast(even_light_preference, 0, path + "even_light_preference");
  CheckFromTo(cost_radius, 0, 100, path + "cost_radius");
  CheckFromTo(inconsistency_radius, 0, 100, path + "inconsistency_radius");
  CheckFromTo(consensus_radius, 0, 100, path + "consensus_radius");
  CheckFromTo(majority, 0, 1, path + "majority");
  CheckFromTo(fewest_to_compare, 2, 1000, path + "fewest_to_compare");
  CheckFromTo(disputed_weight, 0, 1, path + "disputed_weight");
  histogram.Check(path + "histogram.");
}

void SeamOptions::Check(const std::string& path) const {
  CheckAbove(max_data_cost, 0, path + "max_data_cost");
  CheckAtLeast(seam_cost, 0, path + "seam_cost");
  CheckAtLeast(difference_cost, 0, path + "difference_cost");
  CheckAbove(max_difference, 0, path + "max_difference");
}

void BlendOptions::Check(const std::string& path) const {
  CheckAtLeast(clear_px, 0, path + "clear_px");
  CheckFromTo(ramp_start_px, -20, 20, path + "ramp_start_px");
  CheckAbove(ramp_px, 0, path + "ramp_px");
  CheckFromTo(least_border_weight, 1e-9, 1, path + "least_border_weight");
  CheckFromTo(enough_chosen, 0, 1, path + "enough_chosen");
  CheckAbove(others_weight, 0, path + "others_weight");
  CheckAbove(least_consistency, 0, path + "least_consistency");
  CheckFromTo(negligible, 0, 1, path + "negligible");
  CheckFromTo(good_weight, 0, 1, path + "good_weight");
  CheckAtLeast(reach_beyond_px, 0, path + "reach_beyond_px");
  CheckFromTo(farthest_reach, 1, 255, path + "farthest_reach");
}

void DilateOptions::Check(const std::string& path) const {
  CheckFromTo(slit_texels, 1, 255, path + "slit_texels");
}

void FillOptions::Check(const std::string& path) const {
  CheckFromTo(radius_texels, 1, 100, path + "radius_texels");
}

void BakeOptions::Check() const {
  CheckAtLeast(texel_size, 0, "texel_size");
  CheckFromTo(max_page_texels, 64, 32768, "max_page_texels");
  CheckFromTo(gutter_texels, 1, 24, "gutter_texels");
  CheckFromTo(border_margin_px, 0, 20, "border_margin_px");
  CheckFromTo(frame_margin, 0, 0.4, "frame_margin");
  CheckAtLeast(max_memory_mb, 0, "max_memory_mb");
  if (bits != 8 && bits != 16) throw Error("bits must be 8 or 16");
  blocks.Check("blocks.");
  sharpness.Check("sharpness.");
  grain.Check("grain.");
  colour.Check("colour.");
  consistency.Check("consistency.");
  seams.Check("seams.");
  blend.Check("blend.");
  dilate.Check("dilate.");
  fill.Check("fill.");
}

}  // namespace groundglass
