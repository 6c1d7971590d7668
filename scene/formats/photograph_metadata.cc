// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/photograph_metadata.h"

#include "scene/formats/open_image.h"
#include "scene/text.h"

#include <array>
#include <cmath>

namespace groundglass {
namespace {

// Of scanners and of the programs that drive them; in lower case. Programs on phones that scan
// shapes are none of them.
constexpr std::array<const char*, 11> kScanners = {"vuescan",
                                                   "silverfast",
                                                   "nikon scan",
                                                   "epson scan",
                                                   "canoscan",
                                                   "coolscan",
                                                   "scanjet",
                                                   "perfection v",
                                                   "plustek",
                                                   "noritsu",
                                                   "flextight"};
// No digital camera took photographs for sale before it.
constexpr double kFirstDigitalYear = 1990;

// A text that cannot be a maker's or a model's name.
std::string CleanName(std::string name) {
  if (name.empty()) return name;
  name = OneLine(name);
  return std::string(TrimBlanks(name.substr(0, name.find('\0'))));
}

// Reads EXIF's and XMP's fields as OpenImageIO names them; what cannot be meant becomes a fault.
class MetadataReader {
 public:
  MetadataReader(const OIIO::ImageSpec& spec, const ImageSize& size) : spec_(spec) {
    found_.size = size;
  }

  PhotographMetadata Read() {
    found_.maker = CleanName(spec_.get_string_attribute("Make"));
    found_.model = CleanName(spec_.get_string_attribute("Model"));
    found_.lens = CleanName(spec_.get_string_attribute("Exif:LensModel"));
    found_.is_panorama = !spec_.get_string_attribute("GPano:ProjectionType").empty();
    ReadSizeWhenTaken();
    ReadFocalLength();
    found_.made_by = FindPictureMaker();
    ReadPosition();
    ReadDirection();
    return std::move(found_);
  }

 private:
  std::optional<double> Number(const char* name) const {
    const OIIO::ParamValue* value = spec_.find_attribute(name);
    if (value == nullptr) return std::nullopt;
    // XMP's numbers may have come as text, "+12.30".
    if (value->type() == OIIO::TypeString) {
      std::string text = value->get_string();
      if (text.starts_with('+')) text.erase(0, 1);
      return ParseNumber(TrimBlanks(text));
    }
    return value->get_float();
  }
  void Fault(const std::string& line) { found_.faults.push_back(line); }

  // Above 0, else a fault if `zero_is_known` (EXIF writes 0 for unknown in some fields).
  std::optional<double> Positive(const char* name, const char* what, bool zero_is_unknown) {
    const std::optional<double> value = Number(name);
    if (!value || (*value == 0 && zero_is_unknown)) return std::nullopt;
    if (*value > 0 && std::isfinite(*value)) return value;
    Fault(std::string(what) + " of " + FormatNumber(*value));
    return std::nullopt;
  }

  // EXIF keeps the size of the picture as it left the camera, before EXIF's turn.
  void ReadSizeWhenTaken() {
    const int width = spec_.get_int_attribute("Exif:PixelXDimension", 0);
    const int height = spec_.get_int_attribute("Exif:PixelYDimension", 0);
    if (width <= 0 || height <= 0) return;
    const bool swaps = OrientationFromExif(found_.size.orientation).swaps_sides;
    found_.size_when_taken = swaps ? ImageSize{height, width, 1} : ImageSize{width, height, 1};
  }

  void ReadFocalLength() {
    found_.focal_length_mm = Positive("Exif:FocalLength", "focal length", false);
    found_.focal_length_35mm =
        Positive("Exif:FocalLengthIn35mmFilm", "focal length for 35 mm film", true);
    found_.digital_zoom = Positive("Exif:DigitalZoomRatio", "digital zoom", true);
    const bool swaps = OrientationFromExif(found_.size.orientation).swaps_sides;
    const std::optional<double> resolution =
        Positive(swaps ? "Exif:FocalPlaneYResolution" : "Exif:FocalPlaneXResolution",
                 "resolution of the focal plane",
                 true);
    // EXIF's units: 2 inch, 3 centimetre; some makers count in millimetres and micrometres.
    const std::array<double, 6> mm_of_unit = {0, 0, 25.4, 10, 1, 0.001};
    const int unit = spec_.get_int_attribute("Exif:FocalPlaneResolutionUnit", 2);
    if (resolution && unit >= 2 && unit <= 5) {
      found_.pixels_per_mm = *resolution / mm_of_unit[static_cast<size_t>(unit)];
    }
  }

  bool NamesAScanner() const {
    for (const char* field : {"Make", "Model", "Software"}) {
      const std::string text = LowerCase(spec_.get_string_attribute(field));
      for (const char* word : kScanners) {
        if (text.find(word) != std::string::npos) return true;
      }
    }
    return false;
  }

  // Scanners first: their pictures have a size and a resolution too.
  PictureMaker FindPictureMaker() const {
    // EXIF 2.32: 2 to 5 are area sensors, 7 and 8 lines of pixels, as scanners have. FileSource
    // would say it too, but OpenImageIO does not read it.
    const int sensing = spec_.get_int_attribute("Exif:SensingMethod", 0);
    if (sensing == 7 || sensing == 8 || NamesAScanner()) {
      return PictureMaker::kScanner;
    }
    // "1974:07:01 12:00:00"
    const std::string taken = spec_.get_string_attribute("Exif:DateTimeOriginal");
    const std::optional<double> year = ParseNumber(taken.substr(0, taken.find(':')));
    if (year && *year > 1800 && *year < kFirstDigitalYear) return PictureMaker::kScanner;
    // Cameras write the picture's size, which EXIF demands of them; hands that add a focal length
    // do not.
    if ((sensing >= 2 && sensing <= 5) || found_.size_when_taken || found_.pixels_per_mm) {
      return PictureMaker::kDigitalCamera;
    }
    return PictureMaker::kUnknown;
  }

