// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/trials.h"

#include "datasets-synthetic/noise.h"
#include "evaluate/camera_errors.h"
#include "register/register.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/quantile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// What a notebook would say of a photograph whose camera is known: errors in position and look-at
// point, the view angle and aspect as the scene's own tag has them, nothing about the slide.
ViewTag DrawTag(const Camera& true_camera,
                const ViewTag& written,
                const TrialOptions& options,
                uint64_t seed) {
  const double distance = (written.lookat_in_site - written.position_in_site).norm();
  const ViewTag actual = TagFromCamera(true_camera, distance);
  const auto error = [&](double sigma, int which) { return sigma * NormalOf(HashOf(seed, which)); };
  ViewTag tag;
  tag.position_in_site = actual.position_in_site + Eigen::Vector3d(error(options.sigma_position, 0),
                                                                   error(options.sigma_position, 1),
                                                                   error(options.sigma_height, 2));
  tag.lookat_in_site = actual.lookat_in_site + Eigen::Vector3d(error(options.sigma_lookat, 3),
                                                               error(options.sigma_lookat, 4),
                                                               error(options.sigma_lookat, 5));
  tag.view_angle_deg = written.view_angle_deg;
  tag.aspect = written.aspect;
  tag.camera = written.camera;
  tag.sigmas = written.sigmas;
  tag.sigmas.position = options.sigma_position / options.overclaim;
  tag.sigmas.height = options.sigma_height / options.overclaim;
  tag.sigmas.lookat = options.sigma_lookat / options.overclaim;
  return tag;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TrialBin CountTrials(const std::vector<Trial>& trials, double low_px, double high_px) {
  TrialBin bin;
  bin.low_px = low_px;
  bin.high_px = high_px;
  bin.count = static_cast<int>(trials.size());
  std::vector<double> ends;
  for (const Trial& trial : trials) {
    ends.push_back(trial.end_at_640_px);
    bin.num_within_1_px += trial.end_at_640_px <= 1;
    bin.num_within_3_px += trial.end_at_640_px <= 3;
    bin.num_accepted += trial.verdict == Verdict::kAccepted;
    bin.num_wrong_accepted += trial.is_wrong_accepted;
    bin.num_calibrated += trial.confidence.has_value();
    bin.num_inside_95 += trial.IsInside95();
  }
  if (ends.empty()) return bin;
  bin.median_end_px = UpperMedian(std::move(ends));
  return bin;
}

nlohmann::ordered_json JsonFromBin(const TrialBin& bin) {
  return {{"count", bin.count},
          {"within_1_px", bin.num_within_1_px},
          {"within_3_px", bin.num_within_3_px},
          {"accepted", bin.num_accepted},
          {"wrong_accepted", bin.num_wrong_accepted},
          {"calibrated", bin.num_calibrated},
          {"inside_95", bin.num_inside_95},
          {"median_px_at_640", bin.median_end_px}};
}

constexpr Blunder kBlunderKinds[] = {
    Blunder::kSwappedCoordinates, Blunder::kWrongSign, Blunder::kWrongPhotograph, Blunder::kNone};

double ShareInPercent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0; }

// "from LOW to HIGH" of a row of the table.
std::string RangeOf(const TrialBin& bin) {
  if (bin.high_px <= 1e6) return fmt::format("{:g} to {:g}", bin.low_px, bin.high_px);
  return bin.low_px == 0 ? "all" : fmt::format("{:g} and up", bin.low_px);
}

std::string FormatBlunderRow(const TrialBin& bin, Blunder kind) {
  const std::string name =
      kind == Blunder::kNone ? "all blunders" : fmt::format("blunders, {}", BlunderName(kind));
  return fmt::format(
      "{:<28} {:6}  put right (to 3 px) {:5.1f} %  accepted {:5.1f} %  wrong {} ({:.1f} %)\n",
      name,
      bin.count,
      ShareInPercent(bin.num_within_3_px, bin.count),
      ShareInPercent(bin.num_accepted, bin.count),
      bin.num_wrong_accepted,
      ShareInPercent(bin.num_wrong_accepted, bin.count));
}

}  // namespace

