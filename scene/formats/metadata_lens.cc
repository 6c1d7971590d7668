// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/metadata_lens.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/sensor_table.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Half the diagonal of 36 mm x 24 mm, twice.
const double kDiagonal35mm = std::hypot(36.0, 24.0);
constexpr double kShape35mm = 1.5;
// Focal lengths that differ by no more than this share are the same; one of them is rounded.
constexpr double kSameFocalLength = 0.02;
// A whole number that stands for any within half of it, one standard deviation.
const double kRounding = 1 / std::sqrt(12.0);
// Sides that differ by no more than this are the same shape: whole pixels, and cameras' margins.
constexpr double kSameAspect = 0.01;
// A camera's pixels are square to this share, one standard deviation.
constexpr double kSquarePixels = 0.001;

std::string SidesOf(const ImageSize& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

// The frame when it was taken, in pixels of the picture as it is now.
struct WholeFrame {
  double width_px = 0;
  double height_px = 0;
  std::string remark;  // if the picture is not the whole frame
  bool is_known = true;
};

WholeFrame FindWholeFrame(const PhotographMetadata& metadata) {
  const ImageSize& now = metadata.size;
  WholeFrame frame{static_cast<double>(now.width), static_cast<double>(now.height), "", true};
  if (!metadata.size_when_taken) return frame;
  ImageSize taken = *metadata.size_when_taken;
  const auto is_same_shape = [&](const ImageSize& other) {
    return std::abs(static_cast<double>(other.width) * now.height / other.height / now.width - 1) <
           kSameAspect;
  };
  if (is_same_shape(taken)) return frame;
  const ImageSize turned{taken.height, taken.width, 1};
  if (is_same_shape(turned)) {
    frame.remark = ", turned since it was taken";
    return frame;
  }
  frame.remark = ", cropped since it was taken (" + SidesOf(taken) + ")";
  if (taken.width == now.width || taken.height == now.height) {
    frame.width_px = taken.width;
    frame.height_px = taken.height;
  } else if (turned.width == now.width || turned.height == now.height) {
    frame.width_px = turned.width;
    frame.height_px = turned.height;
  } else {
    frame.is_known = false;
  }
  frame.is_known = frame.is_known && frame.width_px >= now.width && frame.height_px >= now.height;
  return frame;
}

// How much less than of a digital camera's whole frame is known of a picture, as shares.
struct ScanDoubt {
  double focal = 0;
  double aspect = 0;
  std::string remark;
};

// 36 mm x 24 mm of film, if the focal length for it is the lens' own.
bool IsOn35mmFilm(const PhotographMetadata& metadata) {
  return metadata.focal_length_mm && metadata.focal_length_35mm &&
         std::abs(*metadata.focal_length_35mm / *metadata.focal_length_mm - 1) < kSameFocalLength;
}

ScanDoubt FindScanDoubt(const PhotographMetadata& metadata, const MetadataLensOptions& options) {
  if (metadata.made_by == PictureMaker::kDigitalCamera) return {};
  ScanDoubt doubt{options.scan_scale_share, options.scan_aspect_share, ""};
  doubt.remark = metadata.made_by == PictureMaker::kScanner
                     ? ", scanned"
                     : ", perhaps scanned, since nothing says that a digital camera took it";
  if (!IsOn35mmFilm(metadata)) return doubt;
  const double shape = static_cast<double>(std::max(metadata.size.width, metadata.size.height)) /
                       std::min(metadata.size.width, metadata.size.height);
  const double off = std::abs(std::log(shape / kShape35mm));
  if (off <= kSameAspect) return doubt;
  // Cropped from the sides or squeezed: the diagonal's view angle lies midway between.
  doubt.focal = std::hypot(doubt.focal, off / 2);
  doubt.aspect = std::hypot(doubt.aspect, off);
  doubt.remark += "; " + SidesOf(metadata.size) + " is not the shape of 35 mm film";
  return doubt;
}

// The focal length in pixels of the picture as it is, with its standard deviation as a share.
struct FocalLength {
  double px = 0;
  double sigma_share = 0;
  std::string how;
};

std::optional<FocalLength> FindFocalLength(const PhotographMetadata& metadata,
                                           const WholeFrame& frame,
                                           const MetadataLensOptions& options) {
  const double longer_px = std::max(frame.width_px, frame.height_px);
  if (metadata.focal_length_mm && options.sensor_width_mm) {
    return FocalLength{*metadata.focal_length_mm / *options.sensor_width_mm * longer_px,
                       options.focal_length_share,
                       FormatNumber(*metadata.focal_length_mm) + " mm on a sensor " +
                           FormatNumber(*options.sensor_width_mm) + " mm wide"};
  }
  // No sensor is so much larger than 36 mm x 24 mm: one of the two was filled in with another
  // thing.
  const bool is_contradiction =
      metadata.focal_length_mm && metadata.focal_length_35mm &&
      *metadata.focal_length_35mm < options.least_crop_factor * *metadata.focal_length_mm;
  if (metadata.focal_length_35mm && !is_contradiction) {
    const double focal_mm = *metadata.focal_length_35mm;
    return FocalLength{focal_mm / kDiagonal35mm * std::hypot(frame.width_px, frame.height_px),
                       std::hypot(options.focal_length_share, kRounding / focal_mm),
                       FormatNumber(focal_mm) + " mm for 35 mm film"};
  }
  if (metadata.focal_length_mm && metadata.pixels_per_mm && metadata.size_when_taken) {
    const double taken_px =
        std::max(metadata.size_when_taken->width, metadata.size_when_taken->height);
    const double sensor_mm = taken_px / *metadata.pixels_per_mm;
    // Sensors of phones to medium format; else the field was filled in with the print's resolution.
    if (sensor_mm > 2 && sensor_mm < 70) {
      return FocalLength{*metadata.focal_length_mm / sensor_mm * longer_px,
                         options.focal_length_share,
                         FormatNumber(*metadata.focal_length_mm) + " mm on a sensor " +
                             FormatNumber(std::round(10 * sensor_mm) / 10) + " mm wide"};
    }
  }
  if (!metadata.focal_length_mm) return std::nullopt;
  const std::optional<double> crop =
      FindCropFactor(metadata.maker, metadata.model, options.sensor_tables);
  if (!crop) return std::nullopt;
  return FocalLength{*metadata.focal_length_mm * *crop / kDiagonal35mm *
                         std::hypot(frame.width_px, frame.height_px),
                     std::hypot(options.focal_length_share, options.sensor_table_share),
                     FormatNumber(*metadata.focal_length_mm) + " mm on a sensor " +
                         FormatNumber(*crop) +
                         " times smaller than 36 mm x 24 mm, by lensfun's table"};
}

std::string WhyNone(const PhotographMetadata& metadata, const MetadataLensOptions& options) {
  if (!metadata.focal_length_mm) {
    for (const std::string& fault : metadata.faults) {
      if (fault.starts_with("focal length")) return "the picture's metadata have a " + fault;
    }
    return "the picture's metadata say no focal length";
  }
  const std::string camera = metadata.model.empty() ? "its camera" : "the " + metadata.model;
  return "the picture's metadata say a focal length of " + FormatNumber(*metadata.focal_length_mm) +
         " mm, but not how large the sensor of " + camera + " is" +
         (HasSensorTables(options.sensor_tables)
              ? ", nor has lensfun's table it (give groundglass calibrate lens --sensor-width)"
              : " (install lensfun's table of cameras, Debian's liblensfun-data-v1, or give "
                "groundglass calibrate lens --sensor-width)");
}

}  // namespace

