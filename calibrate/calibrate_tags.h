// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/surveyed_tags.h"
#include "scene/formats/tag_corners.h"
#include "scene/image.h"
#include "scene/view_tag.h"

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace groundglass {

struct TagsOptions {
  // What an edge point of a tag in a photograph errs by, one standard deviation; pixels. Larger
  // where the corners fit worse.
  double edge_noise_px = 0.25;
  // What is known of the lens where the tag states no standard deviation.
  double view_angle_share = 0.02;
  double shift = 0.015;  // share of the frame's width
  double k1 = 0.05;
  double aspect_share = 0.005;
  // A photograph whose corners miss their places by more, root mean square, shows other tags, or
  // their survey is wrong; pixels.
  double max_rms_px = 4;
  // A view angle further from what is known of the lens, in its standard deviations, makes up for a
  // survey whose signs or axes are wrong.
  double most_lens_sigmas = 5;
  // Two poses (a flat tag seen from afar may face two ways) are told apart if their costs, half
  // the sum of squares in standard deviations, differ by this.
  double clear_cost = 6;
  // A place that was written down errs by Student's t of so many degrees of freedom: by several of
  // its deviations now and then, and when it is a blunder by any number of them.
  double written_freedom = 4;
  // Poses nearer to one another than so many of their joint deviations are one, not well known.
  double same_place_sigmas = 2;
  // Roll beyond which a photograph was not taken by hand; decides between two poses. Degrees.
  double most_roll_deg = 30;

  void Check() const;  // throws Error naming the first field out of range
};

// Where a notebook says that a photograph was taken from.
struct WrittenPlace {
  Eigen::Vector3d position_in_site = Eigen::Vector3d::Zero();
  double sigma = 0;  // one standard deviation each way, model's unit
};

struct TagsResult {
  bool is_found = false;
  std::string reason;  // if not: one line for a person
  ViewTag tag;         // place, direction and roll, and the lens, as far as the tags tell it better
  // The surveyed tags' corners in the photograph, whether a pose was found or not; they do not say
  // which photograph.
  std::vector<SeenTagCorner> corners;
  std::vector<int> ids;  // of the surveyed tags that were used
  double rms_px = 0;     // of their corners, each axis apart
};

// Finds where a photograph of surveyed AprilTags was taken from. `lens`: the tag that gives view
// angle, aspect, shift and distortion, with their sigmas; its pose is not looked at. The look-at
// point is put on the view axis beside the tags, where it is known best: place and direction err
// together, and so they err apart. `written` decides between two poses that a small tag allows.
TagsResult CalibrateTags(const Image8& srgb_grey,
                         std::span<const SurveyedTag> surveyed,
                         const ViewTag& lens,
                         const TagsOptions& options = {},
                         const std::optional<WrittenPlace>& written = std::nullopt);

}  // namespace groundglass
