// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <imgui/imgui.h>

#include <array>
#include <string>
#include <vector>

namespace groundglass {
namespace {

// Asks until `asked` is false.
template <typename Draw>
void Ask(const char* title, bool& asked, const Draw& draw) {
  if (asked && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  draw();
  if (!asked) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

std::string Listed(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace

// What an earlier session did not save is offered; what cannot be is told.
void App::FindLeftWork() {
  std::vector<std::string> tags;
  for (const auto& [name, work] : session_.FindLeftWork()) tags.push_back(name);
  left_masks_ = masks_.FindLeftWork();
  std::vector<std::string> masks;
  for (const auto& [photograph, steps] : left_masks_.steps) {
    masks.push_back(session_.photographs()[photograph].name);
  }
  std::vector<std::string> lines;
  if (!tags.empty()) lines.push_back("Tags and pins: " + Listed(tags, ", "));
  if (!masks.empty()) lines.push_back("Painted masks: " + Listed(masks, ", "));
  offers_left_work_ = !lines.empty();
  lines.insert(lines.end(), left_masks_.left_out.begin(), left_masks_.left_out.end());
  left_work_of_ = Listed(lines, "\n");
  message_ = Listed(left_masks_.left_out, "; ");
}

void App::DrawQuestions() {
  Ask("Unsaved work", asks_to_quit_, [&] {
    std::vector<std::string> unsaved;
    for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
      if (session_.IsUnsaved(i) || masks_.IsUnsaved(i)) {
        unsaved.push_back(session_.photographs()[i].name);
      }
    }
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
    ImGui::TextWrapped("Not saved yet: %s.", Listed(unsaved, ", ").c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::Button("Enter  save all") || says_yes_) {
      bool is_saved = true;
      for (int i = 0; i < static_cast<int>(session_.photographs().size()); ++i) {
        const auto note = [&](const SaveResult& result) {
          message_ = result.message;
          is_saved = is_saved && result.kind == SaveResult::Kind::kSaved;
        };
        if (session_.IsUnsaved(i)) note(session_.Save(i));
        if (masks_.IsUnsaved(i)) note(masks_.Save(i));
      }
      asks_to_quit_ = false;
      is_open_ = !is_saved;
    }
    ImGui::SameLine();
    if (ImGui::Button("Delete  discard") || says_drop_) {
      session_.ForgetJournal();
      is_open_ = false;
    }
    ImGui::SameLine();
    if (ImGui::Button("Esc  cancel") || says_no_) asks_to_quit_ = false;
  });
  Ask("Changed on disk", asks_to_overwrite_, [&] {
    ImGui::Text("Somebody else has changed these files since they were read.");
    if (ImGui::Button("Enter  keep mine") || says_yes_) {
      message_ = session_.Save(photograph_, true).message;
      asks_to_overwrite_ = false;
    }
    ImGui::SameLine();
    if (ImGui::Button("Esc  cancel") || says_no_) asks_to_overwrite_ = false;
  });
  Ask("Mask changed on disk", asks_to_overwrite_mask_, [&] {
    ImGui::Text("Somebody else has changed this mask since it was read.");
    if (ImGui::Button("Enter  keep mine") || says_yes_) {
      asks_to_overwrite_mask_ = false;
      SaveMask(true);
    }
    ImGui::SameLine();
    if (ImGui::Button("Esc  cancel") || says_no_) asks_to_overwrite_mask_ = false;
  });
  Ask("Unsaved work of an earlier session", offers_left_work_, [&] {
    ImGui::Text("There is unsaved work of %s.", session_.LeftWorkIsOf().c_str());
    ImGui::TextUnformatted(left_work_of_.c_str());
    if (ImGui::Button("Enter  take it") || says_yes_) {
      session_.TakeLeftWork();
      masks_.TakeLeftWork(left_masks_);
      offers_left_work_ = false;
    }
    ImGui::SameLine();
    if (ImGui::Button("Delete  drop it") || says_drop_) {
      session_.DropLeftWork();
      masks_.DropLeftWork();
      offers_left_work_ = false;
    }
  });
  Ask("Against the verdict", asks_reason_, [&] {
    static std::array<char, 200> reason = {};
    ImGui::Text("Why is it right all the same? The view file keeps the reason.");
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool is_entered = ImGui::InputText(
        "reason", reason.data(), reason.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    if ((is_entered || ImGui::Button("Enter  take it") || says_yes_) && reason[0] != 0) {
      reason_ = reason.data();
      reason = {};
      asks_reason_ = false;
      Accept(true);
    }
    ImGui::SameLine();
    if (ImGui::Button("Esc  cancel") || says_no_) asks_reason_ = false;
  });
  says_yes_ = says_no_ = says_drop_ = false;
}

}  // namespace groundglass
