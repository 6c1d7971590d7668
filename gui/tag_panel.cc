// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>

namespace groundglass {
namespace {

// The pins, worst first, as places among points and behind them lines.
std::vector<int> WorstFirst(const PinSolution& solution) {
  std::vector<int> order(solution.points.size() + solution.lines.size());
  std::iota(order.begin(), order.end(), 0);
  const auto sigmas = [&](int pin) {
    const size_t index = static_cast<size_t>(pin);
    return index < solution.points.size() ? solution.points[index].sigmas
                                          : solution.lines[index - solution.points.size()].sigmas;
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sigmas(a) > sigmas(b); });
  return order;
}

const char* UseName(PinUse use) {
  return use == PinUse::kUsed ? "used" : use == PinUse::kCheck ? "check" : "off";
}

void DrawFreeNumbers(const PinSolution& solution) {
  const CameraParameters site = SiteParameters(solution.parameters);
  if (!ImGui::BeginTable("numbers", 4, ImGuiTableFlags_SizingFixedFit)) return;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    const bool is_free = solution.is_free[i];
    const ImVec4 colour = is_free ? ImVec4(0.93f, 0.93f, 0.93f, 1) : ImVec4(0.6f, 0.6f, 0.62f, 1);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(colour, "%s", std::string(kCameraParameterNames[i]).c_str());
    ImGui::TableNextColumn();
    // Flush right, so that points stand below one another.
    char number[32];
    std::snprintf(number, sizeof number, "%.3f", site[i]);
    const float before = ImGui::CalcTextSize("-000.000").x - ImGui::CalcTextSize(number).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, before));
    ImGui::TextColored(colour, "%s", number);
    ImGui::TableNextColumn();
    ImGui::TextColored(colour, "\u00B1 %.3f", solution.sigmas[i]);
    ImGui::TableNextColumn();
    ImGui::TextColored(colour, "%s", is_free ? "free" : "held");
  }
  ImGui::EndTable();
}

void DrawNews(const AlignmentNews& news) {
  ImGui::TextWrapped("Verdict: %s", std::string(VerdictName(news.verdict)).c_str());
  for (const std::string& reason : news.reasons) ImGui::TextWrapped("\u2022 %s", reason.c_str());
  ImGui::TextWrapped("moved %.1f px, left uncertain %.2f px", news.moved_px, news.vertex_sigma_px);
  if (news.margin_nats) ImGui::TextWrapped("%.0f nats before the rival", *news.margin_nats);
  if (!news.undetermined.empty()) {
    std::string names;
    for (const std::string& name : news.undetermined) names += " " + name;
    ImGui::TextWrapped("no better known than before:%s", names.c_str());
  }
}

}  // namespace

