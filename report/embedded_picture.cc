// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/embedded_picture.h"

#include "scene/formats/image_io.h"
#include "scene/reduce.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {

std::string EncodeBase64(std::span<const uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // OpenSSL ends it with a zero
  const int size = EVP_EncodeBlock(
      reinterpret_cast<unsigned char*>(text.data()), bytes.data(), static_cast<int>(bytes.size()));
  text.resize(static_cast<size_t>(size));
  return text;
}

Image8 ShrunkPicture(const Image8& srgb8, int width_px) {
  if (srgb8.width <= width_px) return srgb8;
  const int height_px = std::max(
      1, static_cast<int>(std::lround(static_cast<double>(srgb8.height) * width_px / srgb8.width)));
  return ReducedInLight(srgb8, width_px, height_px);
}

kainjow::mustache::data PictureData(const Image8& srgb8, int width_px, size_t max_bytes) {
  constexpr int kLeastWidthPx = 120;
  Image8 picture = ShrunkPicture(srgb8, width_px);
  ImageWriteOptions options;
  options.jpeg_quality = 85;
  std::vector<uint8_t> jpeg = EncodeImage(picture, ".jpg", options);
  while (jpeg.size() > max_bytes && picture.width > kLeastWidthPx) {
    if (options.jpeg_quality > 65) {
      options.jpeg_quality -= 10;
    } else {
      picture = ShrunkPicture(srgb8, std::max(kLeastWidthPx, picture.width * 3 / 4));
    }
    jpeg = EncodeImage(picture, ".jpg", options);
  }
  kainjow::mustache::data data;
  data["width"] = std::to_string(picture.width);
  data["height"] = std::to_string(picture.height);
  data["jpeg"] = EncodeBase64(jpeg);
  return data;
}

}  // namespace groundglass
