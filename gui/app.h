// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "ask/answer.h"
#include "gui/answer_clock.h"
#include "gui/background.h"
#include "gui/document.h"
#include "gui/look_maps.h"
#include "gui/sdl_window.h"
#include "session/alignment.h"
#include "session/bindings.h"
#include "session/job.h"
#include "session/keyframes.h"
#include "session/mask_desk.h"
#include "session/navigator.h"
#include "session/picking.h"
#include "session/session.h"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// A part of the window, px.
struct Pane {
  int x = 0;
  int y = 0;
  int width = 1;
  int height = 1;

  bool Holds(int at_x, int at_y) const {
    return at_x >= x && at_y >= y && at_x < x + width && at_y < y + height;
  }
  Eigen::Vector2d Inside(int at_x, int at_y) const { return {at_x - x + 0.5, at_y - y + 0.5}; }
};

// From `world`, seen from above with north up, to the window.
struct PlanFrame {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // in world
  double px_per_unit = 1;
  Eigen::Vector2d screen_middle = Eigen::Vector2d::Zero();

  Eigen::Vector2d OnScreen(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector2d by = (point_in_world.head<2>() - middle) * px_per_unit;
    return {screen_middle.x() + by.x(), screen_middle.y() - by.y()};
  }
  Eigen::Vector3d InWorld(const Eigen::Vector2d& at, double height) const {
    return {middle.x() + (at.x() - screen_middle.x()) / px_per_unit,
            middle.y() - (at.y() - screen_middle.y()) / px_per_unit,
            height};
  }
};

// What the mouse is doing in the picture.
enum class Gesture {
  kNone,
  kOrbit,
  kPan,
  kLook,
  kMovePhotograph,
  kPin,
  kNewPin,
  kLine,
  kRough,
  kPaint,
  kLasso
};

// The cameras of the scene's tags, for each of the session's photographs.
std::vector<std::optional<Camera>> FindWrittenCameras(const Session& session, const Scene& scene);
// Covariances of where cameras stood, given what their tags say, by photograph.
std::map<std::string, Eigen::Matrix3d> FindWrittenSpread(const Scene& scene);
// Where the keyframes of what is shown are.
std::filesystem::path FlightFolder(const WindowOptions& options, const Scene& scene);

// Everything that the window shows and does. Input becomes actions (bindings.h) and gestures; these
// change the session, the eye or what is shown; every frame is drawn from that state alone.
class App {
 public:
  App(const WindowOptions& options, Document document);
  void Run();

 private:
  // app.cc: the loop.
  double NowMs() const;
  void WakeUp() const;
  void HandleEvents();
  void HandleEvent(const SDL_Event& event);
  void Update();
  void DrawFrame();
  void FinishFrame();
  std::string DescribeState();
  void WriteFence();
  bool HasJobs() const;
  void LayOut();
  void Quit();
  // questions.cc
  void FindLeftWork();

  // app_input.cc: keys and the mouse.
  void HandleKey(const SDL_KeyboardEvent& key);
  // app_mouse.cc
  bool IsCovered() const;
  void HandleMouseButton(const SDL_MouseButtonEvent& button);
  void HandleMouseMotion(const SDL_MouseMotionEvent& motion);
  void HandleWheel(const SDL_MouseWheelEvent& wheel);
  std::vector<BindingPlace> Places() const;
  void Do(Action action, const KeyPress& press);
  bool DoEverywhere(Action action);
  bool DoInLook(Action action, const KeyPress& press);
  bool DoInPhotograph(Action action);
  bool DoInTag(Action action, const KeyPress& press);
  void Cancel();
  void FramePickedFace();
  void TurnByArrow(const std::string& key);
  // Where keys lead that are held at these places; nowhere unless they fly or walk now.
  FlyWay FlyWayByKeys(std::string_view places_held) const;
  void FlyByKeys(double now_ms);

  // app_view.cc: what is looked at, and how.
  bool IsInside() const { return inside_; }
  Camera PaneCamera() const;                       // of the pane's size, for the model
  std::optional<Camera> PhotographCamera() const;  // of the photograph's size
  // As the notebook has it; nothing without a tag.
  const std::optional<Camera>& WrittenCamera(int photograph) const;
  // As it is believed to be now.
  std::optional<Camera> BelievedCamera(int photograph) const;
  // How sure one is of where it stood as it is believed to be now; nothing where no more is known
  // than what was written.
  std::optional<Eigen::Matrix3d> FoundSpread(int photograph) const;
  // app_maps.cc: what faces are coloured by.
  void ShowFaces(DrawMode mode);
  void ShowMap(LookMap map);
  bool ColourFaces(Action action);
  void DoBehindPhotograph(const KeyPress& press);
  void UpdateMap();
  void OpenTiles();
  std::string DescribeMapAt(const FacePick& pick) const;
  PictureRequest MakeRequest();
  void MoveEye(const Eye& eye);
  void Choose(int photograph, bool enter);
  void Leave();
  void FitPhotograph();
  void ZoomPhotograph(const Eigen::Vector2d& about_px, double factor);
  void StepPhotograph(int by);
  void NextWithoutTag();
  Eigen::Vector3d PointUnder(const Eigen::Vector2d& pane_px) const;
  const std::vector<VisibleCorner>& Corners();

