// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "scene/text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>

namespace groundglass {
namespace {

void CheckSize(const std::filesystem::path& file, int width, int height) {
  if (width < 1 || height < 1) throw Error(file, "cannot write an image without pixels");
}

// The file's bytes, made by OpenImageIO in memory: its writers take a full disk for nothing (PNG),
// or end the program (JPEG). `file` names the kind, and is for messages.
std::vector<unsigned char> EncodePixels(const std::filesystem::path& file,
                                        OIIO::ImageSpec spec,
                                        const OIIO::TypeDesc& type,
                                        const void* pixels,
                                        const ImageWriteOptions& options) {
  const std::string extension = LowerCase(file.extension().string());
  if (extension == ".jpg" || extension == ".jpeg") {
    spec.attribute("Compression", "jpeg:" + std::to_string(options.jpeg_quality));
    spec.attribute("jpeg:subsampling", "4:4:4");
  } else if (extension == ".png") {
    // Labels are the same over long runs: the fastest level already finds them.
    const bool is_labels = spec.nchannels == 1 && spec.format == OIIO::TypeUInt16;
    spec.attribute("png:compressionLevel", is_labels ? 1 : 6);
    if (is_labels) spec.attribute("png:filter", 8);  // no filter
    spec.attribute("oiio:UnassociatedAlpha", 1);
  } else if (extension == ".tif" || extension == ".tiff") {
    spec.attribute("Compression", "zip");
    spec.attribute("oiio:UnassociatedAlpha", 1);
  } else if (extension == ".exr") {
    spec.attribute("Compression", "zip");
  } else {
    throw Error(file, "cannot write this kind of image; expected .jpg, .png, .tif or .exr");
  }
  spec.attribute("Software", "groundglass");
  const std::string name = "image" + extension;
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) throw Error(file, "cannot write this image: " + OneLine(OIIO::geterror()));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  if (!output->set_ioproxy(&proxy) || !output->open(name, spec) ||
      !output->write_image(type, pixels) || !output->close()) {
    throw Error(file, "cannot write this image: " + OneLine(output->geterror()));
  }
  return bytes;
}

void WritePixels(const std::filesystem::path& file,
                 const OIIO::ImageSpec& spec,
                 const OIIO::TypeDesc& type,
                 const void* pixels,
                 const ImageWriteOptions& options = {}) {
  WriteFileAtomically(file, AsText(EncodePixels(file, spec, type, pixels, options)));
}

OIIO::TypeDesc IntegerType(const std::filesystem::path& file, int bits) {
  const std::string extension = LowerCase(file.extension().string());
  if (bits != 8 && bits != 16) throw Error(file, "an image has 8 or 16 bits");
  const bool is_jpeg = extension == ".jpg" || extension == ".jpeg";
  if (is_jpeg && bits != 8) throw Error(file, "a JPEG has 8 bits; use .png or .tif for 16");
  return bits == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8;
}

bool IsExr(const std::filesystem::path& file) {
  return LowerCase(file.extension().string()) == ".exr";
}

}  // namespace

void ImageWriteOptions::Check() const {
  CheckFromTo(jpeg_quality, 1, 100, "image options: jpeg_quality");
  if (bits != 8 && bits != 16) throw Error("image options: bits must be 8 or 16");
}

void WriteRadiance(const std::filesystem::path& file,
                   const ImageF& radiance,
                   const ImageWriteOptions& options) {
  options.Check();
  CheckSize(file, radiance.width, radiance.height);
  const OIIO::TypeDesc type = IsExr(file) ? OIIO::TypeHalf : IntegerType(file, options.bits);
  const OIIO::ImageSpec spec(radiance.width, radiance.height, radiance.channels, type);
  if (IsExr(file)) {
    WritePixels(file, spec, OIIO::TypeFloat, radiance.values.data(), options);
    return;
  }
  std::vector<float> encoded(radiance.values.size());
  std::transform(radiance.values.begin(), radiance.values.end(), encoded.begin(), SrgbFromLinear);
  WritePixels(file, spec, OIIO::TypeFloat, encoded.data(), options);
}

void WriteSrgb8(const std::filesystem::path& file,
                const Image8& srgb8,
                const ImageWriteOptions& options) {
  options.Check();
  CheckSize(file, srgb8.width, srgb8.height);
  if (IsExr(file)) {
    ImageF radiance(srgb8.width, srgb8.height, srgb8.channels);
    std::transform(
        srgb8.values.begin(), srgb8.values.end(), radiance.values.begin(), [](uint8_t code) {
          return LinearOfSrgb8()[code];
        });
    WriteRadiance(file, radiance, options);
    return;
  }
  const OIIO::ImageSpec spec(
      srgb8.width, srgb8.height, srgb8.channels, IntegerType(file, options.bits));
  WritePixels(file, spec, OIIO::TypeUInt8, srgb8.values.data(), options);
}

void WriteSrgb16(const std::filesystem::path& file, const Image16& srgb16) {
  CheckSize(file, srgb16.width, srgb16.height);
  const OIIO::ImageSpec spec(srgb16.width, srgb16.height, srgb16.channels, IntegerType(file, 16));
  if (IsExr(file)) {
    ImageF radiance(srgb16.width, srgb16.height, srgb16.channels);
    std::transform(
        srgb16.values.begin(), srgb16.values.end(), radiance.values.begin(), [](uint16_t code) {
          return LinearFromSrgb(static_cast<float>(code) / 65535.0f);
        });
    WriteRadiance(file, radiance);
    return;
  }
  WritePixels(file, spec, OIIO::TypeUInt16, srgb16.values.data());
}

void WriteLabels(const std::filesystem::path& file, const Image16& labels) {
  CheckSize(file, labels.width, labels.height);
  const OIIO::ImageSpec spec(labels.width, labels.height, labels.channels, OIIO::TypeUInt16);
  IntegerType(file, 16);
  if (IsExr(file)) throw Error(file, "labels are whole numbers; write them as .png or .tif");
  WritePixels(file, spec, OIIO::TypeUInt16, labels.values.data());
}

std::vector<uint8_t> EncodeImage(const Image8& srgb8,
                                 const std::string& extension,
                                 const ImageWriteOptions& options) {
  options.Check();
  const std::filesystem::path name = "image" + extension;
  CheckSize(name, srgb8.width, srgb8.height);
  const OIIO::ImageSpec spec(
      srgb8.width, srgb8.height, srgb8.channels, IntegerType(name, options.bits));
  return EncodePixels(name, spec, OIIO::TypeUInt8, srgb8.values.data(), options);
}

}  // namespace groundglass
