// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <sys/resource.h>

#include <csignal>

namespace groundglass {

// A disk on which no file has room for more than so many bytes, as long as the object lives: what
// this process and its children write beyond them fails, as on a full disk. Works for anybody.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t max_bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = max_bytes;
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

}  // namespace groundglass
