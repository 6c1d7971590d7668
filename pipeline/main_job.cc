// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/main_job.h"

#include "invrender/bake_output.h"
#include "pipeline/register_stages.h"
#include "report/report.h"
#include "scene/check_option.h"
#include "scene/coverage.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/output_stages.h"
#include "scene/what_failed.h"
#include "viewer/overlay.h"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <string_view>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kPageFormats = {"jpg", "png", "tif", "exr"};

// What the files of each stage depend on (StageKey).
struct StageKeys {
  std::string registration;
  std::string texture;
  std::string tiles;
  std::string stills;
};

struct JobInputs {
  StageInputs registration;
  StageInputs texture;
  StageInputs tiles;
  StageInputs stills;
};

JobInputs ReadJobInputs(const Scene& scene, const MainJobOptions& options) {
  const MainJobTexts texts = options.texts.value_or(MainJobTexts());
  return {ReadRegistrationInputs(scene, texts.registering),
          ReadTextureInputs(scene, texts.texture),
          ReadStageOptions(texts.tiles),
          ReadStageOptions(texts.stills)};
}

StageKeys MakeStageKeys(uint64_t seed, const JobInputs& inputs) {
  StageKeys keys;
  keys.registration = RegistrationKey(seed, inputs.registration);
  keys.texture = StageKey(kTextureStage, keys.registration, inputs.texture);
  keys.tiles = StageKey(kTilesStage, keys.texture, inputs.tiles);
  keys.stills = StageKey(kStillsStage, keys.texture, inputs.stills);
  return keys;
}

// Everything that goes wrong once the tags are corrected is told, and costs no more than its own
// stage: what the others make is there.
class Attempts {
 public:
  explicit Attempts(const JobObserver& observer) : observer_(observer) {}
  void Try(const char* stage, const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& error) {
      failures_.push_back(std::string(stage) + ": " + WhatFailed(error));
      observer_.Tell(failures_.back());
    }
  }
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  const JobObserver& observer_;
  std::vector<std::string> failures_;
};

// Keeps what earlier runs left for the same keys, removes what they left for others; all of it if
// nobody knows what it was made with.
void KeepSame(const StageKeys& keys, bool is_known, OutputStages& stages) {
  const auto keep = [&](const char* stage, const std::string& key) {
    stages.KeepOnly(stage, is_known ? key : "");
  };
  keep(kRegisterStage, keys.registration);
  keep(kOverlayStage, keys.registration);
  keep(kTextureStage, keys.texture);
  keep(kTilesStage, keys.tiles);
  keep(kStillsStage, keys.stills);
  // It tells of all the others, and is always made again.
  stages.KeepOnly(kReportStage, "");
  stages.Write();
}

// They are taken on the way from one photograph's viewpoint to the next, so it takes two.
std::string WhyNoStills(const std::vector<BakePhotograph>& photographs, const fs::path& out) {
  return "no pictures from new viewpoints: they are drawn on the way from one photograph's "
         "viewpoint "
         "to the next, and only " +
         photographs.front().name + " has a camera; groundglass render " + out.string() +
         " --view FILE.view -o still.png draws one from wherever you like";
}

// Of one main job: what its stages share.
struct MainJob {
  const Scene& scene;
  const fs::path& out;
  const MainJobOptions& options;
  const JobObserver& observer;
  StageKeys keys;
  OutputStages stages;
};

// The job with what earlier runs left: what is the same is kept, the rest is gone.
MainJob BeginMainJob(const Scene& scene,
                     const fs::path& out,
                     const MainJobOptions& options,
                     const JobObserver& observer) {
  const JobInputs inputs = ReadJobInputs(scene, options);
  StageKeys keys = MakeStageKeys(options.seed, inputs);
  TellDamagedManifest(out, observer);
  OutputStages stages(
      out,
      MakeManifest(
          "run", options.seed, {inputs.registration, inputs.texture, inputs.tiles, inputs.stills}));
  KeepSame(keys, options.texts.has_value(), stages);
  TellChanged(stages, {kRegisterStage, kOverlayStage, kTextureStage, kStillsStage}, observer);
  if (options.tiles.form != TilesToWrite::Form::kNone) {
    TellChanged(stages, {kTilesStage}, observer);
  }
  return {scene, out, options, observer, std::move(keys), std::move(stages)};
}

