// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/slide_frame.h"

#include "scene/check_option.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// Places along a side at which the border's end is looked for.
constexpr int kPlaces = 160;
// The middle part of a side: corners may be round.
constexpr double kMiddleShare = 0.8;
// Places on a line lie this near to it, and those well outside of it (towards the rim) speak
// against it by so much; shares of the scan's shorter side.
constexpr double kOnLine = 0.004;
constexpr double kAgainst = 2;

// A scan seen with one of its sides on the left: u runs into the picture, t along the side.
class SideView {
 public:
  SideView(const Image8& grey, int side) : grey_(grey), side_(side) {}

  int Depth() const { return IsUpright() ? grey_.width : grey_.height; }
  int Length() const { return IsUpright() ? grey_.height : grey_.width; }

  // The mean of three neighbours along the side.
  double At(int u, int t) const {
    double sum = 0;
    for (int near = -1; near <= 1; ++near) sum += Pixel(u, std::clamp(t + near, 0, Length() - 1));
    return sum / 3;
  }

  // The line u = offset + slope t (pixels' corners are whole numbers) as normal . p = distance in
  // `image`, the normal pointing into the picture.
  std::pair<Eigen::Vector2d, double> LineInImage(double offset, double slope) const {
    const Eigen::Vector2d first = InImage(offset, 0);
    const Eigen::Vector2d second = InImage(offset + slope * Length(), Length());
    const Eigen::Vector2d along = (second - first).normalized();
    Eigen::Vector2d normal(-along.y(), along.x());
    const Eigen::Vector2d inside = InImage(offset + 1, 0) - first;
    if (normal.dot(inside) < 0) normal = -normal;
    return {normal, normal.dot(first)};
  }

 private:
  bool IsUpright() const { return side_ == 0 || side_ == 2; }
  Eigen::Vector2d InImage(double u, double t) const {
    switch (side_) {
      case 0:
        return {u, t};
      case 1:
        return {t, u};
      case 2:
        return {grey_.width - u, t};
      default:
        return {t, grey_.height - u};
    }
  }
  int Pixel(int u, int t) const {
    switch (side_) {
      case 0:
        return *grey_.At(u, t);
      case 1:
        return *grey_.At(t, u);
      case 2:
        return *grey_.At(grey_.width - 1 - u, t);
      default:
        return *grey_.At(t, grey_.height - 1 - u);
    }
  }

  const Image8& grey_;
  int side_;
};

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The border's grey beside a side; nothing if it is not even.
std::optional<double> BorderLevel(const SideView& view, const FrameOptions& options) {
  const int deep = std::max(2, view.Depth() / 150);
  std::vector<double> levels;
  for (int i = 0; i < kPlaces; ++i) {
    const int t = static_cast<int>((i + 0.5) / kPlaces * view.Length());
    for (int u = 1; u <= deep; ++u) levels.push_back(view.At(u, t));
  }
  const double level = MedianOf(levels);
  const auto num_even = std::count_if(levels.begin(), levels.end(), [&](double value) {
    return std::abs(value - level) <= options.even_levels;
  });
  if (static_cast<double>(num_even) < options.even_share * static_cast<double>(levels.size())) {
    return std::nullopt;
  }
  return level;
}

