// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/april_tag_corners.h"

#include "calibrate/edge_line.h"
#include "scene/quantile.h"
#include "scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

// Crossings are sought this far on either side of an edge at most (pixels); 3 px hold the blur of
// an ordinary photograph.
constexpr double kMaxReachPx = 3;
constexpr double kMinReachPx = 1.2;
// The levels on either side are averaged over this much beyond the reach (pixels).
constexpr double kLevelPx = 1;
constexpr double kProfileStepPx = 0.25;
// The share of an edge left out at each end, and at least so many pixels: the corners' blur.
constexpr double kEndShare = 0.1;
constexpr double kEndPx = 3;
// Edges wider than this (one standard deviation of their blur, pixels), and those within so many
// deviations of whose levels other cells begin, are measured where they are half as bright.
constexpr double kSoftPx = 1.1;
constexpr double kClearOfCells = 1.5;
// The border and the gap of an AprilTag so small that its edges' levels have no room, but whose
// middles are far enough from the edge to be looked at; pixels.
constexpr double kLeastRoomPx = 1.8;
// Of so many places along an edge its blur is taken.
constexpr int kBlurPlaces = 9;
// The least contrast of an edge, of full scale, linear light.
constexpr double kMinContrast = 0.02;

// A picture's values in linear light. Codes are turned into light where they are looked at: few of
// a photograph's pixels are.
class LinearPicture {
 public:
  explicit LinearPicture(const ImageF& radiance)
      : width(radiance.width), height(radiance.height), radiance_(&radiance) {}
  explicit LinearPicture(const Image8& srgb)
      : width(srgb.width), height(srgb.height), srgb_(&srgb) {}

  double At(int x, int y) const {
    return radiance_ != nullptr ? *radiance_->At(x, y) : linear_[*srgb_->At(x, y)];
  }

  const int width;
  const int height;

 private:
  const ImageF* radiance_ = nullptr;
  const Image8* srgb_ = nullptr;
  const std::array<float, 256>& linear_ = LinearOfSrgb8();
};

// Bilinear value; the first pixel's centre is at (0.5, 0.5). Nothing outside the frame.
std::optional<double> Sample(const LinearPicture& grey, const Eigen::Vector2d& at_px) {
  const double x = at_px.x() - 0.5;
  const double y = at_px.y() - 0.5;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  if (x0 < 0 || y0 < 0 || x0 + 1 >= grey.width || y0 + 1 >= grey.height) return std::nullopt;
  const double u = x - x0;
  const double v = y - y0;
  return (1 - v) * ((1 - u) * grey.At(x0, y0) + u * grey.At(x0 + 1, y0)) +
         v * ((1 - u) * grey.At(x0, y0 + 1) + u * grey.At(x0 + 1, y0 + 1));
}

// How far along `outward` (unit length, pixels) from `at_px` black turns into white: the place
// where an ideal step would have the same area under it as the profile seen.
std::optional<double> FindCrossing(const LinearPicture& grey,
                                   const Eigen::Vector2d& at_px,
                                   const Eigen::Vector2d& outward,
                                   double reach_px) {
  double black = 0;
  double white = 0;
  double area = 0;
  int num_level = 0;
  const int reach_steps = static_cast<int>(std::lround(reach_px / kProfileStepPx));
  const int level_steps = static_cast<int>(std::lround(kLevelPx / kProfileStepPx));
  for (int step = -reach_steps - level_steps; step <= reach_steps + level_steps; ++step) {
    const std::optional<double> value = Sample(grey, at_px + step * kProfileStepPx * outward);
    if (!value) return std::nullopt;
    if (step < -reach_steps) {
      black += *value;
      ++num_level;
    } else if (step > reach_steps) {
      white += *value;
    } else {
      // Trapezoids: the two ends count half.
      area += *value * (std::abs(step) == reach_steps ? 0.5 : 1.0);
    }
  }
  black /= num_level;
  white /= num_level;
  if (white - black < kMinContrast) return std::nullopt;
  const double white_px = (area - 2 * reach_steps * black) / (white - black) * kProfileStepPx;
  const double crossing = reach_steps * kProfileStepPx - white_px;
  if (std::abs(crossing) > 0.8 * reach_px) return std::nullopt;
  return crossing;
}

