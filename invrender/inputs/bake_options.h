// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/bake_photograph.h"
#include "invrender/inputs/blend_options.h"
#include "invrender/inputs/block_options.h"
#include "invrender/inputs/colour_options.h"
#include "invrender/inputs/consistency_options.h"
#include "invrender/inputs/detail_options.h"
#include "invrender/inputs/fill_options.h"
#include "invrender/inputs/seam_options.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <functional>
#include <optional>

namespace groundglass {

struct BakeOptions {
  // Side of a texel, model's unit; 0: the best photograph's footprint, face by face.
  double texel_size = 0;
  // Texels along a side of the largest page. Faces too big for it get coarser texels.
  int max_page_texels = 8192;
  // Texels around each chart that repeat its border, so that mipmaps and JPEG blocks stay clean.
  int gutter_texels = 8;

  // Photographs' pixels nearer than this to an occlusion border are used only where no other
  // photograph shows the place: a tag wrong by a pixel would print the sky there.
  double border_margin_px = 2;
  // Pixels nearer than this to the frame's edge are never used, as a fraction of its width.
  double frame_margin = 0.004;
  // At most this much memory for the whole program, millions of bytes; 0: no limit. Photographs are
  // decoded again when they are needed again, charts are done a few at a time, and where even
  // the pages are too large, texels become larger (BakeResult::texel_scale).
  int max_memory_mb = 0;

  // Finds the black mount of a slide at the frame's edges and keeps it out.
  bool detect_mount = true;

  // Fits a gain for each photograph and channel, its vignetting, and how the light fell on each
  // face. Turn off to see the photographs' own exposures.
  bool match_colour = true;
  // Keeps out what differs from what most photographs show: trees, cars, cast shadows.
  bool reject_occluders = true;
  // Measures how blurred each photograph is, so that sharper ones are preferred.
  bool judge_sharpness = true;
  // Measures each photograph's film grain, and lowers it where nothing finer is to be seen.
  bool smooth_grain = true;
  // Blends photographs in a band along seams, and moves seams to where they do not show.
  bool smooth_seams = true;
  // Paints over what no photograph shows, from what lies around it; provenance says so.
  bool fill_gaps = false;
  // 16: photographs are read, and pages made, with 16 bits a channel (TexturePage::srgb16); takes
  // twice the memory for both.
  int bits = 8;

  // The model as it was when the photographs were taken, where it has changed since, in the same
  // frame and unit. Photographs then texture what both have; what is new stays plain.
  std::optional<PolygonModel> as_photographed;

  // Gets each photograph's automatic face mask (MakeFaceMask) with the faces' numbers, from several
  // threads at once.
  std::function<void(const BakePhotograph& photograph, const Image16& numbers)> on_face_mask;

  // The thresholds and weights of each stage, in the order in which they work.
  BlockOptions blocks;
  SharpnessOptions sharpness;
  GrainOptions grain;
  ColourOptions colour;
  ConsistencyOptions consistency;
  SeamOptions seams;
  BlendOptions blend;
  DilateOptions dilate;
  FillOptions fill;

  void Check() const;  // throws Error naming the first field out of range
};

}  // namespace groundglass
