// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "pipeline/register_stages.h"

#include "register/register.h"
#include "register/registration_output.h"
#include "scene/error.h"
#include "scene/formats/colmap_names.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/progress.h"
#include "viewer/overlay.h"

#include <tbb/parallel_for.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr const char* kColmapDatabase = "colmap/database.db";

constexpr const char* kRegistrationFile = "registration.json";

std::string OverlayFile(const std::string& name) { return "overlays/" + name + ".jpg"; }

// What an earlier run found for these photographs, if it can be read.
std::optional<RegisteredScene> ReadRegistered(const Scene& scene, const fs::path& file) {
  RegisteredScene registered;
  try {
    registered = {ReadRegistrations(file),
                  ReadModelErrors(file),
                  ReadRegistrationWarnings(file),
                  ReadTieUse(file)};
  } catch (const Error&) {
    return std::nullopt;  // somebody has changed it: it is made again
  }
  const std::vector<Registration>& registrations = registered.registrations;
  if (registrations.size() != scene.photographs.size() + scene.unreadable.size()) {
    return std::nullopt;
  }
  for (size_t i = 0; i < scene.photographs.size(); ++i) {
    if (registrations[i].name != scene.photographs[i].name) return std::nullopt;
  }
  return registered;
}

}  // namespace

void TellDamagedManifest(const fs::path& out, const JobObserver& observer) {
  if (!IsManifestDamaged(out)) return;
  observer.Tell("manifest.json is damaged, so that nobody knows what the files in " + out.string() +
                " were made with; everything is made again");
}

std::vector<std::string> FindComplete(const fs::path& out,
                                      const std::vector<std::string>& names,
                                      const std::string& key) {
  std::vector<std::string> complete;
  if (!fs::exists(out)) return complete;
  const OutputStages stages(out, {});
  for (const std::string& name : names) {
    if (stages.IsComplete(name, key)) complete.push_back(name);
  }
  return complete;
}

std::vector<std::string> FindKeptRegistration(const RegisterOptions& options,
                                              const fs::path& out,
                                              const std::string& key) {
  std::vector<std::string> kept = FindComplete(out, {kRegisterStage, kOverlayStage}, key);
  if (!options.keep_folder.empty()) std::erase(kept, kRegisterStage);
  return kept;
}

void TellChanged(const OutputStages& stages,
                 const std::vector<std::string>& names,
                 const JobObserver& observer) {
  for (const std::string& name : names) {
    for (const std::string& file : stages.FindChanged(name)) {
      observer.Tell(file + " has changed since it was written; it is made again");
    }
  }
}

RegisteredScene EnsureRegistered(const Scene& scene,
                                 const std::optional<Lens>& lens,
                                 const RegisterOptions& options,
                                 const fs::path& out,
                                 const std::string& key,
                                 OutputStages& stages,
                                 const JobObserver& observer) {
  // What is to be kept of the stages on the way is made only by going it.
  if (options.keep_folder.empty() && stages.Has(kRegisterStage, key, kRegistrationFile)) {
    if (std::optional<RegisteredScene> kept = ReadRegistered(scene, out / kRegistrationFile)) {
      observer.Keep(kRegisterStage);
      if (!stages.IsComplete(kRegisterStage, key)) {
        WriteRegistrationOutput(scene, *kept, out);
        stages.Finish(kRegisterStage);
      }
      return *std::move(kept);
    }
  }
  std::vector<std::string> files = {
      kRegistrationFile, "cameras/cameras.txt", "cameras/images.txt", "cameras/points3D.txt"};
  for (const Photograph& photograph : scene.photographs) {
    files.push_back("views/" + photograph.name + ".view");
  }
  stages.Begin(kRegisterStage, key, files);
  // COLMAP's database outlives what is made of it: other tags or options need not match anew.
  RegisterOptions with_folder = options;
  if (options.use_colmap) {
    with_folder.colmap.folder = out / kColmapStage;
    stages.Begin(kColmapStage, "", {kColmapDatabase});
  }
  RegisteredScene registered =
      RegisterScene(scene, lens, with_folder, observer.Begin(kRegisterStage));
  std::vector<std::string> images;
  for (const Photograph& photograph : scene.photographs) {
    images.push_back(ImageName(scene, photograph));
  }
  for (std::string& warning : TellNamesWithBlanks(out / "cameras", images)) {
    registered.warnings.push_back(std::move(warning));
  }
  WriteRegistrationOutput(scene, registered, out);
  if (options.use_colmap) stages.Finish(kColmapStage);
  stages.Finish(kRegisterStage);
  return registered;
}

void EnsureOverlays(const Scene& scene,
                    const RegisteredScene& registered,
                    const fs::path& out,
                    const std::string& key,
                    OutputStages& stages,
                    const JobObserver& observer) {
  if (stages.IsComplete(kOverlayStage, key)) {
    observer.Keep(kOverlayStage);
    return;
  }
  std::vector<std::string> files;
  std::vector<int> wanted;
  for (size_t i = 0; i < scene.photographs.size(); ++i) {
    if (registered.registrations[i].verdict == Verdict::kUnreadable) continue;
    files.push_back(OverlayFile(scene.photographs[i].name));
    if (!stages.Has(kOverlayStage, key, files.back())) wanted.push_back(static_cast<int>(i));
  }
  stages.Begin(kOverlayStage, key, files);
  const Progress progress = observer.Begin(kOverlayStage);
  const std::vector<ModelEdge> edges = FindModelEdges(scene.model);
  const Visibility visibility(scene.model);
  ProgressCounter steps(progress, static_cast<int>(wanted.size()));
  tbb::parallel_for(size_t{0}, wanted.size(), [&](size_t w) {
    const int i = wanted[w];
    const Registration& registration = registered.registrations[i];
    const Camera measured = registration.MeasuredCamera();
    const Camera corrected = registration.CorrectedCamera();
    const bool is_corrected = HasCorrection(registration.verdict);
    WriteSrgb8(out / OverlayFile(registration.name),
               DrawOverlay(ReadSrgb8(scene.photographs[i].image_file),
                           scene.model,
                           edges,
                           visibility,
                           measured,
                           is_corrected ? &corrected : nullptr));
    steps.Tell(registration.name);
  });
  stages.Finish(kOverlayStage);
}

}  // namespace groundglass
