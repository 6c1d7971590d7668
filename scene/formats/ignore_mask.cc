// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/ignore_mask.h"

#include "scene/error.h"
#include "scene/formats/open_image.h"

#include <algorithm>

namespace groundglass {
namespace {

// How white each pixel is, in the file's own codes.
template <typename T>
Raster<T> Whiteness(OpenImage& image, OIIO::TypeDesc type) {
  const Raster<T> stored = image.Read<T>(type);
  const int channels = stored.channels;
  const bool has_alpha = channels == 2 || channels == 4;
  const int num_colours = has_alpha ? channels - 1 : std::min(channels, 3);
  const size_t pixels = static_cast<size_t>(stored.width) * stored.height;
  const auto pixel = [&](size_t i) { return &stored.values[i * channels]; };
  const auto colour = [&](size_t i) { return *std::max_element(pixel(i), pixel(i) + num_colours); };
  const auto alpha = [&](size_t i) { return pixel(i)[channels - 1]; };

  // Alpha says something only if it varies; and where only alpha varies, it is the mask.
  bool alpha_varies = false;
  bool colour_varies = false;
  for (size_t i = 1; i < pixels; ++i) {
    alpha_varies = alpha_varies || (has_alpha && alpha(i) != alpha(0));
    colour_varies = colour_varies || colour(i) != colour(0);
  }
  const T top = type == OIIO::TypeFloat ? T(1) : std::numeric_limits<T>::max();
  Raster<T> whiteness(stored.width, stored.height, 1);
  for (size_t i = 0; i < pixels; ++i) {
    T value = colour(i);
    if (alpha_varies && !colour_varies) {
      value = alpha(i);
    } else if (alpha_varies) {
      value = static_cast<T>(static_cast<double>(value) * static_cast<double>(alpha(i)) /
                             static_cast<double>(top));
    }
    whiteness.values[i] = value;
  }
  return whiteness;
}

template <typename T>
Image8 WhiteFrom(const Raster<T>& whiteness, double threshold) {
  Image8 ignore(whiteness.width, whiteness.height, 1);
  for (size_t i = 0; i < ignore.values.size(); ++i) {
    ignore.values[i] = static_cast<double>(whiteness.values[i]) >= threshold ? 255 : 0;
  }
  return ignore;
}

// Where white begins: at the middle of what the bits can say, unless the codes are those of a
// program that counts 0, 1, or writes 8-bit codes into 16 bits.
template <typename T>
double Threshold(const Raster<T>& whiteness) {
  const auto has_only = [&](T white) {
    return std::all_of(whiteness.values.begin(), whiteness.values.end(), [&](T value) {
      return value == 0 || value == white;
    });
  };
  if (has_only(1)) return 1;
  if (sizeof(T) > 1 && has_only(255)) return 255;
  constexpr auto kHalf = static_cast<T>(std::numeric_limits<T>::max() / 2);
  return kHalf + 1;
}

Image8 ReadWhite(OpenImage& image) {
  if (image.spec().format == OIIO::TypeUInt8) {
    const Image8 whiteness = Whiteness<uint8_t>(image, OIIO::TypeUInt8);
    return WhiteFrom(whiteness, Threshold(whiteness));
  }
  if (!image.spec().format.is_floating_point()) {
    const Image16 whiteness = Whiteness<uint16_t>(image, OIIO::TypeUInt16);
    return WhiteFrom(whiteness, Threshold(whiteness));
  }
  // Floats count from 0 to 1, or as the codes that they were made from.
  const ImageF whiteness = Whiteness<float>(image, OIIO::TypeFloat);
  const float top = *std::max_element(whiteness.values.begin(), whiteness.values.end());
  return WhiteFrom(whiteness, top <= 1 ? 0.5 : top <= 255 ? 128 : 32768);
}

}  // namespace

void CheckMaskSize(const std::filesystem::path& file,
                   const ImageSize& mask,
                   const ImageSize& photograph) {
  if (mask.width == photograph.width && mask.height == photograph.height) return;
  throw Error(file,
              "mask has " + std::to_string(mask.width) + " x " + std::to_string(mask.height) +
                  " pixels, its photograph " + std::to_string(photograph.width) + " x " +
                  std::to_string(photograph.height));
}

Image8 ReadIgnoreMask(const std::filesystem::path& file, const ImageSize& photograph) {
  OpenImage image(file);
  image.CheckIsWhole(true);
  Image8 ignore = Oriented(ReadWhite(image), image.ExifOrientation());
  CheckMaskSize(file, {ignore.width, ignore.height}, photograph);
  return ignore;
}

}  // namespace groundglass