void TrialOptions::Check() const {
  CheckAtLeast(num_trials, 1, "trial options: num_trials");
  CheckAbove(sigma_position, 0, "trial options: sigma_position");
  CheckAbove(sigma_height, 0, "trial options: sigma_height");
  CheckAbove(sigma_lookat, 0, "trial options: sigma_lookat");
  CheckAbove(overclaim, 0, "trial options: overclaim");
  CheckAtLeast(num_blunders, 0, "trial options: num_blunders");
  registration.Check();
}

std::vector<Trial> RunTrials(const Scene& scene,
                             const Truth& truth,
                             const TrialOptions& options,
                             const Progress& progress) {
  options.Check();
  std::map<std::string, Camera> true_camera_of_name;
  for (const NamedCamera& camera : truth.cameras) true_camera_of_name[camera.name] = camera.camera;
  Scene notebook_scene = scene;
  std::erase_if(notebook_scene.photographs, [&](const Photograph& photograph) {
    return !true_camera_of_name.contains(photograph.name);
  });
  if (notebook_scene.photographs.empty()) {
    throw Error(truth.folder, "no photograph of the scene has a true camera here");
  }
  const std::vector<Photograph> written = notebook_scene.photographs;
  std::vector<Trial> trials;
  for (int notebook = 0; notebook < options.num_trials; ++notebook) {
    for (size_t i = 0; i < written.size(); ++i) {
      notebook_scene.photographs[i].tag =
          DrawTag(true_camera_of_name.at(written[i].name),
                  written[i].tag,
                  options,
                  SeedFor(options.seed, "trial " + written[i].name, notebook));
    }
    const int num_tags = static_cast<int>(written.size());
    const uint64_t blunder_seed = SeedFor(options.seed, "trial blunders", notebook);
    const std::vector<Blunder> blunders =
        DrawBlunders(num_tags, options.num_blunders, blunder_seed);
    std::vector<ViewTag> tags;
    for (const Photograph& photograph : notebook_scene.photographs) tags.push_back(photograph.tag);
    CommitBlunders(blunders, blunder_seed, tags);
    std::map<std::string, Blunder> blunder_of_name;
    for (int i = 0; i < num_tags; ++i) {
      notebook_scene.photographs[i].tag = tags[i];
      blunder_of_name[written[i].name] = blunders[i];
    }
    const std::vector<Registration> registrations =
        RegisterScene(notebook_scene, std::nullopt, options.registration, {}).registrations;
    for (const Registration& registration : registrations) {
      const Camera& true_camera = true_camera_of_name.at(registration.name);
      const double to_640 = 640.0 / true_camera.width_px;
      const CameraErrors errors =
          MeasureCameraErrors(scene.model, true_camera, registration.CorrectedCamera());
      Trial trial;
      trial.name = registration.name;
      trial.notebook = notebook;
      trial.blunder = blunder_of_name.at(registration.name);
      trial.position_error = errors.position;
      trial.position_sigma = registration.sigmas.head<3>().norm();
      trial.verdict = registration.verdict;
      trial.start_px =
          MeasureVertexError(scene.model, true_camera, registration.MeasuredCamera()).mean_px;
      trial.end_px = errors.vertex.mean_px;
      trial.start_at_640_px = trial.start_px * to_640;
      trial.end_at_640_px = trial.end_px * to_640;
      trial.is_wrong_accepted = trial.verdict == Verdict::kAccepted &&
                                trial.end_px > WrongAcceptedThresholdPx(true_camera.width_px);
      // Only accepted photographs claim that their covariance holds, and a blunder's errors were
      // not drawn from the sigmas that its tag states.
      if (trial.verdict == Verdict::kAccepted && trial.blunder == Blunder::kNone) {
        const auto calibration = MeasureCalibration(errors.parameters, registration.covariance);
        if (calibration) trial.confidence = calibration->confidence;
      }
      trials.push_back(trial);
    }
    if (progress) {
      progress(notebook + 1, options.num_trials, "notebook " + std::to_string(notebook + 1));
    }
  }
  return trials;
}

