// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, HistogramCheckNamesEachField) {
  [[maybe_unused]] const auto& [bins_per_unit,
                                fewest_counts,
                                ordinary_share,
                                unseen_share,
                                max_negative_log_likelihood] = HistogramOptions();
  ExpectCheckNamesEach<HistogramOptions>({
      {"bins_per_unit", [](auto& o) { o.bins_per_unit = -1; }},
      {"fewest_counts", [](auto& o) { o.fewest_counts = -1; }},
      {"ordinary_share", [](auto& o) { o.ordinary_share = -1; }},
      {"unseen_share", [](auto& o) { o.unseen_share = -1; }},
      {"max_negative_log_likelihood", [](auto& o) { o.max_negative_log_likelihood = -1; }},
  });
}

TEST(InvrenderOptions, ConsistencyCheckNamesEachField) {
  [[maybe_unused]] const auto& [ordinary_difference,
                                max_inconsistency,
                                agreeing,
                                histogram_weight,
                                blur_weight,
                                vote_unevenness,
                                even_light_preference,
                                cost_radius,
                                inconsistency_radius,
                                consensus_radius,
                                majority,
                                fewest_to_compare,
                                disputed_weight,
                                histogram] = ConsistencyOptions();
  ExpectCheckNamesEach<ConsistencyOptions>({
      {"ordinary_difference", [](auto& o) { o.ordinary_difference = -1; }},
      {"max_inconsistency", [](auto& o) { o.max_inconsistency = -1; }},
      {"agreeing", [](auto& o) { o.agreeing = -1; }},
      {"histogram_weight", [](auto& o) { o.histogram_weight = -1; }},
      {"blur_weight", [](auto& o) { o.blur_weight = -1; }},
      {"vote_unevenness", [](auto& o) { o.vote_unevenness = -1; }},
      {"even_light_preference", [](auto& o) { o.even_light_preference = -1; }},
      {"cost_radius", [](auto& o) { o.cost_radius = -1; }},
      {"inconsistency_radius", [](auto& o) { o.inconsistency_radius = -1; }},
      {"consensus_radius", [](auto& o) { o.consensus_radius = -1; }},
      {"majority", [](auto& o) { o.majority = -1; }},
      {"fewest_to_compare", [](auto& o) { o.fewest_to_compare = -1; }},
      {"disputed_weight", [](auto& o) { o.disputed_weight = -1; }},
      {"histogram.fewest_counts", [](auto& o) { o.histogram.fewest_counts = 0; }},
  });
}

TEST(InvrenderOptions, SeamCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_data_cost, seam_cost, difference_cost, max_difference] =
      SeamOptions();
  ExpectCheckNamesEach<SeamOptions>({
      {"max_data_cost", [](auto& o) { o.max_data_cost = -1; }},
      {"seam_cost", [](auto& o) { o.seam_cost = -1; }},
      {"difference_cost", [](auto& o) { o.difference_cost = -1; }},
      {"max_difference", [](auto& o) { o.max_difference = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
