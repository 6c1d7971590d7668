// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Okabe and Ito's colours, which people of any colour vision tell apart.
constexpr Srgb8Colour kCorrectedBlue = {86, 180, 233};
constexpr Srgb8Colour kWrittenGrey = {190, 190, 190};
constexpr Srgb8Colour kRivalPurple = {204, 121, 167};

// Dashes and dots repeat what colours say.
enum class Stroke { kWhole, kDashed, kDotted };

EdgeStyle StyleOf(Srgb8Colour colour, double width_px, Stroke stroke = Stroke::kWhole) {
  EdgeStyle style;
  style.colour = colour;
  style.width_px = width_px;
  style.silhouette_width_px = 1.3 * width_px;
  style.casing_opacity = 0.6;
  style.casing_px = 0.9;
  if (stroke == Stroke::kDashed) style.dash_px = 10;
  if (stroke == Stroke::kDotted) style.dash_px = 3;
  if (stroke != Stroke::kWhole) style.gap_px = 5;
  return style;
}

constexpr size_t kMostEyesBefore = 50;

}  // namespace

std::vector<std::optional<Camera>> FindWrittenCameras(const Session& session, const Scene& scene) {
  std::vector<std::optional<Camera>> cameras(session.photographs().size());
  for (const Photograph& written : scene.photographs) {
    if (const auto photograph = session.FindPhotograph(written.name)) {
      cameras[*photograph] = CameraFromTag(written.tag, written.size.width, written.size.height);
    }
  }
  return cameras;
}

const std::optional<Camera>& App::WrittenCamera(int photograph) const {
  return written_[photograph];
}

std::optional<Camera> App::BelievedCamera(int photograph) const {
  return session_.CameraOf(photograph);
}

std::optional<Camera> App::PhotographCamera() const {
  if (photograph_ < 0) return std::nullopt;
  return BelievedCamera(photograph_);
}

Camera App::PaneCamera() const {
  if (IsInside()) {
    if (const auto camera = PhotographCamera()) {
      return place_.InPicture(*camera, pane_.width, pane_.height);
    }
  }
  return eye_.InFrame(pane_.width, pane_.height);
}

PictureRequest App::MakeRequest() {
  PictureRequest request;
  request.width_px = pane_.width;
  request.height_px = pane_.height;
  request.quality = governor_.QualityAt(NowMs());
  request.mode = draw_mode_;
  if (shown_map_) {
    // The colours belong to the map, not to the light.
    request.mode = DrawMode::kTextured;
    request.coloured = {shown_map_, &shown_map_->textured};
  }
  if (map_ == LookMap::kTiles1988) request.tiles = tiles_;
  request.edges = shows_edges_ && request.mode != DrawMode::kWireframe && request.tiles == nullptr;
  request.camera = PaneCamera();
  if (!IsInside()) return request;
  request.photograph = cache_.Find(photograph_);
  request.place = place_;
  request.mask = ShownMask();
  request.has_model = PhotographCamera().has_value();
  request.model_share = photograph_alone_ ? 0 : model_share_;
  if (wipes_ && !photograph_alone_) request.wipe_px = static_cast<int>(mouse_px_.x());
  request.edges = false;
  if (photograph_alone_ || !shows_edges_) return request;
  const auto& written = WrittenCamera(photograph_);
  if (shows_written_ && written) {
    request.layers.push_back({place_.InPicture(*written, pane_.width, pane_.height),
                              StyleOf(kWrittenGrey, 1, Stroke::kDashed)});
  }
  const SessionPhotograph& photograph = session_.photographs()[photograph_];
  const auto& news = session_.work(photograph_).alignment;
  if (shows_rival_ && news && news->rival) {
    const Camera rival = CameraFromTag(*news->rival, photograph.size.width, photograph.size.height);
    request.layers.push_back({place_.InPicture(rival, pane_.width, pane_.height),
                              StyleOf(kRivalPurple, 1.6, Stroke::kDotted)});
  }
  if (request.has_model) request.layers.push_back({request.camera, StyleOf(kCorrectedBlue, 1.3)});
  return request;
}

void App::MoveEye(const Eye& eye) {
  eye_ = eye;
  governor_.Moved(NowMs());
  needs_frame_ = true;
}

void App::Choose(int photograph, bool enter) {
  LetGo();
  photograph_ = photograph;
  session_.EndGesture();
  message_.clear();
  if (!enter) return;
  if (!inside_) eyes_before_.push_back(eye_);
  if (eyes_before_.size() > kMostEyesBefore) eyes_before_.erase(eyes_before_.begin());
  inside_ = true;
  cache_.Find(photograph);
  FitPhotograph();
}

void App::Leave() {
  if (const auto camera = PhotographCamera()) eye_ = EyeOf(*camera);
  inside_ = false;
  gesture_ = Gesture::kNone;
}

void App::FitPhotograph() {
  if (photograph_ < 0) return;
  const ImageSize& size = session_.photographs()[photograph_].size;
  if (size.width == 0) return;
  place_.scale = std::min(static_cast<double>(pane_.width) / size.width,
                          static_cast<double>(pane_.height) / size.height);
  place_.origin_px = {(pane_.width - place_.scale * size.width) / 2,
                      (pane_.height - place_.scale * size.height) / 2};
}

void App::ZoomPhotograph(const Eigen::Vector2d& about_px, double factor) {
  const Eigen::Vector2d about = place_.InPhotograph(about_px);
  place_.scale = std::clamp(place_.scale * factor, 0.02, 40.0);
  place_.origin_px = about_px - place_.scale * about;
}

void App::StepPhotograph(int by) {
  const int count = static_cast<int>(session_.photographs().size());
  if (count == 0) return;
  const int next = photograph_ < 0 ? 0 : (photograph_ + by + count) % count;
  Choose(next, inside_ || mode_ == WindowMode::kTag);
}

void App::NextWithoutTag() {
  const int count = static_cast<int>(session_.photographs().size());
  for (int i = 1; i <= count; ++i) {
    const int next = (photograph_ + i + count) % count;
    if (session_.work(next).tag || !session_.photographs()[next].fault.empty()) continue;
    mode_ = WindowMode::kTag;
    Choose(next, true);
    return;
  }
  message_ = "every photograph has a tag";
}

// What lies under the cursor; beside the model, as far away as its middle.
Eigen::Vector3d App::PointUnder(const Eigen::Vector2d& pane_px) const {
  const Camera camera = PaneCamera();
  if (const auto pick = PickFace(visibility_, camera, pane_px)) return pick->point_in_world;
  const Eigen::Vector3d middle = ComputeBounds(session_.model()).Center();
  const Eigen::Vector3d from = camera.PositionInWorld();
  const Eigen::Vector3d along = UnprojectToWorld(camera, pane_px);
  return from + along * std::max(1e-3, (middle - from).norm());
}

const std::vector<VisibleCorner>& App::Corners() {
  if (IsInside() && !PhotographCamera()) {
    corners_.clear();
    return corners_;
  }
  corners_ = FindVisibleCorners(session_.model(), visibility_, PaneCamera());
  return corners_;
}

}  // namespace groundglass
