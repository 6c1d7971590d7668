// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/tiff_writer.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/text.h"

#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace groundglass {
namespace {

constexpr int kTileSize = 256;
static_assert(kTiffBandRows % kTileSize == 0);

// GeoTIFF's tags, which libtiff does not know by itself, and of its keys those that say: a system
// of the user's own, pixels are areas, its name, metres.
constexpr uint32_t kModelPixelScaleTag = 33550;
constexpr uint32_t kModelTiepointTag = 33922;
constexpr uint32_t kGeoKeyDirectoryTag = 34735;
constexpr uint32_t kGeoAsciiParamsTag = 34737;
constexpr uint16_t kUserDefined = 32767;
constexpr uint16_t kMetre = 9001;

TIFFFieldInfo GeoField(uint32_t tag, TIFFDataType type, const char* name) {
  const bool is_text = type == TIFF_ASCII;
  return {tag,
          TIFF_VARIABLE,
          TIFF_VARIABLE,
          type,
          FIELD_CUSTOM,
          1,
          static_cast<unsigned char>(is_text ? 0 : 1),
          const_cast<char*>(name)};
}

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffHandle = std::unique_ptr<TIFF, CloseTiff>;

void SetPlace(TIFF* tiff, const TiffSheet& sheet) {
  static const std::vector<TIFFFieldInfo> kFields = {
      GeoField(kModelPixelScaleTag, TIFF_DOUBLE, "ModelPixelScaleTag"),
      GeoField(kModelTiepointTag, TIFF_DOUBLE, "ModelTiepointTag"),
      GeoField(kGeoKeyDirectoryTag, TIFF_SHORT, "GeoKeyDirectoryTag"),
      GeoField(kGeoAsciiParamsTag, TIFF_ASCII, "GeoAsciiParamsTag")};
  TIFFMergeFieldInfo(tiff, kFields.data(), static_cast<uint32_t>(kFields.size()));
  const double scale[3] = {sheet.pixel_size_m, sheet.pixel_size_m, 0};
  const double tie[6] = {0, 0, 0, sheet.u_m, sheet.v_m, 0};
  const std::string name = sheet.plane_name + "|";
  // Version 1.1.0, five keys: number, where its value is, how many, the value or its place.
  const auto length = static_cast<uint16_t>(name.size());
  const uint16_t keys[] = {
      1,      1, 0,    4, 1024, 0,     1, kUserDefined, 1025, 0, 1, 1, 1026, kGeoAsciiParamsTag,
      length, 0, 3076, 0, 1,    kMetre};
  TIFFSetField(tiff, kModelPixelScaleTag, 3, scale);
  TIFFSetField(tiff, kModelTiepointTag, 6, tie);
  TIFFSetField(tiff, kGeoKeyDirectoryTag, static_cast<int>(std::size(keys)), keys);
  TIFFSetField(tiff, kGeoAsciiParamsTag, name.c_str());
}

template <typename T>
void SetForm(TIFF* tiff, const TiffSheet& sheet, int channels) {
  const bool is_float = std::is_floating_point_v<T>;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, sheet.width_px);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, sheet.height_px);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, channels);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, channels == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kTileSize);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, kTileSize);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  // Codes jump, so that differences of neighbours say nothing.
  TIFFSetField(
      tiff,
      TIFFTAG_PREDICTOR,
      is_float ? PREDICTOR_FLOATINGPOINT : (channels == 3 ? PREDICTOR_HORIZONTAL : PREDICTOR_NONE));
  TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER);
  TIFFSetField(tiff, TIFFTAG_XRESOLUTION, sheet.dpi / 2.54);
  TIFFSetField(tiff, TIFFTAG_YRESOLUTION, sheet.dpi / 2.54);
  TIFFSetField(tiff, TIFFTAG_SOFTWARE, "groundglass");
  if (!sheet.description.empty()) {
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, sheet.description.c_str());
  }
}

// One tile out of a band; what lies beyond the picture repeats its last pixel's bytes as zero.
template <typename T>
void CopyTile(const Raster<T>& band, int column, int row, std::vector<T>& tile) {
  std::fill(tile.begin(), tile.end(), T(0));
  const int width = std::min(kTileSize, band.width - column);
  const int height = std::min(kTileSize, band.height - row);
  for (int y = 0; y < height; ++y) {
    std::copy_n(band.At(column, row + y),
                static_cast<size_t>(width) * band.channels,
                tile.begin() + static_cast<ptrdiff_t>(y) * kTileSize * band.channels);
  }
}

template <typename T>
void WriteTiles(TIFF* tiff,
                const std::filesystem::path& file,
                const TiffSheet& sheet,
                int channels,
                const std::function<Raster<T>(int, int)>& rows) {
  std::vector<T> tile(static_cast<size_t>(kTileSize) * kTileSize * channels);
  for (int first = 0; first < sheet.height_px; first += kTiffBandRows) {
    const Raster<T> band = rows(first, std::min(kTiffBandRows, sheet.height_px - first));
    for (int row = 0; row < band.height; row += kTileSize) {
      for (int column = 0; column < band.width; column += kTileSize) {
        CopyTile(band, column, row, tile);
        if (TIFFWriteTile(tiff,
                          tile.data(),
                          static_cast<uint32_t>(column),
                          static_cast<uint32_t>(first + row),
                          0,
                          0) < 0) {
          throw Error(
              file, "cannot write this file; if the disk is full, free some space, then run again");
        }
      }
    }
  }
}

template <typename T>
void WriteTiffOf(const std::filesystem::path& file,
                 const TiffSheet& sheet,
                 int channels,
                 const std::function<Raster<T>(int, int)>& rows) {
  // Deflate may make noise a little larger; below this it stays within 4 GB all the same.
  constexpr double kPlainTiffBytes = 3.5e9;
  const double num_bytes = 1.0 * sheet.width_px * sheet.height_px * channels * sizeof(T);
  WriteFileAtomically(file, [&](const std::filesystem::path& temporary) {
    const TiffHandle tiff(TIFFOpen(temporary.c_str(), num_bytes > kPlainTiffBytes ? "w8" : "w"));
    if (!tiff) throw Error(file, "cannot write this file: " + std::string(std::strerror(errno)));
    SetForm<T>(tiff.get(), sheet, channels);
    SetPlace(tiff.get(), sheet);
    WriteTiles<T>(tiff.get(), file, sheet, channels, rows);
    if (!TIFFFlush(tiff.get()))
      throw Error(file,
                  "cannot write this file; if the disk is full, free some space, then run again");
  });
}

}  // namespace

void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<Image8(int, int)>& rows) {
  WriteTiffOf<uint8_t>(file, sheet, 3, rows);
}

void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<Image16(int, int)>& rows) {
  WriteTiffOf<uint16_t>(file, sheet, 1, rows);
}

void WriteTiff(const std::filesystem::path& file,
               const TiffSheet& sheet,
               const std::function<ImageF(int, int)>& rows) {
  WriteTiffOf<float>(file, sheet, 1, rows);
}

std::string FormatWorldFile(const TiffSheet& sheet) {
  const double p = sheet.pixel_size_m;
  std::string text;
  for (const double value : {p, 0.0, 0.0, -p, sheet.u_m + p / 2, sheet.v_m - p / 2}) {
    text += FormatNumber(value) + "\n";
  }
  return text;
}

}  // namespace groundglass
