// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/renderer.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/feature_edges.h"
#include "scene/visibility.h"
#include "viewer/edge_drawing.h"
#include "viewer/face_drawing.h"
#include "viewer/face_numbers.h"
#include "viewer/frame_drawing.h"
#include "viewer/gl_context.h"
#include "viewer/gl_functions.h"
#include "viewer/pinhole_frame.h"
#include "viewer/render_target.h"
#include "viewer/uploaded_model.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

// The face of each pixel of the camera's frame, from what was drawn of its pinhole frame.
Image16 LabelsInFrame(const std::vector<GLuint>& drawn,
                      const PinholeFrame& frame,
                      const Camera& camera) {
  const Camera& pinhole = frame.pinhole;
  Image16 labels(camera.width_px, camera.height_px, 1);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      int column = x;
      int row = y;
      if (frame.is_bent) {
        const Eigen::Vector3d ray = UnprojectToCam(camera, {x + 0.5, y + 0.5});
        const auto in_pinhole_px = ProjectFromCam(pinhole, ray);
        column = static_cast<int>(std::floor(in_pinhole_px->x()));
        row = static_cast<int>(std::floor(in_pinhole_px->y()));
        if (column < 0 || row < 0 || column >= pinhole.width_px || row >= pinhole.height_px) {
          continue;
        }
      }
      *labels.At(x, y) =
          static_cast<uint16_t>(drawn[static_cast<size_t>(row) * pinhole.width_px + column]);
    }
  }
  return labels;
}

// A context that is current, for the members of a renderer that are made after it.
std::unique_ptr<GlContext> MakeCurrentContext() {
  std::unique_ptr<GlContext> context = MakeGlContext();
  context->MakeCurrent();
  return context;
}

int GetInteger(const GlFunctions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

}  // namespace

void RenderOptions::Check() const {
  if (multisamples != 1 && multisamples != 4) {
    throw Error("render options: multisamples must be 1 or 4");
  }
  CheckFromTo(supersampling, 1, 4, "render options: supersampling");
  CheckFromTo(anisotropy, 1, 16, "render options: anisotropy");
  CheckFromTo(sun_bearing_deg, -360, 360, "render options: sun_bearing_deg");
  CheckFromTo(sun_height_deg, 0, 90, "render options: sun_height_deg");
}

void RendererOptions::Check() const {
  CheckFromTo(max_page_size_px, 1, 1 << 20, "renderer options: max_page_size_px");
}

struct Renderer::Impl {
  // What is made of OpenGL comes after the context, to be deleted before it, while it is current.
  std::unique_ptr<GlContext> context = MakeCurrentContext();
  GlFunctions gl = FindGlFunctions(*context);
  int max_page_px = GetInteger(gl, GL_MAX_TEXTURE_SIZE);
  int max_frame_px = std::min(max_page_px, GetInteger(gl, GL_MAX_RENDERBUFFER_SIZE));
  FaceDrawing face_drawing = FaceDrawing(gl);
  FrameDrawing frame_drawing = FrameDrawing(gl);
  std::vector<std::string> warnings;
  UploadedModel uploaded;
  RenderTarget multisampled;
  RenderTarget drawn;
  RenderTarget resolved;
  RenderTarget labels;

  PolygonModel model;
  // For the edges; made when they are first drawn.
  std::vector<ModelEdge> edges;
  std::optional<Visibility> visibility;

  Impl(const TexturedModel& textured, const RendererOptions& options)
      : uploaded(
            UploadModel(gl, textured, std::min(options.max_page_size_px, max_page_px), warnings)),
        model(textured.model) {
    gl.FrontFace(GL_CW);  // see ClipFromCam
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    context->Release();
  }
  ~Impl() { context->MakeCurrent(); }

  // The camera's frame without distortion. Error if it is too large to be drawn.
  PinholeFrame FrameOf(const Camera& camera, int supersampling) const {
    PinholeFrame frame = MakePinholeFrame(camera, supersampling, max_frame_px);
    const Camera& pinhole = frame.pinhole;
    if (pinhole.width_px >= 1 && pinhole.height_px >= 1 && pinhole.width_px <= max_frame_px &&
        pinhole.height_px <= max_frame_px) {
      return frame;
    }
    throw Error("viewer: a frame of " + std::to_string(pinhole.width_px) + " x " +
                std::to_string(pinhole.height_px) + " cannot be drawn; from 1 to " +
                std::to_string(max_frame_px) + " px each way can, supersampling included");
  }

  // Faces on their ground into `drawn`, one sample for each of its pixels.
  template <typename View>  // a pinhole camera, or parallel rays
  void DrawModel(const View& view, const RenderOptions& options) {
    const auto fit = [&](RenderTarget& target, int multisamples) {
      FitTarget(
          gl, target, view.width_px, view.height_px, multisamples, TargetKind::kColourAndDepth);
    };
    const bool multi = options.multisamples > 1;
    fit(drawn, 1);
    if (multi) fit(multisampled, options.multisamples);
    BindTarget(gl, multi ? multisampled : drawn);
    const float ground = options.background == Background::kWhite ? 1.0f : 0.0f;
    const float clear_colour[4] = {ground, ground, ground, ground};
    const float clear_depth = 1;
    gl.ClearBufferfv(GL_COLOR, 0, clear_colour);
    gl.ClearBufferfv(GL_DEPTH, 0, &clear_depth);
    if (options.mode != DrawMode::kWireframe) {
      face_drawing.DrawFaces(uploaded, ClipFromLocal(uploaded.mesh, view), options);
    }
    if (multi) AverageSamples(gl, multisampled, drawn);
  }

