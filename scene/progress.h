// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <functional>
#include <string>

namespace groundglass {

// How algorithms tell how far they are: `done` of `total` steps, and what the last one was.
// May be called from several threads, one at a time. An empty function is allowed.
using Progress = std::function<void(int done, int total, const std::string& what)>;

}  // namespace groundglass
