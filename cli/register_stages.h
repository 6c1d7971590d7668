// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/register_arguments.h"
#include "scene/formats/output_stages.h"

#include <string>
#include <vector>

namespace groundglass {

// The stages that `register` and `run` share. `key`: StageKey of the registration's inputs. What is
// there already with this key is kept.
constexpr const char* kRegisterStage = "register";
constexpr const char* kOverlayStage = "overlays";

// On stderr, the files of these stages that somebody has changed since they were written, which are
// made again.
void TellChanged(const OutputStages& stages, const std::vector<std::string>& names);

// Corrected tags: views/, registration.json and cameras/.
RegisteredScene EnsureRegistered(const Scene& scene,
                                 const RegisterArguments& arguments,
                                 const CommonOptions& common,
                                 const std::string& key,
                                 OutputStages& stages);

// overlays/: the model's edges over each photograph.
void EnsureOverlays(const Scene& scene,
                    const RegisteredScene& registered,
                    const RegisterArguments& arguments,
                    const CommonOptions& common,
                    const std::string& key,
                    OutputStages& stages);

}  // namespace groundglass