  // app_tag.cc: pins, alignment, saving.
  bool CanTag() const { return photograph_ >= 0 && mode_ == WindowMode::kTag && IsInside(); }
  std::vector<VisibleCorner> UnpinnedCorners();
  void PressInTag(const Eigen::Vector2d& pane_px);
  void DragInTag(const Eigen::Vector2d& pane_px, const Eigen::Vector2d& by_px, bool is_slow);
  void ReleaseInTag(const Eigen::Vector2d& pane_px);
  void LetGo();
  bool HasPin(const Pins& pins) const;  // whether pin_ is one of them
  void PlacePin(const Eigen::Vector3d& point_in_world, const Eigen::Vector2d& image_px);
  void ChangePins(const Pins& pins, const std::string& gesture = "");
  void StandThere(const Eigen::Vector3d& stood_in_world, const Eigen::Vector3d& looked_in_world);
  void StandAsLooking();
  void NudgePin(const KeyPress& press);
  void SnapPin();
  void ShowRival();
  void StepCorner(int by);
  void TakeCorner();
  void CycleUse();
  void RemovePin();
  void ToggleCropped();
  void Align();
  void StopAlignment();
  void TakeAlignment();
  void Accept(bool against_verdict);
  void BackToNotebook();
  void Save();
  bool IsCropped() const;

  // app_flight.cc
  Keyframes* Flight();
  void FindFlight();
  std::filesystem::path FilmedFile() const;
  void AddKeyframe();
  void RemoveKeyframe();
  void PlayFlight();
  void FollowFlight();
  void DrawFlight();

  // app_mask.cc
  bool CanMask() const { return photograph_ >= 0 && mode_ == WindowMode::kMask && IsInside(); }
  MaskPaint* Mask();
  std::shared_ptr<const Image8> ShownMask();
  void PressInMask(const Eigen::Vector2d& pane_px, int button, bool is_double, bool shift);
  void DragInMask(const Eigen::Vector2d& pane_px);
  void ReleaseInMask();
  void LetGoOfMask();
  void ResizeBrush(double factor, bool is_eraser);
  bool DoInMask(Action action);
  void SaveMask(bool over_others);
  void StartFlood(const std::shared_ptr<const Image8>& picture, const Eigen::Vector2d& from_px);
  void TakeFlood();
  void FinishFlood();
  void ShowFlood(const Image8& flood);
  void DrawMaskTools();
  void DrawMaskPanel();

  // app_ask.cc
  void AskAt(const Eigen::Vector2d& pane_px, bool adds);
  void AskAgain();

  // panels*.cc, plan.cc: drawn with ImGui.
  void DrawPanels();
  void DrawTopBar();
  void DrawPhotographs();
  void DrawPlan();
  PlanFrame MakePlanFrame() const;
  Eigen::Vector3d OnPlan(int x, int y) const;
  void PressOnPlan(int x, int y);
  void ReleaseOnPlan();
  void DrawContext();
  void DrawLookPanel();
  void DrawTagPanel();
  void DrawAskPanel();
  void DrawStatus();
  void DrawHelp();
  void DrawQuestions();
  std::string StatusLine() const;
  std::string TagStatusLine() const;
  // overlay.cc: over the picture.
  void DrawOverlayLines();
  void DrawStations();
  // look_overlay.cc
  void DrawEllipsoid(const Eigen::Vector3d& middle_in_world,
                     const Eigen::Matrix3d& covariance,
                     unsigned colour,
                     bool is_dashed);
  void DrawEllipsoids();
  void DrawLegend();
  void DrawPins();
  void DrawPlaces();
  void DrawLoupe();

