// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/polygon_model.h"
#include "tests/gui/desktop.h"

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// The brick scene, and a small window on a part of it.
inline const std::filesystem::path kBrick =
    std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
inline const std::vector<std::string> kSmallWindow = {"--width", "1100", "--height", "760"};

// The brick scene's model and these photographs, tagged or not.
void MakeScene(const std::filesystem::path& folder,
               const std::vector<std::string>& tagged,
               const std::vector<std::string>& untagged);
std::vector<std::string> With(const std::vector<std::string>& options,
                              const std::filesystem::path& folder);
Camera TrueCamera(const std::string& name);
Eigen::Vector2d PaneCorner(const nlohmann::json& state);
// From a photograph's pixels to the window's.
Eigen::Vector2d InWindow(const nlohmann::json& state, const Eigen::Vector2d& photograph_px);
Eigen::Vector2d OnPlan(const nlohmann::json& state, const Eigen::Vector3d& point_in_world);
// The mean distance between the model's points as both cameras see them, of those that both do.
double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found);
// Of the corners that are seen and that the truth shows too: one that stands apart, so that nobody
// could take it for another, as far as can be from those that are pinned. -1: none is left.
int ChooseCorner(const nlohmann::json& state,
                 const PolygonModel& model,
                 const Camera& truth,
                 const std::vector<int>& pinned);
// Drags corners to where the truth has them, by the whole pixels of the window.
int PinCorners(WindowUnderTest& window,
               const PolygonModel& model,
               const Camera& truth,
               int num_pins);

}  // namespace groundglass
