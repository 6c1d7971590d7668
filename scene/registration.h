// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/view_tag.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// The free numbers of one photograph, in this order: position in `world` (model's unit), yaw,
// pitch and roll (degrees), view angle (degrees), aspect, shift (fraction of the frame's width) and
// k1. Yaw is that of the view axis about `world` Z, from X (east) towards Y (north).
enum CameraParameter {
  kPositionX,
  kPositionY,
  kPositionZ,
  kYaw,
  kPitch,
  kRoll,
  kViewAngle,
  kAspect,
  kShiftX,
  kShiftY,
  kK1
};
constexpr int kNumCameraParameters = 11;
// What people read and write.
constexpr std::array<std::string_view, kNumCameraParameters> kCameraParameterNames = {
    "x", "y", "z", "yaw", "pitch", "roll", "v", "a", "shift_x", "shift_y", "k1"};
using CameraParameters = Eigen::Matrix<double, kNumCameraParameters, 1>;
using CameraCovariance = Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters>;

CameraParameters ParametersFromTag(const ViewTag& tag);
// What is printed: the same numbers in `site`, y southwards and yaw from south (y) towards east
// (x), as the thesis has it; a change of them; and their covariance. The last two are their own
// inverse.
CameraParameters SiteParameters(const CameraParameters& in_world);
CameraParameters SiteChange(const CameraParameters& change_in_world);
CameraCovariance SiteCovariance(const CameraCovariance& in_world);
// The tag with these numbers; its look-at point moves along the new axis, staying at the measured
// distance. k2, k3, p1, p2, sigmas and name are kept from `measured`.
ViewTag TagFromParameters(const CameraParameters& parameters, const ViewTag& measured);
// The standard deviations of the tag's numbers, the look-at point's pulled back through the axis.
TagDeviations TagDeviationsFromCovariance(const CameraParameters& parameters,
                                          const CameraCovariance& covariance,
                                          const ViewTag& measured);

// From good to bad. kUnreadable: the photograph, its tag or its mask could not be read at all.
enum class Verdict { kAccepted, kReview, kRejected, kUnreadable };
std::string_view VerdictName(Verdict verdict);
// Whether a camera was found that is used: accepted, or review.
inline bool HasCorrection(Verdict verdict) { return verdict < Verdict::kRejected; }

// A piece of a model edge, and the photograph's edge that it was matched with.
struct EdgeResidual {
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();   // where the corrected camera sees the piece
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  // from there to the photograph's, across it
};

// What became of one photograph. Of an unreadable one there are name and reasons, and nothing else
// that counts.
struct Registration {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  Verdict verdict = Verdict::kRejected;
  std::vector<std::string> reasons;  // why not accepted
  ViewTag measured;
  ViewTag corrected;                                   // equals `measured` when rejected
  CameraParameters sigmas = CameraParameters::Zero();  // posterior standard deviations
  CameraParameters prior_sigmas = CameraParameters::Zero();
  CameraCovariance covariance = CameraCovariance::Zero();
  std::vector<std::string> undetermined;  // parameters no better known than before
  int num_samples = 0;                    // edge samples with a match
  // Of their distances from the model's edges as it has them, seen by the corrected camera, each
  // weighted by how likely it is matched and how much edge it stands for: the root of the mean
  // square, and 1.4826 times the median, which a few edges that are far off do not change. Nothing
  // where nothing is matched.
  std::optional<double> rms_px;
  std::optional<double> robust_sigma_px;
  std::vector<EdgeResidual> residuals;
  double score_nats = 0;              // above zero: better than chance
  std::optional<double> margin_nats;  // over the second-best camera; nothing if there is none
  // Of a photograph in review: the second-best camera, which margin_nats is over; with the numbers
  // that the fit does not move, and the standard deviations, of the tag that it started from.
  std::optional<ViewTag> rival = {};
  // What other photographs say of the camera: patches of faces sought in them, and found where the
  // cameras expect them; nothing where the photograph was not refined together with others.
  struct Ties {
    int num_tried = 0;
    int num_agreeing = 0;
    double nats = 0;  // how much they speak for the camera
  };
  std::optional<Ties> ties;
  double moved_px = 0;  // mean displacement of the model's visible edges by the correction
  // What is left uncertain: one standard deviation of where the model's points are seen, the mean
  // over those in the frame, hidden ones included.
  double vertex_sigma_px = 0;

  Camera MeasuredCamera() const { return CameraFromTag(measured, width_px, height_px); }
  Camera CorrectedCamera() const { return CameraFromTag(corrected, width_px, height_px); }
};

// A line of the model that the photographs agree to see elsewhere: a cornice that the plan has too
// low, a wall that was built next to where it was drawn.
struct ModelError {
  std::string name;  // the faces that the line borders: "east wall / roof"
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();  // as the model has it, its unit
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_in_world = Eigen::Vector3d::Zero();  // to where it is, at its middle
  double sigma = 0;  // one standard deviation of the offset's length, model's unit
  std::vector<std::string> photographs;  // that show the line
  // Whether it is off as one with the one before it in the list: a wall, a level, a wall's windows.
  bool with_the_one_before = false;
};

}  // namespace groundglass
