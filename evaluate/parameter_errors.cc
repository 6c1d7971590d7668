// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/parameter_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// The number whose correlation with `i` is largest on average over the photographs.
void FindPartner(const std::vector<PhotographParameters>& photographs,
                 int i,
                 ParameterErrors& errors) {
  for (int j = 0; j < kNumCameraParameters; ++j) {
    double sum = 0;
    int count = 0;
    for (const PhotographParameters& photograph : photographs) {
      const CameraCovariance& covariance = photograph.covariance;
      if (i == j || !(covariance(i, i) > 0 && covariance(j, j) > 0)) continue;
      sum += std::abs(covariance(i, j)) / std::sqrt(covariance(i, i) * covariance(j, j));
      ++count;
    }
    if (count > 0 && sum / count > errors.partner_correlation) {
      errors.partner = j;
      errors.partner_correlation = sum / count;
    }
  }
}

const char* UnitOf(int parameter, const std::string& length_unit) {
  if (parameter < 3) return length_unit.c_str();
  return parameter < 7 ? "deg" : "";
}

}  // namespace

std::array<ParameterErrors, kNumCameraParameters> SummariseParameters(
    const std::vector<PhotographParameters>& photographs) {
  std::array<ParameterErrors, kNumCameraParameters> parameters;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    ParameterErrors& errors = parameters[i];
    std::vector<double> narrowings;
    int num_claimed = 0;
    for (const PhotographParameters& photograph : photographs) {
      ++errors.count;
      errors.rms_tag += std::pow(photograph.tag_errors[i], 2);
      errors.rms_found += std::pow(photograph.found_errors[i], 2);
      const double variance = photograph.covariance(i, i);
      if (!(variance > 0)) continue;
      ++num_claimed;
      errors.rms_sigma += variance;
      const double in_sigmas = std::abs(photograph.found_errors[i]) / std::sqrt(variance);
      errors.rms_in_sigmas += in_sigmas * in_sigmas;
      errors.worst_in_sigmas = std::max(errors.worst_in_sigmas, in_sigmas);
      if (photograph.prior_sigmas[i] > 0) {
        narrowings.push_back(std::sqrt(variance) / photograph.prior_sigmas[i]);
      }
    }
    if (errors.count == 0) continue;
    errors.rms_tag = std::sqrt(errors.rms_tag / errors.count);
    errors.rms_found = std::sqrt(errors.rms_found / errors.count);
    if (num_claimed > 0) {
      errors.rms_sigma = std::sqrt(errors.rms_sigma / num_claimed);
      errors.rms_in_sigmas = std::sqrt(errors.rms_in_sigmas / num_claimed);
    }
    if (!narrowings.empty()) {
      std::sort(narrowings.begin(), narrowings.end());
      errors.sigma_over_prior = narrowings[narrowings.size() / 2];
    }
    FindPartner(photographs, i, errors);
  }
  return parameters;
}

std::string FormatParameterTable(
    const std::array<ParameterErrors, kNumCameraParameters>& parameters, const std::string& unit) {
  if (parameters[0].count == 0) return {};
  std::string text = fmt::format("{:<12} {:>11} {:>11} {:>11} {:>13} {:>6} {:>11}  {}\n",
                                 "number, RMS",
                                 "tag's error",
                                 "found's",
                                 "claimed",
                                 "error/claimed",
                                 "worst",
                                 "of prior",
                                 "hardest to tell from");
  for (int i = 0; i < kNumCameraParameters; ++i) {
    const ParameterErrors& errors = parameters[i];
    const std::string name(kCameraParameterNames[i]);
    const std::string unit_name = UnitOf(i, unit);
    text += fmt::format("{:<12} {:11.4f} {:11.4f} ",
                        unit_name.empty() ? name : name + " " + unit_name,
                        errors.rms_tag,
                        errors.rms_found);
    if (errors.rms_sigma == 0) {
      text += "      held\n";
      continue;
    }
    text += fmt::format("{:11.4f} {:13.2f} {:6.2f} {:9.0f} %",
                        errors.rms_sigma,
                        errors.rms_in_sigmas,
                        errors.worst_in_sigmas,
                        100 * errors.sigma_over_prior);
    if (errors.partner >= 0) {
      text += fmt::format(
          "  {} ({:.2f})", kCameraParameterNames[errors.partner], errors.partner_correlation);
    }
    text += "\n";
  }
  return text;
}

}  // namespace groundglass
