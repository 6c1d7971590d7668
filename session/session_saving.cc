// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "session/file_bytes.h"
#include "session/pins_file.h"
#include "session/reason_note.h"
#include "session/session.h"
#include "session/tags_table.h"

#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

TagDeviations DeviationsOf(const ViewTag& tag) {
  TagDeviations deviations = {};
  const auto set = [&](TagKey key, const std::optional<double>& sigma) {
    deviations[static_cast<size_t>(key)] = sigma.value_or(0);
  };
  for (const TagKey key : {TagKey::kX, TagKey::kY}) set(key, tag.sigmas.position);
  set(TagKey::kZ, tag.sigmas.height);
  for (const TagKey key : {TagKey::kI, TagKey::kJ, TagKey::kK}) set(key, tag.sigmas.lookat);
  set(TagKey::kRoll, tag.sigmas.roll_deg);
  set(TagKey::kV, tag.sigmas.view_angle_deg);
  set(TagKey::kA, tag.sigmas.aspect);
  for (const TagKey key : {TagKey::kShiftX, TagKey::kShiftY}) set(key, tag.sigmas.shift);
  set(TagKey::kK1, tag.sigmas.k1);
  return deviations;
}

}  // namespace

std::string Session::ViewBytes(int photograph) const {
  const std::optional<ViewTag> tag = TagOf(photograph);
  const State& state = states_[photograph];
  if (state.loaded_view && state.loaded.tag) {
    return WithReason(FormatCorrectedView(*state.loaded_view, *tag, DeviationsOf(*tag)),
                      state.current.overruled);
  }
  return WithReason(FormatView(*tag, "found by pins in `groundglass view`"),
                    state.current.overruled);
}

// Nothing: there is no file.
std::optional<std::string> Session::PinsBytes(int photograph) const {
  bool are_loaded = !have_others_written_;
  for (size_t i = 0; i < states_.size(); ++i) {
    const State& state = states_[i];
    const bool is_written = static_cast<int>(i) == photograph;
    const PhotographWork& shown = is_written ? state.current : state.saved;
    if (!(shown.pins == state.loaded.pins)) are_loaded = false;
  }
  if (are_loaded) return loaded_pins_;
  const std::string text =
      ReplacePins(pins_on_disk_.value_or(""), photographs_[photograph].name, work(photograph).pins);
  if (text.empty()) return std::nullopt;
  return text;
}

// What alignment said is in no file.
bool Session::IsTagAsLoaded(int photograph, const PhotographWork& work) const {
  const PhotographWork& loaded = states_[photograph].loaded;
  return !work.accepted && work.pins == loaded.pins && work.tag == loaded.tag &&
         work.overruled == loaded.overruled;
}

std::string Session::TableBytes(int photograph) const {
  bool are_loaded = !have_others_written_table_;
  for (int i = 0; i < static_cast<int>(states_.size()); ++i) {
    const PhotographWork& shown = i == photograph ? states_[i].current : states_[i].saved;
    if (!IsTagAsLoaded(i, shown)) are_loaded = false;
  }
  if (are_loaded) return loaded_table_;
  const TagsTable table(tags_table_, table_on_disk_.value_or(""));
  const State& state = states_[photograph];
  const std::string& name = photographs_[photograph].name;
  const std::optional<ViewTag> tag = TagOf(photograph);
  if (IsTagAsLoaded(photograph, state.current) || !tag) return table.With(name, state.loaded_row);
  return table.With(name, table.FormatRow(name, *tag, state.current.overruled));
}

// All files of one photograph at once. What others wrote meanwhile for other photographs stays.
void Session::SaveFiles(int photograph) {
  State& state = states_[photograph];
  const SessionPhotograph& saved = photographs_[photograph];
  const std::optional<std::string> on_disk = BytesOf(pins_file_);
  have_others_written_ = have_others_written_ || on_disk != pins_on_disk_;
  pins_on_disk_ = on_disk;
  std::vector<FileToWrite> files;
  std::optional<std::string> view;
  std::string table;
  if (!tags_table_.empty()) {
    const std::optional<std::string> table_now = BytesOf(tags_table_);
    have_others_written_table_ = have_others_written_table_ || table_now != table_on_disk_;
    table_on_disk_ = table_now;
    table = TableBytes(photograph);
    files.push_back({tags_table_, table});
  } else {
    if (IsTagAsLoaded(photograph, state.current)) {
      view = state.loaded_view;
    } else if (TagOf(photograph)) {
      view = ViewBytes(photograph);
    }
    if (view) files.push_back({saved.view_file, *view});
  }
  const std::optional<std::string> pins = PinsBytes(photograph);
  if (pins) files.push_back({pins_file_, *pins});
  WriteFilesAtomically(files);
  // What this session alone has made goes with what it was made for.
  if (tags_table_.empty() && !view && state.view_on_disk) fs::remove(saved.view_file);
  if (!pins && pins_on_disk_) fs::remove(pins_file_);
  if (!tags_table_.empty()) table_on_disk_ = table;
  state.view_on_disk = view;
  pins_on_disk_ = pins;
}

SaveResult Session::Save(int photograph, bool over_others) {
  State& state = states_[photograph];
  const SessionPhotograph& saved = photographs_[photograph];
  if (state.current == state.saved) {
    return {SaveResult::Kind::kNothingToSave, saved.name + " is saved already"};
  }
  if (IsAsFound(photograph) && !state.current.accepted) {
    return {SaveResult::Kind::kNothingToSave,
            saved.name + " is in review, and nobody has taken what the run found"};
  }
  if (!tags_elsewhere_.empty()) {
    return {SaveResult::Kind::kFailed, "not saved: " + tags_elsewhere_};
  }
  const fs::path& place = tags_table_.empty() ? saved.view_file : tags_table_;
  try {
    const bool is_tag_as_read = tags_table_.empty() ? BytesOf(saved.view_file) == state.view_on_disk
                                                    : BytesOf(tags_table_) == table_on_disk_;
    if (!over_others && (!is_tag_as_read || BytesOf(pins_file_) != pins_on_disk_)) {
      return {SaveResult::Kind::kChangedOnDisk,
              place.string() + " or " + pins_file_.filename().string() +
                  " was changed by somebody else since it was read"};
    }
    const PhotographWork& work = state.current;
    if (!(work.pins == Pins()) && saved.name.find_first_of(" \t") != std::string::npos) {
      throw Error("the name " + Quote(saved.name) +
                  " holds a blank, at which a points file parts its words; rename the photograph");
    }
    SaveFiles(photograph);
  } catch (const std::exception& error) {
    return {SaveResult::Kind::kFailed, std::string("not saved: ") + error.what()};
  }
  state.saved = state.current;
  state.found.reset();
  EndGesture();
  journal_.RestartWorks(Unsaved());
  std::string message = saved.name + " saved: " + place.string();
  if (const auto tag = TagOf(photograph); tag && !tags_table_.empty()) {
    const std::string lost = TagsTable(tags_table_, *table_on_disk_).SigmasWithoutColumn(*tag);
    if (!lost.empty()) message += ", which has no column for " + lost + " and does not keep it";
  }
  return {SaveResult::Kind::kSaved, message};
}

}  // namespace groundglass