  // Degrees, minutes and seconds.
  std::optional<double> Angle(const char* name) const {
    const OIIO::ParamValue* value = spec_.find_attribute(name);
    if (value == nullptr) return std::nullopt;
    double degrees = 0;
    double share = 1;
    const int number = static_cast<int>(value->type().numelements()) * value->nvalues();
    for (int i = 0; i < std::min(number, 3); ++i, share /= 60) {
      degrees += share * static_cast<double>(value->get_float_indexed(i));
    }
    return degrees;
  }

  void ReadPosition() {
    std::optional<double> latitude = Angle("GPS:Latitude");
    std::optional<double> longitude = Angle("GPS:Longitude");
    if (!latitude && !longitude) return;
    if (!latitude || !longitude) return Fault("GPS position with one of its two numbers alone");
    const std::string north_south = spec_.get_string_attribute("GPS:LatitudeRef");
    const std::string east_west = spec_.get_string_attribute("GPS:LongitudeRef");
    if (north_south.empty() || east_west.empty()) {
      return Fault("GPS position that does not say whether north or south, east or west");
    }
    if (north_south[0] == 'S') latitude = -*latitude;
    if (east_west[0] == 'W') longitude = -*longitude;
    // Some write 0/0 for want of a fix.
    if (!std::isfinite(*latitude) || !std::isfinite(*longitude)) {
      return Fault("GPS position that is no number");
    }
    if (*latitude == 0 && *longitude == 0) {
      return Fault("GPS position at 0 N 0 E, in the sea off Africa: the receiver had no fix");
    }
    if (std::abs(*latitude) > 90 || std::abs(*longitude) > 180) {
      return Fault("GPS position at latitude " + FormatNumber(*latitude) + ", longitude " +
                   FormatNumber(*longitude) + ", which is no place on Earth");
    }
    GpsFix fix{*latitude, *longitude, {}, {}, {}};
    ReadHeight(fix);
    fix.horizontal_sigma_m = Positive("GPS:HPositioningError", "GPS error", true);
    fix.dilution = Positive("GPS:DOP", "GPS dilution of precision", true);
    found_.gps = fix;
  }

  void ReadHeight(GpsFix& fix) {
    const std::optional<double> height = Number("GPS:Altitude");
    if (!height) return;
    // From the bottom of the sea to an airliner.
    if (!std::isfinite(*height) || *height > 15000) {
      return Fault("GPS height of " + FormatNumber(*height) + " m");
    }
    fix.height_m = spec_.get_int_attribute("GPS:AltitudeRef", 0) == 1 ? -*height : *height;
  }

  std::optional<double> Within(std::initializer_list<const char*> names, double limit) {
    for (const char* name : names) {
      const std::optional<double> value = Number(name);
      if (!value) continue;
      if (std::isfinite(*value) && std::abs(*value) <= limit) return value;
      Fault(std::string(name) + " of " + FormatNumber(*value) + " degrees");
    }
    return std::nullopt;
  }

  // A gimbal's angles and a survey drone's come before the compass, which is the coarser one.
  void ReadDirection() {
    CompassAndLevel& direction = found_.direction;
    direction.bearing_deg = Within({"drone-dji:GimbalYawDegree", "Camera:Yaw"}, 360);
    if (direction.bearing_deg) {
      direction.source = "XMP";
    } else if ((direction.bearing_deg = Within({"GPS:ImgDirection"}, 360))) {
      direction.source = "GPS direction";
      direction.is_bearing_magnetic =
          spec_.get_string_attribute("GPS:ImgDirectionRef").substr(0, 1) == "M";
    }
    direction.pitch_deg =
        Within({"drone-dji:GimbalPitchDegree", "Camera:Pitch", "Exif:CameraElevationAngle"}, 90);
    direction.roll_deg = Within({"drone-dji:GimbalRollDegree", "Camera:Roll"}, 180);
    if (!direction.pitch_deg) ReadComment();
  }

  // Camera programs for phones write "Yaw:-45.1,Pitch:12.3,Roll:0.4" into the comment.
  void ReadComment() {
    const std::string comment = spec_.get_string_attribute("Exif:UserComment");
    CompassAndLevel& direction = found_.direction;
    const auto find = [&](const char* label) -> std::optional<double> {
      const size_t at = comment.find(label);
      if (at == std::string::npos) return std::nullopt;
      const size_t begin = at + std::string_view(label).size();
      return ParseNumber(
          TrimBlanks(comment.substr(begin, comment.find_first_of(",; \0", begin) - begin)));
    };
    const std::optional<double> pitch = find("Pitch:");
    if (pitch && std::abs(*pitch) <= 90) direction.pitch_deg = pitch;
    const std::optional<double> roll = find("Roll:");
    if (!direction.roll_deg && roll && std::abs(*roll) <= 180) direction.roll_deg = roll;
  }

  const OIIO::ImageSpec& spec_;
  PhotographMetadata found_;
};

}  // namespace

PhotographMetadata ReadPhotographMetadata(const std::filesystem::path& file) {
  const OpenImage image(file);
  return MetadataReader(image.spec(), ReadImageSize(file)).Read();
}

}  // namespace groundglass
