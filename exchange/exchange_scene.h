// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/length_unit.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A photograph as it goes to another program: the camera that the format can hold, and the picture
// that fits it.
struct ExchangeCamera {
  std::string name;        // without an ending, one of a kind: "s5", "north_0001"
  std::string image_name;  // below the folder of pictures: "s5.jpg", "north/0001.jpg"
  Camera camera;
  std::filesystem::path image_file;  // empty if there is none
};

// Lengths in `unit`, in `world`.
struct ExchangeScene {
  std::vector<ExchangeCamera> cameras;
  LengthUnit unit = LengthUnit::kMetre;
  std::optional<Georeference> georeference;
  std::filesystem::path model_file;  // a mesh in `world`; empty if there is none
  std::vector<Registration> registrations;
};

}  // namespace groundglass
