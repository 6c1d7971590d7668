// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/april_tag_detection.h"

#include "scene/error.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

namespace groundglass {
namespace {

// Detecting at half resolution costs little once edges are snapped, and a quarter of the time.
constexpr int kFullDetailWidthPx = 1600;
// The width at which large AprilTags are sought.
constexpr int kCoarseWidthPx = 1000;
// An AprilTag needs this much contrast between its cells (grey levels).
constexpr float kMinDecisionMargin = 20;

using FamilyPtr = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;
using DetectorPtr = std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)>;
using DetectionsPtr = std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)>;

// The same codes inside a border of this many black cells.
FamilyPtr MakeFamily(int border_cells) {
  FamilyPtr family(tag36h11_create(), tag36h11_destroy);
  const int more = border_cells - 1;
  family->width_at_border += 2 * more;
  family->total_width += 2 * more;
  for (uint32_t bit = 0; bit < family->nbits; ++bit) {
    family->bit_x[bit] += static_cast<uint32_t>(more);
    family->bit_y[bit] += static_cast<uint32_t>(more);
  }
  return family;
}

// The pixels of the picture for one of that in which quads are sought.
float Decimation(int width_px, AprilTagDetail detail) {
  const int fine = width_px > kFullDetailWidthPx ? 2 : 1;
  return static_cast<float>(
      detail == AprilTagDetail::kCoarse ? std::max(fine, width_px / kCoarseWidthPx) : fine);
}

// Calls on_found with each detection of the families.
void Detect(const Image8& srgb_grey,
            AprilTagDetail detail,
            const std::vector<apriltag_family_t*>& families,
            int corrected_bits,
            const std::function<void(const apriltag_detection_t&)>& on_found) {
  const DetectorPtr detector(apriltag_detector_create(), apriltag_detector_destroy);
  for (apriltag_family_t* family : families) {
    apriltag_detector_add_family_bits(detector.get(), family, corrected_bits);
  }
  detector->quad_decimate = Decimation(srgb_grey.width, detail);
  // The detector only reads the pixels, though its struct is not const.
  image_u8_t view{srgb_grey.width,
                  srgb_grey.height,
                  srgb_grey.width,
                  const_cast<uint8_t*>(srgb_grey.values.data())};
  const DetectionsPtr found(apriltag_detector_detect(detector.get(), &view),
                            apriltag_detections_destroy);
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* raw = nullptr;
    zarray_get(found.get(), i, &raw);
    if (raw->decision_margin >= kMinDecisionMargin) on_found(*raw);
  }
}

}  // namespace

bool HasCoarseDetail(int width_px) {
  return Decimation(width_px, AprilTagDetail::kCoarse) >
         Decimation(width_px, AprilTagDetail::kFine);
}

std::vector<AprilTagDetection> DetectAprilTags(const Image8& srgb_grey, AprilTagDetail detail) {
  const FamilyPtr narrow = MakeFamily(1);
  const FamilyPtr wide = MakeFamily(2);
  std::map<int, std::vector<AprilTagDetection>> by_id;
  Detect(srgb_grey, detail, {narrow.get(), wide.get()}, 1, [&](const apriltag_detection_t& raw) {
    AprilTagDetection detection;
    detection.id = raw.id;
    detection.border_cells = raw.family == wide.get() ? 2 : 1;
    // The library goes round from the bottom left: (-1, 1), (1, 1), (1, -1), (-1, -1), y down.
    constexpr int kFromLibrary[4] = {3, 2, 1, 0};
    for (int corner = 0; corner < 4; ++corner) {
      const double* point = raw.p[kFromLibrary[corner]];
      detection.corners_px.col(corner) = Eigen::Vector2d(point[0], point[1]);
    }
    by_id[raw.id].push_back(detection);
  });
  std::vector<AprilTagDetection> detections;
  for (const auto& [id, seen] : by_id) {
    if (seen.size() == 1) detections.push_back(seen.front());
  }
  return detections;
}

std::string DescribeOtherAprilTags(const Image8& srgb_grey) {
  // Fewer than so many may be chance, in the families with few bits above all.
  constexpr int kMinAprilTags = 4;
  struct OtherFamily {
    const char* name;
    FamilyPtr family;
    int num_found = 0;
  };
  std::vector<OtherFamily> others;
  others.push_back({"tag25h9", FamilyPtr(tag25h9_create(), tag25h9_destroy)});
  others.push_back({"tag16h5", FamilyPtr(tag16h5_create(), tag16h5_destroy)});
  others.push_back({"tag36h10", FamilyPtr(tag36h10_create(), tag36h10_destroy)});
  others.push_back(
      {"tagStandard41h12", FamilyPtr(tagStandard41h12_create(), tagStandard41h12_destroy)});
  others.push_back(
      {"tagStandard52h13", FamilyPtr(tagStandard52h13_create(), tagStandard52h13_destroy)});
  others.push_back({"tagCircle21h7", FamilyPtr(tagCircle21h7_create(), tagCircle21h7_destroy)});
  std::vector<apriltag_family_t*> families;
  families.reserve(others.size());
  for (const OtherFamily& other : others) families.push_back(other.family.get());
  Detect(srgb_grey, AprilTagDetail::kFine, families, 0, [&](const apriltag_detection_t& raw) {
    for (OtherFamily& other : others) other.num_found += raw.family == other.family.get() ? 1 : 0;
  });
  const auto most = std::max_element(
      others.begin(), others.end(), [](const OtherFamily& a, const OtherFamily& b) {
        return a.num_found < b.num_found;
      });
  if (most->num_found >= kMinAprilTags) {
    return "the pictures show tags of the family " + std::string(most->name) +
           ", of which no board is read; use one of tag36h11, as --print draws it";
  }
  Image8 changed = srgb_grey;
  for (int y = 0; y < changed.height; ++y) {
    std::reverse(changed.At(0, y), changed.At(0, y) + changed.width);
  }
  if (DetectAprilTags(changed).size() >= kMinAprilTags) {
    return "the pictures are mirrored; turn the slides round, or flip them left to right";
  }
  std::transform(
      srgb_grey.values.begin(), srgb_grey.values.end(), changed.values.begin(), [](uint8_t value) {
        return static_cast<uint8_t>(255 - value);
      });
  if (DetectAprilTags(changed).size() >= kMinAprilTags) {
    return "the pictures are negatives; invert their brightness";
  }
  return "no AprilTags are to be seen; the board's tags need to be sharp, evenly lit, and 20 px or "
         "more wide";
}

AprilTagPattern GetAprilTagPattern(int id) {
  if (id < 0 || id >= kNumAprilTagIds) {
    throw Error("tag " + std::to_string(id) + ": the family tag36h11 has tags 0 to " +
                std::to_string(kNumAprilTagIds - 1));
  }
  const FamilyPtr family(tag36h11_create(), tag36h11_destroy);
  // The code's bits from the highest on, each with its cell; the border stays black.
  AprilTagPattern is_white = AprilTagPattern::Constant(false);
  for (uint32_t bit = 0; bit < family->nbits; ++bit) {
    const bool is_set = (family->codes[id] >> (family->nbits - 1 - bit)) & 1;
    is_white(family->bit_y[bit], family->bit_x[bit]) = is_set;
  }
  return is_white;
}

}  // namespace groundglass
