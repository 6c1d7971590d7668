// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "gui/window.h"
#include "scene/camera.h"
#include "scene/formats/scene.h"
#include "scene/registration.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace groundglass {

// What the window shows, as it lies on the disk.
struct Document {
  std::string title;
  TexturedModel textured;  // with pages where there are some
  Scene scene;             // its model is `textured`'s; without photographs for a model alone
  std::filesystem::path journal_file;
  // Of an output folder: the registrations, by photograph.
  std::map<std::string, Registration> registrations;
};

Document OpenDocument(const WindowOptions& options);

}  // namespace groundglass
