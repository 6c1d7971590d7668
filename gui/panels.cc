// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace groundglass {
namespace {

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void BeginPanel(const char* name, int x, int y, int width, int height, int flags = 0) {
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(x), static_cast<float>(y)));
  ImGui::SetNextWindowSize(ImVec2(static_cast<float>(width), static_cast<float>(height)));
  ImGui::Begin(name, nullptr, kPanel | flags);
}

std::string SignOf(Verdict verdict) {
  return verdict == Verdict::kAccepted ? "\u2713 "
         : verdict == Verdict::kReview ? "\u25B2 "
                                       : "\u2717 ";
}

std::string LowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

void App::DrawPanels() {
  // Before the others, since of panels the first lies on top: its lines may reach over them.
  DrawStatus();
  DrawTopBar();
  if (pane_.x > 0) {
    BeginPanel("photographs", 0, pane_.y, pane_.x, plan_.y - pane_.y);
    DrawPhotographs();
    ImGui::End();
    BeginPanel("plan", 0, plan_.y, plan_.width, plan_.height, ImGuiWindowFlags_NoScrollbar);
    DrawPlan();
    ImGui::End();
    const int right = pane_.x + pane_.width;
    BeginPanel("context", right, pane_.y, window_.width_px() - right, pane_.height);
    DrawContext();
    ImGui::End();
  }
  DrawHelp();
  DrawQuestions();
}

void App::DrawTopBar() {
  BeginPanel("top", 0, 0, window_.width_px(), pane_.y, ImGuiWindowFlags_NoScrollbar);
  ImGui::SetCursorPosY(5);
  constexpr std::array<WindowMode, 4> kModes = {
      WindowMode::kLook, WindowMode::kTag, WindowMode::kAsk, WindowMode::kMask};
  constexpr std::array<Action, 4> kActions = {
      Action::kLookMode, Action::kTagMode, Action::kAskMode, Action::kMaskMode};
  for (size_t i = 0; i < kModes.size(); ++i) {
    const std::string label =
        "F" + std::to_string(i + 2) + " " + std::string(WindowModeName(kModes[i]));
    const bool is_chosen = mode_ == kModes[i];
    if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.16f, 0.42f, 0.62f, 1));
    if (ImGui::Button(label.c_str())) DoEverywhere(kActions[i]);
    if (is_chosen) ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  std::string title = document_.title;
  if (photograph_ >= 0) {
    title += ": " + session_.photographs()[photograph_].name;
    if (session_.IsUnsaved(photograph_) || masks_.IsUnsaved(photograph_))
      title += "  \u25CF unsaved";
  }
  ImGui::Text("   %s", title.c_str());
  window_.SetTitle(title + " - groundglass");
  ImGui::End();
}

void App::DrawPhotographs() {
  if (session_.photographs().empty()) {
    ImGui::TextWrapped(
        "No photographs. They belong into images/ of a scene's folder, beside its model.");
    return;
  }
  for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
    const SessionPhotograph& photograph = session_.photographs()[i];
    const auto registration = document_.registrations.find(photograph.name);
    const PhotographWork& work = session_.work(i);
    // Placed by hand and not yet aligned: no tag that is taken.
    const bool is_rough = work.tag && !work.alignment && session_.IsUnsaved(i);
    std::string line = work.tag && !is_rough ? "\u2713 " : "\u25CB ";
    std::string state = !work.tag ? "no tag" : is_rough ? "placed" : "";
    if (registration != document_.registrations.end()) {
      const Verdict verdict = registration->second.verdict;
      line = SignOf(verdict);
      state = VerdictName(verdict);
      const bool is_other_tag =
          HasCorrection(verdict) && session_.UndoDepth(i) == 0 && !session_.HasFound(i);
      if (is_other_tag) state += ", tag changed since";
    }
    if (work.alignment) {
      line = SignOf(work.alignment->verdict);
      state = VerdictName(work.alignment->verdict);
    }
    if (session_.IsAsFound(i)) state += " (run)";
    const std::string fault = !photograph.fault.empty() ? photograph.fault : cache_.FaultOf(i);
    if (!fault.empty()) {
      line = "\u2717 ";
      state = "cannot be read";
    }
    line += photograph.name + "  " + state +
            (session_.IsUnsaved(i) || masks_.IsUnsaved(i) ? " \u25CF" : "");
    const float shown = ImGui::GetTextLineHeightWithSpacing() * 1.6f;
    if (const auto thumbnail = thumbnails_.find(i); thumbnail != thumbnails_.end()) {
      int width = 0;
      int height = 0;
      SDL_QueryTexture(thumbnail->second.get(), nullptr, nullptr, &width, &height);
      ImGui::Image(thumbnail->second.get(), ImVec2(shown * width / height, shown));
    } else {
      // Its place, so that nothing jumps when it comes.
      ImGui::Dummy(ImVec2(1.5f * shown, shown));
    }
    ImGui::SameLine();
    if (ImGui::Selectable(line.c_str(), i == photograph_, ImGuiSelectableFlags_AllowDoubleClick)) {
      Choose(i, IsInside() || mode_ == WindowMode::kTag || ImGui::IsMouseDoubleClicked(0));
    }
    if (ImGui::IsItemHovered() && !fault.empty()) ImGui::SetTooltip("%s", fault.c_str());
  }
}

void App::DrawContext() {
  switch (mode_) {
    case WindowMode::kLook:
      DrawLookPanel();
      break;
    case WindowMode::kTag:
      DrawTagPanel();
      break;
    case WindowMode::kAsk:
      DrawAskPanel();
      break;
    case WindowMode::kMask:
      DrawMaskPanel();
      break;
  }
}

