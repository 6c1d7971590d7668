// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>

namespace groundglass {

// Holds a folder for this process, so that no two write into it at the same time. The system keeps
// the lock with the open folder: no file lies about, and it ends with the process, however that
// ends. File systems that cannot lock a folder do without.
class FolderLock {
 public:
  // Throws Error if another process holds the folder.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace groundglass
