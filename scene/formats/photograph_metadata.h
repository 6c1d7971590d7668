// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// Where a photograph says that it was taken (WGS 84).
struct GpsFix {
  double latitude_deg = 0;   // north positive
  double longitude_deg = 0;  // east positive
  // Above the sea, as EXIF has it; below it negative. Some phones write heights above the ellipsoid
  // in its place.
  std::optional<double> height_m;
  // One standard deviation each way, as the receiver states it.
  std::optional<double> horizontal_sigma_m;
  std::optional<double> dilution;  // of precision (DOP)
};

// The direction in which a photograph says that it looks.
struct CompassAndLevel {
  std::optional<double> bearing_deg;  // of the view axis, clockwise from north
  bool is_bearing_magnetic = false;
  std::optional<double> pitch_deg;  // of the view axis, up positive
  std::optional<double> roll_deg;   // as in a view file
  std::string source;               // "XMP drone-dji", ...
};

// What made a picture's pixels. Film that was scanned may carry its camera's focal length, which
// somebody wrote in; a mount or the scanner's operator chose what of the frame is seen.
enum class PictureMaker {
  kUnknown,  // nothing says so
  kDigitalCamera,
  kScanner,
};

// What an image file says of the photograph's making: EXIF and XMP.
struct PhotographMetadata {
  std::string maker, model, lens;
  PictureMaker made_by = PictureMaker::kUnknown;
  std::optional<double> focal_length_mm;
  std::optional<double> focal_length_35mm;   // of the lens with the same view on 36 mm x 24 mm
  std::optional<double> digital_zoom;        // above 1: the middle of the frame alone
  std::optional<double> pixels_per_mm;       // on the sensor, across, in the size when taken
  ImageSize size;                            // now, upright
  std::optional<ImageSize> size_when_taken;  // upright, if its sides could be told apart
  bool is_panorama = false;
  std::optional<GpsFix> gps;
  CompassAndLevel direction;
  // What cannot be meant, and is therefore left out above; one line each, without the file's name:
  // "focal length of 0".
  std::vector<std::string> faults;
};

// Reads the header only. Throws Error if the file is missing or no image.
PhotographMetadata ReadPhotographMetadata(const std::filesystem::path& file);

}  // namespace groundglass
