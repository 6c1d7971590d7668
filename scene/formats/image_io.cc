// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"

#include "scene/error.h"
#include "scene/formats/open_image.h"
#include "scene/srgb.h"

#include <algorithm>
#include <array>

namespace groundglass {
namespace {

// Picks and repeats channels.
template <typename T>
Raster<T> WithChannels(Raster<T> stored, const std::array<int, 3>& channels) {
  if (stored.channels == 3 && channels == std::array<int, 3>{0, 1, 2}) return stored;
  Raster<T> colour(stored.width, stored.height, 3);
  const size_t pixels = static_cast<size_t>(stored.width) * stored.height;
  for (size_t i = 0; i < pixels; ++i) {
    for (int c = 0; c < 3; ++c) {
      colour.values[3 * i + c] = stored.values[i * stored.channels + channels[c]];
    }
  }
  return colour;
}

// The same, then turns the picture upright.
template <typename T>
Raster<T> ColourOf(OpenImage& image, Raster<T> stored) {
  return Oriented(WithChannels(std::move(stored), image.ColourChannels()), image.ExifOrientation());
}

template <typename T>
Raster<T> FirstChannels(Raster<T> stored, int channels) {
  if (stored.channels == channels) return stored;
  Raster<T> fewer(stored.width, stored.height, channels);
  const size_t pixels = static_cast<size_t>(stored.width) * stored.height;
  for (size_t i = 0; i < pixels; ++i) {
    std::copy_n(&stored.values[i * stored.channels], channels, &fewer.values[i * channels]);
  }
  return fewer;
}

// sRGB codes of 8 or 16 bits.
template <typename Code>
Raster<Code> ReadCodes(OpenImage& image, OIIO::TypeDesc type) {
  const std::optional<ColourProfile> profile = image.Profile();
  if (image.HasInks()) {
    Raster<Code> inks = FirstChannels(image.Read<Code>(type), 4);
    profile ? profile->ToSrgb(inks) : InksToSrgb(inks);
    return Oriented(std::move(inks), image.ExifOrientation());
  }
  Raster<Code> codes = ColourOf(image, image.Read<Code>(type));
  if (profile) profile->ToSrgb(codes);
  return codes;
}

// Of an image whose values are linear light.
ImageF ReadOpenRadiance(OpenImage& image) {
  return ColourOf(image, image.Read<float>(OIIO::TypeFloat));
}

Image8 ReadOpenSrgb8(OpenImage& image) {
  if (image.IsLinear()) {
    const ImageF radiance = ReadOpenRadiance(image);
    Image8 srgb8(radiance.width, radiance.height, 3);
    std::transform(
        radiance.values.begin(), radiance.values.end(), srgb8.values.begin(), Srgb8FromLinear);
    return srgb8;
  }
  return ReadCodes<uint8_t>(image, OIIO::TypeUInt8);
}

void GreyFromSrgb(const Image8& srgb8, uint8_t* grey) {
  const size_t pixels = static_cast<size_t>(srgb8.width) * srgb8.height;
  for (size_t i = 0; i < pixels; ++i) {
    const uint8_t* rgb = &srgb8.values[3 * i];
    grey[i] = static_cast<uint8_t>(Luma(rgb[0], rgb[1], rgb[2]) + 0.5f);
  }
}

// Some rows at a time, so that a large photograph's colours never fill the memory, which takes
// longer than the reading.
Image8 ReadGreyByRows(OpenImage& image) {
  constexpr int kRowsAtOnce = 64;
  const std::optional<ColourProfile> profile = image.Profile();
  const std::array<int, 3> channels = image.ColourChannels();
  Image8 grey(image.spec().width, image.spec().height, 1);
  for (int begin = 0; begin < grey.height; begin += kRowsAtOnce) {
    const int end = std::min(grey.height, begin + kRowsAtOnce);
    Image8 rows =
        WithChannels(image.ReadRows<uint8_t>(OIIO::TypeDesc::UINT8, begin, end), channels);
    if (profile) profile->ToSrgb(rows);
    GreyFromSrgb(rows, grey.At(0, begin));
  }
  return Oriented(std::move(grey), image.ExifOrientation());
}

ImageSize SizeOf(const OpenImage& image) {
  const int orientation = image.ExifOrientation();
  const int width = image.spec().width;
  const int height = image.spec().height;
  return OrientationFromExif(orientation).swaps_sides ? ImageSize{height, width, orientation}
                                                      : ImageSize{width, height, orientation};
}

}  // namespace

ImageSize ReadImageSize(const std::filesystem::path& file) { return SizeOf(OpenImage(file)); }

ImageInspection InspectImage(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  image.Profile();  // throws for one that is damaged
  ImageInspection inspection{SizeOf(image), {}};
  for (const std::string& warning : image.warnings()) {
    inspection.warnings.push_back(Error(file, warning).what());
  }
  return inspection;
}

ImageF ReadRadiance(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  if (image.IsLinear()) {
    return ReadOpenRadiance(image);
  }
  if (image.spec().format == OIIO::TypeUInt8) {
    const std::array<float, 256>& linear_of_code = LinearOfSrgb8();
    const auto srgb8 = ReadCodes<uint8_t>(image, OIIO::TypeUInt8);
    ImageF radiance(srgb8.width, srgb8.height, 3);
    std::transform(
        srgb8.values.begin(), srgb8.values.end(), radiance.values.begin(), [&](uint8_t code) {
          return linear_of_code[code];
        });
    return radiance;
  }
  const auto srgb16 = ReadCodes<uint16_t>(image, OIIO::TypeUInt16);
  ImageF radiance(srgb16.width, srgb16.height, 3);
  std::transform(
      srgb16.values.begin(), srgb16.values.end(), radiance.values.begin(), [](uint16_t code) {
        return LinearFromSrgb(static_cast<float>(code) / 65535.0f);
      });
  return radiance;
}

Image8 ReadSrgb8(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  return ReadOpenSrgb8(image);
}

Image16 ReadSrgb16(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  if (!image.IsLinear()) return ReadCodes<uint16_t>(image, OIIO::TypeUInt16);
  const ImageF radiance = ReadOpenRadiance(image);
  Image16 srgb16(radiance.width, radiance.height, 3);
  std::transform(
      radiance.values.begin(), radiance.values.end(), srgb16.values.begin(), [](float linear) {
        return static_cast<uint16_t>(SrgbFromLinear(linear) * 65535.0f + 0.5f);
      });
  return srgb16;
}

Image8 ReadGrey8(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  if (image.HasRows() && !image.HasInks() && !image.IsLinear()) return ReadGreyByRows(image);
  const Image8 srgb8 = ReadOpenSrgb8(image);
  Image8 grey(srgb8.width, srgb8.height, 1);
  GreyFromSrgb(srgb8, grey.values.data());
  return grey;
}

Image16 ReadLabels(const std::filesystem::path& file) {
  OpenImage image(file);
  image.CheckIsWhole();
  Image16 labels(image.spec().width, image.spec().height, 1);
  const int channels = image.spec().nchannels;
  // Read in the file's own width: a conversion would scale the codes.
  if (image.spec().format == OIIO::TypeUInt8) {
    const Image8 stored = image.Read<uint8_t>(OIIO::TypeUInt8);
    for (size_t i = 0; i < labels.values.size(); ++i)
      labels.values[i] = stored.values[i * channels];
  } else if (image.spec().format == OIIO::TypeUInt16) {
    const Image16 stored = image.Read<uint16_t>(OIIO::TypeUInt16);
    for (size_t i = 0; i < labels.values.size(); ++i)
      labels.values[i] = stored.values[i * channels];
  } else {
    throw Error(file, "a mask must have 8 or 16 bits of whole numbers");
  }
  return Oriented(std::move(labels), image.ExifOrientation());
}

Image8 DecodeSrgb8(const std::vector<uint8_t>& bytes, const std::string& extension) {
  OpenImage image(bytes, "image" + extension);
  return ReadOpenSrgb8(image);
}

}  // namespace groundglass
