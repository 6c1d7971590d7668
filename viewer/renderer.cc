// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/renderer.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/feature_edges.h"
#include "scene/visibility.h"
#include "viewer/edge_drawing.h"
#include "viewer/face_numbers.h"
#include "viewer/gl_context.h"
#include "viewer/gl_functions.h"
#include "viewer/pinhole_frame.h"
#include "viewer/render_mesh.h"
#include "viewer/render_target.h"
#include "viewer/shaders.h"
#include "viewer/texture_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace groundglass {
namespace {

// How faces are coloured, and what kFaceFragmentShader calls it.
enum Colouring { kTexturedFaces, kTexturedAlongSight, kPlainFaces, kShadedFaces, kNumberedFaces };
constexpr std::array<const char*, 5> kColourings = {
    "TEXTURED", "TEXTURED_ALONG_SIGHT", "PLAIN", "SHADED", "NUMBERED"};

Colouring ChooseColouring(const RenderOptions& options, const RenderBatch& batch) {
  if (options.mode == DrawMode::kShaded) return kShadedFaces;
  if (options.mode == DrawMode::kLabels) return kNumberedFaces;
  if (batch.page < 0) return kPlainFaces;
  return options.anisotropy > 1 ? kTexturedAlongSight : kTexturedFaces;
}

// Horizontal directions of the sky at the corners of clip space, for kFrameVertexShader.
Eigen::Matrix3d WorldFromClip(const Camera& pinhole) {
  Eigen::Matrix3d cam_from_clip = Eigen::Matrix3d::Zero();
  cam_from_clip(0, 0) = pinhole.width_px / (2 * pinhole.focal_x_px);
  cam_from_clip(0, 2) = (pinhole.width_px / 2.0 - pinhole.center_x_px) / pinhole.focal_x_px;
  cam_from_clip(1, 1) = pinhole.height_px / (2 * pinhole.focal_y_px);
  cam_from_clip(1, 2) = (pinhole.height_px / 2.0 - pinhole.center_y_px) / pinhole.focal_y_px;
  cam_from_clip(2, 2) = 1;
  return pinhole.cam_from_world.rotation.transpose() * cam_from_clip;
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
  std::unique_ptr<GlContext> context = MakeOsMesaContext();
  GlFunctions gl;
  PolygonModel model;
  RenderMesh mesh;
  std::vector<std::string> warnings;
  int max_frame_px = 0;

  std::array<GlProgram, kColourings.size()> face_programs;  // by Colouring
  GlProgram label_program;
  GlProgram sky_program;
  GlProgram resolve_program;
  GlBuffer vertex_buffer;
  GlVertexArray vertex_array;
  GlVertexArray frame_array;
  std::vector<GlTexture> pages;
  GlTexture grid;
  RenderTarget multisampled;
  RenderTarget drawn;
  RenderTarget resolved;
  RenderTarget labels;

  // For the edges; made when they are first drawn.
  std::vector<ModelEdge> edges;
  std::optional<Visibility> visibility;

  Impl(const TexturedModel& textured, const RendererOptions& options)
      : model(textured.model), mesh(MakeRenderMesh(textured)) {
    options.Check();
    context->MakeCurrent();
    gl = FindGlFunctions(*context);
    for (size_t i = 0; i < kColourings.size(); ++i) {
      face_programs[i] = GlProgram(
          gl,
          kFaceVertexShader,
          std::string("#version 330 core\n#define ") + kColourings[i] + "\n" + kFaceFragmentShader);
    }
    label_program = GlProgram(gl, kFaceVertexShader, kLabelFragmentShader);
    sky_program = GlProgram(gl, kFrameVertexShader, kSkyFragmentShader);
    resolve_program = GlProgram(gl, kFrameVertexShader, kResolveFragmentShader);
    GLint max_texture_px = 0;
    GLint max_renderbuffer_px = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &max_texture_px);
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &max_renderbuffer_px);
    max_frame_px = std::min(max_texture_px, max_renderbuffer_px);
    UploadVertices();
    const int max_page_px = std::min<int>(options.max_page_size_px, max_texture_px);
    for (const TexturePage& page : textured.pages) {
      pages.push_back(UploadTexturePage(
          gl, page.srgb8, static_cast<int>(pages.size()) + 1, max_page_px, warnings));
      if (mesh.IsRepeated(static_cast<int>(pages.size()) - 1)) {
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
      }
    }
    frame_array = GlVertexArray(gl);
    grid = GlTexture(gl);
    gl.FrontFace(GL_CW);  // see ClipFromCam
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
  }
  ~Impl() { context->MakeCurrent(); }

  void UploadVertices() {
    vertex_array = GlVertexArray(gl);
    vertex_buffer = GlBuffer(gl);
    gl.BindVertexArray(vertex_array.Name());
    gl.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer.Name());
    gl.BufferData(GL_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(RenderVertex)),
                  mesh.vertices.data(),
                  GL_STATIC_DRAW);
    const auto set = [&](GLuint location, int size, size_t offset) {
      gl.EnableVertexAttribArray(location);
      gl.VertexAttribPointer(location,
                             size,
                             GL_FLOAT,
                             GL_FALSE,
                             sizeof(RenderVertex),
                             reinterpret_cast<const void*>(offset));
    };
    set(0, 3, offsetof(RenderVertex, position));
    set(1, 3, offsetof(RenderVertex, normal));
    set(2, 2, offsetof(RenderVertex, on_page));
    gl.EnableVertexAttribArray(3);
    gl.VertexAttribIPointer(3,
                            1,
                            GL_UNSIGNED_INT,
                            sizeof(RenderVertex),
                            reinterpret_cast<const void*>(offsetof(RenderVertex, face)));
  }

  void CheckFrame(const Camera& pinhole) const {
    if (pinhole.width_px >= 1 && pinhole.height_px >= 1 && pinhole.width_px <= max_frame_px &&
        pinhole.height_px <= max_frame_px) {
      return;
    }
    throw Error("viewer: a frame of " + std::to_string(pinhole.width_px) + " x " +
                std::to_string(pinhole.height_px) + " cannot be drawn; from 1 to " +
                std::to_string(max_frame_px) + " px each way can, supersampling included");
  }

  Eigen::Matrix4f ClipFromLocal(const Camera& pinhole) const {
    const DepthRange range = FindDepthRange(mesh, pinhole);
    Eigen::Matrix4d cam_from_local = Eigen::Matrix4d::Identity();
    cam_from_local.topLeftCorner<3, 3>() = pinhole.cam_from_world.rotation;
    cam_from_local.topRightCorner<3, 1>() = pinhole.cam_from_world * mesh.origin_in_world;
    return (ClipFromCam(pinhole, range.near_depth, range.far_depth) * cam_from_local).cast<float>();
  }

  void BindTarget(const RenderTarget& target) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.Name());
    gl.Viewport(0, 0, target.width, target.height);
  }

  void DrawSky(const Camera& pinhole) {
    sky_program.Use();
    const Eigen::Matrix3f world_from_clip = WorldFromClip(pinhole).cast<float>();
    gl.UniformMatrix3fv(
        sky_program.Uniform("world_from_clip"), 1, GL_FALSE, world_from_clip.data());
    gl.BindVertexArray(frame_array.Name());
    // Behind what is there, by the share of each pixel that no face covers: in this way the sky
    // needs one sample for each pixel only.
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Disable(GL_BLEND);
  }

  void DrawFaces(const Camera& pinhole, const RenderOptions& options) {
    const double bearing = RadiansFromDegrees(options.sun_bearing_deg);
    const double height = RadiansFromDegrees(options.sun_height_deg);
    const Eigen::Matrix4f clip_from_local = ClipFromLocal(pinhole);
    gl.BindVertexArray(vertex_array.Name());
    gl.Enable(GL_DEPTH_TEST);
    gl.ActiveTexture(GL_TEXTURE0);
    for (const RenderBatch& batch : mesh.batches) {
      const GlProgram& program = face_programs[ChooseColouring(options, batch)];
      program.Use();
      gl.UniformMatrix4fv(program.Uniform("clip_from_local"), 1, GL_FALSE, clip_from_local.data());
      gl.Uniform1i(program.Uniform("page"), 0);
      gl.Uniform1i(program.Uniform("max_taps"), options.anisotropy);
      gl.Uniform3f(program.Uniform("sun_direction"),
                   static_cast<float>(std::sin(bearing) * std::cos(height)),
                   static_cast<float>(std::cos(bearing) * std::cos(height)),
                   static_cast<float>(std::sin(height)));
      if (batch.page >= 0) gl.BindTexture(GL_TEXTURE_2D, pages[batch.page].Name());
      gl.DrawArrays(GL_TRIANGLES, batch.first_vertex, batch.num_vertices);
    }
    gl.Disable(GL_DEPTH_TEST);
  }

  // Sky and faces into `drawn`, one sample for each of its pixels.
  void DrawPinhole(const Camera& pinhole, const RenderOptions& options) {
    const bool multi = options.multisamples > 1;
    FitTarget(gl, drawn, pinhole.width_px, pinhole.height_px, 1, TargetKind::kColourAndDepth);
    if (multi) {
      FitTarget(gl,
                multisampled,
                pinhole.width_px,
                pinhole.height_px,
                options.multisamples,
                TargetKind::kColourAndDepth);
    }
    BindTarget(multi ? multisampled : drawn);
    const float ground = options.background == Background::kWhite ? 1.0f : 0.0f;
    const float clear_colour[4] = {ground, ground, ground, ground};
    const float clear_depth = 1;
    gl.ClearBufferfv(GL_COLOR, 0, clear_colour);
    gl.ClearBufferfv(GL_DEPTH, 0, &clear_depth);
    if (options.mode != DrawMode::kWireframe) DrawFaces(pinhole, options);
    if (multi) {
      gl.BindFramebuffer(GL_READ_FRAMEBUFFER, multisampled.framebuffer.Name());
      gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, drawn.framebuffer.Name());
      gl.BlitFramebuffer(0,
                         0,
                         pinhole.width_px,
                         pinhole.height_px,
                         0,
                         0,
                         pinhole.width_px,
                         pinhole.height_px,
                         GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
    }
    if (options.background == Background::kSky) {
      BindTarget(drawn);
      DrawSky(pinhole);
    }
  }

  // `drawn`, averaged and bent, into `resolved`.
  void Resolve(const Camera& camera, const PinholeFrame& frame, int samples) {
    FitTarget(gl, resolved, camera.width_px, camera.height_px, 1, TargetKind::kColour);
    BindTarget(resolved);
    resolve_program.Use();
    gl.Uniform1i(resolve_program.Uniform("drawn"), 0);
    gl.Uniform1i(resolve_program.Uniform("grid"), 1);
    gl.Uniform1i(resolve_program.Uniform("samples"), samples);
    gl.Uniform1i(resolve_program.Uniform("bent"), frame.is_bent ? 1 : 0);
    gl.Uniform1f(resolve_program.Uniform("grid_step"), PinholeFrame::kGridStep);
    gl.Uniform2f(resolve_program.Uniform("grid_size"),
                 static_cast<float>(frame.grid_width),
                 static_cast<float>(frame.grid_height));
    gl.ActiveTexture(GL_TEXTURE1);
    gl.BindTexture(GL_TEXTURE_2D, grid.Name());
    if (frame.is_bent) {
      gl.TexImage2D(GL_TEXTURE_2D,
                    0,
                    GL_RG32F,
                    frame.grid_width,
                    frame.grid_height,
                    0,
                    GL_RG,
                    GL_FLOAT,
                    frame.grid_px.data());
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, drawn.texture.Name());
    gl.BindVertexArray(frame_array.Name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
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

Renderer::Renderer(const TexturedModel& model, const RendererOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const std::vector<std::string>& Renderer::Warnings() const { return impl_->warnings; }

Image8 Renderer::Render(const Camera& camera, const RenderOptions& options) {
  options.Check();
  Impl& impl = *impl_;
  impl.context->MakeCurrent();
  const PinholeFrame frame = MakePinholeFrame(camera, options.supersampling, impl.max_frame_px);
  impl.CheckFrame(frame.pinhole);
  impl.DrawPinhole(frame.pinhole, options);
  const bool as_drawn = !frame.is_bent && options.supersampling == 1;
  if (!as_drawn) impl.Resolve(camera, frame, options.supersampling);
  Image8 picture = ReadPicture(impl.gl,
                               as_drawn ? impl.drawn : impl.resolved,
                               options.background == Background::kTransparent);
  const bool with_numbers = options.mode == DrawMode::kLabels;
  if (options.edges || with_numbers || options.mode == DrawMode::kWireframe) {
    impl.DrawEdgesOver(picture, camera, options);
  }
  if (with_numbers) DrawFaceNumbers(picture, NumbersFromLabels(impl.model, RenderLabels(camera)));
  return picture;
}

Image16 Renderer::RenderLabels(const Camera& camera) {
  Impl& impl = *impl_;
  const GlFunctions& gl = impl.gl;
  impl.context->MakeCurrent();
  const PinholeFrame frame = MakePinholeFrame(camera, 1, impl.max_frame_px);
  const Camera& pinhole = frame.pinhole;
  impl.CheckFrame(pinhole);
  FitTarget(gl, impl.labels, pinhole.width_px, pinhole.height_px, 1, TargetKind::kLabelsAndDepth);
  impl.BindTarget(impl.labels);
  const GLuint no_face[4] = {0, 0, 0, 0};
  const float clear_depth = 1;
  gl.ClearBufferuiv(GL_COLOR, 0, no_face);
  gl.ClearBufferfv(GL_DEPTH, 0, &clear_depth);
  impl.label_program.Use();
  const Eigen::Matrix4f clip_from_local = impl.ClipFromLocal(pinhole);
  gl.UniformMatrix4fv(
      impl.label_program.Uniform("clip_from_local"), 1, GL_FALSE, clip_from_local.data());
  gl.BindVertexArray(impl.vertex_array.Name());
  gl.Enable(GL_DEPTH_TEST);
  gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(impl.mesh.vertices.size()));
  gl.Disable(GL_DEPTH_TEST);
  std::vector<GLuint> drawn(static_cast<size_t>(pinhole.width_px) * pinhole.height_px);
  gl.ReadPixels(
      0, 0, pinhole.width_px, pinhole.height_px, GL_RED_INTEGER, GL_UNSIGNED_INT, drawn.data());

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

Image8 Render(const TexturedModel& model, const Camera& camera, const RenderOptions& options) {
  return Renderer(model).Render(camera, options);
}

}  // namespace groundglass
