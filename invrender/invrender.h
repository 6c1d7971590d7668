// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/coverage.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/progress.h"
#include "scene/textured_model.h"
#include "scene/visibility.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace groundglass {

// A photograph and the camera that took it.
struct BakePhotograph {
  std::string name;  // the stem: "s5"
  std::filesystem::path image_file;
  Camera camera;
  double weight = 1;  // below 1: used where no other is nearly as good (verdict `review`)
  std::optional<std::filesystem::path> mask_file;   // white = ignore
  std::optional<std::filesystem::path> faces_file;  // hand-painted, in place of the automatic mask
  // The faces (from 0) that it may texture; nothing: all of them.
  std::optional<std::vector<int>> faces;
};

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

  void Check() const;  // throws Error naming the first field out of range
};

struct BakeResult {
  TexturedModel model;
  Coverage coverage;
  std::vector<int> new_faces;  // of the model, that as_photographed has no part of; ascending
  double texel_scale = 1;  // above 1: texels were made this much longer to stay within the memory
};

// Inverse rendering (Thorman 1988, chapter 4): every texel of every face is looked up through the
// exact camera in the photographs that see it. Texels that no photograph shows are black, with
// provenance 0; a face that none shows has no texture. Throws Error for an image that cannot be
// read or does not fit its camera.
BakeResult BakeTextures(const PolygonModel& model,
                        std::span<const BakePhotograph> photographs,
                        const BakeOptions& options = {},
                        const Progress& progress = {});

// Which face each pixel's centre shows, from 1; 0: none, or a face's back. The same answer as
// Visibility::FaceLabels; rays are spent along the model's projected edges only, since nowhere
// else can the answer change.
Image16 MakeFaceMask(const PolygonModel& model, const Visibility& visibility, const Camera& camera);

}  // namespace groundglass
