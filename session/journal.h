// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "session/mask_step.h"
#include "session/photograph_work.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace groundglass {

// A step of a mask, and which mask it was painted on.
struct JournalMaskStep {
  std::string mask_key;  // MaskKey of its file when that was last read or written
  MaskStep step;

  bool operator==(const JournalMaskStep&) const = default;
};

// What an earlier session has left in the journal, by photograph.
struct JournalContents {
  std::map<std::string, PhotographWork> works;                     // the last of each
  std::map<std::string, std::vector<JournalMaskStep>> mask_steps;  // as they were done
  int num_unreadable = 0;  // lines that were cut short, or another version's
};

// Every step is written here as it is done, so that work outlives a program that is ended on the
// spot, as Xlib does when the display goes. One line for each step of a photograph's tag and pins,
// and of its mask; a line that is cut short is left out. A folder that cannot be written to does
// without.
class Journal {
 public:
  // The journal of a scene: in the user's own folder of states, by the scene's place.
  static std::filesystem::path PlaceFor(const std::filesystem::path& scene_folder);

  // Nothing is kept if the path is empty.
  explicit Journal(const std::filesystem::path& file) : file_(file) {}

  JournalContents Read() const;
  // When its last step was written, "14:02"; empty if there is none.
  std::string LastStepAt() const;
  void Append(const std::string& photograph, const PhotographWork& work) const;
  void Append(const std::string& photograph, const JournalMaskStep& step) const;
  // Begin anew with what is unsaved now, of the one kind; lines of the other stay. Without any left
  // the file goes.
  void RestartWorks(const std::map<std::string, PhotographWork>& unsaved) const;
  void RestartMasks(const std::map<std::string, JournalMaskStep>& unsaved) const;
  // Nothing is left.
  void Remove() const;

 private:
  void AppendLine(const std::string& line) const;
  void Restart(bool keeps_masks, const std::string& lines) const;

  std::filesystem::path file_;
};

}  // namespace groundglass
