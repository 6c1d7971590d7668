// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/error.h"

#include <string>

namespace groundglass {

// What `call` throws as an Error, or "nothing was thrown".
template <typename Call>
std::string ThrownMessage(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace groundglass
