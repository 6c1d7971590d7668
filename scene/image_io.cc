// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/image_io.h"

#include "scene/colour_profile.h"
#include "scene/error.h"
#include "scene/srgb.h"
#include "scene/text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>

namespace groundglass {
namespace {

// An image of either side longer than this is a damaged header, not a photograph.
constexpr int kLongestSide = 1 << 17;
constexpr double kMostPixels = 4e9;

// Where an oriented pixel comes from in the file's raster (EXIF's eight orientations).
struct Orientation {
  bool swaps_sides = false;
  bool flips_x = false;  // of the file's columns
  bool flips_y = false;
};

Orientation OrientationFromExif(int code) {
  switch (code) {
    case 2:
      return {false, true, false};
    case 3:
      return {false, true, true};
    case 4:
      return {false, false, true};
    case 5:
      return {true, false, false};
    case 6:
      return {true, false, true};
    case 7:
      return {true, true, true};
    case 8:
      return {true, true, false};
    default:
      return {};
  }
}

template <typename T>
Raster<T> Oriented(Raster<T> stored, int exif_code) {
  const Orientation orientation = OrientationFromExif(exif_code);
  if (!orientation.swaps_sides && !orientation.flips_x && !orientation.flips_y) return stored;
  const int width = orientation.swaps_sides ? stored.height : stored.width;
  const int height = orientation.swaps_sides ? stored.width : stored.height;
  Raster<T> oriented(width, height, stored.channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int from_x = orientation.swaps_sides ? y : x;
      int from_y = orientation.swaps_sides ? x : y;
      if (orientation.flips_x) from_x = stored.width - 1 - from_x;
      if (orientation.flips_y) from_y = stored.height - 1 - from_y;
      std::copy_n(stored.At(from_x, from_y), stored.channels, oriented.At(x, y));
    }
  }
  return oriented;
}

// A photograph file that is open, its header read and believable.
class OpenImage {
 public:
  explicit OpenImage(const std::filesystem::path& file, OIIO::Filesystem::IOProxy* proxy = nullptr)
      : file_(file) {
    std::error_code error;
    if (proxy == nullptr && !std::filesystem::is_regular_file(file, error)) {
      throw Error(file, "no such image file");
    }
    OIIO::ImageSpec config;
    // Colours as they are stored, not multiplied by the alpha that is going to be dropped.
    config["oiio:UnassociatedAlpha"] = 1;
    // OpenImageIO 2.4 forgets the proxy argument when there is a configuration.
    if (proxy != nullptr) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    input_ = OIIO::ImageInput::open(file.string(), &config, proxy);
    if (!input_) {
      throw Error(file, "cannot read this as an image: " + OneLine(OIIO::geterror()));
    }
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.width > kLongestSide ||
        spec.height > kLongestSide ||
        static_cast<double>(spec.width) * spec.height * spec.nchannels > kMostPixels) {
      throw Error(file,
                  "cannot read this as an image: its header gives a size of " +
                      std::to_string(spec.width) + " x " + std::to_string(spec.height) + " x " +
                      std::to_string(spec.nchannels));
    }
  }

  const OIIO::ImageSpec& spec() const { return input_->spec(); }
  int ExifOrientation() const { return spec().get_int_attribute("Orientation", 1); }

  // True if the stored values are linear light rather than sRGB codes.
  bool IsLinear() const {
    const std::string space = spec().get_string_attribute("oiio:ColorSpace");
    if (space == "Linear" || space == "scene_linear") return true;
    return spec().format.is_floating_point() && space != "sRGB";
  }

  // What its codes mean, if the file says so and they are not sRGB's.
  std::optional<ColourProfile> Profile() const {
    const OIIO::ParamValue* icc = spec().find_attribute("ICCProfile");
    if (!icc || icc->type().basetype != OIIO::TypeDesc::UINT8) return std::nullopt;
    ColourProfile profile({static_cast<const uint8_t*>(icc->data()), icc->type().size()},
                          spec().nchannels < 3,
                          file_);
    if (profile.IsSrgb()) return std::nullopt;
    return profile;
  }

  // All channels as the file has them, not yet oriented.
  template <typename T>
  Raster<T> Read(OIIO::TypeDesc type) {
    Raster<T> stored(spec().width, spec().height, spec().nchannels);
    if (!input_->read_image(0, 0, 0, -1, type, stored.values.data()) || input_->has_error()) {
      throw Error(file_, "this image is damaged: " + OneLine(input_->geterror()));
    }
    return stored;
  }

  // The three channels that make its colour; grey is repeated.
  std::array<int, 3> ColourChannels() const {
    const int channels = spec().nchannels;
    if (channels < 3) return {0, 0, 0};
    const int red = spec().channelindex("R");
    const int green = spec().channelindex("G");
    const int blue = spec().channelindex("B");
    if (red >= 0 && green >= 0 && blue >= 0) return {red, green, blue};
    return {0, 1, 2};
  }

