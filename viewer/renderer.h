// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/orthographic_view.h"
#include "scene/textured_model.h"

#include <Eigen/Dense>

#include <memory>
#include <string>
#include <vector>

namespace groundglass {

enum class DrawMode {
  kTextured,   // faces without a texture are plain grey
  kShaded,     // every face in one plaster colour under a soft sun
  kWireframe,  // the model's edges with hidden lines removed
  kLabels,     // each face in a colour of its own, with its number from 1
};

// FaceTexture::page of a face that is not drawn, from either side, and hides what is behind it; for
// Background::kTransparent, where the picture has alpha 0 there (any other is black).
constexpr int kHidingPage = -2;

enum class Background {
  kWhite,
  kSky,          // a gradient from the horizon up; greyish below it
  kTransparent,  // the picture has 4 channels, alpha not premultiplied
};

struct RenderOptions {
  DrawMode mode = DrawMode::kTextured;
  Background background = Background::kWhite;
  // The model's edges over any mode, hidden lines removed.
  bool edges = false;
  // Samples for each pixel at the borders of faces: 1 or 4. Leave at 4; the cost is small.
  int multisamples = 4;
  // Draw this many times larger each way and average, 1 to 4. Use 2 for stills.
  int supersampling = 1;
  // Texels along the line of sight on slanted faces, 1 to 16; 1 is plain trilinear. Slower.
  int anisotropy = 8;
  // Where the sun stands in kShaded: bearing clockwise from the model's north, and height.
  double sun_bearing_deg = 215;
  double sun_height_deg = 42;

  void Check() const;  // throws Error naming the first field out of range
};

struct RendererOptions {
  // Pages larger than this, or than OpenGL allows, are halved until they fit.
  int max_page_size_px = 16384;

  void Check() const;  // throws Error naming the first field out of range
};

// A textured model made ready for drawing: triangles and mipmapped pages in an OpenGL context of
// its own. Drawing the same thing twice gives the same bytes. To be used by one thread at a time;
// several renderers may work in several threads.
class Renderer {
 public:
  explicit Renderer(const TexturedModel& model, const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // sRGB, 3 channels (4 with a transparent background). The camera's whole model holds: principal
  // point, non-square pixels, distortion; averages over a pixel are taken in linear light.
  Image8 Render(const Camera& camera, const RenderOptions& options = {});

  // The face that each pixel's centre shows, from 1; 0 where there is none, or a face's back: as
  // Visibility::FaceLabels but for face borders.
  Image16 RenderLabels(const Camera& camera);

  // The same by parallel rays. options.supersampling and edges are not heeded, and there is no sky.
  // Parts of a view (OrthographicView::Part) put side by side are the whole.
  Image8 Render(const OrthographicView& view, const RenderOptions& options = {});
  Image16 RenderLabels(const OrthographicView& view);

  // What could not be kept ("texture page 1 is shown at 8192 x 4096 in place of 16384 x 8192").
  const std::vector<std::string>& Warnings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The same for a single picture.
Image8 Render(const TexturedModel& model, const Camera& camera, const RenderOptions& options = {});

}  // namespace groundglass
