// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// How the black mount of a slide is told at the frame's edges (FindMount).
struct MountOptions {
  // Darker sRGB codes than this, of 256, in all channels are dark. Raise it for scans with haze.
  int dark_code = 32;
  // A side of the frame that is dark along this share of its length is a mount's.
  double dark_share = 0.5;
  // It reaches no farther in than this share of the frame's shorter side.
  double deepest_share = 0.1;
  // What is found is widened by this share of the frame's width, but by 2 px at least: the mount's
  // edge is blurred.
  double widening_share = 0.004;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "mount options: ") const;
};

// What borders of a face mask count for (ComputeBorderDistance).
struct BorderOptions {
  // Two faces that meet in a crease mix two colours in one pixel. Where the farther surface is
  // hidden it is worse, since an error of the camera moves one over the other: creases count as
  // so much farther away, pixels of the mask.
  double crease_bonus_px = 1.5;
  // Faces meet if their depths differ by no more than this share of them, besides what they change
  // within two pixels.
  double crease_depth_share = 0.001;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "border options: ") const;
};

// What is as good as the best resolution (PreparedPhoto::Quality). Smooth steps from one limit to
// the other; `margin` is PhotoOptions::border_margin_px or frame_margin.
struct QualityOptions {
  // Borders lower quality from so many pixels beyond the margin on, the more the nearer, down to
  // least_at_border so many pixels before the margin.
  double border_clear_px = 4;
  double border_ramp_px = 1;
  double least_at_border = 1e-3;
  // The frame's edge, where lenses are worst: at the margin to this factor; from this share of the
  // frame's width beyond it on not at all.
  double least_at_frame = 0.5;
  double frame_ramp_share = 0.06;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "quality options: ") const;
};

// Where the model has changed since the photographs were taken (EarlierModel).
struct EarlierModelOptions {
  // A face was there before if one of the earlier model lies there whose normal has at least this
  // cosine with its own.
  double same_normal_cosine = 0.999;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "earlier model options: ") const;
};

// What of a photograph may be used, and how much it is worth (PreparePhoto).
struct PhotoOptions {
  // Photographs' pixels nearer than this to an occlusion border are used only where no other
  // photograph shows the place: a tag wrong by a pixel would print the sky there.
  double border_margin_px = 2;
  // Pixels nearer than this to the frame's edge are never used, as a fraction of its width.
  double frame_margin = 0.004;
  // Beside a border, look-ups move so far away from it: more loses what stands at the border, less
  // shows both sides.
  double step_inside_px = 0.3;
  // Finds the black mount of a slide at the frame's edges and keeps it out.
  bool detect_mount = true;
  MountOptions mount;
  BorderOptions borders;
  QualityOptions quality;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "photo options: ") const;
};

}  // namespace groundglass
