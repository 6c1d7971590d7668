// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_board.h"

#include "calibrate/april_tag_corners.h"
#include "calibrate/april_tag_detection.h"
#include "calibrate/board_layout.h"
#include "calibrate/board_solve.h"
#include "scene/error.h"
#include "scene/quantile.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace groundglass {
namespace {

constexpr int kMinPhotographs = 3;
// Before distortion is solved for, a photograph's corners lie this close to the board, as a share
// of the frame's width; if not, it is another board.
constexpr double kMaxStartMisfit = 0.1;
// Sharp photographs of a flat board fit better than this (pixels).
constexpr double kGoodRmsPx = 0.4;
// Photographs in focus and held still are sharper than this (pixels).
constexpr double kSharpPx = 2;

// Measures every detected AprilTag of the board, its corners taken as straight in `lens`.
std::vector<AprilTagCorners> MeasureShot(const Board& board,
                                         const Image8& srgb_grey,
                                         const std::vector<AprilTagDetection>& detections,
                                         const Camera& lens) {
  std::vector<AprilTagCorners> april_tags;
  for (const AprilTagDetection& detection : detections) {
    const int index = detection.id - board.first_id;
    if (index < 0 || index >= board.columns * board.rows) continue;
    auto corners =
        MeasureAprilTagCorners(srgb_grey, detection, board.gap / board.april_tag_size, lens);
    if (!corners) continue;
    corners->id = index;
    april_tags.push_back(*corners);
  }
  return april_tags;
}

// The detections as the solution predicts them: better starts for measuring again.
std::vector<AprilTagDetection> PredictDetections(const Board& board,
                                                 const BoardShot& shot,
                                                 const Camera& lens) {
  std::vector<AprilTagDetection> predicted;
  for (const AprilTagCorners& april_tag : shot.april_tags) {
    const Eigen::Matrix<double, 2, 4> on_board = AprilTagCornersOnBoard(board, april_tag.id);
    AprilTagDetection detection;
    detection.id = april_tag.id + board.first_id;
    detection.border_cells = board.border_cells;
    bool is_seen = true;
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d in_board(on_board(0, corner), on_board(1, corner), 0);
      const auto image_px = ProjectFromCam(lens, shot.cam_from_board * in_board);
      is_seen = is_seen && image_px.has_value();
      if (image_px) detection.corners_px.col(corner) = *image_px;
    }
    if (is_seen) predicted.push_back(detection);
  }
  return predicted;
}

// Of a shot's corners, each axis apart; infinite if the lens cannot see one of them.
double RmsPx(const Board& board, const BoardShot& shot, const Camera& lens) {
  double squared_px = 0;
  for (const AprilTagCorners& april_tag : shot.april_tags) {
    const Eigen::Matrix<double, 2, 4> on_board = AprilTagCornersOnBoard(board, april_tag.id);
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d in_board(on_board(0, corner), on_board(1, corner), 0);
      const auto image_px = ProjectFromCam(lens, shot.cam_from_board * in_board);
      if (!image_px) return std::numeric_limits<double>::infinity();
      squared_px += (*image_px - april_tag.corners_px.segment<2>(2 * corner)).squaredNorm();
    }
  }
  return shot.april_tags.empty() ? 0 : std::sqrt(squared_px / (8.0 * shot.april_tags.size()));
}

// Throws Error with what the photographs show in the board's place.
void CheckFit(double rms_px,
              double max_rms_px,
              const Board& board,
              const std::vector<std::vector<AprilTagDetection>>& detections) {
  if (rms_px <= max_rms_px) return;
  const std::string text = DescribeSeenBoard(board, detections);
  const std::string miss = std::isfinite(rms_px) ? "the corners miss the board by " +
                                                       fmt::format("{:.1f}", rms_px) + " px"
                                                 : std::string("no camera sees the board so");
  throw Error("calibrate board: " + miss +
              "; check columns, rows, tag size and gap, and that the board is flat" +
              (text.empty() ? "" : "; ") + text);
}

