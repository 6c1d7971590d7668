// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/error.h"
#include "scene/formats/colmap_io.h"

#include <filesystem>
#include <string>
#include <utility>

namespace groundglass {

// A camera as another program's file has it, before it is judged (scene/camera_check.h).
struct ForeignCamera {
  NamedCamera named;
  std::string place;  // "FILE:12", "FILE: frame 3"; faults begin with it
  std::string fault;  // why it cannot be read, with the place; empty if it can
};

// What `read` makes of one of a file's cameras. What it throws costs this camera and no other.
template <typename Read>
ForeignCamera ReadForeignCamera(const std::filesystem::path& file,
                                std::string name,
                                std::string place,
                                const Read& read) {
  ForeignCamera foreign;
  foreign.named.name = std::move(name);
  foreign.place = std::move(place);
  try {
    foreign.named.camera = read();
  } catch (const Error& error) {
    const std::string message = error.what();
    foreign.fault = message.starts_with(file.string()) ? message : foreign.place + ": " + message;
  }
  return foreign;
}

}  // namespace groundglass
