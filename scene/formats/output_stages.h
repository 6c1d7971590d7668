// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/output_folder.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace groundglass {

// The stages of a job and what each leaves in its output folder (docs/output-folder.md). A stage
// whose key is the same as before and whose files are all there, as they were written (by their
// SHA-256), need not be done again; what a stage with another key left is removed.
class OutputStages {
 public:
  // `stages` of the manifest is not looked at. Writes nothing yet.
  OutputStages(const std::filesystem::path& folder, Manifest manifest);

  // Removes all files of the stage's record, and the record, unless it has this key.
  void KeepOnly(const std::string& stage, const std::string& key);

  // True if what the stage has left, whole or not, has this key.
  bool IsFrom(const std::string& stage, const std::string& key) const;

  // True if the stage was completed with this key and all its files are there as it left them.
  bool IsComplete(const std::string& stage, const std::string& key) const;

  // True if the stage was at work with this key and has written this file, which nobody has
  // changed since.
  bool Has(const std::string& stage, const std::string& key, const std::string& file) const;

  // The stage's files that are there and not as it left them: cut short, garbled or edited.
  std::vector<std::string> FindChanged(const std::string& stage) const;

  // Says that the stage is at work on these files (relative to the folder); those that it left
  // before and does not name are removed, and so are those that have changed since, and everything
  // that it left with another key. May be said again once more files are known.
  void Begin(const std::string& stage, const std::string& key, std::vector<std::string> files);
  // Says that they are written. Files that were not needed after all are forgotten.
  void Finish(const std::string& stage);

  // Writes manifest.json with what is recorded.
  void Write() const;

 private:
  StageRecord* Find(const std::string& stage);
  const StageRecord* Find(const std::string& stage) const;
  void Remove(const std::string& file) const;
  // Whether the file's bytes are those that the record knows; also true if it knows of none.
  bool IsAsRecorded(const StageRecord& record, const std::string& file) const;
  // "" if it cannot be read. Each file is read once, unless it is written to in between.
  std::string HashOf(const std::string& file) const;

  std::filesystem::path folder_;
  Manifest manifest_;
  std::set<std::string> begun_;  // stages that are writing their files, or have
  struct Hashed {
    std::filesystem::file_time_type written_at;
    uintmax_t size = 0;
    std::string sha256;
  };
  mutable std::map<std::string, Hashed> hashes_;
};

}  // namespace groundglass
