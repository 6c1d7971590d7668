// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What modelling programs write, made fit for use, whatever the file's format: corners that repeat
// the one before them or close the ring are dropped, holes that run the wrong way are turned, and
// of faces that lie twice one is kept. Each kind gets one warning with its number and the first.
struct MendedFaces {
  std::vector<int> usable;  // the faces to keep, in order
  struct Fault {
    int face = -1;
    std::string text;  // "face 12 (east wall) has no area: ..."
  };
  std::vector<Fault> faults;  // of faces that cannot be used
  std::vector<std::string> warnings;
};

// Faces keep their places; KeepFaces leaves out what is not usable. textures: empty, or one for
// each face. lines: where each face stands in the file; empty if it has no lines.
MendedFaces MendFaces(const std::filesystem::path& file,
                      const std::vector<int>& lines,
                      PolygonModel& model,
                      std::vector<FaceTexture>& textures);

// One warning for all faces that cannot be used; nothing if there are none.
void WarnOfFaults(const std::filesystem::path& file,
                  const std::vector<int>& lines,
                  MendedFaces& mended);

// Leaves these faces only, and returns the numbers of the others (FaceNumber).
std::vector<int> KeepFaces(const std::vector<int>& faces,
                           PolygonModel& model,
                           std::vector<FaceTexture>& textures);

}  // namespace groundglass