// The result says what of the model has a texture afterwards.
void EnsureTexture(const std::vector<BakePhotograph>& photographs,
                   MainJob& job,
                   MainJobResult& result) {
  if (job.stages.IsComplete(kTextureStage, job.keys.texture)) {
    job.observer.Keep(kTextureStage);
    const std::optional<Coverage> coverage = ReadCoverage(job.out / "coverage.json");
    if (!coverage) return;
    result.covered_share = coverage->CoveredShare();
    if (job.observer.textured) job.observer.textured(*result.covered_share);
    return;
  }
  const BakeResult bake = BakeAndWrite(job.scene,
                                       photographs,
                                       job.options.baking,
                                       job.options.page_format,
                                       job.out,
                                       job.keys.texture,
                                       job.stages,
                                       job.observer);
  result.remarks.insert(result.remarks.end(), bake.remarks.begin(), bake.remarks.end());
  result.covered_share = bake.coverage.CoveredShare();
  if (job.observer.textured) job.observer.textured(*result.covered_share);
}

// Texture, tiles and pictures.
void MakeTextured(const std::vector<BakePhotograph>& photographs,
                  MainJob& job,
                  Attempts& attempts,
                  MainJobResult& result) {
  attempts.Try("texture", [&] { EnsureTexture(photographs, job, result); });
  attempts.Try("tiles", [&] {
    EnsureTiles(job.scene,
                photographs,
                job.options.tiles,
                job.out,
                job.keys.tiles,
                job.stages,
                job.observer);
  });
  attempts.Try("pictures from new viewpoints", [&] {
    if (!job.stages.IsComplete(kTextureStage, job.keys.texture)) return;
    result.stills = EnsureStills(result.registered.registrations,
                                 job.options.num_stills,
                                 job.out,
                                 job.keys.stills,
                                 job.stages,
                                 job.observer);
    if (result.stills.width == 0 && job.options.num_stills > 0) {
      result.remarks.push_back(WhyNoStills(photographs, job.out));
    }
  });
}

void WriteReport(MainJob& job) {
  job.stages.Begin(kReportStage, job.keys.registration, {"report.html"});
  job.observer.Begin(kReportStage);
  ReportOptions report;
  report.find_edges = MakeEdgeFinding(job.scene.model);
  WriteFileAtomically(job.out / "report.html", MakeReport(job.out, &job.scene, report));
  job.stages.Finish(kReportStage);
}

}  // namespace

void MainJobOptions::Check() const {
  registering.Check();
  baking.Check();
  tiles.options.Check();
  const std::string path = "main job options: ";
  if (std::find(kPageFormats.begin(), kPageFormats.end(), page_format) == kPageFormats.end()) {
    throw OptionError(path + "page_format", "must be jpg, png, tif or exr, not " + page_format);
  }
  if (baking.pages.bits == 16 && page_format == "jpg") {
    throw OptionError(path + "page_format", "must be png, tif or exr with 16 bits, not jpg");
  }
  CheckFromTo(num_stills, 0, 100, path + "num_stills");
}

std::vector<std::string> FindKeptStages(const Scene& scene,
                                        const fs::path& out,
                                        const MainJobOptions& options) {
  if (!options.texts || !fs::exists(out)) return {};
  const StageKeys keys = MakeStageKeys(options.seed, ReadJobInputs(scene, options));
  std::vector<std::string> kept = FindKeptRegistration(options.registering, out, keys.registration);
  const auto add = [&](const char* stage, const std::string& key) {
    for (std::string& name : FindComplete(out, {stage}, key)) kept.push_back(std::move(name));
  };
  add(kTextureStage, keys.texture);
  add(kTilesStage, keys.tiles);
  add(kStillsStage, keys.stills);
  return kept;
}

MainJobResult RunMainJob(const Scene& scene,
                         const fs::path& out,
                         const MainJobOptions& options,
                         const JobObserver& observer) {
  options.Check();
  CheckSelection(options.selection, scene);
  const FolderLock lock = PrepareOutputFolder(out);
  MainJob job = BeginMainJob(scene, out, options, observer);

  MainJobResult result;
  result.registered = EnsureRegistered(
      scene, options.lens, options.registering, out, job.keys.registration, job.stages, observer);
  if (observer.registered) observer.registered(result.registered);
  Attempts attempts(observer);
  attempts.Try("overlays", [&] {
    EnsureOverlays(scene, result.registered, out, job.keys.registration, job.stages, observer);
  });

  std::vector<BakePhotograph> photographs =
      SelectPhotographs(scene, result.registered.registrations, options.selection.accepted_only);
  bool is_narrowed = false;
  attempts.Try("texture", [&] {
    result.selection_faults = NarrowPhotographs(options.selection, scene, photographs);
    is_narrowed = true;
  });
  if (photographs.empty()) {
    observer.Tell(
        "no photograph is left to texture with: none of those that are not excluded could be "
        "registered");
  } else if (is_narrowed) {
    MakeTextured(photographs, job, attempts, result);
  }
  if (options.report) attempts.Try("report", [&] { WriteReport(job); });
  result.failures = attempts.failures();
  return result;
}

}  // namespace groundglass
