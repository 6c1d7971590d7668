// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/scene.h"
#include "scene/image.h"
#include "session/journal.h"
#include "session/photograph_work.h"
#include "session/pin_solver.h"
#include "session/snap.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct SessionOptions {
  PinSolverOptions solver;
  RoughPlaceOptions rough;
  SnapOptions snap;
  int max_undo_steps = 1000;
  double pin_sigma_px = 2;
  // A tag that was saved together with its pins knows of them already: its standard deviations
  // count so many times larger when the same pins are solved again.
  double reopened_widening = 4;

  void Check() const;  // throws Error naming the first field out of range
};

// A photograph as the session has it.
struct SessionPhotograph {
  std::string name;
  std::filesystem::path image_file;
  std::optional<std::filesystem::path> mask_file;
  ImageSize size;                   // 0 x 0 if it cannot be read
  std::filesystem::path view_file;  // where its tag is, or will be
  std::string fault;                // why it cannot be worked on; empty if it can
  std::optional<Lens> lens = {};    // where its tag says no view angle (Photograph)
};

class TagsTable;

// What became of saving.
struct SaveResult {
  enum class Kind { kSaved, kNothingToSave, kChangedOnDisk, kFailed };
  Kind kind = Kind::kSaved;
  std::string message;  // one line for a person
};

// The work on a scene's tags: what is decided about each photograph, with a history for each, a
// journal, and saving. Nothing of it is drawn here, and nothing of it is known to files only later:
// the `.view` files and pins.points that it writes are what the commands read. To be used by one
// thread.
class Session {
 public:
  // scene: as ScanScene reads it. journal: nowhere if its path is empty.
  Session(const Scene& scene,
          const std::filesystem::path& journal_file,
          const SessionOptions& options = {});

  const PolygonModel& model() const { return model_; }
  const SessionOptions& options() const { return options_; }
  const std::vector<SessionPhotograph>& photographs() const { return photographs_; }
  const std::filesystem::path& pins_file() const { return pins_file_; }
  std::optional<int> FindPhotograph(const std::string& name) const;
  // Where its mask is now; nothing: it has none.
  void SetMaskFile(int photograph, const std::optional<std::filesystem::path>& file) {
    photographs_[photograph].mask_file = file;
  }

  // What a run found of a photograph before anybody worked on it here: work starts from that
  // camera, with the standard deviations of the written tag, so that pins may still move it; undo
  // gives the notebook's. It counts as saved until something is changed. Only of a photograph that
  // has a tag, and that nobody has changed yet.
  void StartFrom(int photograph, const AlignmentNews& found);
  // Whether work started from what a run found, and nothing was saved since.
  bool HasFound(int photograph) const { return states_[photograph].found.has_value(); }
  // Whether the work is still what StartFrom made of it.
  bool IsAsFound(int photograph) const;
  // As the notebook has it: as it was loaded. One step.
  void BackToNotebook(int photograph) { Change(photograph, states_[photograph].loaded); }

  const PhotographWork& work(int photograph) const { return states_[photograph].current; }
  // The camera that the work comes to so far: what a run found as long as nothing is changed, the
  // accepted one, else that of the pins, else the tag's; nothing where nobody has said where it
  // stood.
  std::optional<Camera> CameraOf(int photograph) const;
  // Of the pins and the tag; nothing without a tag.
  const std::optional<PinSolution>& Solution(int photograph) const;
  // The tag that saving writes, with its standard deviations.
  std::optional<ViewTag> TagOf(int photograph) const;

  // Changes the work, as one step that can be undone. Steps of the same gesture that is not
  // ended become one.
  void Change(int photograph, PhotographWork next, const std::string& gesture = "");
  void EndGesture() { gesture_.clear(); }
  bool Undo(int photograph);  // false if there is nothing to undo
  bool Redo(int photograph);
  int UndoDepth(int photograph) const { return static_cast<int>(states_[photograph].done.size()); }

  bool IsUnsaved(int photograph) const;
  bool HasUnsaved() const;
  // Writes the photograph's view file and the pins. Where the work is what was loaded, the bytes
  // are, too. over_others: also if somebody else has changed the files since they were read.
  SaveResult Save(int photograph, bool over_others = false);

  // What an earlier session left unsaved of tags and pins, by photograph; taking it is one step for
  // each.
  std::map<std::string, PhotographWork> FindLeftWork() const;
  std::string LeftWorkIsOf() const { return journal_.LastStepAt(); }
  void TakeLeftWork();
  void DropLeftWork();
  // Where steps are kept, those of masks too (mask_desk.h).
  const Journal& journal() const { return journal_; }
  // Nothing of what is unsaved is offered again.
  void ForgetJournal() { journal_.Remove(); }

 private:
  struct State {
    PhotographWork loaded;
    std::optional<PhotographWork> found;  // what StartFrom made of it, until something is saved
    PhotographWork saved;
    PhotographWork current;
    std::vector<PhotographWork> done;         // states before, oldest first
    std::vector<PhotographWork> undone;       // states after, nearest last
    std::optional<std::string> loaded_view;   // bytes; nothing: there was no file
    std::optional<std::string> loaded_row;    // of tags.csv, where that has the tags
    std::optional<std::string> view_on_disk;  // as last read or written
    mutable std::optional<PinSolution> solution;
    mutable std::optional<ViewTag> solved_tag;  // of what `solution` was made
    mutable std::optional<Pins> solved_pins;
  };
  void Add(const Photograph& photograph,
           const std::string& fault,
           const Pins* pins,
           const std::optional<TagsTable>& table);
  void Set(int photograph, PhotographWork work);
  std::map<std::string, PhotographWork> Unsaved() const;
  bool IsTagAsLoaded(int photograph, const PhotographWork& work) const;
  std::string ViewBytes(int photograph) const;
  std::string TableBytes(int photograph) const;
  void SaveFiles(int photograph);
  std::optional<std::string> PinsBytes(int photograph) const;

  PolygonModel model_;
  SessionOptions options_;
  std::filesystem::path pins_file_;
  std::optional<std::string> loaded_pins_;
  bool have_others_written_ = false;  // into the file of pins, since it was loaded
  std::optional<std::string> pins_on_disk_;
  // Where tags are rows of tags.csv: it, as loaded and as last read or written; else empty.
  std::filesystem::path tags_table_;
  std::string loaded_table_;
  std::optional<std::string> table_on_disk_;
  bool have_others_written_table_ = false;
  std::string tags_elsewhere_;  // why view files cannot be written; empty if they can
  std::vector<SessionPhotograph> photographs_;
  std::vector<State> states_;
  Journal journal_;
  std::string gesture_;
};

}  // namespace groundglass
