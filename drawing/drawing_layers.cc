// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_layers.h"

#include "scene/least_norm.h"
#include "scene/model_sigma.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace groundglass {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

}  // namespace

DrawingLayers::DrawingLayers(const DrawingPainter& painter,
                             const TexturedModel& textured,
                             const DrawingSources& sources)
    : painter_(painter), textured_(textured), sources_(sources) {
  for (const PanelView& panel : painter.Panels()) {
    std::vector<FaceMap>& maps = maps_.emplace_back();
    for (int face = 0; face < static_cast<int>(textured.model.faces.size()); ++face) {
      maps.push_back(MakeFaceMap(panel.view, face));
    }
  }
}

DrawingLayers::FaceMap DrawingLayers::MakeFaceMap(const OrthographicView& view, int face) const {
  const PolygonModel& model = textured_.model;
  const FacePlane plane = ComputeFacePlane(model, face);
  const Eigen::Vector3d forward = view.ForwardInWorld();
  const double facing = plane.normal_in_world.dot(forward);
  FaceMap map;
  map.is_seen = facing < -1e-6;
  if (!map.is_seen) return map;
  // normal . (corner + p (x right + y down) + depth forward) = offset
  const double p = view.pixel_size;
  map.depth_from_px =
      Eigen::Vector3d(-p * plane.normal_in_world.dot(view.right_in_world),
                      -p * plane.normal_in_world.dot(view.down_in_world),
                      plane.offset - plane.normal_in_world.dot(view.corner_in_world)) /
      facing;
  map.nearest = std::numeric_limits<double>::max();
  map.farthest = std::numeric_limits<double>::lowest();
  for (const int point : model.faces[face].points) {
    const double depth = (model.points_in_world[point] - view.corner_in_world).dot(forward);
    map.nearest = std::min(map.nearest, depth);
    map.farthest = std::max(map.farthest, depth);
  }
  // Nothing is drawn that lies nearer or farther.
  map.nearest = std::clamp(map.nearest, view.near_depth, view.far_depth);
  map.farthest = std::clamp(map.farthest, view.near_depth, view.far_depth);
  if (textured_.faces.empty() || textured_.faces[face].page < 0) return map;
  const std::vector<Eigen::Vector2d>& texels = textured_.faces[face].corners_texel;
  Eigen::MatrixX3d in_view(texels.size(), 3);
  Eigen::MatrixX2d on_page(texels.size(), 2);
  for (size_t i = 0; i < texels.size(); ++i) {
    const Eigen::Vector3d px = view.FromWorld(model.points_in_world[model.faces[face].points[i]]);
    in_view.row(i) << px.x(), px.y(), 1;
    on_page.row(i) = texels[i].transpose();
  }
  map.page = textured_.faces[face].page;
  map.texel_from_px = SolveLeastNorm(in_view, on_page).transpose();
  return map;
}

uint16_t DrawingLayers::PhotographAt(const FaceMap& map, const Eigen::Vector2d& image_px) const {
  if (map.page < 0 || map.page >= static_cast<int>(sources_.provenance.size())) {
    return kProvenanceNone;
  }
  const Image16& page = sources_.provenance[map.page];
  const Eigen::Vector2d texel = map.texel_from_px * image_px.homogeneous();
  const int x = std::clamp(static_cast<int>(std::floor(texel.x())), 0, page.width - 1);
  const int y = std::clamp(static_cast<int>(std::floor(texel.y())), 0, page.height - 1);
  return *page.At(x, y);
}

template <typename T, typename Value>
Raster<T> DrawingLayers::Fill(int first_row, int num_rows, T nothing, const Value& value) const {
  const Image16 faces = painter_.Faces(first_row, num_rows);
  Raster<T> filled(faces.width, faces.height, 1, nothing);
  for (size_t i = 0; i < painter_.Panels().size(); ++i) {
    const PanelView& panel = painter_.Panels()[i];
    for (int y = 0; y < faces.height; ++y) {
      for (int x = 0; x < panel.view.width_px; ++x) {
        const int face = *faces.At(panel.first_column + x, y) - 1;
        if (face < 0 || !maps_[i][face].is_seen) continue;
        *filled.At(panel.first_column + x, y) =
            value(face, maps_[i][face], Eigen::Vector2d(x + 0.5, first_row + y + 0.5));
      }
    }
  }
  return filled;
}

Image16 DrawingLayers::Photographs(int first_row, int num_rows) const {
  return Fill<uint16_t>(first_row,
                        num_rows,
                        kProvenanceNone,
                        [&](int, const FaceMap& map, const Eigen::Vector2d& image_px) {
                          return PhotographAt(map, image_px);
                        });
}

ImageF DrawingLayers::Sigmas(int first_row, int num_rows) const {
  const double metres = MetresPerUnit(textured_.model.unit);
  const double model_sigma = ModelSigma(textured_.model);
  return Fill<float>(
      first_row,
      num_rows,
      kNothing,
      [&](int face, const FaceMap& map, const Eigen::Vector2d& image_px) {
        const uint16_t number = PhotographAt(map, image_px);
        const DrawnSource* source = number == kProvenanceNone || number == kProvenanceFilled
                                        ? nullptr
                                        : sources_.Find(face, number - 1);
        if (!source || !source->camera_sigma) return kNothing;
        return static_cast<float>(metres * std::hypot(*source->camera_sigma, model_sigma));
      });
}

ImageF DrawingLayers::Heights(int first_row, int num_rows) const {
  const double metres = MetresPerUnit(textured_.model.unit);
  return Fill<float>(
      first_row, num_rows, kNothing, [&](int, const FaceMap& map, const Eigen::Vector2d& image_px) {
        // A steep face that is not quite flat leaves its best plane by a little across the view,
        // and so by much along it.
        const double depth = map.depth_from_px.dot(image_px.homogeneous());
        return static_cast<float>(-metres * std::clamp(depth, map.nearest, map.farthest));
      });
}

}  // namespace groundglass
