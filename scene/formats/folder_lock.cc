// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/folder_lock.h"

#include "scene/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace groundglass {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const bool is_held = errno == EWOULDBLOCK;
  close(descriptor_);
  descriptor_ = -1;
  if (is_held) {
    throw Error(folder,
                "another groundglass is at work in this folder; wait until it is done, or name "
                "another folder");
  }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace groundglass
