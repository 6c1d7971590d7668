// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/known_keys.h"
#include "scene/formats/photograph_metadata.h"

#include <optional>
#include <string>

namespace groundglass {

struct MetadataLensOptions {
  // One standard deviation of a lens' focal length about the one that is written: makers round
  // nominal ones, and focusing near changes them. Share of the focal length.
  double focal_length_share = 0.02;
  // The sensor's width in the camera's own landscape, where its maker's data tell it and the
  // photographs do not. Millimetres.
  std::optional<double> sensor_width_mm;
  // Where lensfun's tables of sensors are installed (sensor_table.h), and how well they know a
  // sensor, one standard deviation as a share: they round, and some follow the makers' data sheets.
  std::filesystem::path sensor_tables = "/usr/share/lensfun";
  double sensor_table_share = 0.015;
  // A focal length for 35 mm film that is a smaller share of the lens's own is not believed.
  double least_crop_factor = 0.3;
  // Of what may be a scan of film: how far mount and scanner change its scale, and the shape of its
  // pixels; one standard deviation as a share.
  double scan_scale_share = 0.01;
  double scan_aspect_share = 0.005;

  void Check() const;  // throws Error naming the first field out of range
};

// The view angle that a photograph's metadata give, across the picture as it is now.
struct MetadataLens {
  std::optional<double> view_angle_deg;
  double sigma_deg = 0;  // one standard deviation
  // How far pixels may be from square, one standard deviation as a share.
  double sigma_aspect_share = 0;
  // How it was found ("26 mm for 35 mm film"), or why there is none ("no metadata", ...); one line.
  std::string how;
};

// From the focal length for 35 mm film, whose diagonal is what counts (CIPA DCG-001, 3.1); else
// from the focal length and the sensor's pixels per millimetre, its width, or its size in lensfun's
// table. A picture that was
// made smaller since keeps its angle; of one that was cropped on one axis the uncropped side tells
// the scale. Nothing where it would be a guess: no focal length, digital zoom, panoramas, crops on
// both axes. What nothing says a digital camera took may be a scan of film, whose mount and scanner
// widen the standard deviations; and so does a shape that is not 35 mm film's where film of that
// size was in the camera, since it was cropped or squeezed.
MetadataLens FindMetadataLens(const PhotographMetadata& metadata,
                              const MetadataLensOptions& options = {});

// What it says as a tag's keys, of a picture of this size: v and, since a camera's pixels are
// square (a scanner's nearly), a, with their standard deviations; none where there is no view
// angle.
KnownKeys KeysOfMetadata(const MetadataLens& lens, const ImageSize& size);

}  // namespace groundglass
