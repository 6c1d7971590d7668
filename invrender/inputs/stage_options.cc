// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What each stage's options may be.
#include "invrender/inputs/blend_options.h"
#include "invrender/inputs/block_options.h"
#include "invrender/inputs/chart_options.h"
#include "invrender/inputs/colour_options.h"
#include "invrender/inputs/consistency_options.h"
#include "invrender/inputs/coverage_options.h"
#include "invrender/inputs/detail_options.h"
#include "invrender/inputs/fill_options.h"
#include "invrender/inputs/memory_options.h"
#include "invrender/inputs/page_options.h"
#include "invrender/inputs/photo_options.h"
#include "invrender/inputs/sampling_options.h"
#include "invrender/inputs/seam_options.h"
#include "scene/check_option.h"

namespace groundglass {

void ChartOptions::Check(const std::string& path) const {
  CheckFromTo(coplanar_sine, 0, 0.1, path + "coplanar_sine");
  CheckFromTo(coplanar_share, 0, 0.1, path + "coplanar_share");
  CheckFromTo(level_sine, 1e-9, 0.5, path + "level_sine");
}

void PageOptions::Check(const std::string& path) const {
  CheckAtLeast(texel_size, 0, path + "texel_size");
  CheckFromTo(kept_share, 0, 1, path + "kept_share");
  CheckAbove(texel_px, 0, path + "texel_px");
  CheckAtLeast(needless_texels, 1, path + "needless_texels");
  CheckFromTo(max_page_texels, 64, 32768, path + "max_page_texels");
  CheckFromTo(gutter_texels, 1, 24, path + "gutter_texels");
  if (bits != 8 && bits != 16) throw OptionError(path + "bits", "must be 8 or 16");
}

void MountOptions::Check(const std::string& path) const {
  CheckFromTo(dark_code, 0, 256, path + "dark_code");
  CheckFromTo(dark_share, 0, 1, path + "dark_share");
  CheckFromTo(deepest_share, 0, 0.5, path + "deepest_share");
  CheckFromTo(widening_share, 0, 0.1, path + "widening_share");
}

void BorderOptions::Check(const std::string& path) const {
  CheckFromTo(crease_bonus_px, 0, 20, path + "crease_bonus_px");
  CheckAtLeast(crease_depth_share, 0, path + "crease_depth_share");
}

void QualityOptions::Check(const std::string& path) const {
  CheckFromTo(border_clear_px, 0, 20, path + "border_clear_px");
  CheckAbove(border_ramp_px, -border_clear_px, path + "border_ramp_px");
  CheckFromTo(least_at_border, 1e-9, 1, path + "least_at_border");
  CheckFromTo(least_at_frame, 0, 1, path + "least_at_frame");
  CheckFromTo(frame_ramp_share, 1e-9, 1, path + "frame_ramp_share");
}

void EarlierModelOptions::Check(const std::string& path) const {
  CheckFromTo(same_normal_cosine, 0, 1, path + "same_normal_cosine");
}

void PhotoOptions::Check(const std::string& path) const {
  CheckFromTo(border_margin_px, 0, 20, path + "border_margin_px");
  CheckFromTo(frame_margin, 0, 0.4, path + "frame_margin");
  CheckFromTo(step_inside_px, 0, 1, path + "step_inside_px");
  mount.Check(path + "mount.");
  borders.Check(path + "borders.");
  quality.Check(path + "quality.");
}

void MemoryOptions::Check(const std::string& path) const {
  CheckAtLeast(max_memory_mb, 0, path + "max_memory_mb");
  CheckFromTo(photo_share, 0, 1, path + "photo_share");
  CheckAtLeast(few_photos, 1, path + "few_photos");
  CheckFromTo(max_texel_scale, 1, 1000, path + "max_texel_scale");
  CheckFromTo(max_halvings, 0, 8, path + "max_halvings");
  CheckAtLeast(worth_dropping, 1, path + "worth_dropping");
  CheckAtLeast(worth_halving, 1, path + "worth_halving");
  CheckAtLeast(mask_estimate_factor, 1, path + "mask_estimate_factor");
}

void BlockOptions::Check(const std::string& path) const {
  CheckFromTo(black, 1e-6, 0.5, path + "black");
  CheckFromTo(burnt, 0.5, 1, path + "burnt");
  CheckAtLeast(clear_px, 0, path + "clear_px");
}

void PatchOptions::Check(const std::string& path) const {
  CheckFromTo(max_patches, 1, 1e6, path + "max_patches");
  CheckFromTo(max_views, 2, 1000, path + "max_views");
  CheckAtLeast(max_coarseness, 1, path + "max_coarseness");
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

void SamplingOptions::Check(const std::string& path) const {
  CheckFromTo(max_taps, 1, 64, path + "max_taps");
  CheckFromTo(one_tap_px, 1, 2, path + "one_tap_px");
  CheckAtLeast(max_anisotropy, 1, path + "max_anisotropy");
  CheckFromTo(bicubic_taps, 0, 1e6, path + "bicubic_taps");
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
  sampling.Check(path + "sampling.");
}

void DilateOptions::Check(const std::string& path) const {
  CheckFromTo(slit_texels, 1, 255, path + "slit_texels");
}

void FillOptions::Check(const std::string& path) const {
  CheckFromTo(radius_texels, 1, 100, path + "radius_texels");
}

void ViewpointOptions::Check(const std::string& path) const {
  CheckAbove(eye_level_ft, 0, path + "eye_level_ft");
  for (const double turn : turns_deg) CheckFromTo(turn, -90, 90, path + "turns_deg");
  for (const double distance : distances) CheckAbove(distance, 0, path + "distances");
  CheckFromTo(least_cosine, 0, 1, path + "least_cosine");
  CheckFromTo(most_backs, 0, 1, path + "most_backs");
}

void CoverageOptions::Check(const std::string& path) const {
  CheckFromTo(least_missing_share, 0, 1, path + "least_missing_share");
  viewpoint.Check(path + "viewpoint.");
}

}  // namespace groundglass
