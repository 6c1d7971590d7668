// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/camera_errors.h"
#include "evaluate/trials.h"
#include "evaluate/truth.h"
#include "register/register.h"
#include "scene/formats/scene_folder.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// What each stage of registration adds: the same photographs without it.
//   ablation_bench SCENE [NOTEBOOKS [SIGMA_FACTOR]]
// SCENE: a scene folder with a truth folder in it. First from the scene's own tags, then, if
// NOTEBOOKS is given, from so many drawn ones whose errors are SIGMA_FACTOR times a tape's.

namespace groundglass {
namespace {

struct Variant {
  std::string name;
  RegisterOptions options;
};

std::vector<Variant> MakeVariants() {
  std::vector<Variant> variants;
  const auto add = [&](const std::string& name) -> RegisterOptions& {
    return variants.emplace_back(Variant{name, {}}).options;
  };
  add("everything");
  RegisterOptions& no_gate = add("no orientation gate");
  no_gate.solutions.refine.matching.gate_deg = no_gate.solutions.score.gate_deg = 90;
  no_gate.joint.matching.gate_deg = 90;
  add("no hypotheses").solutions.hypotheses.max_starts = 0;
  RegisterOptions& wide = add("no hypotheses, full range");
  wide.solutions.hypotheses.max_starts = 0;
  wide.solutions.refine.start_sigmas = 1;
  add("no annealing").solutions.refine.start_sigmas = 1e-6;
  RegisterOptions& exact_model = add("no edge offsets");
  exact_model.solutions.refine.bias.edge_offset_sigmas =
      exact_model.solutions.refine.bias.edge_turn_sigmas = 3e-5;
  exact_model.joint.common_offset_sigmas = exact_model.joint.common_turn_sigmas = 3e-3;
  exact_model.joint.own.edge_offset_sigmas = exact_model.joint.own.edge_turn_sigmas = 3e-5;
  exact_model.joint.least_own_offset_sigmas = exact_model.joint.most_own_offset_sigmas = 3e-5;
  RegisterOptions& strongest = add("strongest candidate alone");
  strongest.solutions.refine.matching.max_candidates = strongest.joint.matching.max_candidates = 1;
  add("each photograph by itself").independent = true;
  RegisterOptions& anchored = add("edges held where the model has them");
  anchored.joint.common_offset_sigmas = anchored.joint.common_turn_sigmas = 3e-3;
  anchored.joint.own = anchored.solutions.refine.bias;
  add("no ground level of its own").joint.ground_level_sigmas = 3e-3;
  add("own errors of edges without tails").joint.own_degrees_of_freedom = 1e6;
  add("no part of the model elsewhere").displaced.most_trials = 0;
  return variants;
}

struct Outcome {
  double error_px = 0;
  Verdict verdict = Verdict::kRejected;
  bool is_inside_95 = false;
  bool is_wrong_accepted = false;
};

void PrintRow(const std::string& name, const std::vector<Outcome>& outcomes) {
  std::vector<double> errors_px;
  double worst_accepted_px = 0;
  int accepted = 0;
  int wrong = 0;
  int inside = 0;
  int found = 0;
  for (const Outcome& outcome : outcomes) {
    errors_px.push_back(outcome.error_px);
    wrong += outcome.is_wrong_accepted;
    if (outcome.verdict != Verdict::kRejected) {
      ++found;
      inside += outcome.is_inside_95;
    }
    if (outcome.verdict == Verdict::kAccepted) {
      ++accepted;
      worst_accepted_px = std::max(worst_accepted_px, outcome.error_px);
    }
  }
  if (errors_px.empty()) return;
  std::sort(errors_px.begin(), errors_px.end());
  std::printf("| %-26s | %.2f / %.2f | %d of %zu | %.2f | %d | %d of %d |\n",
              name.c_str(),
              errors_px[errors_px.size() / 2],
              errors_px.back(),
              accepted,
              errors_px.size(),
              worst_accepted_px,
              wrong,
              inside,
              found);
  std::fflush(stdout);
}

void PrintHeader(const char* title) {
  std::printf(
      "\n%s\n| variant | median / worst px | accepted | worst accepted px | wrong accepted | "
      "truth in the 95 %% ellipsoid |\n|---|---|---|---|---|---|\n",
      title);
}

std::vector<Outcome> RegisterFromTags(const Scene& scene,
                                      const Truth& truth,
                                      const RegisterOptions& options) {
  std::vector<Outcome> outcomes;
  for (const Registration& registration : RegisterScene(scene, {}, options, {}).registrations) {
    for (const NamedCamera& named : truth.cameras) {
      if (named.name != registration.name) continue;
      const CameraErrors errors =
          MeasureCameraErrors(scene.model, named.camera, registration.CorrectedCamera());
      const auto calibration = MeasureCalibration(errors.parameters, registration.covariance);
      Outcome& outcome = outcomes.emplace_back();
      outcome.error_px = errors.vertex.mean_px;
      outcome.verdict = registration.verdict;
      outcome.is_inside_95 = calibration && calibration->is_inside_95;
      outcome.is_wrong_accepted =
          outcome.verdict == Verdict::kAccepted &&
          outcome.error_px > WrongAcceptedThresholdPx(registration.width_px);
    }
  }
  return outcomes;
}

std::vector<Outcome> RegisterFromNotebooks(const Scene& scene,
                                           const Truth& truth,
                                           const RegisterOptions& options,
                                           int notebooks,
                                           double factor) {
  TrialOptions trial_options;
  trial_options.num_trials = notebooks;
  trial_options.sigma_position *= factor;
  trial_options.sigma_height *= factor;
  trial_options.sigma_lookat *= factor;
  trial_options.registration = options;
  std::vector<Outcome> outcomes;
  for (const Trial& trial : RunTrials(scene, truth, trial_options, {})) {
    outcomes.push_back({trial.end_px, trial.verdict, trial.IsInside95(), trial.is_wrong_accepted});
  }
  return outcomes;
}

int Run(const std::string& folder, int notebooks, double factor) {
  const Scene scene = ReadScene(folder);
  const Truth truth = ReadTruth(scene.folder / "truth");
  const std::vector<Variant> variants = MakeVariants();
  PrintHeader("From the scene's tags");
  for (const Variant& variant : variants) {
    PrintRow(variant.name, RegisterFromTags(scene, truth, variant.options));
  }
  if (notebooks < 1) return 0;
  PrintHeader("From drawn notebooks");
  for (const Variant& variant : variants) {
    PrintRow(variant.name, RegisterFromNotebooks(scene, truth, variant.options, notebooks, factor));
  }
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: ablation_bench SCENE [NOTEBOOKS [SIGMA_FACTOR]]\n");
    return 2;
  }
  try {
    return groundglass::Run(
        argv[1], argc > 2 ? std::atoi(argv[2]) : 0, argc > 3 ? std::atof(argv[3]) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ablation_bench: %s\n", error.what());
    return 1;
  }
}
