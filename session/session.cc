// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/session.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/image_paths.h"
#include "session/file_bytes.h"
#include "session/pins_file.h"
#include "session/reason_note.h"
#include "session/tags_table.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

void Widen(double factor, TagSigmas& sigmas) {
  for (const SigmaKey& key : kSigmaKeys) {
    if (std::optional<double>& sigma = sigmas.*key.member) *sigma *= factor;
  }
}

std::vector<Photograph> UntaggedOf(const Scene& scene) {
  std::vector<fs::path> files = scene.untagged_images;
  for (const Photograph& photograph : scene.photographs) files.push_back(photograph.image_file);
  std::vector<std::string> paths;
  for (const fs::path& file : files) {
    paths.push_back(file.lexically_relative(scene.folder / "images").generic_string());
  }
  const std::vector<std::string> names = NamePhotographs(paths);
  std::vector<Photograph> untagged;
  for (size_t i = 0; i < scene.untagged_images.size(); ++i) {
    Photograph& photograph = untagged.emplace_back();
    photograph.name = names[i];
    photograph.image_file = files[i];
    const auto mask = scene.masks_of_untagged.find(files[i]);
    if (mask != scene.masks_of_untagged.end()) photograph.mask_file = mask->second;
  }
  return untagged;
}

}  // namespace

void SessionOptions::Check() const {
  solver.Check();
  rough.Check();
  snap.Check();
  CheckFromTo(max_undo_steps, 1, 1000000, "session options: max_undo_steps");
  CheckAbove(pin_sigma_px, 0, "session options: pin_sigma_px");
  CheckAtLeast(reopened_widening, 1, "session options: reopened_widening");
}

Session::Session(const Scene& scene, const fs::path& journal_file, const SessionOptions& options)
    : model_(scene.model),
      options_(options),
      pins_file_(scene.folder / "pins.points"),
      journal_(journal_file) {
  options_.Check();
  options_.solver.prior = PriorSuitedTo(model_, options_.solver.prior);
  if (!scene.camera_files.empty()) {
    tags_elsewhere_ = scene.camera_files.front().string() + " has this scene's cameras";
  } else if (const fs::path table = scene.folder / "tags.csv";
             fs::exists(table) && !fs::is_directory(scene.folder / "views")) {
    tags_table_ = table;
    table_on_disk_ = BytesOf(table);
    loaded_table_ = table_on_disk_.value_or("");
  }
  loaded_pins_ = BytesOf(pins_file_);
  pins_on_disk_ = loaded_pins_;
  const auto pins_of = ParsePins(loaded_pins_.value_or(""), pins_file_);
  const auto find = [&](const std::string& name) {
    const auto found = pins_of.find(name);
    return found == pins_of.end() ? nullptr : &found->second;
  };
  std::optional<TagsTable> table;
  if (!tags_table_.empty()) {
    try {
      table.emplace(tags_table_, loaded_table_);
    } catch (const Error&) {
      // Saving will say why it cannot be written.
    }
  }
  for (const Photograph& photograph : scene.photographs) {
    Add(photograph, "", find(photograph.name), table);
  }
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    const Photograph& photograph = unreadable.photograph;
    Add(photograph, unreadable.reasons.front(), find(photograph.name), table);
  }
  for (const Photograph& photograph : UntaggedOf(scene)) {
    Add(photograph, "", find(photograph.name), table);
    SessionPhotograph& added = photographs_.back();
    // A folder views/ would take the table's place.
    if (tags_table_.empty()) added.view_file = scene.folder / "views" / (added.name + ".view");
    State& state = states_.back();
    state.loaded.tag = state.saved.tag = state.current.tag = std::nullopt;
    // One that is yet to be filled in, or is at fault.
    state.loaded_view = state.view_on_disk = BytesOf(added.view_file);
    try {
      added.size = ReadImageSize(added.image_file);
    } catch (const Error& error) {
      added.fault = error.what();
    }
  }
}

void Session::Add(const Photograph& photograph,
                  const std::string& fault,
                  const Pins* pins,
                  const std::optional<TagsTable>& table) {
  photographs_.push_back({photograph.name,
                          photograph.image_file,
                          photograph.mask_file,
                          photograph.size,
                          photograph.view_file,
                          fault,
                          photograph.lens});
  State& state = states_.emplace_back();
  state.loaded_view = state.view_on_disk = BytesOf(photograph.view_file);
  state.loaded.tag = photograph.tag;
  state.loaded.overruled = ReasonIn(state.loaded_view.value_or(""));
  if (table) {
    state.loaded_row = table->Row(photograph.name);
    state.loaded.overruled = TagsTable::ReasonOf(state.loaded_row.value_or(""));
  }
  if (pins != nullptr) {
    state.loaded.pins = *pins;
    Widen(options_.reopened_widening, state.loaded.tag->sigmas);
  }
  state.saved = state.current = state.loaded;
}