// The light of an AprilTag's black and white: that of its darkest and brightest cells, into which
// blur brings the least of their neighbours' light.
struct Levels {
  double black = 0;
  double white = 0;
};

std::optional<Levels> FindLevels(const LinearPicture& grey, const AprilTagDetection& tag) {
  constexpr size_t kCells = 4;
  const Eigen::Matrix<double, 2, 4>& corners = tag.corners_px;
  const int cells = kAprilTagCells - 2 + 2 * tag.border_cells;
  std::vector<double> values;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double u = (column + 0.5) / cells;
      const double v = (row + 0.5) / cells;
      // Perspective within an AprilTag is slight: cells' middles are hit well enough.
      const auto value = Sample(grey,
                                (1 - v) * ((1 - u) * corners.col(0) + u * corners.col(1)) +
                                    v * ((1 - u) * corners.col(3) + u * corners.col(2)));
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
  }
  std::sort(values.begin(), values.end());
  return Levels{std::accumulate(values.begin(), values.begin() + kCells, 0.0) / kCells,
                std::accumulate(values.end() - kCells, values.end(), 0.0) / kCells};
}

// Where a profile across an edge is half as bright as between black and the white beside it. Blur
// brings light there from no nearer than the border's other side.
struct HalfCrossing {
  double at_px = 0;    // outward
  double blur_px = 0;  // one standard deviation, if it is normal
};

// black_px, white_px: how far inward and outward the border's and the gap's middles lie. `white`:
// if not given, what is seen there.
std::optional<HalfCrossing> FindHalfCrossing(const LinearPicture& grey,
                                             const Eigen::Vector2d& at_px,
                                             const Eigen::Vector2d& outward,
                                             double black,
                                             std::optional<double> given_white,
                                             double black_px,
                                             double white_px) {
  double white = given_white.value_or(0);
  constexpr int kWhiteSteps = 2;
  for (int step = -kWhiteSteps; step <= kWhiteSteps && !given_white; ++step) {
    const auto value = Sample(grey, at_px + (white_px + step * kProfileStepPx) * outward);
    if (!value) return std::nullopt;
    white += *value / (2 * kWhiteSteps + 1);
  }
  if (white - black < kMinContrast) return std::nullopt;
  const double half = 0.5 * (black + white);
  std::optional<double> before;
  for (double t = -black_px; t <= white_px; t += kProfileStepPx) {
    const std::optional<double> value = Sample(grey, at_px + t * outward);
    if (!value) return std::nullopt;
    if (before && *before <= half && *value > half) {
      const double crossing = t - kProfileStepPx * (*value - half) / (*value - *before);
      const auto inside = Sample(grey, at_px + (crossing - 0.5) * outward);
      const auto outside = Sample(grey, at_px + (crossing + 0.5) * outward);
      if (!inside || !outside || !(*outside > *inside)) return std::nullopt;
      // The slope of a normal edge at its middle is its contrast / (sigma sqrt(2 pi)).
      return HalfCrossing{crossing, (white - black) / (*outside - *inside) / std::sqrt(2 * M_PI)};
    }
    before = value;
  }
  return std::nullopt;
}

// One edge of an AprilTag's black square as it is to be measured; pixels.
struct EdgeToMeasure {
  Eigen::Vector2d from, to, along, outward;
  double length_px = 0;
  double border_px = 0;  // how wide its black border and the white gap appear
  double gap_px = 0;
  double end_px = 0;  // left out at each end

  double RoomPx() const { return std::min(border_px, gap_px); }
  double ReachPx() const { return std::min(kMaxReachPx, 0.9 * RoomPx() - kLevelPx); }
};

