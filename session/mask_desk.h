// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "session/mask_paint.h"
#include "session/session.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace groundglass {

// The masks of a session's photographs: each is read when it is first asked for, painted, and saved
// as masks/NAME.png. A mask that was there stays what undo leads back to, to its last byte. To be
// used by one thread.
class MaskDesk {
 public:
  // session must outlive it; it is told where masks are that are saved.
  MaskDesk(Session& session, const std::filesystem::path& scene_folder)
      : session_(session), folder_(scene_folder / "masks") {}

  // Throws Error if there is a mask that cannot be read, or no size of the photograph.
  MaskPaint& Paint(int photograph);
  bool IsUnsaved(int photograph) const;
  bool HasUnsaved() const;
  // Writes the mask; where it is as it was read, the first bytes, or no file if there was none.
  // over_others: also if somebody else has changed the file since it was read.
  SaveResult Save(int photograph, bool over_others = false);

 private:
  struct Desk {
    MaskPaint paint;
    Image8 loaded;                            // as it was read
    Image8 saved;                             // as it is on the disk
    std::filesystem::path file;               // where it is, or will be
    std::optional<std::string> loaded_bytes;  // nothing: there was no file
    std::optional<std::string> bytes_on_disk;
    mutable int compared_version = -1;  // of the paint, for which this holds:
    mutable bool is_unsaved = false;
  };
  Session& session_;
  std::filesystem::path folder_;
  std::map<int, Desk> desks_;
};

}  // namespace groundglass