void MetadataLensOptions::Check() const {
  CheckFromTo(focal_length_share, 1e-6, 1, "metadata lens options: focal_length_share");
  CheckAbove(sensor_table_share, 0, "metadata lens options: sensor_table_share");
  CheckAtLeast(least_crop_factor, 0, "metadata lens options: least_crop_factor");
  CheckAtLeast(scan_scale_share, 0, "metadata lens options: scan_scale_share");
  CheckAtLeast(scan_aspect_share, 0, "metadata lens options: scan_aspect_share");
  if (sensor_width_mm) CheckFromTo(*sensor_width_mm, 1, 500, "sensor-width");
}

MetadataLens FindMetadataLens(const PhotographMetadata& metadata,
                              const MetadataLensOptions& options) {
  options.Check();
  if (metadata.is_panorama) return {{}, 0, 0, "a panorama, which has no view angle of a lens"};
  if (metadata.digital_zoom && *metadata.digital_zoom > 1.01) {
    return {{},
            0,
            0,
            "digital zoom of " + FormatNumber(*metadata.digital_zoom) +
                ", which cameras count into their focal lengths or not"};
  }
  const WholeFrame frame = FindWholeFrame(metadata);
  const std::optional<FocalLength> focal = FindFocalLength(metadata, frame, options);
  if (!focal) return {{}, 0, 0, WhyNone(metadata, options)};
  if (!frame.is_known) {
    return {{},
            0,
            0,
            "the picture has " + SidesOf(metadata.size) + " pixels" + frame.remark +
                " by both sides, so its scale is not known"};
  }
  const ScanDoubt doubt = FindScanDoubt(metadata, options);
  const double half_tangent = metadata.size.width / (2 * focal->px);
  MetadataLens found;
  found.view_angle_deg = DegreesFromRadians(2 * std::atan(half_tangent));
  found.sigma_deg = DegreesFromRadians(2 * half_tangent / (1 + half_tangent * half_tangent)) *
                    std::hypot(focal->sigma_share, doubt.focal);
  found.sigma_aspect_share = std::hypot(kSquarePixels, doubt.aspect);
  const std::string camera = std::string(TrimBlanks(metadata.model.starts_with(metadata.maker)
                                                        ? metadata.model
                                                        : metadata.maker + " " + metadata.model));
  found.how =
      focal->how + (camera.empty() ? "" : " (" + camera + ")") + frame.remark + doubt.remark;
  return found;
}

KnownKeys KeysOfMetadata(const MetadataLens& lens, const ImageSize& size) {
  KnownKeys keys;
  if (!lens.view_angle_deg) return keys;
  const double aspect = static_cast<double>(size.width) / size.height;
  AddKnown(keys, "v", *lens.view_angle_deg, lens.how);
  AddKnown(keys, "sigma_v", lens.sigma_deg);
  AddKnown(keys, "a", aspect);
  AddKnown(keys, "sigma_a", lens.sigma_aspect_share * aspect);
  return keys;
}

}  // namespace groundglass
