// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Masks that hide the building: other programs have white for what is to be looked at.
#include "scene/advice/advice_parts.h"
#include "scene/camera.h"
#include "scene/error.h"
#include "scene/formats/ignore_mask.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

constexpr double kNearlyAll = 0.9;
constexpr int kFewPlaces = 12;

// The share of the model's faces in the frame that a mask hides, by places half-way from their
// middles to their corners; none where few are there.
std::optional<double> HiddenShare(const Scene& scene,
                                  const Photograph& photograph,
                                  const Image8& ignore) {
  const Camera camera =
      CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
  int num_seen = 0;
  int num_hidden = 0;
  for (const Face& face : scene.model.faces) {
    Eigen::Vector3d middle_in_world = Eigen::Vector3d::Zero();
    for (const int point : face.points) middle_in_world += scene.model.points_in_world[point];
    middle_in_world /= static_cast<double>(face.points.size());
    for (const int point : face.points) {
      const auto at_px =
          Project(camera, (middle_in_world + scene.model.points_in_world[point]) / 2);
      if (!at_px || at_px->x() < 0 || at_px->y() < 0 || at_px->x() >= ignore.width ||
          at_px->y() >= ignore.height) {
        continue;
      }
      ++num_seen;
      const auto x = static_cast<int>(at_px->x());
      const auto y = static_cast<int>(at_px->y());
      if (ignore.At(x, y)[0] != 0) ++num_hidden;
    }
  }
  if (num_seen < kFewPlaces) return std::nullopt;
  return static_cast<double>(num_hidden) / num_seen;
}

}  // namespace

void AdviseOnMasks(const AdviceContext& context) {
  std::vector<std::string> names;
  for (const Photograph& photograph : context.scene.photographs) {
    if (!photograph.mask_file) continue;
    try {
      const Image8 ignore = ReadIgnoreMask(*photograph.mask_file, photograph.size);
      if (HiddenShare(context.scene, photograph, ignore).value_or(0) < kNearlyAll) continue;
    } catch (const Error&) {
      continue;  // told where it is read
    }
    names.push_back(photograph.name);
  }
  if (names.empty()) return;
  context.Add(
      Advice::Severity::kScene,
      (context.scene.folder / "masks").string(),
      (names.size() == 1 ? "the mask of " : "the masks of ") + ListNames(names) +
          (names.size() == 1 ? " hides" : " hide") + " nearly all that the tag sees of the model",
      "white is what is not to be looked at: where it is the building that is white, invert "
      "the mask");
}

}  // namespace groundglass