// Why too few photographs show the board.
std::string ExplainWhy(std::span<const BoardPhotograph> photographs,
                       size_t num_shots,
                       const Board& board,
                       const std::vector<std::vector<AprilTagDetection>>& detections) {
  const int end_id = board.first_id + board.columns * board.rows;
  size_t num_april_tags = 0;
  size_t num_own = 0;
  size_t most = 0;
  for (size_t i = 0; i < detections.size(); ++i) {
    num_april_tags += detections[i].size();
    num_own += static_cast<size_t>(std::count_if(
        detections[i].begin(), detections[i].end(), [&](const AprilTagDetection& april_tag) {
          return april_tag.id >= board.first_id && april_tag.id < end_id;
        }));
    if (detections[i].size() > detections[most].size()) most = i;
  }
  if (num_april_tags == 0) {
    // Several, since one may show nothing at all.
    std::string text;
    for (size_t i = 0; i < std::min<size_t>(photographs.size(), 3); ++i) {
      text = DescribeOtherAprilTags(photographs[i].srgb_grey);
      if (text.find("no AprilTags") == std::string::npos) break;
    }
    return "; " + text;
  }
  if (2 * num_own > num_april_tags) {
    if (num_shots == photographs.size()) return "";
    return "; " + photographs[most].name + " shows most, " +
           std::to_string(detections[most].size()) +
           ": elsewhere they are too small, blurred or cut off; let the board fill the frame";
  }
  return "; " + DescribeSeenBoard(board, detections);
}

// What would make the lens better known.
std::vector<std::string> Remarks(const std::vector<BoardShot>& shots,
                                 const LensSolution& solution,
                                 const Lens& lens,
                                 int width_px,
                                 int height_px) {
  std::vector<std::string> remarks;
  const Eigen::Vector2d center_px(0.5 * width_px, 0.5 * height_px);
  double reach = 0;
  double tilt_rad = 0;
  std::vector<double> blurs_px;
  for (const BoardShot& shot : shots) {
    tilt_rad = std::max(tilt_rad, std::acos(std::min(1.0, shot.cam_from_board.rotation(2, 2))));
    for (const AprilTagCorners& april_tag : shot.april_tags) {
      blurs_px.push_back(april_tag.blur_px);
      for (int corner = 0; corner < 4; ++corner) {
        reach = std::max(reach, (april_tag.corners_px.segment<2>(2 * corner) - center_px).norm());
      }
    }
  }
  reach /= center_px.norm();
  if (solution.rms_px > kGoodRmsPx) {
    remarks.push_back(
        fmt::format("the corners miss the board by {:.2f} px, where a flat and well measured "
                    "one is good to 0.1: measure the tag size and the gap again",
                    solution.rms_px));
  }
  const double blur_px = UpperMedian(std::move(blurs_px));
  if (blur_px > kSharpPx) {
    remarks.push_back(
        fmt::format("the pictures are blurred: the board's edges spread by {:.1f} px (one standard "
                    "deviation); sharper ones would tell the lens better",
                    blur_px));
  }
  if (reach < 0.75) {
    remarks.push_back(
        fmt::format("the board reaches only {:.0f} % of the way to the frame's corners: "
                    "beyond that, k1 is a guess",
                    100 * reach));
  }
  if (DegreesFromRadians(tilt_rad) < 15) {
    remarks.push_back(
        fmt::format("the board is turned by {:.0f} degrees at most: 20 to 45 would tell the "
                    "view angle better",
                    DegreesFromRadians(tilt_rad)));
  }
  if (lens.sigma_view_angle_deg > 0.01 * lens.view_angle_deg) {
    remarks.push_back(
        fmt::format("the view angle is known to {:.1f} % only: more photographs, from more "
                    "sides",
                    100 * lens.sigma_view_angle_deg / lens.view_angle_deg));
  }
  return remarks;
}

