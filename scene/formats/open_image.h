// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene: shows OpenImageIO's types.
#pragma once

#include "scene/error.h"
#include "scene/formats/colour_profile.h"
#include "scene/formats/image_kind.h"
#include "scene/image.h"
#include "scene/text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// Where an oriented pixel comes from in the file's raster (EXIF's eight orientations).
struct Orientation {
  bool swaps_sides = false;
  bool flips_x = false;  // of the file's columns
  bool flips_y = false;
};
Orientation OrientationFromExif(int code);

// An image file that is open at the page to be read, its header read and believable.
class OpenImage {
 public:
  // Throws Error if the file is missing or no image; see image_io.h.
  explicit OpenImage(const std::filesystem::path& file);
  OpenImage(const std::vector<uint8_t>& bytes, const std::filesystem::path& name);

  const OIIO::ImageSpec& spec() const { return spec_; }
  int ExifOrientation() const { return spec_.get_int_attribute("Orientation", 1); }

  // What a person should know of how the file is taken, if it is not as usual.
  const std::vector<std::string>& warnings() const { return warnings_; }

  // True if the stored values are linear light rather than sRGB codes.
  bool IsLinear() const;

  // True if Read gives four inks.
  bool HasInks() const { return has_inks_; }

  // What its codes mean, if the file says so and they are not sRGB's.
  std::optional<ColourProfile> Profile() const;

  // Throws Error for a JPEG that ends before its picture does, and for what ends in zeros where its
  // format has none; warns of one without its end mark, and of other files that end in zeros. Reads
  // the
  // file. may_be_black: zeros are what many a mask ends in.
  void CheckIsWhole(bool may_be_black = false);

  // All channels as the file has them, not yet oriented. Throws Error if the file is damaged.
  template <typename T>
  Raster<T> Read(OIIO::TypeDesc type) {
    if (has_inks_ && kind_.reader == "jpeg") return ReadJpegInksAs<T>();
    Raster<T> stored(spec_.width, spec_.height, spec_.nchannels);
    CheckRead(input_->read_image(page_, 0, 0, -1, type, stored.values.data()));
    if (has_inks_ && kind_.reader == "psd") {  // it counts paper in place of ink
      for (T& value : stored.values) value = static_cast<T>(std::numeric_limits<T>::max() - value);
    }
    return stored;
  }

  // Whether ReadRows can be called: a file of tiles, or of a JPEG's inks, is read whole.
  bool HasRows() const { return spec_.tile_width == 0 && !has_inks_; }

  // The rows from `begin` to before `end`, as Read has them; ask in order.
  template <typename T>
  Raster<T> ReadRows(OIIO::TypeDesc type, int begin, int end) {
    Raster<T> rows(spec_.width, end - begin, spec_.nchannels);
    CheckRead(input_->read_scanlines(
        page_, 0, spec_.y + begin, spec_.y + end, 0, 0, spec_.nchannels, type, rows.values.data()));
    return rows;
  }

  // The three channels that make its colour; grey is repeated.
  std::array<int, 3> ColourChannels() const;

 private:
  void Open(const OIIO::ImageSpec& config);
  void ChoosePage();
  void LookForInks(OIIO::ImageSpec config);
  void CheckRead(bool is_read);
  void CheckTail(bool may_be_black);
  template <typename T>
  Raster<T> ReadJpegInksAs();

  std::filesystem::path file_;
  ImageKind kind_;
  std::unique_ptr<OIIO::Filesystem::IOProxy> proxy_;  // bytes in memory
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;  // of the page
  int page_ = 0;
  bool has_inks_ = false;
  std::vector<std::string> warnings_;
};

// The picture turned upright.
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

}  // namespace groundglass
