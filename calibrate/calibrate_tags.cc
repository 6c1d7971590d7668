// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_tags.h"

#include "calibrate/april_tag_corners.h"
#include "calibrate/april_tag_detection.h"
#include "calibrate/square_poses.h"
#include "calibrate/tags_solver.h"
#include "scene/check_option.h"
#include "scene/cholesky.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace groundglass {
namespace {

// Corners of tags too small to be measured are as good as the detector's; pixels.
constexpr double kDetectedCorner_px = 0.5;
// White beside a tag that measuring its edges may count on, as a share of its size: one cell.
constexpr double kWhiteBeside = 0.125;

// The surveyed tags that a photograph shows, with their corners.
std::vector<SeenTag> FindSeenTags(const Image8& srgb_grey,
                                  std::span<const SurveyedTag> surveyed,
                                  const Camera& lens,
                                  const TagsOptions& options) {
  std::vector<SeenTag> seen;
  for (const AprilTagDetection& detection : DetectAprilTags(srgb_grey)) {
    const auto place = std::find_if(surveyed.begin(), surveyed.end(), [&](const SurveyedTag& tag) {
      return tag.id == detection.id;
    });
    if (place == surveyed.end()) continue;
    SeenTag tag;
    tag.place = *place;
    const auto measured = MeasureAprilTagCorners(srgb_grey, detection, kWhiteBeside, lens);
    std::optional<Eigen::MatrixXd> root;
    if (measured) root = UpperCholeskyFactor(measured->information);
    if (root) {
      tag.corners_px = measured->corners_px;
      tag.root_information = *root;
    } else {
      tag.corners_px = Eigen::Map<const Eigen::Matrix<double, 8, 1>>(detection.corners_px.data());
      tag.root_information.setIdentity();
      tag.root_information *= options.edge_noise_px / kDetectedCorner_px;
    }
    seen.push_back(tag);
  }
  return seen;
}

std::vector<SeenTagCorner> CornersOf(const std::vector<SeenTag>& seen, const TagsOptions& options) {
  std::vector<SeenTagCorner> corners;
  for (const SeenTag& tag : seen) {
    const Eigen::Matrix<double, 8, 8> information =
        tag.root_information.transpose() * tag.root_information;
    const Eigen::Matrix<double, 8, 1> variances_px =
        information.inverse().diagonal() * options.edge_noise_px * options.edge_noise_px;
    for (int i = 0; i < 4; ++i) {
      corners.push_back({"",
                         tag.place.id,
                         i,
                         tag.corners_px.segment<2>(2 * i),
                         std::sqrt(variances_px.segment<2>(2 * i).maxCoeff()),
                         tag.place.corners_in_world.col(i),
                         tag.place.sigma});
    }
  }
  return corners;
}

struct FoundPose {
  TagsState state;
  double cost = HUGE_VAL;  // half the sum of squares; with the written place's, if there is one
  double rms_px = 0;
  ViewTag tag;
  bool is_upright = false;
};

// What a written place says against a pose, in the measure of half a sum of squares: Student's t in
// three dimensions.
double CostOfWritten(const WrittenPlace& written, const ViewTag& tag, const TagsOptions& options) {
  const Eigen::Vector3d off = tag.position_in_site - written.position_in_site;
  const double across = std::hypot(written.sigma, *tag.sigmas.position);
  const double up = std::hypot(written.sigma, *tag.sigmas.height);
  const double squares =
      off.head<2>().squaredNorm() / (across * across) + off.z() * off.z() / (up * up);
  const double freedom = options.written_freedom;
  return (freedom + 3) / 2 * std::log1p(squares / freedom);
}

bool IsSamePlace(const ViewTag& a, const ViewTag& b, const TagsOptions& options) {
  const Eigen::Vector3d off = (a.position_in_site - b.position_in_site).cwiseAbs();
  const double across = std::hypot(*a.sigmas.position, *b.sigmas.position);
  const double up = std::hypot(*a.sigmas.height, *b.sigmas.height);
  return off.head<2>().maxCoeff() <= options.same_place_sigmas * across &&
         off.z() <= options.same_place_sigmas * up;
}

// The deviations of a pose that may as well be the other.
void WidenTo(const ViewTag& other, ViewTag& tag) {
  const auto widen = [](std::optional<double>& sigma, double off) {
    sigma = std::hypot(*sigma, off);
  };
  const Eigen::Vector3d off = (tag.position_in_site - other.position_in_site).cwiseAbs();
  widen(tag.sigmas.position, off.head<2>().maxCoeff());
  widen(tag.sigmas.height, off.z());
  widen(tag.sigmas.lookat, (tag.lookat_in_site - other.lookat_in_site).cwiseAbs().maxCoeff());
  widen(tag.sigmas.roll_deg, tag.roll_deg - other.roll_deg);
}

// The poses that the tags' picture allows, the best first: each tag by itself allows two, from
// which all of them are solved together.
std::vector<FoundPose> FindPoses(const TagsSolver& solver,
                                 const std::vector<RigidTransform>& starts,
                                 const std::optional<WrittenPlace>& written,
                                 const TagsOptions& options) {
  constexpr double kSamePose = 0.02;  // of the rotations' elements
  std::vector<FoundPose> found;
  for (const RigidTransform& start : starts) {
    FoundPose own;
    own.state = solver.Start(start);
    own.cost = solver.Minimise(own.state);
    if (!std::isfinite(own.cost)) continue;
    const std::optional<ViewTag> tag = solver.TagOf(own.state, own.cost);
    if (!tag) continue;
    own.tag = *tag;
    own.rms_px = solver.RmsPx(own.state);
    own.is_upright = std::abs(tag->roll_deg) <= options.most_roll_deg;
    if (written) own.cost += CostOfWritten(*written, own.tag, options);
    const auto same = std::find_if(found.begin(), found.end(), [&](const FoundPose& other) {
      return (other.state.Pose().rotation - own.state.Pose().rotation).norm() < kSamePose;
    });
    if (same == found.end()) {
      found.push_back(std::move(own));
    } else if (own.cost < same->cost) {
      *same = std::move(own);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const FoundPose& a, const FoundPose& b) {
    return a.cost < b.cost;
  });
  return found;
}

// The best of the poses, if it is clearly that, or the one that was taken by hand; nothing, and
// why.
std::optional<FoundPose> ChoosePose(std::vector<FoundPose> found,
                                    bool has_written,
                                    const TagsOptions& options,
                                    std::string& why_not) {
  if (found.empty()) {
    why_not = "no pose shows its tags where they are";
    return std::nullopt;
  }
  const double unclear_below = found.front().cost + options.clear_cost;
  std::erase_if(found, [&](const FoundPose& other) { return other.cost >= unclear_below; });
  if (std::any_of(found.begin(), found.end(), [](auto& pose) { return pose.is_upright; })) {
    std::erase_if(found, [](const FoundPose& pose) { return !pose.is_upright; });
  }
  FoundPose best = found.front();
  for (size_t i = 1; i < found.size(); ++i) {
    if (!IsSamePlace(found.front().tag, found[i].tag, options)) {
      why_not = "its tag is too small or too far to tell which of two ways it faces, " +
                std::string(has_written ? "and the place in views/ is no nearer to one of them"
                                        : "and no place in views/ tells");
      return std::nullopt;
    }
    WidenTo(found[i].tag, best.tag);
  }
  return best;
}

}  // namespace

