// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/formats.h"

#include "scene/text.h"

namespace groundglass {

const std::vector<CameraFormat>& CameraFormats() {
  constexpr CameraNeeds kPinhole = {.no_distortion = true};
  constexpr CameraNeeds kSquarePinhole = {.no_distortion = true, .square_pixels = true};
  constexpr CameraNeeds kPlain = {.no_distortion = true, .square_pixels = true, .centred = true};
  static const std::vector<CameraFormat> kFormats = {
      {.name = "colmap", .makes = "cameras.txt, images.txt, points3D.txt", .is_folder = true},
      {.name = "colmap-binary",
       .makes = "cameras.bin, images.bin, points3D.bin",
       .is_folder = true,
       .format = FormatColmapBinary},
      {.name = "nerfstudio",
       .makes = "transforms.json",
       .ending = ".json",
       .format = FormatNerfstudio,
       .read = ReadNerfstudio},
      {.name = "fspy",
       .makes = "NAME.fspy for each photograph",
       .is_folder = true,
       .needs = kSquarePinhole,
       .keeps_pictures = true,
       .ending = ".fspy",
       .format = FormatFspy,
       .read = ReadFspy},
      {.name = "meshlab",
       .makes = "a project, .mlp",
       .needs = kPinhole,
       .ending = ".mlp",
       .format = FormatMeshLab,
       .read = ReadMeshLab},
      {.name = "blender", .makes = "a script, .py", .needs = kPinhole, .format = FormatBlender},
      {.name = "mvs-texturing",
       .makes = "NAME.cam and NAME.jpg for each photograph",
       .is_folder = true,
       .needs = kPinhole,
       .keeps_pictures = true,
       .format = FormatMvsTexturing},
      {.name = "metashape",
       .makes = "cameras, .xml",
       .ending = ".xml",
       .format = FormatMetashape,
       .read = ReadMetashape},
      {.name = "realitycapture",
       .makes = "NAME.xmp and NAME.jpg for each photograph",
       .is_folder = true,
       .needs = kPlain,
       .keeps_pictures = true,
       .format = FormatRealityCapture},
      {.name = "realitycapture-csv",
       .makes = "cameras.csv and NAME.jpg for each photograph",
       .is_folder = true,
       .needs = kPlain,
       .keeps_pictures = true,
       .format = FormatRealityCaptureCsv},
      {.name = "kml",
       .makes = "stations on the globe, .kml",
       .needs = kPinhole,
       .is_on_globe = true,
       .format = FormatKml},
      {.name = "geojson",
       .makes = "stations and what they see, .geojson",
       .is_on_globe = true,
       .format = FormatGeoJson},
      {.name = "xmp",
       .makes = "NAME.xmp for each photograph",
       .is_folder = true,
       .format = FormatSidecars},
      {.name = "csv", .makes = "a table of corrections, .csv", .format = FormatCorrections}};
  return kFormats;
}

const CameraFormat* FindCameraFormat(std::string_view name) {
  for (const CameraFormat& format : CameraFormats()) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

const CameraFormat* FindCameraReader(const std::filesystem::path& file) {
  const std::string ending = LowerCase(file.extension().string());
  for (const CameraFormat& format : CameraFormats()) {
    if (format.read && format.ending == ending) return &format;
  }
  return nullptr;
}

}  // namespace groundglass
