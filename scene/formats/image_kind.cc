// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_kind.h"

#include "scene/formats/text_encoding.h"
#include "scene/text.h"

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <set>
#include <vector>

namespace groundglass {
namespace {

using Bytes = std::span<const uint8_t>;

constexpr size_t kHeadSize = 1 << 18;  // holds the directories of every camera's raw files
constexpr const char* kExport = "export it as JPEG, PNG or TIFF";
constexpr const char* kUnknown = "nothing that is known here";

bool Has(Bytes bytes, size_t at, std::string_view text) {
  return at + text.size() <= bytes.size() &&
         std::equal(text.begin(),
                    text.end(),
                    bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

// Formats that say at their beginning what they are.
struct Mark {
  size_t at;
  std::string_view text;
  const char* reader;
  const char* description;
};
using namespace std::string_view_literals;
constexpr Mark kMarks[] = {
    {0, "\xFF\xD8\xFF"sv, "jpeg", "a JPEG"},
    {0, "\x89PNG\r\n\x1A\n"sv, "png", "a PNG"},
    {0, "GIF8"sv, "gif", "a GIF"},
    {0, "BM"sv, "bmp", "a BMP"},
    {8, "WEBP"sv, "webp", "a WebP"},
    {0, "8BPS"sv, "psd", "a Photoshop file"},
    {0, "\x76\x2F\x31\x01"sv, "openexr", "an OpenEXR"},
    {0, "\0\0\0\x0CjP  \r\n\x87\n"sv, "jpeg2000", "a JPEG 2000"},
    {0, "\xFF\x4F\xFF\x51"sv, "jpeg2000", "a JPEG 2000"},
    {0, "SDPX"sv, "dpx", "a DPX"},
    {0, "XPDS"sv, "dpx", "a DPX"},
    {0, "\x80\x2A\x5F\xD7"sv, "cineon", "a Cineon"},
    {0, "\xD7\x5F\x2A\x80"sv, "cineon", "a Cineon"},
    {0, "#?RADIANCE"sv, "hdr", "a Radiance HDR"},
    {0, "#?RGBE"sv, "hdr", "a Radiance HDR"},
    {0, "DDS "sv, "dds", "a DDS"},
    {0, "SIMPLE  ="sv, "fits", "a FITS"},
    {0, "\x53\x80\xF6\x34"sv, "softimage", "a Softimage PIC"},
    {0, "\x01\xDA"sv, "sgi", "an SGI"},
    {0, "FOR4"sv, "iff", "an IFF"},
    {0, "\0\0\x01\0"sv, "ico", "an icon"},
    {128, "DICM"sv, "dicom", "a DICOM"},
    {0, "IIRO"sv, "raw", "a camera raw file"},  // Olympus
    {0, "IIRS"sv, "raw", "a camera raw file"},
    {0, "MMOR"sv, "raw", "a camera raw file"},
    {0, "IIU\0"sv, "raw", "a camera raw file"},  // Panasonic
    {0, "FUJIFILMCCD-RAW"sv, "raw", "a camera raw file"},
    {0, "\0MRM"sv, "raw", "a camera raw file"},  // Minolta
    {0, "FOVb"sv, "raw", "a camera raw file"},   // Sigma
    {6, "HEAPCCDR"sv, "raw", "a camera raw file"},
    {4, "ftypcrx "sv, "raw", "a camera raw file"},
};

// What people leave in a folder of images by mistake.
struct Stranger {
  size_t at;
  std::string_view text;
  const char* description;
  const char* remedy;
};
constexpr const char* kTakeFrames = "take single pictures out of it: ffmpeg -i FILE -r 1 s%02d.png";
constexpr Stranger kStrangers[] = {
    {0, "\xFF\x0A"sv, "a JPEG XL", kExport},
    {0, "\0\0\0\x0CJXL "sv, "a JPEG XL", kExport},
    {0, "%PDF"sv, "a PDF", "export its pages as TIFF or PNG: pdftoppm -tiff -r 300 FILE s"},
    {0, "PK\x03\x04"sv, "a zip archive", "unpack it"},
    {0, "\x1F\x8B"sv, "a gzip archive", "unpack it"},
    {0, "Rar!"sv, "a RAR archive", "unpack it"},
    {0, "7z\xBC\xAF"sv, "a 7z archive", "unpack it"},
    {0, "version https://git-lfs"sv, "a Git LFS pointer", "get the picture with: git lfs pull"},
    {0, "\x1A\x45\xDF\xA3"sv, "a film", kTakeFrames},
    {8, "AVI "sv, "a film", kTakeFrames},
    {0, "\0\0\x01\xBA"sv, "a film", kTakeFrames},
    {0, "%!PS"sv, "PostScript", kExport},
    {0, "II\xBC"sv, "a JPEG XR", kExport},
    {0, "gimp xcf"sv, "a GIMP file", kExport},
    {0, "\0\x05\x16\x07"sv, "macOS' notes on a file", "delete it"},
};

uint32_t Number(Bytes bytes, size_t at, int size, bool is_big_endian) {
  uint32_t value = 0;
  for (int i = 0; i < size; ++i) {
    const size_t from = at + static_cast<size_t>(is_big_endian ? i : size - 1 - i);
    value = value << 8 | (from < bytes.size() ? bytes[from] : 0);
  }
  return value;
}

// Camera raw files that are TIFFs: a colour filter array or DNG's mark in one of their first
// directories. Read as a plain TIFF they would give their thumbnail.
bool IsRawTiff(Bytes bytes) {
  const bool is_big_endian = bytes[0] == 'M';
  if (Has(bytes, 8, "CR"sv)) return true;  // Canon
  std::vector<uint32_t> directories = {Number(bytes, 4, 4, is_big_endian)};
  for (size_t i = 0; i < directories.size() && i < 8; ++i) {
    const size_t start = directories[i];
    if (start + 2 > bytes.size()) continue;
    const uint32_t num_entries = std::min(Number(bytes, start, 2, is_big_endian), 512u);
    for (uint32_t entry = 0; entry < num_entries; ++entry) {
      const size_t at = start + 2 + 12 * static_cast<size_t>(entry);
      const uint32_t tag = Number(bytes, at, 2, is_big_endian);
      const uint32_t count = Number(bytes, at + 4, 4, is_big_endian);
      constexpr uint32_t kPhotometric = 262, kSubDirectories = 330, kDngVersion = 50706;
      constexpr uint32_t kColourFilterArray = 32803, kLinearRaw = 34892;
      if (tag == kDngVersion) return true;
      if (tag == kPhotometric) {
        const uint32_t photometric = Number(bytes, at + 8, 2, is_big_endian);
        if (photometric == kColourFilterArray || photometric == kLinearRaw) return true;
      }
      if (tag != kSubDirectories) continue;
      const size_t list = count == 1 ? at + 8 : Number(bytes, at + 8, 4, is_big_endian);
      for (uint32_t k = 0; k < std::min(count, 4u); ++k) {
        directories.push_back(Number(bytes, list + 4 * static_cast<size_t>(k), 4, is_big_endian));
      }
    }
  }
  return false;
}

// ISO base media: HEIF and AVIF are images, all else films.
ImageKind KindOfIsoMedia(Bytes bytes) {
  const size_t size = std::min<size_t>(Number(bytes, 0, 4, true), bytes.size());
  for (size_t at = 8; at + 4 <= size; at += at == 8 ? 8 : 4) {
    for (const std::string_view brand :
         {"heic"sv, "heix"sv, "heim"sv, "heis"sv, "hevc"sv, "mif1"sv, "msf1"sv, "avif"sv}) {
      if (Has(bytes, at, brand)) return {"heif", "a HEIF", ""};
    }
  }
  return {"", "a film", kTakeFrames};
}

// Targa has no mark at its beginning: a header whose every field is one that is allowed.
bool IsTarga(Bytes bytes) {
  if (bytes.size() < 19) return false;
  const int map = bytes[1], type = bytes[2], depth = bytes[16];
  const bool is_type = type == 1 || type == 2 || type == 3 || type == 9 || type == 10 || type == 11;
  const bool is_mapped = type == 1 || type == 9;
  return map <= 1 && is_type && (!is_mapped || map == 1) &&
         (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32) &&
         Number(bytes, 12, 2, false) > 0 && Number(bytes, 14, 2, false) > 0;
}

// The same where the name does not say so: nothing else in the header is odd, and the file holds
// the pixels that it says.
bool IsSurelyTarga(Bytes bytes) {
  if (!IsTarga(bytes)) return false;
  const int map = bytes[1], type = bytes[2], depth = bytes[16], descriptor = bytes[17];
  const bool is_mapped = type == 1 || type == 9;
  const bool is_grey = type == 3 || type == 11;
  if ((map == 1) != is_mapped || (descriptor & 0xC0) != 0 || (descriptor & 0x0F) > 8) return false;
  if ((is_mapped || is_grey) ? depth > 16 : depth < 15) return false;
  const uint32_t num_colours = Number(bytes, 5, 2, false);
  if (map == 0 && (num_colours != 0 || bytes[7] != 0)) return false;
  if (map == 1 && (num_colours == 0 || bytes[7] < 15 || bytes[7] > 32)) return false;
  const uint64_t num_pixels =
      static_cast<uint64_t>(Number(bytes, 12, 2, false)) * Number(bytes, 14, 2, false);
  // In runs, 128 pixels are two bytes at least.
  const uint64_t least = 18 + (type <= 3 ? num_pixels * ((depth + 7) / 8) : num_pixels / 64);
  return bytes.size() >= std::min<uint64_t>(least, kHeadSize);
}

bool IsText(std::string_view text) {
  if (text.size() < kHeadSize) return IsUtf8(text);
  for (size_t cut = 0; cut < 4; ++cut) {  // the head may end within a letter
    if (IsUtf8(text.substr(0, text.size() - cut))) return true;
  }
  return false;
}

ImageKind KindOfUnmarked(Bytes bytes, const std::string& extension) {
  if (bytes.empty()) return {"", "an empty file", "copy it again from where it came from"};
  if (std::all_of(bytes.begin(), bytes.end(), [](uint8_t b) { return b == 0; })) {
    return {"", "a file of zeros", "copy it again from where it came from"};
  }
  if (IsTarga(bytes) && (extension == ".tga" || extension == ".tpic")) {
    return {"targa", "a Targa", ""};
  }
  if (extension == ".rla") return {"rla", "an RLA", ""};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.find('\0') == std::string_view::npos && IsText(text)) {
    const std::string start = LowerCase(text.substr(0, 512));
    if (start.find("<svg") != std::string::npos) return {"", "an SVG drawing", kExport};
    if (start.find("<html") != std::string::npos || start.find("<!doctype html") == 0) {
      return {"", "a web page", "save the picture itself, not the page that shows it"};
    }
    return {"", "text", kExport};
  }
  return {"", kUnknown, kExport};
}

// OpenImageIO's extensions of one format, or of all that are read here.
std::set<std::string> ExtensionsOf(std::string_view wanted) {
  // Films, depth maps, volumes, and what only stands for an image.
  static const std::set<std::string, std::less<>> kNoPhotographs = {
      "ffmpeg", "null", "term", "zfile", "openvdb"};
  const std::string list = OIIO::get_string_attribute("extension_list");
  std::set<std::string> extensions;
  size_t at = 0;
  while (at < list.size()) {
    const size_t end = std::min(list.find(';', at), list.size());
    const size_t colon = std::min(list.find(':', at), end);
    const std::string format = list.substr(at, colon - at);
    if (wanted.empty() ? kNoPhotographs.count(format) == 0 : format == wanted) {
      for (size_t word = colon + 1; word < end;) {
        const size_t comma = std::min(list.find(',', word), end);
        extensions.insert("." + list.substr(word, comma - word));
        word = comma + 1;
      }
    }
    at = end + 1;
  }
  return extensions;
}

}  // namespace

ImageKind FindImageKind(Bytes bytes, const std::filesystem::path& name) {
  const std::string extension = LowerCase(name.extension().string());
  if (Has(bytes, 0, "II*\0"sv) || Has(bytes, 0, "MM\0*"sv)) {
    if (IsRawTiff(bytes)) return {"raw", "a camera raw file", ""};
    return {"tiff", "a TIFF", ""};
  }
  if (Has(bytes, 0, "II+\0"sv) || Has(bytes, 0, "MM\0+"sv)) return {"tiff", "a TIFF", ""};
  for (const Mark& mark : kMarks) {
    if (!Has(bytes, mark.at, mark.text)) continue;
    if (mark.reader == "webp"sv && !Has(bytes, 0, "RIFF"sv)) continue;
    if (mark.reader == "ico"sv && bytes.size() > 5 && bytes[5] != 0) continue;
    return {mark.reader, mark.description, ""};
  }
  if (Has(bytes, 4, "ftyp"sv)) return KindOfIsoMedia(bytes);
  if (Has(bytes, 4, "moov"sv) || Has(bytes, 4, "mdat"sv)) return {"", "a film", kTakeFrames};
  if (bytes.size() > 2 && bytes[0] == 'P' &&
      ((bytes[1] >= '1' && bytes[1] <= '6') || bytes[1] == 'F' || bytes[1] == 'f') &&
      (bytes[2] == '\n' || bytes[2] == ' ' || bytes[2] == '\r' || bytes[2] == '\t' ||
       bytes[2] == '#')) {
    return {"pnm", "a PNM", ""};
  }
  for (const Stranger& stranger : kStrangers) {
    if (!Has(bytes, stranger.at, stranger.text)) continue;
    return {"", stranger.description, stranger.remedy};
  }
  ImageKind unmarked = KindOfUnmarked(bytes, extension);
  static const std::set<std::string> raw_extensions = ExtensionsOf("raw");
  if (unmarked.description == kUnknown && raw_extensions.count(extension) > 0) {
    return {"raw", "a camera raw file", ""};
  }
  // Last, for what fits nothing else: a Targa under another format's name.
  if (unmarked.description == kUnknown && IsSurelyTarga(bytes)) return {"targa", "a Targa", ""};
  return unmarked;
}

ImageKind FindImageKind(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {"", "a file that cannot be opened", "look at its permissions"};
  std::vector<uint8_t> head(kHeadSize);
  in.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(in.gcount()));
  return FindImageKind(head, file);
}

std::vector<std::filesystem::path> ListImageFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const std::filesystem::path& file = entry->path();
    if (!entry->is_regular_file(ignored) || file.filename().string().front() == '.') continue;
    if (IsImageExtension(file.extension().string()) || FindImageKind(file).IsImage()) {
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

bool IsImageExtension(std::string_view extension) {
  static const std::set<std::string> extensions = [] {
    std::set<std::string> all = ExtensionsOf("");
    all.insert({".jfif", ".mpo", ".hif"});
    return all;
  }();
  return extensions.count(LowerCase(extension)) > 0;
}

std::string ImageStem(const std::filesystem::path& file) {
  return (IsImageExtension(file.extension().string()) ? file.stem() : file.filename()).string();
}

}  // namespace groundglass