void TagsOptions::Check() const {
  CheckAbove(edge_noise_px, 0, "tags options: edge_noise_px");
  CheckAbove(view_angle_share, 0, "tags options: view_angle_share");
  CheckAbove(shift, 0, "tags options: shift");
  CheckAbove(k1, 0, "tags options: k1");
  CheckAbove(aspect_share, 0, "tags options: aspect_share");
  CheckAbove(max_rms_px, 0, "tags options: max_rms_px");
  CheckAbove(most_lens_sigmas, 0, "tags options: most_lens_sigmas");
  CheckAtLeast(clear_cost, 0, "tags options: clear_cost");
  CheckAtLeast(written_freedom, 1, "tags options: written_freedom");
  CheckAtLeast(same_place_sigmas, 0, "tags options: same_place_sigmas");
  CheckFromTo(most_roll_deg, 0, 180, "tags options: most_roll_deg");
}

TagsResult CalibrateTags(const Image8& srgb_grey,
                         std::span<const SurveyedTag> surveyed,
                         const ViewTag& lens,
                         const TagsOptions& options,
                         const std::optional<WrittenPlace>& written) {
  options.Check();
  TagsResult result;
  const ImageSizePx size{srgb_grey.width, srgb_grey.height};
  Camera camera = CameraFromTag(lens, size.width, size.height);
  camera.cam_from_world = {};
  std::vector<SeenTag> seen = FindSeenTags(srgb_grey, surveyed, camera, options);
  if (seen.empty()) {
    result.reason = "it shows none of the surveyed tags";
    return result;
  }
  result.corners = CornersOf(seen, options);
  for (const SeenTag& tag : seen) result.ids.push_back(tag.place.id);
  std::vector<RigidTransform> starts;
  for (const SeenTag& tag : seen) {
    const std::vector<RigidTransform> own =
        FindSquarePoses(tag.place.corners_in_world, tag.corners_px, camera);
    starts.insert(starts.end(), own.begin(), own.end());
  }
  const TagsSolver solver(std::move(seen), lens, size, options);
  const std::optional<FoundPose> found = ChoosePose(
      FindPoses(solver, starts, written, options), written.has_value(), options, result.reason);
  if (!found) return result;
  result.rms_px = found->rms_px;
  if (!(result.rms_px <= options.max_rms_px)) {
    result.reason =
        "its tags' corners miss their surveyed places by " +
        (result.rms_px > 9999 ? std::string("thousands of")
                              : std::to_string(static_cast<int>(std::lround(result.rms_px)))) +
        " px; check apriltags.csv, and that each number is there once";
    return result;
  }
  const double sigma_deg =
      lens.sigmas.view_angle_deg.value_or(options.view_angle_share * lens.view_angle_deg);
  if (std::abs(found->tag.view_angle_deg - lens.view_angle_deg) >
      options.most_lens_sigmas * sigma_deg) {
    result.reason = "its tags' surveyed places suit only a view angle of " +
                    FormatNumber(std::round(10 * found->tag.view_angle_deg) / 10) +
                    " degrees, where " + FormatNumber(std::round(10 * lens.view_angle_deg) / 10) +
                    " is known; check the signs, the axes and the unit in apriltags.csv, and v";
    return result;
  }
  result.is_found = true;
  result.tag = found->tag;
  return result;
}

}  // namespace groundglass