EdgeToMeasure EdgeOf(const AprilTagDetection& tag, int number, double gap_share) {
  EdgeToMeasure edge;
  // Edges go round clockwise on the screen, so the white is on the left of the direction.
  edge.from = tag.corners_px.col(number);
  edge.to = tag.corners_px.col((number + 1) % 4);
  edge.length_px = (edge.to - edge.from).norm();
  edge.along = (edge.to - edge.from) / edge.length_px;
  edge.outward = {edge.along.y(), -edge.along.x()};
  // The AprilTag's depth across this edge says how wide its black border and the gap appear.
  const Eigen::Vector2d opposite =
      0.5 * (tag.corners_px.col((number + 2) % 4) + tag.corners_px.col((number + 3) % 4));
  const double depth_px = -edge.outward.dot(opposite - 0.5 * (edge.from + edge.to));
  edge.border_px = depth_px * tag.border_cells / (kAprilTagCells - 2.0 + 2 * tag.border_cells);
  edge.gap_px = depth_px * gap_share;
  edge.end_px = std::max(kEndPx, kEndShare * edge.length_px);
  return edge;
}

// How an AprilTag's edges are to be measured.
struct EdgeLook {
  double blur_px = 0;           // one standard deviation
  std::optional<double> black;  // if they are soft: where they are half as bright
  std::optional<double> white;  // if the gap is too narrow to show it
};

EdgeLook FindLook(const LinearPicture& grey,
                  const AprilTagDetection& tag,
                  const std::array<EdgeToMeasure, 4>& edges) {
  EdgeLook look;
  const std::optional<Levels> levels = FindLevels(grey, tag);
  if (!levels) return look;
  const bool is_small = std::any_of(edges.begin(), edges.end(), [](const EdgeToMeasure& edge) {
    return edge.ReachPx() < kMinReachPx;
  });
  if (is_small) look.white = levels->white;
  std::vector<double> blurs;
  double room_left_px = HUGE_VAL;
  for (const EdgeToMeasure& edge : edges) {
    room_left_px = std::min(room_left_px, edge.RoomPx() - edge.ReachPx() - kLevelPx);
    for (int place = 0; place < kBlurPlaces; ++place) {
      const double s =
          edge.end_px + (edge.length_px - 2 * edge.end_px) * (place + 0.5) / kBlurPlaces;
      const auto half = FindHalfCrossing(grey,
                                         edge.from + s * edge.along,
                                         edge.outward,
                                         levels->black,
                                         look.white,
                                         0.5 * edge.border_px,
                                         0.5 * edge.gap_px);
      if (half) blurs.push_back(half->blur_px);
    }
  }
  if (blurs.size() < kBlurPlaces) return look;
  look.blur_px = UpperMedian(std::move(blurs));
  if (look.blur_px > kSoftPx || kClearOfCells * look.blur_px > room_left_px)
    look.black = levels->black;
  return look;
}

// Every crossing along an edge, in pixels of the photograph.
std::vector<Eigen::Vector2d> FindCrossings(const LinearPicture& grey,
                                           const EdgeToMeasure& edge,
                                           const EdgeLook& look) {
  std::vector<Eigen::Vector2d> crossings;
  for (double s = edge.end_px; s <= edge.length_px - edge.end_px; s += 1) {
    const Eigen::Vector2d on_edge = edge.from + s * edge.along;
    std::optional<double> crossing;
    if (!look.black) {
      crossing = FindCrossing(grey, on_edge, edge.outward, edge.ReachPx());
    } else if (const auto half = FindHalfCrossing(grey,
                                                  on_edge,
                                                  edge.outward,
                                                  *look.black,
                                                  look.white,
                                                  0.5 * edge.border_px,
                                                  0.5 * edge.gap_px)) {
      crossing = half->at_px;
    }
    if (crossing) crossings.push_back(on_edge + *crossing * edge.outward);
  }
  return crossings;
}

