// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/parameter_projection.h"
#include "scene/camera.h"
#include "scene/formats/lens.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One standard deviation of what a tape and a tripod measure, where the tag itself does not say.
struct PriorOptions {
  // Camera position across (x and y each), its height, and each of i, j, k. A length that is given
  // stands as it is. Where none is: the larger of a tape's, OwnPositionMetres and so on, and of a
  // share of the distance to the look-at point.
  std::optional<double> position_m;
  double position_share = 0.005;
  std::optional<double> height_m;
  double height_share = 0.002;
  std::optional<double> lookat_m;
  double lookat_share = 0.01;
  double tape_scale = 1;  // of a tape's lengths: less at a maquette (PriorSuitedTo)
  double roll_deg = 1.5;
  double view_angle_share = 0.01;
  double aspect_share = 0.005;
  // Fraction of the frame's width, each way. Where nobody gives it: a slide's in its mount, or a
  // digital camera's principal point.
  std::optional<double> shift;
  double slide_shift = 0.015;
  double digital_shift = 0.005;
  double k1 = 0.05;

  // What a slide's mount and its scan add to a calibrated lens. No slides: set digital.
  double slide_scale_share = 0.01;
  double slide_aspect_share = 0.003;
  bool digital = false;  // no mount and no scan: what is true of the lens holds as it is
  // A digital camera's pixels are square to this share, unless the tag's aspect differs from the
  // frame's by more than the second: then it is no rounded number.
  double digital_aspect_share = 0.0002;
  double rounded_aspect_share = 0.005;

  // How many times larger than stated the standard deviations of position and direction are.
  double overclaim = 1;

  // Parameters held at the tag's values: names of kCameraParameterNames, or "shift" for both.
  std::vector<std::string> lock;
  // Parameters that are looked for as if neither the tag nor the lens file gave a standard
  // deviation: these options' own are taken, unless the lens file's are larger. Names as for lock.
  std::vector<std::string> free;

  // A tape's: 0.076 m across (a quarter of a foot), 0.030 m for the height (a tenth of a foot) and
  // 0.122 m (0.4 ft), times tape_scale, but not below a millimetre.
  double OwnPositionMetres() const;
  double OwnHeightMetres() const;
  double OwnLookatMetres() const;
  double OwnShift() const { return shift.value_or(digital ? digital_shift : slide_shift); }

  void Check() const;  // throws Error naming the first field out of range
};

// The options with the lengths that nobody gave as suit the model: at a maquette (ModelScale) a
// ruler takes the place of the tape, and they shrink in proportion.
PriorOptions PriorSuitedTo(const PolygonModel& model, PriorOptions options);

// What is known of a photograph's camera before looking at the photograph: a normal distribution
// over CameraParameters. Position and look-at point are measured apart, so position and direction
// are correlated. covariance = root * root^T; parameters = mean + root * u with u standard normal,
// the whitened parameters.
struct CameraPrior {
  CameraParameters mean = CameraParameters::Zero();
  CameraCovariance root = CameraCovariance::Zero();
  CameraParameters sigmas = CameraParameters::Zero();
  ViewTag measured;  // what is not solved for (k2 k3 p1 p2) stays as it says
  // Of the picture that is aligned, in whose pixels the camera projects.
  int width_px = 0;
  int height_px = 0;

  CameraParameters ParametersAt(const CameraParameters& whitened) const {
    return mean + root * whitened;
  }
  // The same the other way round. Parameters that are locked do not count.
  CameraParameters WhitenedAt(const CameraParameters& parameters) const;
  ParameterProjection ProjectionAt(const CameraParameters& whitened) const {
    return {ParametersAt(whitened), TagDistortion(measured), width_px, height_px};
  }
  Camera CameraAt(const CameraParameters& whitened) const;
};
// width_px x height_px: of the picture that is aligned.
CameraPrior MakeCameraPrior(const ViewTag& tag,
                            int width_px,
                            int height_px,
                            LengthUnit unit,
                            const std::optional<Lens>& lens,
                            const PriorOptions& options);

// The same camera with larger standard deviations of position, yaw and pitch, by this factor.
CameraPrior WithWiderPose(const CameraPrior& prior, double factor);

}  // namespace groundglass