std::optional<int> Session::FindPhotograph(const std::string& name) const {
  for (size_t i = 0; i < photographs_.size(); ++i) {
    if (photographs_[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

void Session::StartFrom(int photograph, const AlignmentNews& found) {
  State& state = states_[photograph];
  if (!state.loaded.tag || !state.done.empty()) return;
  PhotographWork work = state.loaded;
  work.alignment = found;
  work.tag = found.corrected;
  work.tag->sigmas = state.loaded.tag->sigmas;
  work.tag->camera = state.loaded.tag->camera;
  if (found.verdict == Verdict::kAccepted) work.accepted = found.corrected;
  state.found = work;
  state.done.push_back(state.current);
  state.current = std::move(work);
}

bool Session::IsAsFound(int photograph) const {
  return states_[photograph].found && states_[photograph].current == *states_[photograph].found;
}

const std::optional<PinSolution>& Session::Solution(int photograph) const {
  const State& state = states_[photograph];
  const PhotographWork& current = state.current;
  if (!current.tag) {
    state.solution.reset();
    state.solved_tag.reset();
    return state.solution;
  }
  if (state.solution && state.solved_tag == current.tag && state.solved_pins == current.pins) {
    return state.solution;
  }
  const ImageSize& size = photographs_[photograph].size;
  // From the last solution on, so that the model follows the hand.
  std::optional<ViewTag> start;
  if (state.solution && state.solution->is_solved && state.solved_tag == current.tag) {
    start = state.solution->tag;
  }
  state.solution = SolvePins(*current.tag,
                             start,
                             size.width,
                             size.height,
                             model_.unit,
                             photographs_[photograph].lens,
                             current.pins,
                             options_.solver);
  state.solved_tag = current.tag;
  state.solved_pins = current.pins;
  return state.solution;
}

std::optional<ViewTag> Session::TagOf(int photograph) const {
  const PhotographWork& current = work(photograph);
  if (current.accepted) return current.accepted;
  if (!current.tag) return std::nullopt;
  // What was loaded is written as it was.
  if (current.pins == states_[photograph].loaded.pins &&
      current.tag == states_[photograph].loaded.tag) {
    return current.tag;
  }
  const std::optional<PinSolution>& solution = Solution(photograph);
  const bool are_enough =
      std::count_if(current.pins.points.begin(),
                    current.pins.points.end(),
                    [](const PointPin& pin) { return pin.use == PinUse::kUsed; }) +
          std::count_if(current.pins.lines.begin(),
                        current.pins.lines.end(),
                        [](const LinePin& pin) { return pin.use == PinUse::kUsed; }) >=
      3;
  if (!solution->is_solved) return current.tag;
  return are_enough ? TagToSave(*solution) : solution->tag;
}

std::optional<Camera> Session::CameraOf(int photograph) const {
  const PhotographWork& current = work(photograph);
  const ImageSize& size = photographs_[photograph].size;
  if (size.width == 0) return std::nullopt;
  if (IsAsFound(photograph)) {
    return CameraFromTag(current.alignment->corrected, size.width, size.height);
  }
  if (current.accepted) return CameraFromTag(*current.accepted, size.width, size.height);
  const std::optional<PinSolution>& solution = Solution(photograph);
  if (!solution) return std::nullopt;
  return CameraFromTag(solution->tag, size.width, size.height);
}

void Session::Set(int photograph, PhotographWork next) {
  states_[photograph].current = std::move(next);
  journal_.Append(photographs_[photograph].name, work(photograph));
}

void Session::Change(int photograph, PhotographWork next, const std::string& gesture) {
  State& state = states_[photograph];
  if (next == state.current) return;
  const std::string own = gesture.empty() ? "" : std::to_string(photograph) + gesture;
  const bool goes_on = !own.empty() && own == gesture_ && !state.done.empty();
  if (!goes_on) state.done.push_back(state.current);
  if (state.done.size() > static_cast<size_t>(options_.max_undo_steps)) {
    state.done.erase(state.done.begin());
  }
  state.undone.clear();
  gesture_ = own;
  Set(photograph, std::move(next));
}

bool Session::Undo(int photograph) {
  State& state = states_[photograph];
  EndGesture();
  if (state.done.empty()) return false;
  state.undone.push_back(state.current);
  PhotographWork before = std::move(state.done.back());
  state.done.pop_back();
  Set(photograph, std::move(before));
  return true;
}

bool Session::Redo(int photograph) {
  State& state = states_[photograph];
  EndGesture();
  if (state.undone.empty()) return false;
  state.done.push_back(state.current);
  PhotographWork after = std::move(state.undone.back());
  state.undone.pop_back();
  Set(photograph, std::move(after));
  return true;
}

bool Session::IsUnsaved(int photograph) const {
  return !(states_[photograph].current == states_[photograph].saved) && !IsAsFound(photograph);
}

bool Session::HasUnsaved() const { return !Unsaved().empty(); }

std::map<std::string, PhotographWork> Session::Unsaved() const {
  std::map<std::string, PhotographWork> unsaved;
  for (size_t i = 0; i < states_.size(); ++i) {
    if (IsUnsaved(static_cast<int>(i))) unsaved[photographs_[i].name] = states_[i].current;
  }
  return unsaved;
}

std::map<std::string, PhotographWork> Session::FindLeftWork() const {
  std::map<std::string, PhotographWork> left;
  for (const auto& [name, work] : journal_.Read().works) {
    const std::optional<int> photograph = FindPhotograph(name);
    if (!photograph || states_[*photograph].saved == work) continue;
    if (states_[*photograph].found == work) continue;
    left[name] = work;
  }
  return left;
}

void Session::TakeLeftWork() {
  for (auto& [name, work] : FindLeftWork()) {
    if (const std::optional<int> photograph = FindPhotograph(name)) {
      Change(*photograph, std::move(work));
    }
  }
}

void Session::DropLeftWork() { journal_.RestartWorks(Unsaved()); }

}  // namespace groundglass
