// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/colmap_io.h"
#include "scene/length_unit.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// Cameras on their way from one program to another.
struct ExchangeSource {
  std::vector<NamedCamera> cameras;
  std::filesystem::path images;  // the folder that the names are below; empty if nobody says
  LengthUnit unit = LengthUnit::kFoot;
  std::optional<Georeference> georeference;
  std::filesystem::path model_file;          // empty if there is none
  std::vector<Registration> registrations;   // of an output folder
  std::vector<std::filesystem::path> files;  // that the cameras were read from
  std::vector<std::string> warnings;         // of cameras that are left out, among others
};

// The names of all formats that cameras are written in.
std::vector<std::string> CameraFormatNames();
// "nerfstudio: transforms.json" in lines, for a help text.
std::string DescribeCameraFormats();
// Whether the input is a file with cameras of another program's, by its ending, a folder of fSpy's
// projects, or an output folder.
bool HasExchangeCameras(const std::filesystem::path& input);

// Cameras of an output folder (but for those of rejected photographs), a COLMAP model, a folder of
// view files (whose pictures' sizes come from `images`), a file of fSpy's, MeshLab's, Metashape's
// or nerfstudio's, or a folder of fSpy's. images: the folder of pictures; empty: view files'
// ../images. A camera that cannot be one is left out with a warning. Throws Error where none is
// left.
ExchangeSource ReadExchangeSource(const std::filesystem::path& input,
                                  const std::filesystem::path& images);

struct ExchangeResult {
  std::string summary;  // one line
  std::vector<std::string> warnings;
};
// Writes them in a format (one of CameraFormatNames) to a file or, of formats that make several, a
// folder. Pictures that a format cannot hold as they are (a principal point off the middle, oblong
// pixels, a lens that bends) are written anew beside the file, in images/ with masks in masks/,
// white where the picture is; the originals are never touched. Throws Error, one that says what to
// do where pictures are needed and not there.
ExchangeResult WriteCamerasAs(std::string_view format,
                              const ExchangeSource& source,
                              const std::filesystem::path& out);

// The cameras as a folder of view files, look-at points this far ahead.
ExchangeResult WriteCamerasAsViews(const ExchangeSource& source,
                                   const std::filesystem::path& out,
                                   double lookat_distance);

}  // namespace groundglass
