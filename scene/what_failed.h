// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <exception>
#include <new>
#include <string>

namespace groundglass {

// What to tell a person of an exception: its own words, if they are meant for people.
inline std::string WhatFailed(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) == nullptr) return error.what();
  return "there is not enough memory; end other programs, allow this one more, or give it less to "
         "do: --memory, --threads 1, smaller photographs";
}

}  // namespace groundglass
