// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/scene.h"

#include <filesystem>
#include <string>

namespace groundglass {

// Decodes every picture once, so that a damaged one is known before the work begins. A photograph
// with a fault goes to Scene::unreadable; throws Error with the first fault of the scene as a whole
// (no model, no tags), and if no photograph can be used.
Scene ReadScene(const std::filesystem::path& folder, const SceneOptions& options = {});

// The same, but collects every fault, of the scene and of its photographs, instead of stopping.
SceneCheck CheckScene(const std::filesystem::path& folder, const SceneOptions& options = {});

// The same, but no picture is decoded: quick with hundreds of photographs, and one that is damaged
// behind a sound header is found only when it is looked at.
SceneCheck ScanScene(const std::filesystem::path& folder, const SceneOptions& options = {});

// A photograph's path below images/, as COLMAP names it: "north/0001.jpg".
std::string ImageName(const Scene& scene, const Photograph& photograph);
// The photograph of this name among those that can be used; null if there is none.
const Photograph* FindUsablePhotograph(const Scene& scene, const std::string& name);

}  // namespace groundglass
