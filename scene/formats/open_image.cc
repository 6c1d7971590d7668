// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/open_image.h"

#include "scene/formats/jpeg_file.h"
#include "scene/formats/webp_exif.h"

#include <OpenImageIO/tiffutils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace groundglass {
namespace {

// An image of either side longer than this is a damaged header, not a photograph.
constexpr int kLongestSide = 1 << 17;
constexpr double kMostPixels = 4e9;
constexpr int kMostPages = 1000;

std::string SizeOf(const OIIO::ImageSpec& spec) {
  return std::to_string(spec.width) + " x " + std::to_string(spec.height);
}

double NumPixels(const OIIO::ImageSpec& spec) {
  return static_cast<double>(spec.width) * spec.height;
}

std::string CannotRead(const std::string& why) { return "cannot read this as an image: " + why; }

// A library's reason, without the name of the file, which the error names already.
std::string Reason(std::string message, const std::filesystem::path& file) {
  for (const std::string& name : {" \"" + file.string() + "\"", " (\"" + file.string() + "\")"}) {
    const size_t at = message.find(name);
    if (at != std::string::npos) message.erase(at, name.size());
  }
  return OneLine(message);
}

}  // namespace

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

OpenImage::OpenImage(const std::filesystem::path& file) : file_(file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file, "no such image file");
  kind_ = FindImageKind(file);
  OIIO::ImageSpec config;
  // Colours as they are stored, not multiplied by the alpha that is going to be dropped.
  config["oiio:UnassociatedAlpha"] = 1;
  Open(config);
  if (kind_.reader == "webp") {
    const std::string exif = ReadWebpExif(file);
    if (!exif.empty()) OIIO::decode_exif(exif, spec_);
  }
  if (spec_.get_string_attribute("tiff:ColorSpace").find("LAB") != std::string::npos) {
    throw Error(
        file,
        CannotRead("its colours are CIELAB, and not red, green and blue; convert it to sRGB "
                   "with an image editor"));
  }
  LookForInks(config);
  if (spec_.get_string_attribute("oiio:ColorSpace") == "KodakLog") {
    warnings_.push_back(
        "holds logarithmic film codes, which are taken as sRGB; convert it to sRGB");
  }
}

OpenImage::OpenImage(const std::vector<uint8_t>& bytes, const std::filesystem::path& name)
    : file_(name), kind_(FindImageKind(bytes, name)) {
  // The library only reads the bytes, though it asks for ones that it might change.
  proxy_ = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<uint8_t*>(bytes.data()),
                                                           bytes.size());
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  Open(config);
}

void OpenImage::Open(const OIIO::ImageSpec& config) {
  if (!kind_.IsImage()) {
    throw Error(file_, CannotRead("it is " + kind_.description + "; " + kind_.remedy));
  }
  input_ = OIIO::ImageInput::create(kind_.reader);
  if (!input_) {
    OIIO::geterror();
    throw Error(file_,
                CannotRead("it is " + kind_.description +
                           ", which this machine's OpenImageIO was built without; export it as "
                           "JPEG, PNG or TIFF"));
  }
  if (proxy_ && (!input_->supports("ioproxy") || !input_->set_ioproxy(proxy_.get()))) {
    throw Error(file_, CannotRead(kind_.description + " cannot lie inside another file"));
  }
  if (!input_->open(file_.string(), spec_, config)) {
    throw Error(file_, CannotRead(Reason(input_->geterror(), file_)));
  }
  ChoosePage();
  if (spec_.width < 1 || spec_.height < 1 || spec_.nchannels < 1 || spec_.width > kLongestSide ||
      spec_.height > kLongestSide || NumPixels(spec_) * spec_.nchannels > kMostPixels) {
    throw Error(file_,
                CannotRead("its header gives a size of " + SizeOf(spec_) + " x " +
                           std::to_string(spec_.nchannels) + "; expected at most " +
                           std::to_string(kLongestSide) + " pixels on a side and " +
                           FormatNumber(kMostPixels / 1e9) +
                           "e9 numbers in all: reduce it, or save it again if it is damaged"));
  }
}