 private:
  std::filesystem::path file_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

// libjpeg fills what is missing of a truncated file with grey and says nothing, so look for the
// end marker ourselves: past the headers, which may hold a whole thumbnail.
void CheckJpegIsWhole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  std::vector<unsigned char> bytes(std::max<std::streamoff>(size, 0));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return;  // not a JPEG
  size_t at = 2;
  while (at + 1 < bytes.size()) {
    if (bytes[at] != 0xFF) {
      ++at;  // entropy-coded data
      continue;
    }
    const unsigned char marker = bytes[at + 1];
    if (marker == 0xD9) return;
    const bool is_bare =
        marker == 0x00 || marker == 0x01 || marker == 0xFF || (marker >= 0xD0 && marker <= 0xD8);
    if (is_bare) {
      at += marker == 0xFF ? 1 : 2;
      continue;
    }
    if (at + 3 >= bytes.size()) break;
    at += 2 + (static_cast<size_t>(bytes[at + 2]) << 8 | bytes[at + 3]);
  }
  throw Error(file, "this image is damaged: the file ends before the picture does");
}

// Picks and repeats channels, then turns the picture upright.
template <typename T>
Raster<T> ColourOf(OpenImage& image, Raster<T> stored) {
  const std::array<int, 3> channels = image.ColourChannels();
  if (stored.channels == 3 && channels == std::array<int, 3>{0, 1, 2}) {
    return Oriented(std::move(stored), image.ExifOrientation());
  }
  Raster<T> colour(stored.width, stored.height, 3);
  const size_t pixels = static_cast<size_t>(stored.width) * stored.height;
  for (size_t i = 0; i < pixels; ++i) {
    for (int c = 0; c < 3; ++c) {
      colour.values[3 * i + c] = stored.values[i * stored.channels + channels[c]];
    }
  }
  return Oriented(std::move(colour), image.ExifOrientation());
}

// sRGB codes of 8 or 16 bits.
template <typename Code>
Raster<Code> ReadCodes(OpenImage& image, OIIO::TypeDesc type) {
  const std::optional<ColourProfile> profile = image.Profile();
  Raster<Code> codes = ColourOf(image, image.Read<Code>(type));
  if (profile) profile->ToSrgb(codes);
  return codes;
}

// Of an image whose values are linear light.
ImageF ReadOpenRadiance(OpenImage& image) {
  return ColourOf(image, image.Read<float>(OIIO::TypeFloat));
}

uint8_t CodeFromLinear(float linear) {
  return static_cast<uint8_t>(SrgbFromLinear(linear) * 255.0f + 0.5f);
}

Image8 ReadOpenSrgb8(OpenImage& image) {
  if (image.IsLinear()) {
    const ImageF radiance = ReadOpenRadiance(image);
    Image8 srgb8(radiance.width, radiance.height, 3);
    std::transform(
        radiance.values.begin(), radiance.values.end(), srgb8.values.begin(), CodeFromLinear);
    return srgb8;
  }
  return ReadCodes<uint8_t>(image, OIIO::TypeUInt8);
}

}  // namespace

ImageSize ReadImageSize(const std::filesystem::path& file) {
  const OpenImage image(file);
  const bool swaps = OrientationFromExif(image.ExifOrientation()).swaps_sides;
  const int width = image.spec().width;
  const int height = image.spec().height;
  return swaps ? ImageSize{height, width} : ImageSize{width, height};
}

int ReadExifOrientation(const std::filesystem::path& file) {
  return OpenImage(file).ExifOrientation();
}

ImageF ReadRadiance(const std::filesystem::path& file) {
  OpenImage image(file);
  CheckJpegIsWhole(file);
  if (image.IsLinear()) {
    return ReadOpenRadiance(image);
  }
  if (image.spec().format == OIIO::TypeUInt8) {
    std::array<float, 256> linear_of_code;
    for (int code = 0; code < 256; ++code) {
      linear_of_code[code] = LinearFromSrgb(static_cast<float>(code) / 255.0f);
    }
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
  CheckJpegIsWhole(file);
  return ReadOpenSrgb8(image);
}

Image16 ReadSrgb16(const std::filesystem::path& file) {
  OpenImage image(file);
  CheckJpegIsWhole(file);
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
  const Image8 srgb8 = ReadSrgb8(file);
  Image8 grey(srgb8.width, srgb8.height, 1);
  for (size_t i = 0; i < grey.values.size(); ++i) {
    const uint8_t* rgb = &srgb8.values[3 * i];
    grey.values[i] =
        static_cast<uint8_t>(0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2] + 0.5f);
  }
  return grey;
}

Image16 ReadLabels(const std::filesystem::path& file) {
  OpenImage image(file);
  CheckJpegIsWhole(file);
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
  OIIO::Filesystem::IOMemReader proxy(const_cast<uint8_t*>(bytes.data()), bytes.size());
  OpenImage image("image" + extension, &proxy);
  return ReadOpenSrgb8(image);
}

}  // namespace groundglass
