// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "ask/opened_folder.h"
#include "gui/window.h"
#include "session/session.h"

#include <filesystem>
#include <map>
#include <string>

namespace groundglass {

// What the window shows, as it lies on the disk.
struct Document {
  std::string title;
  OpenedFolder opened;
  std::filesystem::path journal_file;                 // nowhere without a scene
  std::map<std::string, Registration> registrations;  // by photograph
};

Document OpenDocument(const WindowOptions& options);

// Lets the work on each photograph start from what the run found of it, where the run's tag is the
// one that the scene still has. Those that were written anew since are left alone.
void StartFromTheRun(const Document& document, Session& session);

}  // namespace groundglass
