// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"

#include <array>
#include <string>
#include <vector>

namespace groundglass {

// One photograph's numbers against their truth, in the order and units of kCameraParameterNames.
struct PhotographParameters {
  CameraParameters tag_errors = CameraParameters::Zero();    // of the tag as measured
  CameraParameters found_errors = CameraParameters::Zero();  // found minus true
  CameraParameters prior_sigmas = CameraParameters::Zero();
  CameraCovariance covariance = CameraCovariance::Zero();  // claimed for what was found
};

// One number over all photographs.
struct ParameterErrors {
  int count = 0;
  double rms_tag = 0;    // error of the tags
  double rms_found = 0;  // error of what was found
  // What was claimed, root mean square; 0 for what was held.
  double rms_sigma = 0;
  // Errors in units of the sigma claimed, where one is: 1 if claims are right.
  double rms_in_sigmas = 0;
  double worst_in_sigmas = 0;
  // How much the photographs narrowed the number down: claimed sigma over prior sigma, median.
  double sigma_over_prior = 0;
  // The number that it is hardest to tell from, by the mean size of their correlation; -1 if there
  // is none.
  int partner = -1;
  double partner_correlation = 0;
};
std::array<ParameterErrors, kNumCameraParameters> SummariseParameters(
    const std::vector<PhotographParameters>& photographs);

// A line for each number, `held` where nothing is claimed; empty if there are no photographs. unit:
// the model's, "ft".
std::string FormatParameterTable(
    const std::array<ParameterErrors, kNumCameraParameters>& parameters, const std::string& unit);

}  // namespace groundglass
