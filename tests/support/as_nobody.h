// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace groundglass {

// Root writes anywhere, and tests in containers are often run as root: as long as this lives, the
// process has the rights of nobody.
class AsNobody {
 public:
  AsNobody() : is_root_(geteuid() == 0) {
    constexpr uid_t kNobody = 65534;
    if (is_root_ && seteuid(kNobody) != 0) throw std::runtime_error("cannot become nobody");
  }
  ~AsNobody() {
    if (is_root_ && seteuid(0) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool is_root_;
};

}  // namespace groundglass
