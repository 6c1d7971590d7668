// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/picture.h"

#include "viewer/tile_renderer.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace groundglass {
namespace {

cv::Mat Wrapped(Image8& picture) {
  return {picture.height, picture.width, CV_8UC3, picture.values.data()};
}

// The photograph where it lies in the picture, dark grey around it.
Image8 PlacePhotograph(const PictureRequest& request) {
  Image8 picture(request.width_px, request.height_px, 3, 40);
  const Image8& photograph = *request.photograph;
  cv::Mat to = Wrapped(picture);
  const cv::Mat from(
      photograph.height, photograph.width, CV_8UC3, const_cast<uint8_t*>(photograph.values.data()));
  // Pixels' centres are at halves here and at whole numbers there.
  const double scale = request.place.scale;
  const Eigen::Vector2d shift =
      request.place.origin_px + Eigen::Vector2d::Constant(0.5 * scale - 0.5);
  const cv::Matx23d placed(scale, 0, shift.x(), 0, scale, shift.y());
  // Reduced first where it is shown much smaller, or it would glitter.
  if (scale < 0.5) {
    cv::Mat reduced;
    cv::resize(from, reduced, {}, scale, scale, cv::INTER_AREA);
    const double to_x = scale * from.cols / reduced.cols;
    const double to_y = scale * from.rows / reduced.rows;
    const cv::Matx23d rest(to_x,
                           0,
                           request.place.origin_px.x() + 0.5 * to_x - 0.5,
                           0,
                           to_y,
                           request.place.origin_px.y() + 0.5 * to_y - 0.5);
    cv::warpAffine(reduced, to, rest, to.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
  } else {
    const int how = scale >= 4 ? cv::INTER_NEAREST : cv::INTER_LINEAR;
    cv::warpAffine(from, to, placed, to.size(), how, cv::BORDER_TRANSPARENT);
  }
  return picture;
}

// Hatches in orange what the mask leaves out, so that both pattern and colour say it.
void HatchMask(const PictureRequest& request, Image8& picture) {
  const Image8& mask = *request.mask;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Eigen::Vector2d at = request.place.InPhotograph({x + 0.5, y + 0.5});
      const bool is_inside =
          at.x() >= 0 && at.y() >= 0 && at.x() < mask.width && at.y() < mask.height;
      if (!is_inside || *mask.At(static_cast<int>(at.x()), static_cast<int>(at.y())) == 0) continue;
      constexpr std::array<int, 3> kOrange = {230, 159, 0};
      const int share_of_8 = (x + y) % 12 < 4 ? 7 : 3;
      uint8_t* pixel = picture.At(x, y);
      for (int c = 0; c < 3; ++c) {
        pixel[c] =
            static_cast<uint8_t>((kOrange[c] * share_of_8 + pixel[c] * (8 - share_of_8)) / 8);
      }
    }
  }
}

// The model over the photograph: faded, or whole to the right of the wipe.
void Mix(const PictureRequest& request, Image8& model, Image8& photograph) {
  cv::Mat over = Wrapped(model);
  cv::Mat under = Wrapped(photograph);
  cv::Mat mixed;
  cv::addWeighted(over, request.model_share, under, 1 - request.model_share, 0, mixed);
  if (request.wipe_px >= 0) {
    const int wipe = std::min(request.wipe_px, request.width_px);
    under.copyTo(mixed);
    const cv::Rect right(wipe, 0, request.width_px - wipe, request.height_px);
    if (right.width > 0) over(right).copyTo(mixed(right));
  }
  mixed.copyTo(under);
}

RenderOptions OptionsFor(const PictureRequest& request) {
  RenderOptions options;
  options.mode = request.mode;
  options.edges = request.edges;
  options.background = request.mode == DrawMode::kWireframe ? Background::kWhite : Background::kSky;
  const bool is_moving = request.quality != FrameQuality::kAtRest;
  options.multisamples =
      request.quality == FrameQuality::kAtRest || request.quality == FrameQuality::kSmooth ? 4 : 1;
  options.anisotropy = is_moving ? 1 : 8;
  return options;
}

