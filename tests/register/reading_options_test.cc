// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(ReadingOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [doubt,
                                beyond,
                                factor,
                                share,
                                shared,
                                slips,
                                slips_in_all,
                                slip,
                                num,
                                grid,
                                climbs,
                                least_wider,
                                least_slip,
                                lead] = ReadingOptions();
  ExpectCheckNamesEach<ReadingOptions>({
      {"doubt_below_nats_per_observation",
       [](auto& o) { o.doubt_below_nats_per_observation = -1; }},
      {"doubt_beyond_sigmas", [](auto& o) { o.doubt_beyond_sigmas = 0; }},
      {"wider_factor", [](auto& o) { o.wider_factor = 0.9; }},
      {"wider_share", [](auto& o) { o.wider_share = 0; }},
      {"num_shared", [](auto& o) { o.num_shared = -1; }},
      {"slips_below_nats_per_observation",
       [](auto& o) { o.slips_below_nats_per_observation = -1; }},
      {"slips_below_nats", [](auto& o) { o.slips_below_nats = -1; }},
      {"slip_share", [](auto& o) { o.slip_share = 2; }},
      {"num_slips", [](auto& o) { o.num_slips = -1; }},
      {"glance_grid_points", [](auto& o) { o.glance_grid_points = 0; }},
      {"glance_climbs", [](auto& o) { o.glance_climbs = 0; }},
      {"min_wider_nats", [](auto& o) { o.min_wider_nats = -1; }},
      {"min_slip_nats", [](auto& o) { o.min_slip_nats = -1; }},
      {"min_slip_lead_nats", [](auto& o) { o.min_slip_lead_nats = -1; }},
  });
}

TEST(OverclaimOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [least, most, photographs, least_of_set, photographs_of_set] =
      OverclaimOptions();
  ExpectCheckNamesEach<OverclaimOptions>({
      {"least_overclaim", [](auto& o) { o.least_overclaim = 0.5; }},
      {"most_overclaim", [](auto& o) { o.most_overclaim = 0; }},
      {"least_photographs", [](auto& o) { o.least_photographs = 0; }},
      {"least_overclaim_of_set", [](auto& o) { o.least_overclaim_of_set = 0; }},
      {"least_photographs_of_set", [](auto& o) { o.least_photographs_of_set = 0; }},
  });
}

TEST(DisplacedGroupOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [profile,
                                offset,
                                suspicion,
                                photographs,
                                trials,
                                most,
                                least,
                                gain,
                                doubtful] = DisplacedGroupOptions();
  ExpectCheckNamesEach<DisplacedGroupOptions>({
      {"profile.step_sigmas", [](auto& o) { o.profile.step_sigmas = 0; }},
      {"least_offset_sigmas", [](auto& o) { o.least_offset_sigmas = -1; }},
      {"least_suspicion_nats", [](auto& o) { o.least_suspicion_nats = -1; }},
      {"least_photographs", [](auto& o) { o.least_photographs = 0; }},
      {"most_trials", [](auto& o) { o.most_trials = -1; }},
      {"most_nats_of_photograph", [](auto& o) { o.most_nats_of_photograph = 0; }},
      {"least_nats_of_photograph", [](auto& o) { o.least_nats_of_photograph = -1; }},
      {"least_gain_nats", [](auto& o) { o.least_gain_nats = -1; }},
      {"doubtful_nats", [](auto& o) { o.doubtful_nats = 0; }},
  });
}

TEST(GroupProfileOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [least, most, sets, reach, step, least_px, most_px] =
      GroupProfileOptions();
  ExpectCheckNamesEach<GroupProfileOptions>({
      {"least_share", [](auto& o) { o.least_share = -1; }},
      {"most_share", [](auto& o) { o.most_share = 2; }},
      {"reach_sigmas", [](auto& o) { o.reach_sigmas = 0; }},
      {"step_sigmas", [](auto& o) { o.step_sigmas = 0; }},
      {"most_sets", [](auto& o) { o.most_sets = 0; }},
      {"least_spare_px", [](auto& o) { o.least_spare_px = -1; }},
      {"most_spare_px", [](auto& o) { o.most_spare_px = 1; }},
  });
}

}  // namespace
}  // namespace groundglass