Lens MakeLens(const LensSolution& solution) {
  const auto sigma = [&](int i) { return std::sqrt(solution.covariance(i, i)); };
  Lens lens;
  lens.view_angle_deg = DegreesFromRadians(solution.lens[0]);
  lens.sigma_view_angle_deg = DegreesFromRadians(sigma(0));
  lens.aspect = solution.lens[1];
  lens.sigma_aspect = sigma(1);
  lens.shift_x = solution.lens[2];
  lens.sigma_shift_x = sigma(2);
  lens.shift_y = solution.lens[3];
  lens.sigma_shift_y = sigma(3);
  lens.k1 = solution.lens[4];
  lens.sigma_k1 = sigma(4);
  lens.k2 = solution.lens[5];
  lens.sigma_k2 = sigma(5);
  return lens;
}

void CheckSizes(std::span<const BoardPhotograph> photographs) {
  for (const BoardPhotograph& photograph : photographs) {
    const Image8& image = photograph.srgb_grey;
    const Image8& first = photographs.front().srgb_grey;
    if (image.channels != 1) throw Error(photograph.name, "expected grey, one channel");
    if (image.width != first.width || image.height != first.height) {
      throw Error(photograph.name,
                  std::to_string(image.width) + " x " + std::to_string(image.height) +
                      " pixels, but " + photographs.front().name + " has " +
                      std::to_string(first.width) + " x " + std::to_string(first.height) +
                      "; photographs of one lens have one size");
    }
  }
}

// A board's AprilTags are about as large as one another in a photograph: where many are found at
// low resolution, all are.
std::vector<std::vector<AprilTagDetection>> DetectAll(std::span<const BoardPhotograph> photographs,
                                                      const Board& board,
                                                      const BoardOptions& options) {
  const double enough = options.coarse_share * board.columns * board.rows;
  std::vector<std::vector<AprilTagDetection>> detections(photographs.size());
  tbb::parallel_for(size_t{0}, photographs.size(), [&](size_t i) {
    detections[i] = DetectAprilTags(photographs[i].srgb_grey, AprilTagDetail::kCoarse);
    if (static_cast<double>(detections[i].size()) >= enough ||
        !HasCoarseDetail(photographs[i].srgb_grey.width)) {
      return;
    }
    detections[i] = DetectAprilTags(photographs[i].srgb_grey);
  });
  return detections;
}

// Measures the photographs that show enough of the board, with a lens without distortion. Throws
// Error if they are too few.
std::vector<BoardShot> MeasureShots(std::span<const BoardPhotograph> photographs,
                                    const Board& board,
                                    const std::vector<std::vector<AprilTagDetection>>& detections,
                                    const BoardOptions& options) {
  const int width_px = photographs.front().srgb_grey.width;
  const int height_px = photographs.front().srgb_grey.height;
  const LensVector no_lens{
      2 * std::atan(0.5), static_cast<double>(width_px) / height_px, 0, 0, 0, 0};
  const Camera straight = CameraFromLensVector(no_lens, width_px, height_px);
  std::vector<std::vector<AprilTagCorners>> april_tags(photographs.size());
  tbb::parallel_for(size_t{0}, photographs.size(), [&](size_t i) {
    april_tags[i] = MeasureShot(board, photographs[i].srgb_grey, detections[i], straight);
  });
  std::vector<BoardShot> shots;
  for (size_t i = 0; i < photographs.size(); ++i) {
    if (static_cast<int>(april_tags[i].size()) < options.min_april_tags) continue;
    shots.push_back({i, april_tags[i], {}});
  }
  if (shots.size() < kMinPhotographs) {
    throw Error("calibrate board: " + std::to_string(shots.size()) + " of " +
                std::to_string(photographs.size()) + " photographs show the board with at least " +
                std::to_string(options.min_april_tags) +
                " of its tags; at least 3 are needed, from several sides" +
                ExplainWhy(photographs, shots.size(), board, detections));
  }
  return shots;
}

