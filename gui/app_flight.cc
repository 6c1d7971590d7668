// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "gui/overlay_shapes.h"
#include "scene/shell_word.h"
#include "viewer/camera_path.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr int kFramesASecond = 25;
constexpr int kSecondsAKeyframe = 2;

}  // namespace

// Beside the scene's files, else in the output folder, which leaves other files alone.
std::filesystem::path FlightFolder(const WindowOptions& options, const Scene& scene) {
  if (!scene.folder.empty()) return scene.folder / "flight";
  const bool is_file = std::filesystem::is_regular_file(options.folder);
  return (is_file ? options.folder.parent_path() : options.folder) / "flight";
}

Keyframes* App::Flight() {
  if (!keyframes_) {
    try {
      keyframes_.emplace(FlightFolder(options_, document_.opened.scene));
    } catch (const std::exception& error) {
      message_ = error.what();
      return nullptr;
    }
  }
  return &*keyframes_;
}

// The way that a film takes, a frame each.
void App::FindFlight() {
  flight_.clear();
  const Keyframes* keyframes = Flight();
  if (keyframes == nullptr || keyframes->cameras().size() < 2) {
    is_playing_ = false;
    return;
  }
  const int num_frames =
      kFramesASecond * kSecondsAKeyframe * static_cast<int>(keyframes->cameras().size() - 1);
  flight_ = MakeFlight(session_.model(), keyframes->cameras(), num_frames);
}

// What `render` draws: it takes a scene's model, not its folder.
std::filesystem::path App::FilmedFile() const {
  const Scene& scene = document_.opened.scene;
  return document_.opened.is_output || scene.model_file.empty() ? options_.folder
                                                                : scene.model_file;
}

void App::AddKeyframe() {
  Keyframes* keyframes = Flight();
  if (keyframes == nullptr) return;
  try {
    const double distance =
        (ComputeBounds(session_.model()).Center() - eye_.position_in_world).norm();
    keyframes->Add(eye_.InFrame(1280, 720), std::max(distance, 1e-3));
    shows_flight_ = true;
    FindFlight();
    const size_t count = keyframes->cameras().size();
    message_ = "keyframe " + std::to_string(count) +
               (count < 2 ? ": a second one makes a flight" : ": Shift+K flies") +
               "; a film of them: groundglass render " + ShellWord(FilmedFile()) + " --path " +
               ShellWord(keyframes->folder()) + " -o flight.mp4";
  } catch (const std::exception& error) {
    message_ = std::string("no keyframe: ") + error.what();
  }
}

void App::RemoveKeyframe() {
  Keyframes* keyframes = Flight();
  if (keyframes == nullptr) return;
  try {
    message_ = keyframes->RemoveLast() ? "the last keyframe is taken back"
                                       : "no keyframe was added since the window opened";
  } catch (const std::exception& error) {
    message_ = error.what();
  }
  FindFlight();
}

void App::PlayFlight() {
  if (is_playing_) {
    is_playing_ = false;
    return;
  }
  if (flight_.empty()) FindFlight();
  shows_flight_ = true;
  if (flight_.empty()) {
    message_ = "K adds keyframes; two at least make a flight";
    return;
  }
  eyes_before_.push_back(eye_);
  is_playing_ = true;
  playing_since_ms_ = NowMs();
}

// At the pace of the film, however many frames are drawn on the way.
void App::FollowFlight() {
  if (!is_playing_) return;
  const auto frame = static_cast<size_t>((NowMs() - playing_since_ms_) / 1000 * kFramesASecond);
  is_playing_ = frame + 1 < flight_.size();
  MoveEye(EyeOf(flight_[std::min(frame, flight_.size() - 1)]));
}

// The way and its keyframes, unless one is on it.
void App::DrawFlight() {
  if (!shows_flight_ || is_playing_ || IsInside() || !keyframes_) return;
  const Camera camera = PaneCamera();
  const auto on_screen = [&](const Camera& at) -> std::optional<ImVec2> {
    const auto seen = Project(camera, at.PositionInWorld());
    if (!seen) return std::nullopt;
    return ImVec2(static_cast<float>(pane_.x + seen->x()), static_cast<float>(pane_.y + seen->y()));
  };
  constexpr size_t kEvery = 5;  // frames
  for (size_t i = 0; i + kEvery < flight_.size(); i += kEvery) {
    const auto from = on_screen(flight_[i]);
    const auto to = on_screen(flight_[i + kEvery]);
    if (from && to) OverlayLine(*from, *to, kOverlayGreen, 1.5f);
  }
  for (size_t i = 0; i < keyframes_->cameras().size(); ++i) {
    const auto at = on_screen(keyframes_->cameras()[i]);
    if (!at) continue;
    OverlayRing(*at, 5, kOverlayGreen);
    OverlayText(ImVec2(at->x + 9, at->y - 8), kOverlayGreen, std::to_string(i + 1));
  }
}

}  // namespace groundglass