bool IsSameCamera(const Camera& a, const Camera& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.focal_x_px == b.focal_x_px &&
         a.focal_y_px == b.focal_y_px && a.center_x_px == b.center_x_px &&
         a.center_y_px == b.center_y_px && a.k1 == b.k1 && a.k2 == b.k2 && a.k3 == b.k3 &&
         a.p1 == b.p1 && a.p2 == b.p2 && a.cam_from_world.rotation == b.cam_from_world.rotation &&
         a.cam_from_world.translation == b.cam_from_world.translation;
}

}  // namespace

bool IsSamePicture(const PictureRequest& a, const PictureRequest& b) {
  const auto is_same_layer = [](const EdgeLayer& first, const EdgeLayer& second) {
    return IsSameCamera(first.camera, second.camera) && first.style.colour == second.style.colour;
  };
  return a.width_px == b.width_px && a.height_px == b.height_px && a.quality == b.quality &&
         a.mode == b.mode && a.coloured == b.coloured && a.tiles == b.tiles && a.mask == b.mask &&
         a.edges == b.edges && a.has_model == b.has_model && IsSameCamera(a.camera, b.camera) &&
         a.photograph == b.photograph && a.place == b.place && a.model_share == b.model_share &&
         a.wipe_px == b.wipe_px &&
         std::equal(
             a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), is_same_layer);
}

Camera PhotographPlace::InPicture(const Camera& camera, int width_px, int height_px) const {
  Camera placed = camera;
  placed.width_px = width_px;
  placed.height_px = height_px;
  placed.focal_x_px *= scale;
  placed.focal_y_px *= scale;
  placed.center_x_px = origin_px.x() + scale * camera.center_x_px;
  placed.center_y_px = origin_px.y() + scale * camera.center_y_px;
  return placed;
}

PictureMaker::PictureMaker(const TexturedModel& model)
    : model_(model),
      renderer_(model),
      visibility_(model.model),
      edges_(FindModelEdges(model.model)) {}

Image8 PictureMaker::DrawFrom(const Camera& camera, const PictureRequest& request) {
  if (request.tiles) {
    TileRenderer tiles(camera, request.quality == FrameQuality::kAtRest ? 2 : 1);
    for (const MappedTiles& file : *request.tiles) tiles.Draw(file.Tiles());
    return tiles.Picture();
  }
  if (!request.coloured) return renderer_.Render(camera, OptionsFor(request));
  if (coloured_ != request.coloured) {
    coloured_.reset();  // should the next fail
    coloured_renderer_.emplace(*request.coloured);
    coloured_ = request.coloured;
  }
  return coloured_renderer_->Render(camera, OptionsFor(request));
}

Image8 PictureMaker::DrawTheModel(const PictureRequest& request) {
  const double scale = FrameScale(request.quality);
  if (scale == 1) return DrawFrom(request.camera, request);
  const Camera smaller = ResizedCamera(request.camera,
                                       std::max(1, static_cast<int>(request.width_px * scale)),
                                       std::max(1, static_cast<int>(request.height_px * scale)));
  Image8 drawn = DrawFrom(smaller, request);
  Image8 picture(request.width_px, request.height_px, 3);
  cv::Mat to = Wrapped(picture);
  cv::resize(Wrapped(drawn), to, to.size(), 0, 0, cv::INTER_LINEAR);
  return picture;
}

Picture PictureMaker::Make(const PictureRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const bool shows_model = request.has_model && (request.model_share > 0 || request.wipe_px >= 0);
  Image8 picture;
  if (!request.photograph) {
    picture = request.has_model ? DrawTheModel(request)
                                : Image8(request.width_px, request.height_px, 3, 40);
  } else {
    picture = PlacePhotograph(request);
    if (request.mask) HatchMask(request, picture);
    if (shows_model) {
      Image8 model = DrawTheModel(request);
      Mix(request, model, picture);
    }
  }
  for (const EdgeLayer& layer : request.layers) {
    DrawEdges(
        picture,
        FindVisibleSpans(model_.model, edges_, visibility_, layer.camera, EdgeMargin(layer.style)),
        layer.camera,
        layer.style);
  }
  Picture made;
  made.width_px = request.width_px;
  made.height_px = request.height_px;
  made.quality = request.quality;
  made.bgra.resize(4 * static_cast<size_t>(request.width_px) * request.height_px);
  cv::Mat bgra(request.height_px, request.width_px, CV_8UC4, made.bgra.data());
  cv::cvtColor(Wrapped(picture), bgra, cv::COLOR_RGB2BGRA);
  made.took_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return made;
}

}  // namespace groundglass