// Measures again where the solution expects the edges, straight in its lens.
void MeasureAgain(std::span<const BoardPhotograph> photographs,
                  const Board& board,
                  const Camera& found,
                  std::vector<BoardShot>& shots) {
  tbb::parallel_for(size_t{0}, shots.size(), [&](size_t i) {
    shots[i].april_tags = MeasureShot(board,
                                      photographs[shots[i].photograph].srgb_grey,
                                      PredictDetections(board, shots[i], found),
                                      found);
  });
  std::erase_if(shots, [](const BoardShot& shot) { return shot.april_tags.empty(); });
}

// The same picture three times, or three from one place, tell where the board is and nothing of the
// lens.
void CheckAngle(const Lens& lens, double max_sigma_share) {
  if (lens.sigma_view_angle_deg <= max_sigma_share * lens.view_angle_deg) return;
  throw Error("calibrate board: the view angle is " + fmt::format("{:.0f}", lens.view_angle_deg) +
              " +- " + fmt::format("{:.0f}", lens.sigma_view_angle_deg) +
              " degrees, which is nothing known; photograph the board from several sides, turned "
              "by 20 to 45 degrees, not several times from one");
}

// Says what board the pictures show if the corners miss the one that was given.
void RemarkOnMisfit(const Board& board,
                    const std::vector<std::vector<AprilTagDetection>>& detections,
                    BoardResult& result) {
  if (result.rms_px <= kGoodRmsPx) return;
  const std::string text = DescribeSeenBoard(board, detections);
  if (!text.empty()) result.remarks.push_back(text);
  const std::string as_given =
      " --columns " + std::to_string(board.columns) + " --rows " + std::to_string(board.rows);
  result.shows_other_board =
      text.find(" --columns ") != std::string::npos && text.find(as_given) == std::string::npos;
}

}  // namespace

BoardResult CalibrateBoard(std::span<const BoardPhotograph> photographs,
                           const Board& given,
                           const BoardOptions& options) {
  given.Check();
  options.Check();
  CheckSizes(photographs);
  if (photographs.empty()) throw Error("calibrate board: no photographs");
  const int width_px = photographs.front().srgb_grey.width;
  const int height_px = photographs.front().srgb_grey.height;

  std::vector<std::vector<AprilTagDetection>> detections = DetectAll(photographs, given, options);
  const Board board = FindBoardLayout(given, detections);
  std::vector<BoardShot> shots = MeasureShots(photographs, board, detections, options);

  const LensVector start = EstimateLens(board, shots, width_px, height_px);
  const Camera start_lens = CameraFromLensVector(start, width_px, height_px);
  for (const BoardShot& shot : shots) {
    CheckFit(RmsPx(board, shot, start_lens), kMaxStartMisfit * width_px, board, detections);
  }
  LensSolution solution = RefineLens(board, options, start, shots, width_px, height_px);
  CheckFit(solution.rms_px, options.max_rms_px, board, detections);

  MeasureAgain(photographs, board, CameraFromLensVector(solution.lens, width_px, height_px), shots);
  solution = RefineLens(board, options, solution.lens, shots, width_px, height_px);

  BoardResult result;
  result.layout = DescribeLayout(board);
  result.lens = MakeLens(solution);
  CheckAngle(result.lens, options.max_sigma_share);
  result.num_corners = solution.num_corners;
  result.rms_px = solution.rms_px;
  for (const BoardPhotograph& photograph : photographs) {
    result.photographs.push_back({photograph.name, 0, 0, {}});
  }
  const Camera final_lens = CameraFromLensVector(solution.lens, width_px, height_px);
  for (const BoardShot& shot : shots) {
    BoardSighting& sighting = result.photographs[shot.photograph];
    sighting.num_april_tags = static_cast<int>(shot.april_tags.size());
    sighting.rms_px = RmsPx(board, shot, final_lens);
    sighting.cam_from_board = shot.cam_from_board;
  }
  result.remarks = Remarks(shots, solution, result.lens, width_px, height_px);
  RemarkOnMisfit(board, detections, result);
  return result;
}

}  // namespace groundglass
