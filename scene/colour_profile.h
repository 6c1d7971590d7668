// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace groundglass {

// The ICC profile that a scanner or camera put into an image file: what its numbers mean.
class ColourProfile {
 public:
  // is_grey: the file has one channel of colour. Throws Error naming the file if the profile is
  // damaged or is for another kind of image (CMYK, say).
  ColourProfile(std::span<const uint8_t> icc, bool is_grey, const std::filesystem::path& file);
  ~ColourProfile();
  ColourProfile(ColourProfile&&) noexcept;
  ColourProfile& operator=(ColourProfile&&) noexcept;

  // True if its numbers are sRGB codes as they are, to a code of 255.
  bool IsSrgb() const { return is_srgb_; }

  // The file's numbers, 3 channels (grey repeated), to sRGB codes: relative colorimetric, with
  // black point compensation; colours that sRGB does not have are clipped.
  void ToSrgb(Image8& colour) const;
  void ToSrgb(Image16& colour) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool is_srgb_ = false;
};

}  // namespace groundglass
