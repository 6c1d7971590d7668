// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/output_stages.h"

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
  manifest_.stages = ReadStages(folder);
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
  return record && record->is_complete && record->key == key &&
         std::all_of(record->files.begin(), record->files.end(), [&](const std::string& file) {
           return fs::is_regular_file(folder_ / file);
         });
}

bool OutputStages::Has(const std::string& stage,
                       const std::string& key,
                       const std::string& file) const {
  const StageRecord* record = Find(stage);
  return record && record->key == key &&
         std::find(record->files.begin(), record->files.end(), file) != record->files.end() &&
         fs::is_regular_file(folder_ / file);
}

void OutputStages::Begin(const std::string& stage,
                         const std::string& key,
                         std::vector<std::string> files) {
  StageRecord* record = Find(stage);
  if (!record) record = &manifest_.stages.emplace_back();
  const bool is_same = record->key == key;
  for (const std::string& file : record->files) {
    if (!is_same || std::find(files.begin(), files.end(), file) == files.end()) Remove(file);
  }
  // Of unknown origin, and in the way.
  for (const std::string& file : files) {
    if (!is_same) Remove(file);
  }
  *record = {stage, key, false, std::move(files)};
  Write();
}

void OutputStages::Finish(const std::string& stage) {
  StageRecord* record = Find(stage);
  if (!record) return;
  std::erase_if(record->files,
                [&](const std::string& file) { return !fs::is_regular_file(folder_ / file); });
  record->is_complete = true;
  Write();
}

void OutputStages::Write() const { WriteManifest(folder_, manifest_); }

}  // namespace groundglass
