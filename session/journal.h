// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "session/photograph_work.h"

#include <filesystem>
#include <map>
#include <string>

namespace groundglass {

// Every step is written here as it is done, so that work outlives a program that is ended on the
// spot, as Xlib does when the display goes. One line for each step; a last line that is cut short
// is left out. A folder that cannot be written to does without.
class Journal {
 public:
  // The journal of a scene: in the user's own folder of states, by the scene's place.
  static std::filesystem::path PlaceFor(const std::filesystem::path& scene_folder);

  explicit Journal(const std::filesystem::path& file) : file_(file) {}

  // The last state of each photograph that an earlier session left unsaved; empty if none did.
  std::map<std::string, PhotographWork> Read() const;
  // When its last step was written, "14:02"; empty if there is none.
  std::string LastStepAt() const;
  void Append(const std::string& photograph, const PhotographWork& work) const;
  // Begins anew with what is unsaved now; without any the file goes.
  void Restart(const std::map<std::string, PhotographWork>& unsaved) const;

 private:
  std::filesystem::path file_;
};

}  // namespace groundglass
