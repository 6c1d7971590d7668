// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/tag_detection.h"

#include "scene/error.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <map>
#include <memory>

namespace groundglass {
namespace {

// Detecting at half resolution costs little once edges are snapped, and a quarter of the time.
constexpr int kFullDetailWidthPx = 1600;
// A tag needs this much contrast between its cells (grey levels).
constexpr float kMinDecisionMargin = 20;

using FamilyPtr = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;
using DetectorPtr = std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)>;
using DetectionsPtr = std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)>;

}  // namespace

std::vector<TagDetection> DetectTags(const Image8& srgb_grey) {
  const FamilyPtr family(tag36h11_create(), tag36h11_destroy);
  const DetectorPtr detector(apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), family.get(), 1);
  detector->quad_decimate = srgb_grey.width > kFullDetailWidthPx ? 2.0F : 1.0F;

  // The detector only reads the pixels, though its struct is not const.
  image_u8_t view{srgb_grey.width,
                  srgb_grey.height,
                  srgb_grey.width,
                  const_cast<uint8_t*>(srgb_grey.values.data())};
  const DetectionsPtr found(apriltag_detector_detect(detector.get(), &view),
                            apriltag_detections_destroy);

  std::map<int, std::vector<TagDetection>> by_id;
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* raw = nullptr;
    zarray_get(found.get(), i, &raw);
    if (raw->decision_margin < kMinDecisionMargin) continue;
    TagDetection detection;
    detection.id = raw->id;
    // The library goes round from the bottom left: (-1, 1), (1, 1), (1, -1), (-1, -1), y down.
    constexpr int kFromLibrary[4] = {3, 2, 1, 0};
    for (int corner = 0; corner < 4; ++corner) {
      const double* point = raw->p[kFromLibrary[corner]];
      detection.corners_px.col(corner) = Eigen::Vector2d(point[0], point[1]);
    }
    by_id[raw->id].push_back(detection);
  }
  std::vector<TagDetection> detections;
  for (const auto& [id, seen] : by_id) {
    if (seen.size() == 1) detections.push_back(seen.front());
  }
  return detections;
}

TagPattern GetTagPattern(int id) {
  if (id < 0 || id >= kNumTagIds) {
    throw Error("tag " + std::to_string(id) + ": the family tag36h11 has tags 0 to " +
                std::to_string(kNumTagIds - 1));
  }
  const FamilyPtr family(tag36h11_create(), tag36h11_destroy);
  // The code's bits from the highest on, each with its cell; the border stays black.
  TagPattern is_white = TagPattern::Constant(false);
  for (uint32_t bit = 0; bit < family->nbits; ++bit) {
    const bool is_set = (family->codes[id] >> (family->nbits - 1 - bit)) & 1;
    is_white(family->bit_y[bit], family->bit_x[bit]) = is_set;
  }
  return is_white;
}

}  // namespace groundglass
