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
};

// All readers apply the file's orientation, and throw Error naming the file if it is missing,
// damaged, or not an image. 8- and 16-bit, half and float; JPEG, PNG, TIFF, EXR. Those that give
// colours heed the file's ICC profile, and throw Error for one that is damaged or does not fit.

// Size only, without decoding the pixels; orientation applied.
ImageSize ReadImageSize(const std::filesystem::path& file);
// How the file asks to be turned before it is shown: EXIF's 1 (not at all) to 8; from 5 on its sides
// change places.
int ReadExifOrientation(const std::filesystem::path& file);
// Linear light, 3 channels; an alpha channel is dropped, grey is repeated.
ImageF ReadRadiance(const std::filesystem::path& file);
// 8-bit sRGB, 3 channels.
Image8 ReadSrgb8(const std::filesystem::path& file);
// 16-bit sRGB, 3 channels; 8-bit files are widened.
Image16 ReadSrgb16(const std::filesystem::path& file);
// 8-bit sRGB grey (Rec. 709 luma of the encoded values), 1 channel: what edges are sought in.
Image8 ReadGrey8(const std::filesystem::path& file);
// Codes kept exactly, 1 channel (the first): face masks, occluder masks.
Image16 ReadLabels(const std::filesystem::path& file);

struct ImageWriteOptions {
  int jpeg_quality = 95;  // 4:4:4
  int bits = 8;           // 8 or 16 for PNG and TIFF; EXR is always half float
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
