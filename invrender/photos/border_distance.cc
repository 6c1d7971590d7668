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

// Tells creases, where two faces meet between two neighbouring pixels, from occlusions.
class CreaseTest {
 public:
  CreaseTest(const PolygonModel& model, const Camera& camera, const BorderOptions& options)
      : camera_(camera), depths_(model, camera), depth_share_(options.crease_depth_share) {}

  // The two planes meet between the pixels if their depths differ by no more there than each
  // changes within two pixels.
  bool Meet(int first,
            int second,
            const Eigen::Vector2d& px,
            const Eigen::Vector2d& other_px) const {
    const Eigen::Vector3d ray = UnprojectToCam(camera_, px);
    const Eigen::Vector3d other = UnprojectToCam(camera_, other_px);
    const Eigen::Vector3d middle = (ray + other) / 2;
    const double a = depths_.At(first, middle);
    const double b = depths_.At(second, middle);
    const double slope = std::abs(depths_.At(first, ray) - depths_.At(first, other)) +
                         std::abs(depths_.At(second, ray) - depths_.At(second, other));
    return std::abs(a - b) <= slope + depth_share_ * std::abs(a);
  }

 private:
  const Camera& camera_;
  FaceDepths depths_;
  double depth_share_;
};

// Eighths of a pixel; a pixel beside a border has its centre half a pixel from it.
constexpr uint8_t kBesideOcclusion = kBorderStepsPerPx / 2;

// The pixels on both sides of each border get their distance to it.
void MarkBorders(const CreaseTest& creases,
                 const Image16& labels,
                 const std::vector<int>& chart_of_face,
                 const BorderOptions& options,
                 Image8& border) {
  const auto beside_crease =
      static_cast<uint8_t>((0.5 + options.crease_bonus_px) * kBorderStepsPerPx);
  const auto compare = [&](int x, int y, int other_x, int other_y) {
    const int first = *labels.At(x, y) - 1;
    const int second = *labels.At(other_x, other_y) - 1;
    const bool are_faces = first >= 0 && second >= 0;
    if (are_faces && chart_of_face[first] == chart_of_face[second]) return;
    const bool is_crease =
        are_faces &&
        creases.Meet(first, second, {x + 0.5, y + 0.5}, {other_x + 0.5, other_y + 0.5});
    const uint8_t steps = is_crease ? beside_crease : kBesideOcclusion;
    *border.At(x, y) = std::min(*border.At(x, y), steps);
    *border.At(other_x, other_y) = std::min(*border.At(other_x, other_y), steps);
  };
  for (int y = 0; y < labels.height; ++y) {
    const uint16_t* row = labels.At(0, y);
    const uint16_t* below = labels.At(0, std::min(y + 1, labels.height - 1));
    for (int x = 0; x < labels.width; ++x) {
      if (x + 1 < labels.width && row[x] != row[x + 1]) compare(x, y, x + 1, y);
      if (row[x] != below[x]) compare(x, y, x, y + 1);
    }
  }
}

// Pixels without a face, and those to be ignored.
void SetWhereNothingShows(const Image16& labels,
                          const Image8& ignored,
                          uint8_t value,
                          Image8& border) {
  for (size_t i = 0; i < labels.values.size(); ++i) {
    border.values[i] = labels.values[i] == 0 ? value : border.values[i];
  }
  for (size_t i = 0; i < ignored.values.size(); ++i) {
    border.values[i] = ignored.values[i] != 0 ? value : border.values[i];
  }
}

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
// distances on 5 x 5 (Borgefors 1986), 3 % off at most. Values end at kFarthestBorder, so that a
// byte holds them and a vector instruction does 16 pixels at once; cv::distanceTransform does one
// at a time in 32 bits, and knows no sources that start above zero, as creases do.
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
Image8 FindDarkRim(const Raster<Code>& srgb, const MountOptions& options) {
  const int dark = options.dark_code << (8 * (sizeof(Code) - 1));
  const int width = srgb.width;
  const int height = srgb.height;
  const int depth = static_cast<int>(options.deepest_share * std::min(width, height));
  const auto is_dark = [&](int x, int y) {
    const Code* pixel = srgb.At(x, y);
    return std::max({pixel[0], pixel[1], pixel[2]}) < dark;
  };
  Image8 mount(width, height, 1);
  // From each side inwards, as far as a column (or row) stays dark.
  const auto walk = [&](int count, auto position) {
    int num_dark = 0;
    for (int i = 0; i < count; ++i) {
      const auto [x, y] = position(i, 1);
      num_dark += is_dark(x, y) ? 1 : 0;
    }
    if (num_dark < options.dark_share * count) return;
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
  const int reach = std::max(2, static_cast<int>(std::lround(options.widening_share * width)));
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
                             const BorderOptions& options) {
  Image8 border(labels.width, labels.height, 1, kFarthestBorder);
  MarkBorders(CreaseTest(model, camera, options), labels, chart_of_face, options, border);
  SetWhereNothingShows(labels, ignored, kBesideOcclusion, border);
  SpreadDistances(border);
  SetWhereNothingShows(labels, ignored, 0, border);
  return border;
}

Image8 FindMount(const Image8& srgb8, const MountOptions& options) {
  return FindDarkRim(srgb8, options);
}
Image8 FindMount(const Image16& srgb16, const MountOptions& options) {
  return FindDarkRim(srgb16, options);
}

}  // namespace groundglass
