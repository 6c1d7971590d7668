// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "scene/formats/tile_file.h"
#include "session/frame_governor.h"
#include "viewer/edge_drawing.h"
#include "viewer/renderer.h"

#include <Eigen/Dense>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace groundglass {

// A photograph in the picture: picture px = origin_px + scale * photograph px.
struct PhotographPlace {
  double scale = 1;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();

  Eigen::Vector2d InPicture(const Eigen::Vector2d& photograph_px) const {
    return origin_px + scale * photograph_px;
  }
  Eigen::Vector2d InPhotograph(const Eigen::Vector2d& picture_px) const {
    return (picture_px - origin_px) / scale;
  }
  // The photograph's camera for the whole picture.
  Camera InPicture(const Camera& camera, int width_px, int height_px) const;
  bool operator==(const PhotographPlace&) const = default;
};

// The model's edges as one camera (of the picture's size) sees them.
struct EdgeLayer {
  Camera camera;
  EdgeStyle style;
};

// Everything that the picture in the window's middle is made of.
struct PictureRequest {
  int width_px = 0;
  int height_px = 0;
  FrameQuality quality = FrameQuality::kAtRest;
  DrawMode mode = DrawMode::kTextured;
  // In place of the model's own texture; null: that.
  std::shared_ptr<const TexturedModel> coloured;
  // In place of its faces: tiles of the database of 1988; null: faces.
  std::shared_ptr<const std::vector<MappedTiles>> tiles;
  bool edges = false;                        // over the model
  bool has_model = true;                     // else only what follows
  Camera camera;                             // of the model, of the picture's size
  std::shared_ptr<const Image8> photograph;  // null: the model alone
  std::shared_ptr<const Image8> mask;  // of the photograph's size: what is not to be looked at
  PhotographPlace place;
  double model_share = 1;  // of the model over the photograph, 0 to 1
  int wipe_px = -1;        // from this column on the model is whole; -1: no wipe
  std::vector<EdgeLayer> layers;
};

// Whether both ask for the same picture.
bool IsSamePicture(const PictureRequest& a, const PictureRequest& b);

struct Picture {
  int width_px = 0;
  int height_px = 0;
  std::vector<uint8_t> bgra;
  FrameQuality quality = FrameQuality::kAtRest;
  double took_ms = 0;
};

// Draws pictures of one model. To be used by one thread.
class PictureMaker {
 public:
  explicit PictureMaker(const TexturedModel& model);
  Picture Make(const PictureRequest& request);

 private:
  Image8 DrawTheModel(const PictureRequest& request);
  Image8 DrawFrom(const Camera& camera, const PictureRequest& request);

  const TexturedModel& model_;
  Renderer renderer_;
  std::shared_ptr<const TexturedModel> coloured_;  // what coloured_renderer_ draws
  std::optional<Renderer> coloured_renderer_;
  Visibility visibility_;
  std::vector<ModelEdge> edges_;
};

}  // namespace groundglass