// How much of a file's end is zeros and nothing else, of its size.
double ShareOfZerosAtEnd(const std::filesystem::path& file) {
  constexpr std::streamoff kBlock = 1 << 16;
  std::error_code failure;
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file, failure));
  std::ifstream stream(file, std::ios::binary);
  std::string block;
  std::streamoff end = size;
  while (stream && end > 0) {
    const std::streamoff begin = std::max<std::streamoff>(0, end - kBlock);
    block.resize(static_cast<size_t>(end - begin));
    stream.seekg(begin);
    stream.read(block.data(), end - begin);
    const size_t last = block.find_last_not_of('\0');
    if (last != std::string::npos) {
      return static_cast<double>(size - begin - static_cast<std::streamoff>(last) - 1) /
             static_cast<double>(size);
    }
    end = begin;
  }
  return size > 0 && end == 0 ? 1 : 0;
}

// Some mark a single picture as an animation too. A reader of its own, since it loses its place.
bool HasSecondPicture(const std::filesystem::path& file) {
  const auto probe = OIIO::ImageInput::open(file.string());
  const bool has = probe && probe->seek_subimage(1, 0);
  OIIO::geterror();
  return has;
}

// A scanner's TIFF may begin with a thumbnail, or hold several pictures.
void OpenImage::ChoosePage() {
  warnings_.clear();
  page_ = 0;
  if (kind_.reader != "tiff" && kind_.reader != "ico" && kind_.reader != "gif" &&
      kind_.reader != "webp") {
    return;  // theirs are frames and layers, of which the first stands for all
  }
  if (kind_.reader == "gif" || kind_.reader == "webp") {
    // Their readers lose their place when they are asked for pages that are not there.
    if (spec_.get_int_attribute("oiio:Movie") != 0 && HasSecondPicture(file_)) {
      warnings_.push_back("is an animation; its first picture is taken");
    }
    return;
  }
  std::vector<OIIO::ImageSpec> pages = {spec_};
  while (static_cast<int>(pages.size()) < kMostPages &&
         input_->seek_subimage(static_cast<int>(pages.size()), 0)) {
    pages.push_back(input_->spec());
  }
  input_->geterror();  // that there is no further page
  const auto is_smaller = [](const OIIO::ImageSpec& a, const OIIO::ImageSpec& b) {
    return NumPixels(a) < NumPixels(b);
  };
  const auto largest = std::max_element(pages.begin(), pages.end(), is_smaller);
  page_ = static_cast<int>(largest - pages.begin());
  const auto num_largest = std::count_if(
      pages.begin(), pages.end(), [&](const auto& page) { return !is_smaller(page, *largest); });
  if (page_ > 0 || num_largest > 1) {
    warnings_.push_back("has " + std::to_string(pages.size()) + " pages; page " +
                        std::to_string(page_ + 1) + " of " + SizeOf(*largest) + " pixels, the " +
                        (num_largest > 1 ? "first of the " : "") + "largest, is taken");
  }
  if (!input_->seek_subimage(page_, 0)) {
    throw Error(file_, "this image is damaged: " + Reason(input_->geterror(), file_));
  }
  spec_ = pages[static_cast<size_t>(page_)];
}

// Inks have to be asked for: else the library makes a rough guess at their colours.
void OpenImage::LookForInks(OIIO::ImageSpec config) {
  const OIIO::ParamValue* icc = spec_.find_attribute("ICCProfile");
  if (kind_.reader == "psd") {
    has_inks_ = icc && spec_.get_string_attribute("ICCProfile:color_space") == "CMYK";
  } else {
    has_inks_ = spec_.get_string_attribute("tiff:ColorSpace") == "CMYK" ||
                spec_.get_string_attribute("jpeg:ColorSpace") == "CMYK";
  }
  if (!has_inks_) return;
  if (kind_.reader != "jpeg") {
    const std::vector<std::string> warnings = warnings_;
    config["oiio:RawColor"] = 1;
    Open(config);
    if (spec_.nchannels < 4) throw Error(file_, "its four inks cannot be read; save it as RGB");
  }
  if (!icc) {
    warnings_.push_back(
        "is CMYK without an ICC profile; its colours are taken as those of ordinary offset print "
        "(convert it to sRGB if they look wrong)");
  }
}

