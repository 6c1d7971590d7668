// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/place.h"
#include "scene/image.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

enum class SightingState {
  kShown,
  kGrazing,  // shown, but so aslant that it is of no use
  kOutside,  // of the frame
  kBehind,   // the camera
  kBackFace,
  kHidden,
  kMasked,
};
std::string_view SightingStateName(SightingState state);

// How one photograph sees a place.
struct Sighting {
  int photograph = -1;  // of the survey
  SightingState state = SightingState::kShown;
  std::string reason;                       // a line for a person; empty if it is shown
  std::optional<Eigen::Vector2d> image_px;  // nothing behind the camera
  // One standard deviation of image_px from the camera, and from the place itself, along the worse
  // direction, px.
  double camera_sigma_px = 0;
  double place_sigma_px = 0;
  double distance = 0;   // model's unit
  double angle_deg = 0;  // between the line of sight and the face: 90 is straight on
  // How long and how wide one pixel is on the face, model's unit.
  std::array<double, 2> pixel_size = {0, 0};
};

struct SightingOptions {
  double min_angle_deg = 10;  // flatter is grazing

  void Check() const;  // throws Error naming the first field out of range
};

// The masks of a survey's photographs, each read when it is first asked for. To be used by one
// thread.
class SurveyMasks {
 public:
  explicit SurveyMasks(const Survey& survey) : survey_(survey) {}  // which must outlive it
  // Whether the mask says that something else is seen there. Throws Error if it cannot be read.
  bool Ignores(int photograph, const Eigen::Vector2d& image_px);

 private:
  const Survey& survey_;
  std::map<int, Image8> masks_;
};

// How one photograph of the survey sees a place.
Sighting FindSighting(const Survey& survey,
                      const Visibility& visibility,
                      const Place& place,
                      int photograph,
                      SurveyMasks& masks,
                      const SightingOptions& options = {});

// How each photograph of the survey sees a place: those that show it first, the finest first; then
// the others in the survey's order. Reads the masks of photographs that would show it.
std::vector<Sighting> FindSightings(const Survey& survey,
                                    const Visibility& visibility,
                                    const Place& place,
                                    const SightingOptions& options = {});

// How long and how wide a texel of the model's texture is on this face, model's unit; nothing
// where it has none.
std::optional<std::array<double, 2>> TexelSize(const Survey& survey, int face);

// What a picture shows around a point of it, enlarged to size_px each way, the point marked in the
// middle; grey beyond the picture. radius_px: of the picture, each way.
Image8 CropAround(const Image8& srgb8, const Eigen::Vector2d& image_px, int radius_px, int size_px);

}  // namespace groundglass
