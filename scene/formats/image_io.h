// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

struct ImageSize {
  int width = 0;
  int height = 0;
  int orientation = 1;  // EXIF's, from 1 to 8; heeded in width and height
};

// All readers take whatever OpenImageIO reads, told by the file's content and not by its name:
// JPEG, PNG, TIFF, OpenEXR, HEIF, WebP, JPEG 2000, BMP, PPM, Targa, Photoshop, camera raw ...; 8
// and 16 bits, half and float; of several pages the largest. They apply the file's orientation, and
// throw Error naming the file if it is missing, damaged, or no image. Those that give colours heed
// the file's ICC profile, four inks (CMYK) included, and throw Error for one that is damaged or
// does not fit.

// Size only, without decoding the pixels; orientation applied.
ImageSize ReadImageSize(const std::filesystem::path& file);

// The size, and one line for everything that a person should know of how the file is taken: its
// second page, inks without a profile, a JPEG without its end mark. Throws Error for one that is
// cut (only JPEGs are looked at so closely before their pixels are read).
struct ImageInspection {
  ImageSize size;
  std::vector<std::string> warnings;  // each begins with the file's name
};
ImageInspection InspectImage(const std::filesystem::path& file);

// Linear light, 3 channels; an alpha channel is dropped, grey is repeated.
ImageF ReadRadiance(const std::filesystem::path& file);
// 8-bit sRGB, 3 channels.
Image8 ReadSrgb8(const std::filesystem::path& file);
// 16-bit sRGB, 3 channels; 8-bit files are widened.
Image16 ReadSrgb16(const std::filesystem::path& file);
// 8-bit sRGB grey (Rec. 709 luma of the encoded values), 1 channel: what edges are sought in.
Image8 ReadGrey8(const std::filesystem::path& file);
// Codes kept exactly, 1 channel (the first): face masks. (ignore_mask.h has those of people and
// trees.)
Image16 ReadLabels(const std::filesystem::path& file);

struct ImageWriteOptions {
  int jpeg_quality = 95;  // 4:4:4
  int bits = 8;           // 8 or 16 for PNG and TIFF; EXR is always half float

  void Check() const;  // throws Error naming the first field out of range
};

// The extension chooses the format; written beside its place and renamed into it. Radiance is
// encoded to sRGB, except for EXR, which stays linear.
void WriteRadiance(const std::filesystem::path& file,
                   const ImageF& radiance,
                   const ImageWriteOptions& options = {});
// 1, 3 or 4 channels, written as they are.
void WriteSrgb8(const std::filesystem::path& file,
                const Image8& srgb8,
                const ImageWriteOptions& options = {});
// 3 channels of 16 bits: PNG, TIFF or EXR.
void WriteSrgb16(const std::filesystem::path& file, const Image16& srgb16);
void WriteLabels(const std::filesystem::path& file, const Image16& labels);

// Encoded JPEG or PNG bytes, for containers such as GLB.
std::vector<uint8_t> EncodeImage(const Image8& srgb8,
                                 const std::string& extension,
                                 const ImageWriteOptions& options = {});
Image8 DecodeSrgb8(const std::vector<uint8_t>& bytes, const std::string& extension);

}  // namespace groundglass
