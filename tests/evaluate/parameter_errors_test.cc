// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/parameter_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

constexpr int kYaw = 3;
constexpr int kShiftX = 8;

// Yaw and shift_x are looked for and can hardly be told apart; the rest is held.
PhotographParameters Photograph(double found_shift_x, double sigma_shift_x) {
  PhotographParameters photograph;
  photograph.tag_errors[kShiftX] = 0.02;
  photograph.found_errors[kShiftX] = found_shift_x;
  photograph.prior_sigmas[kYaw] = 0.5;
  photograph.prior_sigmas[kShiftX] = 0.015;
  photograph.covariance(kShiftX, kShiftX) = sigma_shift_x * sigma_shift_x;
  photograph.covariance(kYaw, kYaw) = 0.01;
  photograph.covariance(kYaw, kShiftX) = photograph.covariance(kShiftX, kYaw) =
      -0.97 * 0.1 * sigma_shift_x;
  return photograph;
}

TEST(ParameterErrors, RootMeanSquaresOverPhotographs) {
  const auto parameters =
      SummariseParameters({Photograph(0.003, 0.003), Photograph(-0.004, 0.002)});
  const ParameterErrors& shift = parameters[kShiftX];
  EXPECT_EQ(shift.count, 2);
  EXPECT_DOUBLE_EQ(shift.rms_tag, 0.02);
  EXPECT_NEAR(shift.rms_found, 0.005 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(shift.rms_sigma, std::sqrt(13e-6 / 2), 1e-12);
  EXPECT_NEAR(shift.rms_in_sigmas, std::sqrt((1 + 4) / 2.0), 1e-12);
  EXPECT_NEAR(shift.worst_in_sigmas, 2, 1e-12);
  EXPECT_NEAR(shift.sigma_over_prior, 0.2, 1e-12);
}

TEST(ParameterErrors, ThePartnerIsWhatCannotBeToldApart) {
  const auto parameters = SummariseParameters({Photograph(0.003, 0.003)});
  EXPECT_EQ(parameters[kShiftX].partner, kYaw);
  EXPECT_NEAR(parameters[kShiftX].partner_correlation, 0.97, 1e-12);
  EXPECT_EQ(parameters[kYaw].partner, kShiftX);
  EXPECT_EQ(parameters[0].partner, -1);
}

TEST(ParameterErrors, WhatWasHeldClaimsNothing) {
  const auto parameters = SummariseParameters({Photograph(0.003, 0.003)});
  EXPECT_EQ(parameters[10].rms_sigma, 0);
  EXPECT_EQ(parameters[10].worst_in_sigmas, 0);
  const std::string table = FormatParameterTable(parameters, "ft");
  EXPECT_THAT(table, testing::HasSubstr("yaw (0.97)"));
  EXPECT_THAT(table, testing::ContainsRegex("k1 .* held"));
  EXPECT_THAT(table, testing::ContainsRegex("x ft "));
}

TEST(ParameterErrors, NoPhotographsNoTable) {
  const std::vector<PhotographParameters> none;
  EXPECT_EQ(FormatParameterTable(SummariseParameters(none), "ft"), "");
}

}  // namespace
}  // namespace groundglass
