// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "pipeline/job_observer.h"
#include "register/register.h"
#include "scene/formats/output_stages.h"
#include "scene/formats/scene_folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The stages that `register` and the main job share. `key`: StageKey of the registration's inputs.
// What is there already with this key is kept.
constexpr const char* kRegisterStage = "register";
constexpr const char* kOverlayStage = "overlays";
// Keypoints and matches, in the folder of this name. COLMAP's database knows itself what it was
// made from, so its key never changes.
constexpr const char* kColmapStage = "colmap";

// Tells that the manifest which an earlier run left in `out` cannot be read, so that nothing of it
// is kept.
void TellDamagedManifest(const std::filesystem::path& out, const JobObserver& observer);

// Of these stages, those that an earlier run has left in `out` complete with this key. Writes
// nothing.
std::vector<std::string> FindComplete(const std::filesystem::path& out,
                                      const std::vector<std::string>& names,
                                      const std::string& key);

// What `register` would keep: as above, but registration is done anew where what its stages hand to
// one another is to be kept (RegisterOptions::keep_folder).
std::vector<std::string> FindKeptRegistration(const RegisterOptions& options,
                                              const std::filesystem::path& out,
                                              const std::string& key);

// Tells the files of these stages that somebody has changed since they were written, which are made
// again.
void TellChanged(const OutputStages& stages,
                 const std::vector<std::string>& names,
                 const JobObserver& observer);

// Corrected tags: views/, registration.json and cameras/; with options.use_colmap also
// colmap/database.db, which is kept for later runs. With options.keep_folder they are made
// anew.
RegisteredScene EnsureRegistered(const Scene& scene,
                                 const std::optional<Lens>& lens,
                                 const RegisterOptions& options,
                                 const std::filesystem::path& out,
                                 const std::string& key,
                                 OutputStages& stages,
                                 const JobObserver& observer = {});

// overlays/: the model's edges over each photograph.
void EnsureOverlays(const Scene& scene,
                    const RegisteredScene& registered,
                    const std::filesystem::path& out,
                    const std::string& key,
                    OutputStages& stages,
                    const JobObserver& observer = {});

}  // namespace groundglass
