// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/mask_desk.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/ignore_mask.h"
#include "scene/text.h"
#include "session/file_bytes.h"

namespace groundglass {

namespace fs = std::filesystem;

MaskPaint& MaskDesk::Paint(int photograph) {
  const auto open = desks_.find(photograph);
  if (open != desks_.end()) return open->second.paint;
  const SessionPhotograph& of = session_.photographs()[photograph];
  if (of.size.width == 0) throw Error(of.image_file, "cannot be read, so it has no mask");
  const fs::path file = of.mask_file.value_or(folder_ / (of.name + ".png"));
  std::optional<std::string> bytes = BytesOf(file);
  Image8 ignore;
  if (bytes) ignore = ReadIgnoreMask(file, of.size);
  MaskPaint paint(of.size, std::move(ignore));
  const Image8 loaded = paint.ignore();
  return desks_.emplace(photograph, Desk{std::move(paint), loaded, loaded, file, bytes, bytes})
      .first->second.paint;
}

bool MaskDesk::IsUnsaved(int photograph) const {
  const auto open = desks_.find(photograph);
  if (open == desks_.end()) return false;
  const Desk& desk = open->second;
  if (desk.compared_version != desk.paint.version()) {
    desk.compared_version = desk.paint.version();
    desk.is_unsaved = desk.paint.ignore().values != desk.saved.values;
  }
  return desk.is_unsaved;
}

bool MaskDesk::HasUnsaved() const {
  for (const auto& [photograph, desk] : desks_) {
    if (IsUnsaved(photograph)) return true;
  }
  return false;
}

SaveResult MaskDesk::Save(int photograph, bool over_others) {
  const std::string& name = session_.photographs()[photograph].name;
  if (!IsUnsaved(photograph)) {
    return {SaveResult::Kind::kNothingToSave, "the mask of " + name + " is saved already"};
  }
  Desk& desk = desks_.at(photograph);
  if (LowerCase(desk.file.extension().string()) != ".png") {
    return {SaveResult::Kind::kFailed,
            "not saved: the mask of " + name + " is " + desk.file.string() +
                ", which is no .png; make it one first"};
  }
  try {
    if (!over_others && BytesOf(desk.file) != desk.bytes_on_disk) {
      return {SaveResult::Kind::kChangedOnDisk,
              desk.file.string() + " was changed by somebody else since it was read"};
    }
    std::optional<std::string> bytes = desk.loaded_bytes;
    if (desk.paint.ignore().values != desk.loaded.values) {
      bytes = std::string(AsText(EncodeImage(desk.paint.ignore(), ".png")));
    }
    if (bytes) {
      WriteFileAtomically(desk.file, *bytes);
    } else {
      fs::remove(desk.file);
    }
    desk.bytes_on_disk = bytes;
    session_.SetMaskFile(photograph, bytes ? std::optional<fs::path>(desk.file) : std::nullopt);
  } catch (const std::exception& error) {
    return {SaveResult::Kind::kFailed, std::string("not saved: ") + error.what()};
  }
  desk.saved = desk.paint.ignore();
  desk.compared_version = -1;
  return {SaveResult::Kind::kSaved, "the mask of " + name + " is saved: " + desk.file.string()};
}

}  // namespace groundglass
