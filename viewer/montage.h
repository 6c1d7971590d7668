// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/textured_model.h"
#include "viewer/montage_light.h"
#include "viewer/photo_grain.h"

#include <string>
#include <vector>

namespace groundglass {

struct MontageOptions {
  // Leaves out the design's faces that lie on the building's: a design is often the building as it
  // stands with something added. Off, they are drawn too, over the photograph's.
  bool new_parts_only = false;
  // Faces lie on one another, so that the design's is not hidden, that are no farther apart than
  // this share of the building's size.
  double same_place_share = 0.002;
  // Brighter or darker by hand, stops, on top of what the photograph tells.
  double exposure_stops = 0;
  // Reflectance of the design's faces that have no texture.
  double plain_albedo = 0.5;
  // As RenderOptions::supersampling; edges are smooth at 1 too, pictures on faces finer at 2.
  int supersampling = 2;
  // How much lens, film and scanner blur, one standard deviation, px. Drawings are sharper than any
  // photograph.
  double blur_px = 0.6;
  // Off: the design has no grain.
  bool grain = true;
  MontageLightOptions light;
  PhotoGrainOptions photo_grain;

  void Check() const;  // throws Error naming the first field out of range
};

// A photograph, and what is known of it.
struct MontagePhotograph {
  const Image8& srgb8;  // 3 channels
  const Image8* mask =
      nullptr;           // of its size, 255: what stands there hides the design; may be null
  const Camera& camera;  // of its size
};

struct Montage {
  Image8 srgb8;
  // How much of each pixel the design covers, 0 to 1; one channel.
  ImageF cover;
  MontageLight light;
  double grain_sigma = 0;  // of the photograph's middle tones, luma codes of 0 to 255
  int num_faces = 0;       // of the design that were drawn
  std::vector<std::string> warnings;
};

// Draws a design into a photograph as its camera sees it, lens and all (Nakamae, Harada, Ishizaki
// and Nishita, SIGGRAPH 1986): hidden where the building or the mask hides it, in the light and
// with the grain that the photograph has of the building. Both models are in one `world` and one
// unit, the design with the plain colours of its materials on pages (ReadColouredModel). The
// building is not taken away where the design leaves it out, and no shadows are cast.
// Error if the sizes differ, or none of the design is to be drawn.
Montage DrawMontage(const MontagePhotograph& photograph,
                    const TexturedModel& building,
                    const TexturedModel& design,
                    const MontageOptions& options = {});

}  // namespace groundglass
