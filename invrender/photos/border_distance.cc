// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/border_distance.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Depth along the ray of a face's plane, where the ray has z = 1 in `cam`.
class FaceDepths {
 public:
  FaceDepths(const PolygonModel& model, const Camera& camera) {
    planes_.reserve(model.faces.size());
    for (size_t face = 0; face < model.faces.size(); ++face) {
      const FacePlane plane = ComputeFacePlane(model, static_cast<int>(face));
      const Eigen::Vector3d normal_in_cam = camera.cam_from_world.rotation * plane.normal_in_world;
      planes_.push_back(
          {normal_in_cam, plane.offset + normal_in_cam.dot(camera.cam_from_world.translation)});
    }
  }
  double At(int face, const Eigen::Vector3d& ray_in_cam) const {
    return planes_[face].offset / planes_[face].normal_in_cam.dot(ray_in_cam);
  }

 private:
  struct Plane {
    Eigen::Vector3d normal_in_cam;
    double offset;
  };
  std::vector<Plane> planes_;
};

// at[x] becomes the least of at[x'] + kSide |x - x'| within the row, for values up to
// kFarthestBorder: by steps of 1, 2, 4 ... pixels, which compilers turn into vector instructions.
constexpr int kSide = 8;
constexpr int kDiagonal = 11;
constexpr int kKnight = 18;
void SpreadAlongRow(int width, uint8_t* at, uint8_t* copy) {
  for (int step = 1; kSide * step <= kFarthestBorder && step < width; step *= 2) {
    const auto more = static_cast<uint8_t>(kSide * step);
    const auto most = static_cast<uint8_t>(255 - more);
    std::copy_n(at, width, copy);
    for (int x = 0; x < width - step; ++x) {
      const auto from_right = static_cast<uint8_t>(std::min(copy[x + step], most) + more);
      at[x] = std::min(at[x], from_right);
    }
    for (int x = 0; x < width - step; ++x) {
      const auto from_left = static_cast<uint8_t>(std::min(copy[x], most) + more);
      at[x + step] = std::min(at[x + step], from_left);
    }
  }
}

// Every pixel's least sum of a neighbour's value and the way to it, in eighths of a pixel: chamfer
// distances on 5 x 5 (Borgefors 1986), 3 % off at most. Values end at kFarthestBorder.
void SpreadDistances(Image8& steps) {
  static_assert(kFarthestBorder + kKnight <= 255);
  constexpr int kMargin = 2;  // so that no pixel lacks neighbours
  const int width = steps.width;
  const int stride = width + 2 * kMargin;
  // The two rows before the one at work, as they are after it.
  std::vector<uint8_t> rows[3];
  for (std::vector<uint8_t>& row : rows) row.assign(stride, kFarthestBorder);
  std::vector<uint8_t> copy(width);
  const auto sweep = [&](int y) {
    uint8_t* row = steps.At(0, y);
    const uint8_t* near = rows[1].data() + kMargin;
    const uint8_t* far = rows[2].data() + kMargin;
    uint8_t* at = rows[0].data() + kMargin;
    for (int x = 0; x < width; ++x) {
      const uint8_t straight = near[x] + kSide;
      const uint8_t diagonal = std::min(near[x - 1], near[x + 1]) + kDiagonal;
      const uint8_t knight =
          std::min(std::min(near[x - 2], near[x + 2]), std::min(far[x - 1], far[x + 1])) + kKnight;
      at[x] = std::min(std::min(row[x], straight), std::min(diagonal, knight));
    }
    SpreadAlongRow(width, at, copy.data());
    std::copy_n(at, width, row);
    rows[2].swap(rows[1]);
    rows[1].swap(rows[0]);
  };
  for (int y = 0; y < steps.height; ++y) sweep(y);
  for (std::vector<uint8_t>& row : rows) row.assign(stride, kFarthestBorder);
  for (int y = steps.height - 1; y >= 0; --y) sweep(y);
}

