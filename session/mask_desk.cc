// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/mask_desk.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/output_folder.h"
#include "scene/text.h"
#include "session/file_bytes.h"

namespace groundglass {

namespace fs = std::filesystem;

namespace {

std::string UnsavedSteps(int count) {
  return std::to_string(count) + (count == 1 ? " unsaved step" : " unsaved steps");
}

}  // namespace

std::string MaskKey(const std::optional<std::string>& bytes) {
  return bytes ? HashText(*bytes) : "none";
}

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
  Desk desk = {std::move(paint), loaded, loaded, file, bytes, bytes, MaskKey(bytes)};
  Desk& opened = desks_.emplace(photograph, std::move(desk)).first->second;
  opened.paint.TellSteps([this, photograph](const MaskStep& step) {
    session_.journal().Append(session_.photographs()[photograph].name,
                              JournalMaskStep{desks_.at(photograph).key, step});
  });
  return opened.paint;
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
    desk.key = MaskKey(bytes);
    session_.SetMaskFile(photograph, bytes ? std::optional<fs::path>(desk.file) : std::nullopt);
  } catch (const std::exception& error) {
    return {SaveResult::Kind::kFailed, std::string("not saved: ") + error.what()};
  }
  desk.saved = desk.paint.ignore();
  desk.compared_version = -1;
  RestartJournal();
  return {SaveResult::Kind::kSaved, "the mask of " + name + " is saved: " + desk.file.string()};
}

// With what is unsaved now, each mask in one step.
void MaskDesk::RestartJournal() const {
  std::map<std::string, JournalMaskStep> unsaved;
  for (const auto& [photograph, desk] : desks_) {
    const Image8& ignore = desk.paint.ignore();
    if (const std::optional<MaskPart> part = FindChangedPart(desk.saved, ignore)) {
      const std::string& name = session_.photographs()[photograph].name;
      unsaved[name] = {desk.key, MaskStepOf(ignore, *part)};
    }
  }
  session_.journal().RestartMasks(unsaved);
}

// Of one photograph.
LeftMasks MaskDesk::CheckedSteps(int photograph, const std::vector<JournalMaskStep>& steps) {
  LeftMasks left;
  const SessionPhotograph& of = session_.photographs()[photograph];
  const std::string mask = "the mask of " + of.name;
  int num_others = 0;
  int num_unfit = 0;
  try {
    Image8 ignore = Paint(photograph).ignore();
    std::vector<MaskStep> fit;
    for (const JournalMaskStep& journalled : steps) {
      if (journalled.mask_key != desks_.at(photograph).key) {
        ++num_others;
      } else if (!Fits(journalled.step, of.size)) {
        ++num_unfit;
      } else {
        fit.push_back(journalled.step);
        PutMaskStep(journalled.step, ignore);
      }
    }
    if (ignore.values != Paint(photograph).ignore().values) left.steps[photograph] = fit;
  } catch (const Error& error) {
    left.left_out.push_back(mask + ": " + UnsavedSteps(static_cast<int>(steps.size())) +
                            " left out: " + error.what());
  }
  if (num_others > 0) {
    left.left_out.push_back(mask + ": " + UnsavedSteps(num_others) +
                            " left out: somebody else has changed it since");
  }
  if (num_unfit > 0) {
    left.left_out.push_back(mask + ": " + UnsavedSteps(num_unfit) +
                            " left out: they do not fit the photograph");
  }
  return left;
}

LeftMasks MaskDesk::FindLeftWork() {
  LeftMasks left;
  const JournalContents contents = session_.journal().Read();
  for (const auto& [name, steps] : contents.mask_steps) {
    const std::optional<int> photograph = session_.FindPhotograph(name);
    if (!photograph) {
      left.left_out.push_back("the mask of " + name + ": " +
                              UnsavedSteps(static_cast<int>(steps.size())) +
                              " left out: there is no such photograph any more");
      continue;
    }
    LeftMasks of = CheckedSteps(*photograph, steps);
    left.steps.merge(of.steps);
    left.left_out.insert(left.left_out.end(), of.left_out.begin(), of.left_out.end());
  }
  if (contents.num_unreadable > 0) {
    left.left_out.push_back("the journal: " + UnsavedSteps(contents.num_unreadable) +
                            " left out: cut short, or another version's");
  }
  return left;
}

void MaskDesk::TakeLeftWork(const LeftMasks& left) {
  for (const auto& [photograph, steps] : left.steps) Paint(photograph).Put(steps);
  RestartJournal();
}

}  // namespace groundglass
