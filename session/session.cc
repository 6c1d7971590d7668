// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/session.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/view_io.h"
#include "session/pins_file.h"

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> BytesOf(const fs::path& file) {
  std::error_code ignored;
  if (file.empty() || !fs::is_regular_file(file, ignored)) return std::nullopt;
  return ReadFileBytes(file);
}

void Widen(double factor, TagSigmas& sigmas) {
  for (const SigmaKey& key : kSigmaKeys) {
    if (std::optional<double>& sigma = sigmas.*key.member) *sigma *= factor;
  }
}

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
  }
  return untagged;
}

}  // namespace

void SessionOptions::Check() const {
  solver.Check();
  rough.Check();
  CheckFromTo(max_undo_steps, 1, 1000000, "session options: max_undo_steps");
  CheckAbove(pin_sigma_px, 0, "session options: pin_sigma_px");
  CheckAtLeast(reopened_widening, 1, "session options: reopened_widening");
}

Session::Session(const Scene& scene, const fs::path& journal_file, const SessionOptions& options)
    : model_(scene.model),
      options_(options),
      pins_file_(scene.folder / "pins.points"),
      journal_(journal_file),
      has_journal_(!journal_file.empty()) {
  options_.Check();
  options_.solver.prior = PriorSuitedTo(model_, options_.solver.prior);
  if (!scene.camera_files.empty()) {
    tags_elsewhere_ = scene.camera_files.front().string() + " has this scene's cameras";
  } else if (fs::exists(scene.folder / "tags.csv")) {
    tags_elsewhere_ = (scene.folder / "tags.csv").string() +
                      " has this scene's tags; `convert` it to views/ to save tags from here";
  }
  loaded_pins_ = BytesOf(pins_file_);
  pins_on_disk_ = loaded_pins_;
  const auto pins_of = ParsePins(loaded_pins_.value_or(""), pins_file_);
  const auto find = [&](const std::string& name) {
    const auto found = pins_of.find(name);
    return found == pins_of.end() ? nullptr : &found->second;
  };
  for (const Photograph& photograph : scene.photographs) Add(photograph, "", find(photograph.name));
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    Add(unreadable.photograph, unreadable.reasons.front(), find(unreadable.photograph.name));
  }
  for (const Photograph& photograph : UntaggedOf(scene)) {
    Add(photograph, "", find(photograph.name));
    SessionPhotograph& added = photographs_.back();
    added.view_file = scene.folder / "views" / (added.name + ".view");
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

void Session::Add(const Photograph& photograph, const std::string& fault, const Pins* pins) {
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
  if (current.accepted) return CameraFromTag(*current.accepted, size.width, size.height);
  const std::optional<PinSolution>& solution = Solution(photograph);
  if (!solution) return std::nullopt;
  return CameraFromTag(solution->tag, size.width, size.height);
}

void Session::Set(int photograph, PhotographWork next) {
  states_[photograph].current = std::move(next);
  if (has_journal_) journal_.Append(photographs_[photograph].name, work(photograph));
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
  return !(states_[photograph].current == states_[photograph].saved);
}

bool Session::HasUnsaved() const { return !Unsaved().empty(); }

std::map<std::string, PhotographWork> Session::Unsaved() const {
  std::map<std::string, PhotographWork> unsaved;
  for (size_t i = 0; i < states_.size(); ++i) {
    if (IsUnsaved(static_cast<int>(i))) unsaved[photographs_[i].name] = states_[i].current;
  }
  return unsaved;
}

std::string Session::ViewBytes(int photograph) const {
  const std::optional<ViewTag> tag = TagOf(photograph);
  const State& state = states_[photograph];
  if (state.loaded_view && state.loaded.tag) {
    return FormatCorrectedView(*state.loaded_view, *tag, DeviationsOf(*tag));
  }
  return FormatView(*tag, "found by pins in `groundglass view`");
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

SaveResult Session::Save(int photograph, bool over_others) {
  State& state = states_[photograph];
  const SessionPhotograph& saved = photographs_[photograph];
  if (!IsUnsaved(photograph)) {
    return {SaveResult::Kind::kNothingToSave, saved.name + " is saved already"};
  }
  if (!tags_elsewhere_.empty()) {
    return {SaveResult::Kind::kFailed, "not saved: " + tags_elsewhere_};
  }
  try {
    if (!over_others &&
        (BytesOf(saved.view_file) != state.view_on_disk || BytesOf(pins_file_) != pins_on_disk_)) {
      return {SaveResult::Kind::kChangedOnDisk,
              saved.view_file.string() + " or " + pins_file_.filename().string() +
                  " was changed by somebody else since it was read"};
    }
    const PhotographWork& work = state.current;
    if (!(work.pins == Pins()) && saved.name.find_first_of(" \t") != std::string::npos) {
      throw Error("the name " + Quote(saved.name) +
                  " holds a blank, at which a points file parts its words; rename the photograph");
    }
    // What others wrote meanwhile for other photographs stays.
    const std::optional<std::string> on_disk = BytesOf(pins_file_);
    have_others_written_ = have_others_written_ || on_disk != pins_on_disk_;
    pins_on_disk_ = on_disk;
    std::optional<std::string> view;
    // What alignment said is in no file.
    if (!work.accepted && work.pins == state.loaded.pins && work.tag == state.loaded.tag) {
      view = state.loaded_view;
    } else if (TagOf(photograph)) {
      view = ViewBytes(photograph);
    }
    const std::optional<std::string> pins = PinsBytes(photograph);
    std::vector<FileToWrite> files;
    if (view) files.push_back({saved.view_file, *view});
    if (pins) files.push_back({pins_file_, *pins});
    WriteFilesAtomically(files);
    // What this session alone has made goes with what it was made for.
    if (!view && state.view_on_disk) fs::remove(saved.view_file);
    if (!pins && pins_on_disk_) fs::remove(pins_file_);
    state.view_on_disk = view;
    pins_on_disk_ = pins;
  } catch (const std::exception& error) {
    return {SaveResult::Kind::kFailed, std::string("not saved: ") + error.what()};
  }
  state.saved = state.current;
  EndGesture();
  if (has_journal_) journal_.Restart(Unsaved());
  return {SaveResult::Kind::kSaved, saved.name + " saved: " + saved.view_file.string()};
}

std::map<std::string, PhotographWork> Session::FindLeftWork() const {
  std::map<std::string, PhotographWork> left;
  if (!has_journal_) return left;
  for (auto& [name, work] : journal_.Read()) {
    const std::optional<int> photograph = FindPhotograph(name);
    if (photograph && !(states_[*photograph].saved == work)) left[name] = work;
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

void Session::DropLeftWork() {
  if (has_journal_) journal_.Restart(Unsaved());
}

void Session::ForgetJournal() {
  if (has_journal_) journal_.Restart({});
}

}  // namespace groundglass
