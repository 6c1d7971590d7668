// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/view_io.h"

#include <imgui/backends/imgui_impl_sdl.h>
#include <imgui/imgui.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <utility>

namespace groundglass {
namespace {

std::vector<std::filesystem::path> ImageFilesOf(const Session& session) {
  std::vector<std::filesystem::path> files;
  for (const SessionPhotograph& photograph : session.photographs()) {
    files.push_back(photograph.image_file);
  }
  return files;
}

Uint32 WakeEvent() {
  static const Uint32 event = SDL_RegisterEvents(1);
  return event;
}

}  // namespace

App::App(const WindowOptions& options, Document document)
    : options_(options),
      document_(std::move(document)),
      session_(document_.opened.scene, document_.journal_file),
      masks_(session_, document_.opened.scene.folder),
      written_(FindWrittenCameras(session_, document_.opened.scene)),
      visibility_(document_.opened.textured.model),
      edges_(FindModelEdges(document_.opened.textured.model)),
      survey_(SurveyOf(document_.opened)),
      written_spread_(FindWrittenSpread(document_.opened.scene)),
      window_("groundglass", options.width_px, options.height_px),
      worker_(document_.opened.textured, [this] { WakeUp(); }),
      cache_(ImageFilesOf(session_), [this] { WakeUp(); }),
      maps_(document_.opened.is_output ? options.folder : std::filesystem::path(),
            document_.opened.textured,
            survey_,
            visibility_,
            [this] { WakeUp(); }),
      text_scale_(options.text_scale),
      new_text_scale_(options.text_scale) {
  const bool has_texture = !document_.opened.textured.pages.empty();
  draw_mode_ = has_texture ? DrawMode::kTextured : DrawMode::kShaded;
  StartFromTheRun(document_, session_);
  window_.SetTextScale(text_scale_);
  LayOut();
  eye_ = FirstEye(session_.model(), static_cast<double>(pane_.width) / pane_.height);
  FindLeftWork();
}

double App::NowMs() const {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
      .count();
}

void App::WakeUp() const {
  SDL_Event event = {};
  event.type = WakeEvent();
  SDL_PushEvent(&event);
}

void App::Run() {
  while (is_open_) {
    HandleEvents();
    Update();
    if (needs_frame_ || frames_to_draw_ > 0) DrawFrame();
    FinishFrame();
    longest_turn_ms_ = std::max(longest_turn_ms_, NowMs() - turn_began_ms_);
  }
}

void App::HandleEvents() {
  const bool is_restless = frames_to_draw_ > 0 || needs_frame_ || governor_.IsMoving(NowMs()) ||
                           is_playing_ || wants_fence_;
  SDL_Event event;
  const bool has_event = SDL_WaitEventTimeout(&event, is_restless ? 4 : 250) != 0;
  turn_began_ms_ = NowMs();
  if (!has_event) return;
  do {
    needs_frame_ = true;
    frames_to_draw_ = std::max(frames_to_draw_, 2);
    if (event.type == WakeEvent()) continue;
    if (!options_.test_log.empty()) {
      answers_.Asked(NowMs() - static_cast<double>(SDL_GetTicks() - event.common.timestamp));
    }
    HandleEvent(event);
  } while (SDL_PollEvent(&event));
}

void App::HandleEvent(const SDL_Event& event) {
  ImGui_ImplSDL2_ProcessEvent(&event);
  switch (event.type) {
    case SDL_QUIT:
      Quit();
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      HandleKey(event.key);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      HandleMouseButton(event.button);
      break;
    case SDL_MOUSEMOTION:
      HandleMouseMotion(event.motion);
      break;
    case SDL_MOUSEWHEEL:
      HandleWheel(event.wheel);
      break;
    default:
      break;
  }
}

void App::LayOut() {
  const int width = window_.width_px();
  const int height = window_.height_px();
  const auto scaled = [&](double px) { return static_cast<int>(px * text_scale_); };
  const bool fits = has_panels_ && width >= scaled(700);
  const int top = scaled(32);
  const int bottom = scaled(30);
  const int left = fits ? scaled(230) : 0;
  const int right = fits ? scaled(310) : 0;
  pane_ = {left, top, std::max(64, width - left - right), std::max(64, height - top - bottom)};
  const int plan_height = std::min(left, (height - top - bottom) / 2);
  plan_ = {0, height - bottom - plan_height, left, plan_height};
}

void App::Update() {
  const double now = NowMs();
  if (new_text_scale_ != text_scale_) {
    text_scale_ = new_text_scale_;
    window_.SetTextScale(text_scale_);
  }
  const Pane before = pane_;
  LayOut();
  if (IsInside() && (before.width != pane_.width || before.height != pane_.height)) {
    FitPhotograph();
  }
  FlyByKeys(now);
  FollowFlight();
  TakeAlignment();
  TakeFlood();
  UpdateMap();
  cache_.LetThumbnailsWait(governor_.IsMoving(now));
  for (auto& [photograph, thumbnail] : cache_.TakeThumbnails()) {
    thumbnails_[photograph] = window_.MakeTexture(thumbnail);
    needs_frame_ = true;
  }
  if (auto drawn = worker_.Take()) {
    last_picture_ms_ = drawn->took_ms;
    ++num_pictures_;
    governor_.Drew(drawn->quality, drawn->took_ms);
    picture_ = window_.MakeTexture(drawn->width_px, drawn->height_px, drawn->bgra);
    picture_size_ = {0, 0, drawn->width_px, drawn->height_px};
    answers_.Drawn();
    needs_frame_ = true;
  }
  if (const std::string fault = worker_.Fault(); !fault.empty()) message_ = fault;
  PictureRequest request = MakeRequest();
  const bool is_same = posted_ && IsSamePicture(*posted_, request);
  if (is_same) {
    answers_.NothingToDraw();
  } else if (!worker_.IsBusy()) {
    posted_ = request;
    worker_.Post(std::move(request));
    answers_.Posted();
  }
}

void App::DrawFrame() {
  const double start = NowMs();
  needs_frame_ = false;
  if (frames_to_draw_ > 0) --frames_to_draw_;
  window_.BeginFrame();
  if (picture_) {
    const SDL_Rect to = {pane_.x, pane_.y, pane_.width, pane_.height};
    SDL_RenderCopy(window_.renderer(), picture_.get(), nullptr, &to);
  }
  DrawOverlayLines();
  DrawPanels();
  window_.EndFrame();
  last_frame_ms_ = NowMs() - start;
  answers_.Shown(NowMs());
  ++num_frames_;
}

bool App::HasJobs() const {
  // A map that is made is not yet one that is shown.
  const bool is_map_due =
      map_ != LookMap::kNone && map_ != LookMap::kTiles1988 && shown_map_ == nullptr;
  return worker_.IsBusy() || is_map_due || is_playing_ || alignment_.IsRunning() ||
         flood_.IsRunning() || governor_.IsMoving(NowMs()) || (IsInside() && cache_.IsBusy());
}

void App::FinishFrame() {
  if (wants_screenshot_) {
    wants_screenshot_ = false;
    std::filesystem::path file;
    for (int i = 1; file.empty() || std::filesystem::exists(file); ++i) {
      file = "groundglass_" + std::to_string(i) + ".png";
    }
    try {
      window_.WriteScreenshot(file);
      message_ = "written: " + file.string();
    } catch (const Error& error) {
      message_ = error.what();
    }
    needs_frame_ = true;
  }
  const bool is_settled = !needs_frame_ && frames_to_draw_ == 0 && !HasJobs() && posted_ &&
                          IsSamePicture(*posted_, MakeRequest());
  if (wants_fence_ && is_settled) {
    wants_fence_ = false;
    WriteFence();
  }
}

// What a test may want to know.
std::string App::DescribeState() {
  const PlanFrame plan = MakePlanFrame();
  nlohmann::ordered_json json = {
      {"fence", num_fences_},
      {"mode", WindowModeName(mode_)},
      {"inside", inside_},
      {"message", message_},
      {"pane", {pane_.x, pane_.y, pane_.width, pane_.height}},
      {"plan", {plan.middle.x(), plan.middle.y(), plan.px_per_unit}},
      {"plan_middle", {plan.screen_middle.x(), plan.screen_middle.y()}},
      {"now_ms", NowMs()},
      {"frames", num_frames_},
      {"pictures", num_pictures_},
      {"frame_ms", last_frame_ms_},
      {"picture_ms", last_picture_ms_},
      {"answers_ms", answers_.Take()},
      {"longest_turn_ms", std::exchange(longest_turn_ms_, 0)},
      {"thumbnails", thumbnails_.size()},
      {"left_work", offers_left_work_},
      {"gesture", static_cast<int>(gesture_)},
      {"armed", armed_point_.value_or(-1)},
      {"covered", IsCovered()},
      {"keyframes", keyframes_ ? keyframes_->cameras().size() : 0},
      {"map", shown_map_ ? shown_map_->legend.title : ""},
      {"places", places_.size()},
      {"eye",
       {eye_.position_in_world.x(), eye_.position_in_world.y(), eye_.position_in_world.z()}}};
  if (photograph_ < 0) return json.dump();
  const PhotographWork& work = session_.work(photograph_);
  json["photograph"] = session_.photographs()[photograph_].name;
  json["unsaved"] = session_.IsUnsaved(photograph_);
  json["undo_depth"] = session_.UndoDepth(photograph_);
  json["pins"] = work.pins.points.size();
  json["lines"] = work.pins.lines.size();
  if (CanMask()) {
    const auto& values = masks_.Paint(photograph_).ignore().values;
    json["masked"] = std::count(values.begin(), values.end(), 255);
    json["brush_px"] = brush_px_;
    json["mask_unsaved"] = masks_.IsUnsaved(photograph_);
  }
  json["verdict"] = work.alignment ? VerdictName(work.alignment->verdict) : "";
  if (work.tag) json["found"] = FormatView(*session_.TagOf(photograph_));
  json["place"] = {place_.scale, place_.origin_px.x(), place_.origin_px.y()};
  json["corners"] = nlohmann::ordered_json::array();
  for (const VisibleCorner& corner : Corners()) {
    json["corners"].push_back({corner.point, corner.image_px.x(), corner.image_px.y()});
  }
  return json.dump();
}

void App::WriteFence() {
  ++num_fences_;
  if (options_.test_log.empty()) return;
  std::ofstream(options_.test_log, std::ios::app) << DescribeState() << std::endl;
}

void App::Quit() {
  FinishFlood();
  if (session_.HasUnsaved() || masks_.HasUnsaved()) {
    asks_to_quit_ = true;
  } else {
    is_open_ = false;
  }
}

void WindowOptions::Check() const {
  CheckFromTo(width_px, 320, 16384, "window options: width_px");
  CheckFromTo(height_px, 240, 16384, "window options: height_px");
  CheckFromTo(text_scale, 0.5, 3, "window options: text_scale");
}

void RunWindow(const WindowOptions& options) {
  options.Check();
  App(options, OpenDocument(options)).Run();
}

}  // namespace groundglass
