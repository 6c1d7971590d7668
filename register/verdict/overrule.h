// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"

#include <string>
#include <vector>

namespace groundglass {

// Photographs whose verdict a person decides, whatever the evidence says: by name.
struct OverruleOptions {
  std::vector<std::string> accept;
  std::vector<std::string> reject;

  void Check() const;  // throws Error naming a photograph that is in both lists
};

// Changes the verdict of a registration that is named and puts who decided, and against what, in
// front of its reasons. A verdict that is as the person wants it already stays as it is.
void OverruleVerdict(const OverruleOptions& options, Registration& registration);

}  // namespace groundglass