// Where the border ends, at places along a side: (t, u), pixels' corners at whole numbers.
std::vector<Eigen::Vector2d> FindBorderEnds(const SideView& view,
                                            double level,
                                            const FrameOptions& options) {
  std::vector<Eigen::Vector2d> ends;
  const int deepest = static_cast<int>(options.deepest_share * view.Depth());
  for (int i = 0; i < kPlaces; ++i) {
    const double share = 0.5 - kMiddleShare / 2 + (i + 0.5) / kPlaces * kMiddleShare;
    const int t = static_cast<int>(share * view.Length());
    const auto differs = [&](int u) {
      return std::abs(view.At(u, t) - level) > options.contrast_levels;
    };
    for (int u = 0; u + 2 < deepest; ++u) {
      if (!differs(u) || !differs(u + 1) || !differs(u + 2)) continue;
      // Half way between the border's grey and the picture's, as blur leaves it.
      const double inside = view.At(u + 2, t);
      const double half = (level + inside) / 2;
      double place = u;
      for (int near = std::max(0, u - 3); near < u + 2; ++near) {
        const double before = view.At(near, t) - half;
        const double behind = view.At(near + 1, t) - half;
        if (before * behind > 0 || before == behind) continue;
        place = near + before / (before - behind) + 0.5;
        break;
      }
      if (u > 0) ends.emplace_back(t + 0.5, place);
      break;
    }
  }
  return ends;
}

struct FrameSide {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  // into the picture, unit length
  double distance_px = 0;                            // normal . p of its points
  double sigma_px = 0;
  double sigma_deg = 0;
};

// The line on which most places lie and few lie outside, fitted by least squares.
std::optional<FrameSide> FitSide(const SideView& view,
                                 const std::vector<Eigen::Vector2d>& ends,
                                 double near_px,
                                 const FrameOptions& options) {
  const double most_slope = std::tan(RadiansFromDegrees(options.most_turn_deg));
  double best_score = 0;
  double best_offset = 0, best_slope = 0;
  const size_t step = std::max<size_t>(1, ends.size() / 40);
  for (size_t a = 0; a < ends.size(); a += step) {
    for (size_t b = a + step; b < ends.size(); b += step) {
      const double run = ends[b].x() - ends[a].x();
      if (run < view.Length() / 10.0) continue;
      const double slope = (ends[b].y() - ends[a].y()) / run;
      if (std::abs(slope) > most_slope) continue;
      const double offset = ends[a].y() - slope * ends[a].x();
      double score = 0;
      for (const Eigen::Vector2d& end : ends) {
        const double deeper = end.y() - offset - slope * end.x();
        if (std::abs(deeper) <= near_px) score += 1;
        if (deeper < -2 * near_px) score -= kAgainst;
      }
      if (score > best_score) {
        best_score = score;
        best_offset = offset;
        best_slope = slope;
      }
    }
  }
  if (best_score < options.least_on_line * kPlaces) return std::nullopt;
  double n = 0, s = 0, ss = 0, o = 0, so = 0, residuals = 0;
  for (int round = 0; round < 3; ++round) {
    n = s = ss = o = so = residuals = 0;
    for (const Eigen::Vector2d& end : ends) {
      const double off = end.y() - best_offset - best_slope * end.x();
      if (std::abs(off) > near_px) continue;
      n += 1;
      s += end.x();
      ss += end.x() * end.x();
      o += end.y();
      so += end.x() * end.y();
      residuals += off * off;
    }
    const double determinant = n * ss - s * s;
    if (n < 4 || determinant <= 0) return std::nullopt;
    best_slope = (n * so - s * o) / determinant;
    best_offset = (o - best_slope * s) / n;
  }
  const double noise_px = std::max(0.1, std::sqrt(residuals / n));
  const auto [normal, distance] = view.LineInImage(best_offset, best_slope);
  FrameSide side{normal, distance, 0, 0};
  // Neighbouring places are no independent witnesses: as if one in four counted.
  side.sigma_px = 2 * noise_px / std::sqrt(n);
  side.sigma_deg = DegreesFromRadians(2 * noise_px / std::sqrt(std::max(1e-9, ss - s * s / n)));
  return side;
}

// How far a side is turned clockwise from where it lies in an upright frame; degrees.
double TurnOf(const FrameSide& side, int number) {
  constexpr std::array<double, 4> kUpright_deg = {0, 90, 180, 270};
  const double angle = DegreesFromRadians(std::atan2(side.normal.y(), side.normal.x()));
  return std::remainder(angle - kUpright_deg[static_cast<size_t>(number)], 360.0);
}