void OpenImage::CheckIsWhole(bool may_be_black) {
  if (proxy_) return;
  if (kind_.reader != "jpeg") {
    CheckTail(may_be_black);
    return;
  }
  const JpegState state = FindJpegState(file_);
  if (state == JpegState::kIncomplete) {
    throw Error(file_,
                "this image is damaged: the file ends before the picture does; copy it again from "
                "where it came from");
  }
  if (state == JpegState::kNoEndMark) {
    warnings_.push_back("lacks its end mark, as if it had been cut; all of its pixels are there");
  }
}

// Where a copy was interrupted, disks and cards leave zeros, which many a decoder takes for colour.
void OpenImage::CheckTail(bool may_be_black) {
  constexpr double kTellingShare = 0.05;
  constexpr double kDamagedShare = 0.2;
  constexpr std::array<std::string_view, 3> kCompressed = {"webp", "heif", "jpeg2000"};
  const double share = ShareOfZerosAtEnd(file_);
  if (share < kTellingShare) return;
  const std::string percent = std::to_string(std::lround(100 * share));
  if (share >= kDamagedShare &&
      std::find(kCompressed.begin(), kCompressed.end(), kind_.reader) != kCompressed.end()) {
    throw Error(file_,
                "this image is damaged: the last " + percent +
                    " % of the file are zeros, as an interrupted copy leaves them; copy it again "
                    "from where it came from");
  }
  if (may_be_black) return;
  warnings_.push_back("ends in zeros, the last " + percent +
                      " % of the file: black, or the copy was interrupted");
}

bool OpenImage::IsLinear() const {
  const std::string space = spec_.get_string_attribute("oiio:ColorSpace");
  if (space == "Linear" || space == "scene_linear") return true;
  return spec_.format.is_floating_point() && space != "sRGB";
}

std::optional<ColourProfile> OpenImage::Profile() const {
  const OIIO::ParamValue* icc = spec_.find_attribute("ICCProfile");
  if (!icc || icc->type().basetype != OIIO::TypeDesc::UINT8) return std::nullopt;
  const PixelKind kind = has_inks_             ? PixelKind::kInks
                         : spec_.nchannels < 3 ? PixelKind::kGrey
                                               : PixelKind::kRgb;
  ColourProfile profile(
      {static_cast<const uint8_t*>(icc->data()), icc->type().size()}, kind, file_);
  if (profile.IsSrgb()) return std::nullopt;
  return profile;
}

void OpenImage::CheckRead(bool is_read) {
  if (is_read && !input_->has_error()) return;
  const std::string reason = Reason(input_->geterror(), file_);
  // A JPEG's library complains of trifles too: bytes too many, a missing end mark.
  if (is_read && kind_.reader == "jpeg" && !proxy_ &&
      FindJpegState(file_, true) != JpegState::kIncomplete) {
    return;
  }
  throw Error(file_, "this image is damaged: " + reason);
}

template <typename T>
Raster<T> OpenImage::ReadJpegInksAs() {
  const Image8 inks = ReadJpegInks(file_);
  Raster<T> converted(inks.width, inks.height, 4);
  const T step = std::is_floating_point_v<T> ? T(1) / 255 : std::numeric_limits<T>::max() / 255;
  std::transform(inks.values.begin(), inks.values.end(), converted.values.begin(), [&](uint8_t v) {
    return static_cast<T>(v * step);
  });
  return converted;
}
template Image8 OpenImage::ReadJpegInksAs<uint8_t>();
template Image16 OpenImage::ReadJpegInksAs<uint16_t>();
template ImageF OpenImage::ReadJpegInksAs<float>();

std::array<int, 3> OpenImage::ColourChannels() const {
  if (spec_.nchannels < 3) return {0, 0, 0};
  // "R", or in a layer of an OpenEXR "beauty.R", whose channels come in the order of their names.
  const auto find = [&](const char* letter) {
    for (size_t i = 0; i < spec_.channelnames.size(); ++i) {
      const std::string& name = spec_.channelnames[i];
      const size_t dot = name.rfind('.');
      if (name.substr(dot == std::string::npos ? 0 : dot + 1) == letter) return static_cast<int>(i);
    }
    return -1;
  };
  const int red = find("R"), green = find("G"), blue = find("B");
  if (red >= 0 && green >= 0 && blue >= 0) return {red, green, blue};
  return {0, 1, 2};
}

}  // namespace groundglass
