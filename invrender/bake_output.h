// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/registration.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace groundglass {

// The photographs that the corrected tags allow to texture: accepted ones, and those in review at
// a lower weight unless accepted_only. Rejected ones are left out.
std::vector<BakePhotograph> SelectPhotographs(const Scene& scene,
                                              const std::vector<Registration>& registrations,
                                              bool accepted_only);

// The photographs that these cameras are named after, by file name or stem. Throws Error if there
// is none.
std::vector<BakePhotograph> SelectPhotographs(const Scene& scene,
                                              const std::vector<NamedCamera>& cameras);

// All of the scene's photographs, with the cameras that their tags describe.
std::vector<BakePhotograph> SelectPhotographs(const Scene& scene);

// Writes model.glb, model.obj with .mtl and pages (`page_extension`: .jpg, .png, .tif or .exr),
// coverage.json, and provenance_N.png. Pages that an earlier bake left there and this one does not
// have are removed.
void WriteBake(const BakeResult& result,
               const std::filesystem::path& out,
               const std::string& page_extension = ".jpg");

// The files that WriteBake writes, relative to `out`.
std::vector<std::string> BakeFiles(const BakeResult& result, const std::string& page_extension);

// For BakeOptions::on_face_mask: writes the automatic masks, faces/NAME.png.
std::function<void(const BakePhotograph&, const Image16&)> FaceMaskWriter(
    const std::filesystem::path& out);

}  // namespace groundglass
