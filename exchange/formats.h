// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "exchange/exchange_scene.h"
#include "exchange/foreign_camera.h"
#include "exchange/prepared_image.h"
#include "scene/formats/atomic_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// The cameras that other programs read and write: one function a format and a direction, all
// conversions in rules.h. Files refer to pictures by their paths from where they lie.
//
// `out` is the file, or of formats that make several the folder; nothing is written yet.
using FormatCameras = std::vector<FileToWrite> (*)(const ExchangeScene& scene,
                                                   const std::filesystem::path& out);
std::vector<FileToWrite> FormatColmapBinary(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatNerfstudio(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatFspy(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatMeshLab(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatBlender(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatMvsTexturing(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatMetashape(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatRealityCapture(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatRealityCaptureCsv(const ExchangeScene&,
                                                 const std::filesystem::path&);
std::vector<FileToWrite> FormatKml(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatGeoJson(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatSidecars(const ExchangeScene&, const std::filesystem::path&);
std::vector<FileToWrite> FormatCorrections(const ExchangeScene&, const std::filesystem::path&);

// Cameras of a file, in the file's own world and lengths, each named as its picture is there; what
// is wrong with one of them is told with it. Error naming the file and what is wrong where there is
// no camera in it at all.
using ReadCameras = std::vector<ForeignCamera> (*)(const std::filesystem::path& file);
std::vector<ForeignCamera> ReadNerfstudio(const std::filesystem::path& file);
std::vector<ForeignCamera> ReadFspy(const std::filesystem::path& file);
std::vector<ForeignCamera> ReadMeshLab(const std::filesystem::path& file);
std::vector<ForeignCamera> ReadMetashape(const std::filesystem::path& file);

struct CameraFormat {
  std::string_view name;           // for people: --to nerfstudio
  std::string_view makes;          // "transforms.json", "NAME.fspy for each photograph"
  bool is_folder = false;          // `out` is a folder
  CameraNeeds needs = {};          // what it cannot hold
  bool keeps_pictures = false;     // pictures lie beside the file or in it
  bool is_on_globe = false;        // the model must say where on Earth it stands
  std::string_view ending = {};    // of files that are read: ".mlp"
  FormatCameras format = nullptr;  // null: COLMAP's text, which WriteColmapModel writes
  ReadCameras read = nullptr;
};
const std::vector<CameraFormat>& CameraFormats();
// The format of this name, or that reads files of this ending; null if there is none.
const CameraFormat* FindCameraFormat(std::string_view name);
const CameraFormat* FindCameraReader(const std::filesystem::path& file);

}  // namespace groundglass