void App::DrawLookPanel() {
  const auto faces = [&](const char* label, DrawMode mode) {
    const bool is_chosen = map_ == LookMap::kNone && draw_mode_ == mode;
    if (ImGui::RadioButton(label, is_chosen)) ShowFaces(mode);
  };
  const auto map = [&](const char* label, LookMap which) {
    if (ImGui::RadioButton(label, map_ == which)) ShowMap(which);
  };
  faces("1 wire", DrawMode::kWireframe);
  faces("2 shaded", DrawMode::kShaded);
  faces("3 textured", DrawMode::kTextured);
  faces("4 face numbers", DrawMode::kLabels);
  map("5 coverage", LookMap::kCoverage);
  map("6 provenance", LookMap::kProvenance);
  map(document_.opened.textured.pages.empty() ? "7 pixel size" : "7 texel size",
      LookMap::kTexelSize);
  map("8 uncertainty", LookMap::kUncertainty);
  map("9 tiles of 1988", LookMap::kTiles1988);
  ImGui::Checkbox("O edges", &shows_edges_);
  ImGui::Checkbox("P photographs at their stations", &shows_stations_);
  ImGui::Checkbox("E 95 % ellipsoids of stations", &shows_ellipsoids_);
  if (ImGui::Checkbox("G walk", &is_walking_) && is_walking_) {
    MoveEye(Walk(eye_, session_.model(), visibility_, 0, 0));
  }
  if (IsInside()) {
    float share = static_cast<float>(model_share_);
    if (ImGui::SliderFloat("model", &share, 0, 1, "%.2f")) model_share_ = share;
    ImGui::Checkbox("V wipe", &wipes_);
    ImGui::Checkbox("C as written too (grey)", &shows_written_);
  }
  ImGui::Separator();
  if (picked_) {
    const int face = picked_->face;
    const PolygonModel& model = session_.model();
    ImGui::TextWrapped("%s", DescribeFace(model, face).c_str());
    ImGui::TextWrapped(
        "%.2f square %s", ComputeFaceArea(model, face), UnitName(model.unit).c_str());
    if (const auto texel = TexelSize(survey_, face)) {
      ImGui::TextWrapped(
          "texels of %.4f x %.4f %s", (*texel)[0], (*texel)[1], UnitName(model.unit).c_str());
    }
    if (const std::string here = DescribeMapAt(*picked_); !here.empty()) {
      ImGui::TextWrapped("%s", here.c_str());
    }
  } else {
    ImGui::TextWrapped("%s",
                       IsInside() ? "Esc leaves the photograph; then a click on a face tells its "
                                    "name and area. F4 asks here."
                                  : "Click a face for its name and area.");
  }
}

void App::DrawStatus() {
  constexpr int kMarginPx = 8;
  const float width = static_cast<float>(window_.width_px() - 2 * kMarginPx);
  const std::string line =
      message_.empty() ? StatusLine() : message_ + "   \u00B7   " + StatusLine();
  // What is too long for one line takes more of them, over the picture.
  const float text_height = ImGui::CalcTextSize(line.c_str(), nullptr, false, width).y;
  const int height =
      std::max(window_.height_px() - pane_.y - pane_.height, static_cast<int>(text_height) + 12);
  BeginPanel("status",
             0,
             window_.height_px() - height,
             window_.width_px(),
             height,
             ImGuiWindowFlags_NoScrollbar);
  ImGui::SetCursorPosY(5);
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(line.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

std::string App::StatusLine() const {
  if (shows_help_) return "type to search \u00B7 Esc closes";
  if (mode_ == WindowMode::kAsk) {
    return "click: what is there \u00B7 Shift+click: a distance, an area \u00B7 Esc forgets \u00B7 "
           "F1 keys";
  }
  if (CanTag()) return TagStatusLine();
  if (CanMask()) {
    return "drag paints, right drag erases \u00B7 Shift+drag: lasso \u00B7 double click: up to "
           "edges "
           "\u00B7 [ ] size \u00B7 Ctrl+Z \u00B7 Ctrl+S save \u00B7 Esc back";
  }
  if (IsInside()) {
    return "wheel zooms, drag moves the photograph \u00B7 , . fade \u00B7 B photograph alone "
           "\u00B7 V wipe \u00B7 F3 tag \u00B7 Esc back \u00B7 F1 keys";
  }
  if (is_walking_)
    return "drag looks around \u00B7 W A S D or arrows walk \u00B7 G ends \u00B7 F1 keys";
  return "drag turns, middle drag moves, wheel nears, right drag with WASD flies \u00B7 Enter: "
         "into the photograph \u00B7 F1 keys";
}

void App::DrawHelp() {
  if (!shows_help_) return;
  const float width = static_cast<float>(window_.width_px());
  const float height = static_cast<float>(window_.height_px());
  ImGui::SetNextWindowPos(ImVec2(0.15f * width, 0.08f * height));
  ImGui::SetNextWindowSize(ImVec2(0.7f * width, 0.84f * height));
  ImGui::SetNextWindowFocus();
  ImGui::Begin(
      "Keys", &shows_help_, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
  static std::array<char, 64> filter = {};
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputText("search", filter.data(), filter.size());
  const std::string sought = LowerCase(filter.data());
  if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) {
    ImGui::TableSetupColumn("where", ImGuiTableColumnFlags_WidthStretch, 0.2f);
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 0.3f);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.5f);
    for (const Binding& binding : Bindings()) {
      const std::string keys(binding.keys);
      const std::string does(binding.does);
      if (LowerCase(does + " " + keys).find(sought) == std::string::npos) continue;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(std::string(BindingPlaceName(binding.place)).c_str());
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", keys.c_str());
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", does.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace groundglass
