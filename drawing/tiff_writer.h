// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <filesystem>
#include <functional>
#include <string>

namespace groundglass {

// A TIFF too large for memory, with a place: tiled, Deflate, BigTIFF where it must be.
struct TiffSheet {
  int width_px = 0;
  int height_px = 0;
  double dpi = 254;         // as it is to be printed
  double pixel_size_m = 1;  // in the plane
  double u_m = 0;           // the first pixel's outer corner
  double v_m = 0;
  // The name of the plane's axes for programs that ask where on Earth a picture is: nowhere.
  std::string plane_name;
  std::string description;
};

// The pictures are made by rows of this many, from the top; the last may have fewer.
constexpr int kTiffBandRows = 512;

// Kinds: 8 bits and 3 channels, 16 bits and one (codes), float and one (values; NaN is nothing).
// `rows(first_row, num_rows)` gives rows of the whole width. Written beside its place and renamed
// into it. Error if it cannot be written.
void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<Image8(int first_row, int num_rows)>& rows);
void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<Image16(int first_row, int num_rows)>& rows);
void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<ImageF(int first_row, int num_rows)>& rows);

// The world file beside it (.tfw), for programs that take no other: the pixel's size, and the
// centre of the first pixel.
std::string FormatWorldFile(const TiffSheet& sheet);

}  // namespace groundglass
