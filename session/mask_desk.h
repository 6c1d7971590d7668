// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "session/mask_paint.h"
#include "session/session.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// By which a journal knows a mask's file again; nothing: there is none.
std::string MaskKey(const std::optional<std::string>& bytes);

// What an earlier session painted and did not save.
struct LeftMasks {
  std::map<int, std::vector<MaskStep>>
      steps;                          // to be put onto the masks as they are; by photograph
  std::vector<std::string> left_out;  // what else it did, and why it is lost; a line each
};

// The masks of a session's photographs: each is read when it is first asked for, painted, and saved
// as masks/NAME.png. A mask that was there stays what undo leads back to, to its last byte. Every
// step that is done goes into the session's journal. To be used by one thread.
class MaskDesk {
 public:
  // session must outlive it; it is told where masks are that are saved.
  MaskDesk(Session& session, const std::filesystem::path& scene_folder)
      : session_(session), folder_(scene_folder / "masks") {}
  // Its masks tell it of their steps.
  MaskDesk(const MaskDesk&) = delete;
  MaskDesk& operator=(const MaskDesk&) = delete;

  // Throws Error if there is a mask that cannot be read, or no size of the photograph.
  MaskPaint& Paint(int photograph);
  bool IsUnsaved(int photograph) const;
  bool HasUnsaved() const;
  // Writes the mask; where it is as it was read, the first bytes, or no file if there was none.
  // over_others: also if somebody else has changed the file since it was read.
  SaveResult Save(int photograph, bool over_others = false);

  // Steps count only on the mask that they were painted on: where somebody has changed it since,
  // they are left out.
  LeftMasks FindLeftWork();
  // One step for each mask.
  void TakeLeftWork(const LeftMasks& left);
  void DropLeftWork() { RestartJournal(); }

 private:
  struct Desk {
    MaskPaint paint;
    Image8 loaded;                            // as it was read
    Image8 saved;                             // as it is on the disk
    std::filesystem::path file;               // where it is, or will be
    std::optional<std::string> loaded_bytes;  // nothing: there was no file
    std::optional<std::string> bytes_on_disk;
    std::string key;                    // MaskKey of bytes_on_disk
    mutable int compared_version = -1;  // of the paint, for which this holds:
    mutable bool is_unsaved = false;
  };
  void RestartJournal() const;
  LeftMasks CheckedSteps(int photograph, const std::vector<JournalMaskStep>& steps);

  Session& session_;
  std::filesystem::path folder_;
  std::map<int, Desk> desks_;
};

}  // namespace groundglass
