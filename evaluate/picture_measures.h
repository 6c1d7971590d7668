// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <array>
#include <vector>

namespace groundglass {

// A rendered picture against the true one, over the pixels that show the model.
struct PictureErrors {
  double psnr_db = 0;   // of 8-bit sRGB values, all channels; at most 99
  double ssim = 0;      // Wang et al. 2004: luma, 11x11 Gaussian window of sigma 1.5
  double coverage = 0;  // share of the model's pixels that have texture
  long num_pixels = 0;  // that show the model
  // Fitted to the covered pixels by least squares on the encoded values: what each channel of the
  // rendered picture was multiplied by.
  std::array<double, 3> gain = {1, 1, 1};
};

// Both pictures are sRGB; what the rendered one has beyond three channels (alpha, not
// premultiplied) does not count. `labels` is not 0 where the true picture shows the model;
// `covered` (1 channel) is not 0 where the rendered one has texture, and empty if it has
// everywhere. Uncovered pixels count as black; outside the model both pictures are taken as equal.
// Throws Error if sizes differ or no pixel shows the model.
PictureErrors ComparePictures(const Image8& true_srgb8,
                              const Image8& rendered_srgb8,
                              const Image16& labels,
                              const Image8& covered);

// How well two label pictures agree on one label: intersection and union in pixels.
struct MaskOverlap {
  long intersection_px = 0;
  long union_px = 0;
  double IntersectionOverUnion() const {
    return union_px > 0 ? static_cast<double>(intersection_px) / static_cast<double>(union_px) : 0;
  }
};
// Adds to `overlaps`, indexed by label - 1, what two label pictures of one size share. Labels
// beyond the vector's size are no faces (occluders) and count as 0.
void AddMaskOverlaps(const Image16& true_labels,
                     const Image16& found_labels,
                     std::vector<MaskOverlap>& overlaps);

}  // namespace groundglass