using FrameSides = std::array<std::optional<FrameSide>, 4>;

// The turn that all sides have; a reason in `frame` where they have none.
bool FindTurn(const FrameSides& sides, const FrameOptions& options, SlideFrame& frame) {
  double weights = 0, sum = 0, least = 1e9, most = -1e9;
  for (int i = 0; i < 4; ++i) {
    const auto& side = sides[static_cast<size_t>(i)];
    if (!side) continue;
    const double turn = TurnOf(*side, i);
    const double weight = 1 / (side->sigma_deg * side->sigma_deg);
    weights += weight;
    sum += weight * turn;
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  if (most - least > options.square_deg) {
    frame.reason = "what ends along its sides makes no rectangle";
    return false;
  }
  frame.turn_deg = sum / weights;
  frame.sigma_turn_deg = std::max(1 / std::sqrt(weights), (most - least) / 4);
  return true;
}

// What lies between two opposite sides along an axis.
struct Extent {
  double middle = 0;
  double size = 0;
};

// Where a side lies along an axis, beside a point of the frame's middle.
double PlaceAlong(const FrameSide& side,
                  const Eigen::Vector2d& axis,
                  const Eigen::Vector2d& beside) {
  return beside.dot(axis) + (side.distance_px - side.normal.dot(beside)) / side.normal.dot(axis);
}

// Between two opposite sides; where one is missing, `size_if_missing` tells.
Extent Between(const std::optional<FrameSide>& low,
               const std::optional<FrameSide>& high,
               const Eigen::Vector2d& axis,
               const Eigen::Vector2d& beside,
               double size_if_missing) {
  if (low && high) {
    const double from = PlaceAlong(*low, axis, beside);
    const double to = PlaceAlong(*high, axis, beside);
    return {(from + to) / 2, to - from};
  }
  const double middle = low ? PlaceAlong(*low, axis, beside) + size_if_missing / 2
                            : PlaceAlong(*high, axis, beside) - size_if_missing / 2;
  return {middle, size_if_missing};
}

// Middle and size of the frame whose sides these are, at least three.
void FindExtents(const FrameSides& sides, const FrameOptions& options, SlideFrame& frame) {
  const double turn = RadiansFromDegrees(frame.turn_deg);
  const Eigen::Vector2d right(std::cos(turn), std::sin(turn));
  const Eigen::Vector2d down(-right.y(), right.x());
  // Sides are not quite at right angles, so where they are looked at matters: once more beside the
  // middle that comes out.
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector2d beside = frame.center_px;
    const double aspect = options.aspect.value_or(1);
    const bool has_width = sides[0] && sides[2];
    const Extent first = has_width ? Between(sides[0], sides[2], right, beside, 0)
                                   : Between(sides[1], sides[3], down, beside, 0);
    const Extent across =
        has_width ? first : Between(sides[0], sides[2], right, beside, first.size * aspect);
    const Extent along =
        has_width ? Between(sides[1], sides[3], down, beside, first.size / aspect) : first;
    frame.center_px = across.middle * right + along.middle * down;
    frame.width_px = across.size;
    frame.height_px = along.size;
  }
}

// Width / height of the whole raster of a television camera's frame of this size.
std::optional<double> CameraRasterAspect(int width_px, int height_px) {
  const bool is_525 = height_px == 480 || height_px == 486;
  const bool is_625 = height_px == 576;
  if (width_px == 720 && is_525) return 4.0 / 3 * 720 / 710.85;
  if (width_px == 704 && is_525) return 4.0 / 3 * 704 / 710.85;
  if (width_px == 720 && is_625) return 4.0 / 3 * 720 / 702;
  if (width_px == 704 && is_625) return 4.0 / 3 * 704 / 702;
  if ((width_px == 640 && height_px == 480) || (width_px == 768 && is_625)) return 4.0 / 3;
  return std::nullopt;
}

}  // namespace

