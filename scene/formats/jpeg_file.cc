// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/jpeg_file.h"

#include "scene/error.h"
#include "scene/text.h"

#include <cstdio>
// libjpeg's header needs FILE.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>

namespace groundglass {
namespace {

using JpegBytes = std::vector<unsigned char>;

JpegBytes ReadJpegBytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  JpegBytes bytes(std::max<std::streamoff>(size, 0));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  return bytes;
}

// What the marks of a JPEG say, past its headers, which may hold a whole thumbnail.
struct Marks {
  bool has_end = false;
  int num_components = 0;  // of the frame
  int num_scanned = 0;     // components over all scans
};

Marks FindMarks(const JpegBytes& bytes) {
  constexpr unsigned char kEnd = 0xD9, kStartOfScan = 0xDA;
  Marks marks;
  size_t at = 2;
  while (at + 1 < bytes.size()) {
    if (bytes[at] != 0xFF) {  // entropy-coded data
      const void* next = std::memchr(&bytes[at], 0xFF, bytes.size() - at);
      if (!next) break;
      at = static_cast<size_t>(static_cast<const unsigned char*>(next) - bytes.data());
      continue;
    }
    const unsigned char marker = bytes[at + 1];
    if (marker == kEnd) {
      marks.has_end = true;
      return marks;
    }
    const bool is_bare =
        marker == 0x00 || marker == 0x01 || marker == 0xFF || (marker >= 0xD0 && marker <= 0xD8);
    if (is_bare) {
      at += marker == 0xFF ? 1 : 2;
      continue;
    }
    if (at + 3 >= bytes.size()) break;
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame && at + 9 < bytes.size()) marks.num_components = bytes[at + 9];
    if (marker == kStartOfScan && at + 4 < bytes.size()) marks.num_scanned += bytes[at + 4];
    at += 2 + (static_cast<size_t>(bytes[at + 2]) << 8 | bytes[at + 3]);
  }
  return marks;
}

struct DecodingStopped {};

// One decoding. libjpeg's errors come out as exceptions: its C code is built to be unwound.
class Decoder {
 public:
  explicit Decoder(const JpegBytes& bytes) {
    info_.err = jpeg_std_error(&errors_);
    errors_.error_exit = [](j_common_ptr) { throw DecodingStopped(); };
    errors_.output_message = [](j_common_ptr) {};
    errors_.emit_message = [](j_common_ptr info, int level) {
      if (level >= 0) return;  // not a warning
      auto* self = static_cast<Decoder*>(info->client_data);
      const int code = info->err->msg_code;
      self->is_damaged_ |= code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
                           code == JWRN_MUST_RESYNC || code == JWRN_BOGUS_PROGRESSION;
    };
    info_.client_data = this;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, bytes.data(), static_cast<unsigned long>(bytes.size()));
  }
  ~Decoder() { jpeg_destroy_decompress(&info_); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  jpeg_decompress_struct& info() { return info_; }

  // True if all pixels came out of the file's own data.
  bool DecodeAll(const std::function<void(const std::vector<JSAMPLE>&)>& on_row) {
    jpeg_start_decompress(&info_);
    std::vector<JSAMPLE> row(static_cast<size_t>(info_.output_width) *
                             static_cast<size_t>(info_.output_components));
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW rows[] = {row.data()};
      if (jpeg_read_scanlines(&info_, rows, 1) != 1) return false;
      if (on_row) on_row(row);
    }
    return !is_damaged_;
  }

  // Every coefficient to its last bit: a progressive file can end between two of its scans.
  bool HasAllScans() const {
    if (!info_.progressive_mode || !info_.coef_bits) return true;
    for (int component = 0; component < info_.num_components; ++component) {
      for (int i = 0; i < DCTSIZE2; ++i) {
        if (info_.coef_bits[component][i] != 0) return false;
      }
    }
    return true;
  }

  size_t NumBytesLeft() const { return info_.src->bytes_in_buffer; }

 private:
  jpeg_decompress_struct info_{};
  jpeg_error_mgr errors_{};
  bool is_damaged_ = false;
};

}  // namespace

JpegState FindJpegState(const std::filesystem::path& file, bool look_closely) {
  const JpegBytes bytes = ReadJpegBytes(file);
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return JpegState::kIncomplete;
  const Marks marks = FindMarks(bytes);
  if (marks.has_end && !look_closely) return JpegState::kWhole;
  if (!marks.has_end && marks.num_scanned < marks.num_components) return JpegState::kIncomplete;
  Decoder decoder(bytes);
  try {
    jpeg_read_header(&decoder.info(), TRUE);
    if (!decoder.DecodeAll({}) || !decoder.HasAllScans()) return JpegState::kIncomplete;
  } catch (const DecodingStopped&) {
    return JpegState::kIncomplete;
  }
  if (marks.has_end) return JpegState::kWhole;
  // A file that was cut and filled up with zeros decodes too, but has zeros to spare.
  constexpr size_t kFewBytes = 16;
  return decoder.NumBytesLeft() <= kFewBytes ? JpegState::kNoEndMark : JpegState::kIncomplete;
}

Image8 ReadJpegInks(const std::filesystem::path& file) {
  const JpegBytes bytes = ReadJpegBytes(file);
  Decoder decoder(bytes);
  try {
    jpeg_decompress_struct& info = decoder.info();
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_CMYK;
    // Adobe's programs write how much paper shows in place of how much ink lies on it.
    const bool is_inverted = info.saw_Adobe_marker;
    Image8 inks(static_cast<int>(info.image_width), static_cast<int>(info.image_height), 4);
    auto out = inks.values.begin();
    decoder.DecodeAll([&](const std::vector<JSAMPLE>& row) {
      out = std::transform(row.begin(), row.end(), out, [&](JSAMPLE value) {
        return static_cast<uint8_t>(is_inverted ? 255 - value : value);
      });
    });
    return inks;
  } catch (const DecodingStopped&) {
    throw Error(file, "this image is damaged: its four inks cannot be decoded");
  }
}

}  // namespace groundglass