  WindowOptions options_;
  Document document_;
  Session session_;
  MaskDesk masks_;
  std::vector<std::optional<Camera>> written_;
  Visibility visibility_;
  std::vector<ModelEdge> edges_;
  Survey survey_;
  // Covariances of where the cameras stood, as written, by photograph.
  std::map<std::string, Eigen::Matrix3d> written_spread_;
  SdlWindow window_;
  PictureWorker worker_;
  PhotographCache cache_;
  LookMaps maps_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  // The window.
  bool is_open_ = true;
  bool needs_frame_ = true;
  bool has_panels_ = true;
  bool shows_help_ = false;
  bool asks_to_quit_ = false;
  bool asks_to_overwrite_ = false;
  bool asks_to_overwrite_mask_ = false;
  bool asks_reason_ = false;
  bool offers_left_work_ = false;
  std::string left_work_of_;  // whose it is: tags and pins, masks, what is left out
  LeftMasks left_masks_;
  bool says_yes_ = false;  // to the question that is asked, by key
  bool says_no_ = false;
  bool says_drop_ = false;
  int frames_to_draw_ = 3;  // ImGui needs some after a change
  double text_scale_ = 1;
  double new_text_scale_ = 1;
  bool wants_screenshot_ = false;
  bool wants_fence_ = false;
  int num_fences_ = 0;
  std::string message_;
  std::string reason_;
  Pane pane_;
  Pane plan_;
  FrameGovernor governor_;
  TexturePtr picture_;
  Pane picture_size_;
  int num_frames_ = 0;
  int num_pictures_ = 0;
  double last_frame_ms_ = 0;
  double last_picture_ms_ = 0;
  // For tests and measurements alone: how long the window took, since it last said so.
  AnswerClock answers_;
  double turn_began_ms_ = 0;
  double longest_turn_ms_ = 0;  // of the loop: input, changes and frame, without waiting
  std::map<int, TexturePtr> thumbnails_;
  std::optional<PictureRequest> posted_;

  // What is shown.
  WindowMode mode_ = WindowMode::kLook;
  DrawMode draw_mode_ = DrawMode::kTextured;
  LookMap map_ = LookMap::kNone;
  std::shared_ptr<const ColouredModel> shown_map_;  // map_, once it is made
  std::shared_ptr<const std::vector<MappedTiles>> tiles_;
  bool shows_edges_ = true;
  bool shows_ellipsoids_ = false;
  bool shows_stations_ = true;
  bool shows_written_ = true;
  bool shows_rival_ = false;
  bool is_walking_ = false;
  Eye eye_;
  std::vector<Eye> eyes_before_;
  std::optional<FacePick> picked_;
  int photograph_ = -1;  // chosen; -1: none
  bool inside_ = false;
  PhotographPlace place_;
  double model_share_ = 0;
  bool photograph_alone_ = false;
  bool wipes_ = false;

  // Gestures.
  Gesture gesture_ = Gesture::kNone;
  Eigen::Vector2d mouse_px_ = Eigen::Vector2d::Zero();  // in the pane
  int mouse_x_ = 0;
  int mouse_y_ = 0;
  Eigen::Vector2d pressed_px_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d about_in_world_ = Eigen::Vector3d::Zero();
  double depth_ = 1;
  bool has_moved_ = false;
  int gesture_number_ = 0;
  double fly_speed_ = 1;
  double last_fly_ms_ = 0;

  // Tag.
  std::optional<int> armed_point_;   // of the model: the next click says where it is seen
  std::optional<int> pin_;           // selected: among points, or behind them among lines
  bool pin_is_due_ = false;          // the corner was taken by a click of its own
  std::optional<LinePin> new_line_;  // an edge that was pressed and not yet dragged
  int line_end_ = -1;                // of the selected line: 0, 1; -1: the whole line
  Eigen::Vector3d rough_start_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rough_end_ = Eigen::Vector3d::Zero();
  bool shows_loupe_ = false;  // always; else while a pin is moved
  TexturePtr loupe_;
  std::vector<VisibleCorner> corners_;
  AlignmentJob alignment_;
  int aligned_photograph_ = -1;
  PhotographWork aligned_work_;  // as it was when alignment began

  // Flight.
  std::optional<Keyframes> keyframes_;  // read when they are first asked for
  std::vector<Camera> flight_;          // a frame each
  bool shows_flight_ = false;
  bool is_playing_ = false;
  double playing_since_ms_ = 0;

  // Mask.
  double brush_px_ = 16;  // radius, of the window
  double eraser_px_ = 16;
  bool is_erasing_ = false;
  double mask_share_ = 0;  // of the photograph, as it is shown
  // Of the mask's undo, before the last press in it; nothing if that was elsewhere.
  std::optional<int> depth_before_press_;
  Eigen::Vector2d painted_px_ = Eigen::Vector2d::Zero();  // of the photograph: where the brush was
  std::vector<Eigen::Vector2d> lasso_px_;
  Job<Image8> flood_;
  int flooded_photograph_ = -1;
  bool flood_erases_ = false;
  std::shared_ptr<const Image8> mask_shown_;
  int mask_of_ = -1;
  int mask_version_ = 0;

  // Ask.
  std::vector<Place> places_;
  std::optional<Answer> answer_;
  std::map<int, TexturePtr> crops_;
};

}  // namespace groundglass