void FrameOptions::Check() const {
  CheckFromTo(even_share, 0, 1, "frame options: even_share");
  CheckAtLeast(even_levels, 0, "frame options: even_levels");
  CheckAbove(contrast_levels, 0, "frame options: contrast_levels");
  CheckFromTo(deepest_share, 0, 0.5, "frame options: deepest_share");
  CheckFromTo(most_turn_deg, 0, 40, "frame options: most_turn_deg");
  CheckFromTo(least_on_line, 0, 1, "frame options: least_on_line");
  CheckAbove(square_deg, 0, "frame options: square_deg");
  CheckAtLeast(least_aspect, 0.1, "frame options: least_aspect");
  CheckAtLeast(most_aspect, least_aspect, "frame options: most_aspect");
  CheckAbove(mount_play, 0, "frame options: mount_play");
  CheckAbove(least_aspect_sigma, 0, "frame options: least_aspect_sigma");
  CheckAbove(video_aspect_share, 0, "frame options: video_aspect_share");
  CheckAbove(slide_aspect, 0, "frame options: slide_aspect");
  CheckAtLeast(blur_px, 0, "frame options: blur_px");
  if (aspect) CheckFromTo(*aspect, 0.1, 10, "aspect");
}

SlideFrame FindSlideFrame(const Image8& srgb_grey, const FrameOptions& options) {
  options.Check();
  SlideFrame frame;
  if (std::min(srgb_grey.width, srgb_grey.height) < 64) {
    frame.reason = "the scan is smaller than 64 pixels";
    return frame;
  }
  const double near_px = std::max(1.2, kOnLine * std::min(srgb_grey.width, srgb_grey.height));
  FrameSides sides;
  int num_seen = 0;
  for (int i = 0; i < 4; ++i) {
    const SideView view(srgb_grey, i);
    const std::optional<double> level = BorderLevel(view, options);
    if (!level) continue;
    auto& side = sides[static_cast<size_t>(i)];
    side = FitSide(view, FindBorderEnds(view, *level, options), near_px, options);
    frame.is_side_seen[static_cast<size_t>(i)] = side.has_value();
    if (!side) continue;
    ++num_seen;
    frame.sigma_px = std::max(frame.sigma_px, side->sigma_px);
  }
  if (num_seen < 3) {
    frame.reason = num_seen == 0
                       ? "no even border surrounds the picture"
                       : "only " + std::to_string(num_seen) +
                             (num_seen == 1 ? " side of a border is" : " sides of a border are") +
                             " there; three are needed";
    return frame;
  }
  if (!FindTurn(sides, options, frame)) return frame;
  if (num_seen == 3 && !options.aspect) {
    frame.reason =
        "one side of the frame lies outside of the scan; --aspect tells where (width / height)";
    return frame;
  }
  frame.center_px = {srgb_grey.width / 2.0, srgb_grey.height / 2.0};
  FindExtents(sides, options, frame);
  const double aspect =
      std::max(frame.width_px, frame.height_px) / std::min(frame.width_px, frame.height_px);
  if (!(aspect >= options.least_aspect && aspect <= options.most_aspect)) {
    frame.reason = "what its border leaves is no picture's shape";
    return frame;
  }
  frame.is_found = true;
  return frame;
}

std::optional<VideoAspect> FindVideoAspect(int width_px,
                                           int height_px,
                                           const FrameOptions& options) {
  options.Check();
  const std::optional<double> camera = CameraRasterAspect(width_px, height_px);
  if (!camera) return std::nullopt;
  if (options.aspect)
    return VideoAspect{*options.aspect, options.video_aspect_share * *options.aspect};
  const double slide = options.slide_aspect;
  return VideoAspect{0.5 * (*camera + slide),
                     std::hypot(0.5 * (slide - *camera), options.video_aspect_share * *camera)};
}

}  // namespace groundglass
