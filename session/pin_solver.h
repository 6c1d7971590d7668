// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/register.h"
#include "scene/formats/lens.h"
#include "scene/length_unit.h"
#include "scene/registration.h"
#include "session/pins.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct PinSolverOptions {
  int max_iterations = 60;
  // A pin whose residual is so many of its own standard deviations is bad.
  double bad_pin_sigmas = 3;
  // A number that pins make so much surer than it was is free; else what was known holds it.
  double free_share = 0.7;
  // One or two pins aim a camera that nobody has aimed: one standard deviation of that, degrees,
  // unless the tag is less sure still. Roll is free from the second pin on.
  double aim_yaw_deg = 45;
  double aim_pitch_deg = 20;
  double aim_roll_deg = 5;
  // A pin that alone determines something has no residual to be judged by: this share of its own
  // variance stays in what its residual may be.
  double least_variance_share = 0.02;
  // What tags are taken to be sure of that do not say it.
  PriorOptions prior;

  void Check() const;  // throws Error naming the first field out of range
};

// How a pin fits the camera that was solved.
struct PinResidual {
  std::optional<Eigen::Vector2d> seen_px;                 // a point: where the camera sees it
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // seen - pinned; of a line: two distances
  double size_px = 0;                                     // its length; of a line the larger one
  // The residual in units of what it may be by chance, given that the pin drew the camera towards
  // itself (Baarda 1968); of pins that have no say, given how sure the camera is.
  double sigmas = 0;
  bool is_bad = false;
};

struct PinSolution {
  bool is_solved = false;
  std::string fault;  // why not; the tag is then the one that was given
  ViewTag tag;        // its look-at point as far away as the one that was given
  CameraParameters parameters = CameraParameters::Zero();
  CameraCovariance covariance = CameraCovariance::Zero();
  CameraParameters sigmas = CameraParameters::Zero();
  CameraParameters prior_sigmas = CameraParameters::Zero();
  std::array<bool, kNumCameraParameters> is_free = {};  // by pins; else held by what was known
  std::vector<PinResidual> points;                      // one for each pin
  std::vector<PinResidual> lines;
  // The bad pin that fits worst, by its place among the points, or behind them among the lines.
  std::optional<int> worst;
  double rms_px = 0;  // of the pins that are used
};

// The most likely camera, given its tag with its standard deviations (TagSigmas; those that are
// not given are a tape's and a tripod's) and the pins. A single point aims the camera where it
// stands; two turn and move it along its view as well; from three on (a line counts as one) all
// eleven numbers are solved for. start: the camera to begin with, as a tag, such as the last
// solution; the prior is `tag`'s, with `lens` where the tag says no view angle. Never throws for
// pins that do not fit: then `fault` says why.
PinSolution SolvePins(const ViewTag& tag,
                      const std::optional<ViewTag>& start,
                      int width_px,
                      int height_px,
                      LengthUnit unit,
                      const std::optional<Lens>& lens,
                      const Pins& pins,
                      const PinSolverOptions& options = {});

// The tag with the solution's numbers and standard deviations, as it is written down: what a later
// registration searches within.
ViewTag TagToSave(const PinSolution& solution);

// A tag from a rough place: a person stood about here and looked about there. Its sigmas say so:
// a tenth of the distance across, eye height to a twentieth of it, and the lens unknown.
struct RoughPlaceOptions {
  double position_share = 0.15;  // of the distance to what is looked at
  double height_share = 0.05;
  double lookat_share = 0.15;
  double roll_deg = 3;
  double view_angle_deg = 54;  // of an unknown lens: a standard one
  double view_angle_sigma_deg = 12;
  double shift = 0.02;          // as a frame is
  double cropped_shift = 0.25;  // as a picture may be that was cut
  double cropped_from = 0.1;    // a tag whose shift is less sure than this is of such a picture

  void Check() const;  // throws Error naming the first field out of range
};
// Whether the tag is of a picture that was cut, so that its middle is unknown.
bool IsOfCroppedPicture(const ViewTag& tag, const RoughPlaceOptions& options = {});
ViewTag RoughTag(const Eigen::Vector3d& stood_in_world,
                 const Eigen::Vector3d& looked_in_world,
                 int width_px,
                 int height_px,
                 bool is_cropped,
                 const RoughPlaceOptions& options = {});

}  // namespace groundglass