void App::DrawTagPanel() {
  if (photograph_ < 0) {
    ImGui::TextWrapped("Choose a photograph.");
    return;
  }
  const PhotographWork& work = session_.work(photograph_);
  const std::string fault = cache_.FaultOf(photograph_);
  if (!fault.empty()) ImGui::TextWrapped("%s; pins stay.", fault.c_str());
  if (!work.tag) {
    ImGui::TextWrapped(
        "1. On the plan, press where the camera stood, drag to what it looked at, release.");
    if (ImGui::Button("It stood where I looked from last")) StandAsLooking();
    return;
  }
  bool is_cropped = IsCropped();
  if (ImGui::Checkbox("X the picture was cut", &is_cropped)) ToggleCropped();
  if (alignment_.IsRunning()) {
    if (ImGui::Button("Esc stop")) StopAlignment();
  } else if (ImGui::Button("A align")) {
    Align();
  }
  ImGui::SameLine();
  if (ImGui::Button("Ctrl+S save")) Save();
  if (session_.UndoDepth(photograph_) > 0 && ImGui::Button("Ctrl+Home back to the notebook")) {
    BackToNotebook();
    return;
  }
  if (!work.overruled.empty()) {
    ImGui::Separator();
    ImGui::TextWrapped("taken against the verdict: %s", work.overruled.c_str());
  }
  if (work.alignment) {
    ImGui::Separator();
    if (session_.IsAsFound(photograph_)) ImGui::TextWrapped("As the run found it.");
    DrawNews(*work.alignment);
    if (work.accepted) {
      if (work.overruled.empty()) ImGui::TextWrapped("taken");
    } else if (ImGui::Button("Ctrl+Shift+Enter take it all the same")) {
      Accept(true);
    }
    if (work.alignment->rival) ImGui::Checkbox("R the rival (purple)", &shows_rival_);
  }
  const auto& solution = session_.Solution(photograph_);
  if (!solution) return;
  ImGui::Separator();
  if (!solution->fault.empty()) ImGui::TextWrapped("\u25B2 %s", solution->fault.c_str());
  if (work.pins.points.empty() && work.pins.lines.empty()) {
    ImGui::TextWrapped(
        "No pins yet. Drag corners of the model to where the photograph shows them; six or more, "
        "from all over the picture, decide most.");
  } else {
    ImGui::Text("pins %zu, lines %zu; rms %.2f px",
                work.pins.points.size(),
                work.pins.lines.size(),
                solution->rms_px);
  }
  for (const int pin : WorstFirst(*solution)) {
    const size_t index = static_cast<size_t>(pin);
    const bool is_point = index < work.pins.points.size();
    const PinResidual& residual =
        is_point ? solution->points[index] : solution->lines[index - work.pins.points.size()];
    const PinUse use = is_point ? work.pins.points[index].use
                                : work.pins.lines[index - work.pins.points.size()].use;
    char line[96];
    std::snprintf(line,
                  sizeof line,
                  "%s %s %d  %.2f px  %.1f \u03C3  %s",
                  residual.is_bad ? "\u25B2" : " ",
                  is_point ? "pin" : "line",
                  static_cast<int>(is_point ? index : index - work.pins.points.size()) + 1,
                  residual.size_px,
                  residual.sigmas,
                  UseName(use));
    if (ImGui::Selectable(line, pin_ == pin)) {
      pin_ = pin;
      if (is_point) {
        const Eigen::Vector2d middle(pane_.width / 2.0, pane_.height / 2.0);
        place_.scale = std::max(place_.scale, 2.0);
        place_.origin_px = middle - place_.scale * work.pins.points[index].image_px;
      }
    }
  }
  ImGui::Separator();
  DrawFreeNumbers(*solution);
}

std::string App::TagStatusLine() const {
  if (!session_.work(photograph_).tag) {
    return "on the plan: press where it stood, drag to what it looked at \u00B7 Esc back \u00B7 F1 "
           "keys";
  }
  if (alignment_.IsRunning()) {
    // Without three pins registration has to look everywhere that the tag allows.
    const bool is_long = aligned_work_.pins.points.size() < 3;
    return "aligning " + session_.photographs()[aligned_photograph_].name +
           " ... \u00B7 Esc stops it" +
           (is_long ? " \u00B7 may take minutes from a rough place; three pins make it quick" : "");
  }
  if (armed_point_ && pin_is_due_) {
    return "click where this corner is in the photograph \u00B7 Enter: where it is seen now \u00B7 "
           "Esc lets it go";
  }
  if (pin_)
    return "arrows move the pin by 0.1 px, Shift 1, Ctrl 10 \u00B7 S snaps \u00B7 U use \u00B7 "
           "Delete \u00B7 Esc "
           "lets it go";
  const auto& solution = session_.Solution(photograph_);
  if (solution && solution->worst) {
    return "\u25B2 pin " + std::to_string(*solution->worst + 1) +
           " fits worst: move it, U to leave it out \u00B7 A align";
  }
  const PhotographWork& work = session_.work(photograph_);
  if (session_.IsAsFound(photograph_) && work.accepted) {
    return "accepted by the run: pins may still move it \u00B7 Alt+Right next photograph \u00B7 F1 "
           "keys";
  }
  if (work.accepted) {
    return std::string(session_.IsUnsaved(photograph_) ? "taken: Ctrl+S saves it" : "saved") +
           " \u00B7 N next without a tag \u00B7 F1 keys";
  }
  if (work.alignment) {
    return std::string(work.alignment->rival ? "R shows the rival \u00B7 " : "") +
           "pin more corners, then A \u00B7 Ctrl+Shift+Enter takes it all the same \u00B7 F1 keys";
  }
  return "drag a corner of the model to where it is in the photograph \u00B7 an edge to its line "
         "\u00B7 A align \u00B7 Ctrl+S save \u00B7 F1 keys";
}

}  // namespace groundglass
