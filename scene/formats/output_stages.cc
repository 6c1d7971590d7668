// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/output_stages.h"

#include "scene/error.h"

#include <algorithm>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// A record is a text file that anybody may write: only names that stay inside the folder are ours.
bool IsInside(const fs::path& file) {
  const fs::path normal = file.lexically_normal();
  return !normal.empty() && normal.is_relative() && *normal.begin() != ".." && normal != ".";
}

}  // namespace

OutputStages::OutputStages(const fs::path& folder, Manifest manifest)
    : folder_(folder), manifest_(std::move(manifest)) {
  if (std::optional<Manifest> before = ReadManifest(folder)) {
    manifest_.stages = std::move(before->stages);
  }
}

StageRecord* OutputStages::Find(const std::string& stage) {
  return const_cast<StageRecord*>(std::as_const(*this).Find(stage));
}

const StageRecord* OutputStages::Find(const std::string& stage) const {
  const auto found = std::find_if(manifest_.stages.begin(),
                                  manifest_.stages.end(),
                                  [&](const StageRecord& record) { return record.name == stage; });
  return found == manifest_.stages.end() ? nullptr : &*found;
}

void OutputStages::Remove(const std::string& file) const {
  if (!IsInside(file)) return;
  std::error_code ignored;
  if (fs::is_directory(folder_ / file, ignored)) return;
  fs::remove(folder_ / file, ignored);
  // Folders that have become empty were made for it.
  for (fs::path parent = fs::path(file).parent_path();
       !parent.empty() && fs::remove(folder_ / parent, ignored);
       parent = parent.parent_path()) {
  }
}

std::string OutputStages::HashOf(const std::string& file) const {
  std::error_code failure;
  const fs::file_time_type written_at = fs::last_write_time(folder_ / file, failure);
  const uintmax_t size = failure ? 0 : fs::file_size(folder_ / file, failure);
  if (failure || !IsInside(file)) return "";
  Hashed& hashed = hashes_[file];
  if (hashed.sha256.empty() || hashed.written_at != written_at || hashed.size != size) {
    try {
      hashed = {written_at, size, HashFile(folder_ / file)};
    } catch (const Error&) {
      return "";
    }
  }
  return hashed.sha256;
}

bool OutputStages::IsAsRecorded(const StageRecord& record, const std::string& file) const {
  const auto known = record.sha256_of_files.find(file);
  return known == record.sha256_of_files.end() || HashOf(file) == known->second;
}

std::vector<std::string> OutputStages::FindChanged(const std::string& stage) const {
  std::vector<std::string> changed;
  const StageRecord* record = Find(stage);
  if (!record) return changed;
  for (const std::string& file : record->files) {
    if (!IsInside(file) || !fs::is_regular_file(folder_ / file)) continue;
    if (!IsAsRecorded(*record, file)) changed.push_back(file);
  }
  return changed;
}

void OutputStages::KeepOnly(const std::string& stage, const std::string& key) {
  const StageRecord* record = Find(stage);
  if (!record || record->key == key) return;
  for (const std::string& file : record->files) Remove(file);
  std::erase_if(manifest_.stages, [&](const StageRecord& other) { return other.name == stage; });
}

bool OutputStages::IsFrom(const std::string& stage, const std::string& key) const {
  const StageRecord* record = Find(stage);
  return record && record->key == key;
}

bool OutputStages::IsComplete(const std::string& stage, const std::string& key) const {
  const StageRecord* record = Find(stage);
  if (!record || !record->is_complete || record->key != key) return false;
  const auto is_there = [&](const std::string& file) {
    return fs::is_regular_file(folder_ / file);
  };
  // Names before bytes, which take longer.
  return std::all_of(record->files.begin(), record->files.end(), is_there) &&
         std::all_of(record->files.begin(), record->files.end(), [&](const std::string& file) {
           return record->sha256_of_files.count(file) > 0 && IsAsRecorded(*record, file);
         });
}

bool OutputStages::Has(const std::string& stage,
                       const std::string& key,
                       const std::string& file) const {
  const StageRecord* record = Find(stage);
  return record && record->key == key &&
         std::find(record->files.begin(), record->files.end(), file) != record->files.end() &&
         fs::is_regular_file(folder_ / file) && IsAsRecorded(*record, file);
}

void OutputStages::Begin(const std::string& stage,
                         const std::string& key,
                         std::vector<std::string> files) {
  StageRecord* record = Find(stage);
  if (!record) record = &manifest_.stages.emplace_back();
  const bool is_same = record->key == key;
  // Said again, its files are no longer those of before: it is writing them.
  const bool is_again = !begun_.insert(stage).second;
  for (const std::string& file : record->files) {
    const bool is_wanted = std::find(files.begin(), files.end(), file) != files.end();
    if (is_same && is_wanted && (is_again || IsAsRecorded(*record, file))) continue;
    Remove(file);
    record->sha256_of_files.erase(file);
  }
  // Of unknown origin, and in the way.
  for (const std::string& file : files) {
    if (!is_same) Remove(file);
  }
  std::map<std::string, std::string> known;
  if (is_same) known = std::move(record->sha256_of_files);
  *record = {stage, key, false, std::move(files), std::move(known)};
  Write();
}

void OutputStages::Finish(const std::string& stage) {
  StageRecord* record = Find(stage);
  if (!record) return;
  std::erase_if(record->files,
                [&](const std::string& file) { return !fs::is_regular_file(folder_ / file); });
  record->sha256_of_files.clear();
  for (const std::string& file : record->files) {
    hashes_.erase(file);  // clocks are too coarse to tell that it was just written
    record->sha256_of_files[file] = HashOf(file);
  }
  record->is_complete = true;
  Write();
}

void OutputStages::Write() const { WriteManifest(folder_, manifest_); }

}  // namespace groundglass