std::vector<TrialBin> SummariseTrials(const std::vector<Trial>& trials) {
  const std::vector<std::pair<double, double>> ranges = {
      {0, 5}, {5, 10}, {10, 20}, {20, 40}, {40, kInfinity}, {0, kInfinity}};
  std::vector<TrialBin> bins;
  for (const auto& [low, high] : ranges) {
    std::vector<Trial> chosen;
    for (const Trial& trial : trials) {
      if (trial.blunder == Blunder::kNone && trial.start_at_640_px >= low &&
          trial.start_at_640_px < high) {
        chosen.push_back(trial);
      }
    }
    if (!chosen.empty()) bins.push_back(CountTrials(chosen, low, high));
  }
  return bins;
}

TrialBin SummariseBlunders(const std::vector<Trial>& trials, Blunder kind) {
  std::vector<Trial> chosen;
  for (const Trial& trial : trials) {
    if (trial.blunder != Blunder::kNone && (kind == Blunder::kNone || trial.blunder == kind)) {
      chosen.push_back(trial);
    }
  }
  return CountTrials(chosen, 0, kInfinity);
}

std::string FormatTrialsTable(const std::vector<Trial>& trials, const TrialOptions& options) {
  std::string text =
      fmt::format("{} notebooks, sigmas {:g} across, {:g} up, look-at {:g}; pixels at 640 wide\n",
                  options.num_trials,
                  options.sigma_position,
                  options.sigma_height,
                  options.sigma_lookat);
  text += fmt::format("{:<12} {:>6} {:>9} {:>9} {:>11} {:>9} {:>6} {:>11}\n",
                      "start px",
                      "tags",
                      "to 1 px",
                      "to 3 px",
                      "median px",
                      "accepted",
                      "wrong",
                      "in 95 %");
  for (const TrialBin& bin : SummariseTrials(trials)) {
    text += fmt::format("{:<12} {:6} {:7.1f} % {:7.1f} % {:11.2f} {:7.1f} % {:6} {:9.1f} %\n",
                        RangeOf(bin),
                        bin.count,
                        ShareInPercent(bin.num_within_1_px, bin.count),
                        ShareInPercent(bin.num_within_3_px, bin.count),
                        bin.median_end_px,
                        ShareInPercent(bin.num_accepted, bin.count),
                        bin.num_wrong_accepted,
                        ShareInPercent(bin.num_inside_95, bin.num_calibrated));
  }
  if (options.num_blunders == 0) return text;
  for (const Blunder kind : kBlunderKinds) {
    text += FormatBlunderRow(SummariseBlunders(trials, kind), kind);
  }
  return text;
}

std::string FormatTrialsJson(const std::vector<Trial>& trials, const TrialOptions& options) {
  nlohmann::ordered_json json;
  json["notebooks"] = options.num_trials;
  json["seed"] = options.seed;
  json["sigma_position"] = options.sigma_position;
  json["sigma_height"] = options.sigma_height;
  json["sigma_lookat"] = options.sigma_lookat;
  json["blunders_each"] = options.num_blunders;
  json["bins"] = nlohmann::ordered_json::array();
  for (const TrialBin& bin : SummariseTrials(trials)) {
    nlohmann::ordered_json entry = {{"low_px_at_640", bin.low_px}, {"high_px_at_640", nullptr}};
    if (bin.high_px < 1e6) entry["high_px_at_640"] = bin.high_px;
    entry.update(JsonFromBin(bin));
    json["bins"].push_back(entry);
  }
  if (options.num_blunders > 0) {
    for (const Blunder kind : kBlunderKinds) {
      const std::string name = kind == Blunder::kNone ? "all" : std::string(BlunderName(kind));
      json["blunders"][name] = JsonFromBin(SummariseBlunders(trials, kind));
    }
  }
  json["trials"] = nlohmann::ordered_json::array();
  for (const Trial& trial : trials) {
    nlohmann::ordered_json confidence;
    if (trial.confidence) confidence = *trial.confidence;
    json["trials"].push_back({{"name", trial.name},
                              {"notebook", trial.notebook},
                              {"start_px", trial.start_px},
                              {"end_px", trial.end_px},
                              {"position_error", trial.position_error},
                              {"position_sigma", trial.position_sigma},
                              {"blunder", std::string(BlunderName(trial.blunder))},
                              {"verdict", std::string(VerdictName(trial.verdict))},
                              {"wrong_accepted", trial.is_wrong_accepted},
                              {"confidence", confidence},
                              {"inside_95", trial.IsInside95()}});
  }
  return json.dump(2) + "\n";
}

}  // namespace groundglass