std::optional<AprilTagCorners> MeasureCorners(const LinearPicture& grey,
                                              const AprilTagDetection& start,
                                              double gap_share,
                                              const Camera& lens) {
  // Undistorted pixels: normalised coordinates at the focal length's scale.
  const auto undistort = [&lens](const Eigen::Vector2d& image_px) -> Eigen::Vector2d {
    const Eigen::Vector3d ray = UnprojectToCam(lens, image_px);
    return {lens.focal_x_px * ray.x(), lens.focal_y_px * ray.y()};
  };
  std::array<EdgeToMeasure, 4> edges;
  for (int number = 0; number < 4; ++number) {
    EdgeToMeasure& edge = edges[static_cast<size_t>(number)];
    edge = EdgeOf(start, number, gap_share);
    if (edge.RoomPx() < kLeastRoomPx) return std::nullopt;
  }
  const EdgeLook look = FindLook(grey, start, edges);
  for (const EdgeToMeasure& edge : edges) {
    if (edge.ReachPx() >= kMinReachPx) continue;
    // Its levels are looked at half way into border and gap, beyond the edge's own blur.
    if (!look.black || kClearOfCells * look.blur_px > 0.5 * edge.RoomPx()) return std::nullopt;
  }
  std::array<EdgeLine, 4> lines;
  for (size_t number = 0; number < 4; ++number) {
    const EdgeToMeasure& edge = edges[number];
    std::vector<Eigen::Vector2d> crossings = FindCrossings(grey, edge, look);
    if (static_cast<double>(crossings.size()) < 0.5 * (edge.length_px - 2 * edge.end_px)) {
      return std::nullopt;
    }
    for (Eigen::Vector2d& crossing : crossings) crossing = undistort(crossing);
    const auto line = FitLine(std::move(crossings), undistort(edge.from), undistort(edge.to));
    if (!line) return std::nullopt;
    lines[number] = *line;
    // A crossing is known the worse the flatter its edge is.
    lines[number].end_covariance *= std::pow(std::max(1.0, look.blur_px / kSoftPx), 2);
  }

  AprilTagCorners result;
  result.id = start.id;
  result.blur_px = look.blur_px;
  // From the deviations of the lines' ends (start and end of edge 0, 1, 2, 3) to the corners'.
  Eigen::Matrix<double, 8, 8> corners_from_ends = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 8> end_covariance = Eigen::Matrix<double, 8, 8>::Zero();
  for (int corner = 0; corner < 4; ++corner) {
    const int before = (corner + 3) % 4;  // the edge that ends here
    const EdgeLine& ending = lines[static_cast<size_t>(before)];
    const EdgeLine& starting = lines[static_cast<size_t>(corner)];
    Eigen::Matrix2d normals;
    normals << ending.normal.transpose(), starting.normal.transpose();
    if (std::abs(normals.determinant()) < 0.05) return std::nullopt;
    const Eigen::Matrix2d point_from_offsets = normals.inverse();
    const Eigen::Vector2d undistorted =
        point_from_offsets * Eigen::Vector2d(ending.offset, starting.offset);
    const auto image_px = ProjectFromCam(
        lens, {undistorted.x() / lens.focal_x_px, undistorted.y() / lens.focal_y_px, 1});
    if (!image_px) return std::nullopt;
    result.corners_px.segment<2>(2 * corner) = *image_px;
    corners_from_ends.block<2, 1>(2 * corner, 2 * before + 1) = point_from_offsets.col(0);
    corners_from_ends.block<2, 1>(2 * corner, 2 * corner) = point_from_offsets.col(1);
    end_covariance.block<2, 2>(2 * corner, 2 * corner) = starting.end_covariance;
  }
  result.information =
      (corners_from_ends * end_covariance * corners_from_ends.transpose()).inverse();
  return result;
}

}  // namespace

std::optional<AprilTagCorners> MeasureAprilTagCorners(const ImageF& radiance_grey,
                                                      const AprilTagDetection& start,
                                                      double gap_share,
                                                      const Camera& lens) {
  return MeasureCorners(LinearPicture(radiance_grey), start, gap_share, lens);
}

std::optional<AprilTagCorners> MeasureAprilTagCorners(const Image8& srgb_grey,
                                                      const AprilTagDetection& start,
                                                      double gap_share,
                                                      const Camera& lens) {
  return MeasureCorners(LinearPicture(srgb_grey), start, gap_share, lens);
}

}  // namespace groundglass