template <typename Code>
Image8 FindDarkRim(const Raster<Code>& srgb) {
  constexpr int kDark = 32 << (8 * (sizeof(Code) - 1));
  constexpr double kDarkShare = 0.5;  // of a side, to be a mount's
  constexpr double kDeepest = 0.1;    // of the frame's width
  const int width = srgb.width;
  const int height = srgb.height;
  const int depth = static_cast<int>(kDeepest * std::min(width, height));
  const auto is_dark = [&](int x, int y) {
    const Code* pixel = srgb.At(x, y);
    return std::max({pixel[0], pixel[1], pixel[2]}) < kDark;
  };
  Image8 mount(width, height, 1);
  // From each side inwards, as far as a column (or row) stays dark.
  const auto walk = [&](int count, auto position) {
    int num_dark = 0;
    for (int i = 0; i < count; ++i) {
      const auto [x, y] = position(i, 1);
      num_dark += is_dark(x, y) ? 1 : 0;
    }
    if (num_dark < kDarkShare * count) return;
    for (int i = 0; i < count; ++i) {
      for (int in = 0; in < depth; ++in) {
        const auto [x, y] = position(i, in);
        if (in > 1 && !is_dark(x, y)) break;
        *mount.At(x, y) = 255;
      }
    }
  };
  using Position = std::pair<int, int>;
  if (depth < 2) return mount;
  walk(height, [&](int i, int in) { return Position(in, i); });
  walk(height, [&](int i, int in) { return Position(width - 1 - in, i); });
  walk(width, [&](int i, int in) { return Position(i, in); });
  walk(width, [&](int i, int in) { return Position(i, height - 1 - in); });
  cv::Mat view(height, width, CV_8U, mount.values.data());
  const int reach = std::max(2, static_cast<int>(std::lround(0.004 * width)));
  cv::dilate(view.clone(),
             view,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  return mount;
}

}  // namespace

Image8 ComputeBorderDistance(const PolygonModel& model,
                             const Camera& camera,
                             const Image16& labels,
                             const std::vector<int>& chart_of_face,
                             const Image8& ignored,
                             double crease_bonus_px) {
  const int width = labels.width;
  const int height = labels.height;
  const FaceDepths depths(model, camera);
  // Eighths of a pixel; a pixel beside a border has its centre half a pixel from it.
  constexpr uint8_t kBesideJump = kBorderStepsPerPx / 2;
  const auto beside_crease = static_cast<uint8_t>((0.5 + crease_bonus_px) * kBorderStepsPerPx);
  Image8 border(width, height, 1, kFarthestBorder);
  const auto compare = [&](int x, int y, int other_x, int other_y) {
    const uint16_t first = *labels.At(x, y);
    const uint16_t second = *labels.At(other_x, other_y);
    bool is_crease = false;
    if (first != 0 && second != 0) {
      if (chart_of_face[first - 1] == chart_of_face[second - 1]) return;
      // The two planes meet between the pixels if their depths differ by no more there than each
      // changes within two pixels.
      const Eigen::Vector3d ray = UnprojectToCam(camera, {x + 0.5, y + 0.5});
      const Eigen::Vector3d other = UnprojectToCam(camera, {other_x + 0.5, other_y + 0.5});
      const Eigen::Vector3d middle = (ray + other) / 2;
      const double a = depths.At(first - 1, middle);
      const double b = depths.At(second - 1, middle);
      const double slope = std::abs(depths.At(first - 1, ray) - depths.At(first - 1, other)) +
                           std::abs(depths.At(second - 1, ray) - depths.At(second - 1, other));
      is_crease = std::abs(a - b) <= slope + 0.001 * std::abs(a);
    }
    const uint8_t steps = is_crease ? beside_crease : kBesideJump;
    *border.At(x, y) = std::min(*border.At(x, y), steps);
    *border.At(other_x, other_y) = std::min(*border.At(other_x, other_y), steps);
  };
  for (int y = 0; y < height; ++y) {
    const uint16_t* row = labels.At(0, y);
    const uint16_t* below = labels.At(0, std::min(y + 1, height - 1));
    for (int x = 0; x < width; ++x) {
      if (x + 1 < width && row[x] != row[x + 1]) compare(x, y, x + 1, y);
      if (row[x] != below[x]) compare(x, y, x, y + 1);
    }
  }
  const auto cover = [&](uint8_t value) {
    for (size_t i = 0; i < labels.values.size(); ++i) {
      border.values[i] = labels.values[i] == 0 ? value : border.values[i];
    }
    for (size_t i = 0; i < ignored.values.size(); ++i) {
      border.values[i] = ignored.values[i] != 0 ? value : border.values[i];
    }
  };
  cover(kBesideJump);
  SpreadDistances(border);
  cover(0);
  return border;
}

Image8 FindMount(const Image8& srgb8) { return FindDarkRim(srgb8); }
Image8 FindMount(const Image16& srgb16) { return FindDarkRim(srgb16); }

}  // namespace groundglass
