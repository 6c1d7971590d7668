// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The edges of a texture, eight times enlarged, side by side: looked up as in the thesis (each
// texel the nearest pixel of one photograph, Thorman 1988, Figure 7), by this project, and the
// truth.
#include "evaluate/truth.h"
#include "invrender/bake.h"
#include "invrender/bake_output.h"
#include "invrender/photos/face_mask.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "viewer/renderer.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace groundglass {
namespace {

constexpr int kEnlarge = 8;
constexpr int kCropPx = 56;

// Paints the pages of a bake anew: every texel inside a face takes the nearest pixel of the closest
// photograph whose mask shows the face there.
void BakeNearest(std::span<const BakePhotograph> photographs, TexturedModel& textured) {
  const Visibility visibility(textured.model);
  std::vector<Image8> pictures;
  std::vector<Image16> masks;
  for (const BakePhotograph& photograph : photographs) {
    pictures.push_back(ReadSrgb8(photograph.image_file));
    masks.push_back(MakeFaceMask(textured.model, visibility, photograph.camera));
  }
  for (size_t face = 0; face < textured.faces.size(); ++face) {
    const FaceTexture& texture = textured.faces[face];
    if (texture.page < 0) continue;
    Image8& page = textured.pages[texture.page].srgb8;
    const std::vector<int>& points = textured.model.faces[face].points;
    // Where texels lie in the world: the inverse of the face's affine map.
    Eigen::MatrixXd from(points.size(), 3);
    Eigen::MatrixXd to(points.size(), 3);
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    for (size_t i = 0; i < points.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      from.row(row) << texture.corners_texel[i].transpose(), 1;
      to.row(row) = textured.model.points_in_world[points[i]].transpose();
      low = low.cwiseMin(texture.corners_texel[i]);
      high = high.cwiseMax(texture.corners_texel[i]);
    }
    const Eigen::Matrix3d world_from_texel = from.colPivHouseholderQr().solve(to).transpose();
    const int x0 = std::max(0, static_cast<int>(low.x()) - 1);
    const int y0 = std::max(0, static_cast<int>(low.y()) - 1);
    for (int y = y0; y < std::min<int>(page.height, static_cast<int>(high.y()) + 2); ++y) {
      for (int x = x0; x < std::min<int>(page.width, static_cast<int>(high.x()) + 2); ++x) {
        const Eigen::Vector3d point = world_from_texel * Eigen::Vector3d(x + 0.5, y + 0.5, 1);
        double nearest = 1e300;
        for (size_t i = 0; i < photographs.size(); ++i) {
          const Camera& camera = photographs[i].camera;
          const auto px = Project(camera, point);
          if (!px || !IsInsideFrame(camera, *px)) continue;
          const int u = std::min(static_cast<int>(px->x()), camera.width_px - 1);
          const int v = std::min(static_cast<int>(px->y()), camera.height_px - 1);
          const double distance = (camera.PositionInWorld() - point).norm();
          if (*masks[i].At(u, v) != face + 1 || distance >= nearest) continue;
          nearest = distance;
          std::copy_n(pictures[i].At(u, v), 3, page.At(x, y));
        }
      }
    }
  }
}

void Enlarge(const Image8& from, int x0, int y0, int column, Image8& to) {
  for (int y = 0; y < kEnlarge * kCropPx; ++y) {
    for (int x = 0; x < kEnlarge * kCropPx; ++x) {
      std::copy_n(from.At(x0 + x / kEnlarge, y0 + y / kEnlarge),
                  3,
                  to.At(column * (kEnlarge * kCropPx + kEnlarge) + x, y));
    }
  }
}

int Run(const std::string& folder, const std::string& view_name, int x0, int y0, const char* out) {
  const Scene scene = ReadScene(folder);
  const Truth truth = ReadTruth(scene.folder / "truth");
  const std::vector<BakePhotograph> photographs = SelectPhotographs(scene, truth.cameras);
  for (const NovelView& view : truth.novel_views) {
    if (view.name != view_name) continue;
    const Image8 true_srgb8 = ReadSrgb8(view.image_file);
    const Camera camera = CameraFromTag(view.tag, true_srgb8.width, true_srgb8.height);
    TexturedModel textured = BakeTextures(scene.model, photographs).model;
    RenderOptions options;
    options.supersampling = 2;
    Image8 picture(3 * kEnlarge * kCropPx + 2 * kEnlarge, kEnlarge * kCropPx, 3, 255);
    Enlarge(Render(textured, camera, options), x0, y0, 1, picture);
    Enlarge(true_srgb8, x0, y0, 2, picture);
    BakeNearest(photographs, textured);
    Enlarge(Render(textured, camera, options), x0, y0, 0, picture);
    WriteSrgb8(out, picture);
  }
  return 0;
}

}  // namespace
}  // namespace groundglass

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: invrender_edges_bench SCENE NOVEL_VIEW X Y OUT.png\n");
    return 2;
  }
  try {
    return groundglass::Run(argv[1], argv[2], std::atoi(argv[3]), std::atoi(argv[4]), argv[5]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "invrender_edges_bench: %s\n", error.what());
    return 1;
  }
}
