// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace groundglass {

// What an image file's numbers count: light as grey or in three colours, or the four inks of print
// (cyan, magenta, yellow, black; 0 is paper).
enum class PixelKind { kGrey, kRgb, kInks };

// The ICC profile that a scanner or camera put into an image file: what its numbers mean.
class ColourProfile {
 public:
  // Throws Error naming the file if the profile is damaged or is for another kind of pixels.
  ColourProfile(std::span<const uint8_t> icc, PixelKind kind, const std::filesystem::path& file);
  ~ColourProfile();
  ColourProfile(ColourProfile&&) noexcept;
  ColourProfile& operator=(ColourProfile&&) noexcept;

  // True if its numbers are sRGB codes as they are, to a code of 255.
  bool IsSrgb() const { return is_srgb_; }

  // The file's numbers, 3 channels (grey repeated) or 4 of inks, to 3 of sRGB codes: relative
  // colorimetric, with black point compensation; colours that sRGB does not have are clipped.
  void ToSrgb(Image8& colour) const;
  void ToSrgb(Image16& colour) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool is_srgb_ = false;
};

// Four inks without a profile: the sixteen overprints of ordinary offset print, mixed by the area
// that each covers (Neugebauer 1937). Over all mixtures it lies 9 codes of 255 (rms) from a press
// profile (SWOP); (1 - c)(1 - k), which programs use in its place, 22.
void InksToSrgb(Image8& colour);
void InksToSrgb(Image16& colour);

}  // namespace groundglass