  // Each pixel's face, from 1.
  template <typename View>
  std::vector<GLuint> DrawLabels(const View& view) {
    FitTarget(gl, labels, view.width_px, view.height_px, 1, TargetKind::kLabelsAndDepth);
    BindTarget(gl, labels);
    const GLuint no_face[4] = {0, 0, 0, 0};
    const float clear_depth = 1;
    gl.ClearBufferuiv(GL_COLOR, 0, no_face);
    gl.ClearBufferfv(GL_DEPTH, 0, &clear_depth);
    face_drawing.DrawLabels(uploaded, ClipFromLocal(uploaded.mesh, view));
    return ReadLabels(gl, labels);
  }

  Image16 LabelsOf(const Camera& camera) {
    const PinholeFrame frame = FrameOf(camera, 1);
    return LabelsInFrame(DrawLabels(frame.pinhole), frame, camera);
  }

  void CheckFrame(const OrthographicView& view) const {
    if (view.width_px < 1 || view.height_px < 1 || view.width_px > max_frame_px ||
        view.height_px > max_frame_px) {
      throw Error("viewer: a picture of " + std::to_string(view.width_px) + " x " +
                  std::to_string(view.height_px) + " cannot be drawn at once; from 1 to " +
                  std::to_string(max_frame_px) + " px each way can");
    }
  }

  // The target that holds the camera's own frame: `drawn`, or what is made of it.
  const RenderTarget& Resolve(const Camera& camera, const PinholeFrame& frame, int samples) {
    if (!frame.is_bent && samples == 1) return drawn;
    FitTarget(gl, resolved, camera.width_px, camera.height_px, 1, TargetKind::kColour);
    BindTarget(gl, resolved);
    frame_drawing.DrawResolved(drawn, frame, samples);
    return resolved;
  }

  void DrawEdgesOver(Image8& picture, const Camera& camera, const RenderOptions& options) {
    if (!visibility) {
      visibility.emplace(model);
      edges = FindModelEdges(model);
    }
    const double unit = LineUnit(picture);
    EdgeStyle style;
    style.width_px = 1.2 * unit;
    style.silhouette_width_px = 2.0 * unit;
    style.opacity = options.mode == DrawMode::kWireframe ? 1 : 0.8;
    DrawEdges(picture,
              FindVisibleSpans(model, edges, *visibility, camera, EdgeMargin(style)),
              camera,
              style);
  }
};

Renderer::Renderer(const TexturedModel& model, const RendererOptions& options) {
  options.Check();
  impl_ = std::make_unique<Impl>(model, options);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const std::vector<std::string>& Renderer::Warnings() const { return impl_->warnings; }

Image8 Renderer::Render(const Camera& camera, const RenderOptions& options) {
  options.Check();
  Impl& impl = *impl_;
  const CurrentGlContext current(*impl.context);
  const PinholeFrame frame = impl.FrameOf(camera, options.supersampling);
  impl.DrawModel(frame.pinhole, options);
  if (options.background == Background::kSky) {
    BindTarget(impl.gl, impl.drawn);
    impl.frame_drawing.DrawSky(frame.pinhole);
  }
  const RenderTarget& whole = impl.Resolve(camera, frame, options.supersampling);
  Image8 picture = ReadPicture(impl.gl, whole, options.background == Background::kTransparent);
  const bool with_numbers = options.mode == DrawMode::kLabels;
  if (options.edges || with_numbers || options.mode == DrawMode::kWireframe) {
    impl.DrawEdgesOver(picture, camera, options);
  }
  if (with_numbers) DrawFaceNumbers(picture, NumbersFromLabels(impl.model, impl.LabelsOf(camera)));
  return picture;
}

Image16 Renderer::RenderLabels(const Camera& camera) {
  const CurrentGlContext current(*impl_->context);
  return impl_->LabelsOf(camera);
}

Image8 Renderer::Render(const OrthographicView& view, const RenderOptions& options) {
  options.Check();
  Impl& impl = *impl_;
  impl.CheckFrame(view);
  const CurrentGlContext current(*impl.context);
  impl.DrawModel(view, options);
  return ReadPicture(impl.gl, impl.drawn, options.background == Background::kTransparent);
}

Image16 Renderer::RenderLabels(const OrthographicView& view) {
  Impl& impl = *impl_;
  impl.CheckFrame(view);
  const CurrentGlContext current(*impl.context);
  const std::vector<GLuint> drawn = impl.DrawLabels(view);
  Image16 labels(view.width_px, view.height_px, 1);
  std::transform(drawn.begin(), drawn.end(), labels.values.begin(), [](GLuint label) {
    return static_cast<uint16_t>(label);
  });
  return labels;
}

Image8 Render(const TexturedModel& model, const Camera& camera, const RenderOptions& options) {
  return Renderer(model).Render(camera, options);
}

}  // namespace groundglass
