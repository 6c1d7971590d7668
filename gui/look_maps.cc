// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/look_maps.h"

#include "scene/error.h"

#include <chrono>

namespace groundglass {
namespace {

template <typename Future>
bool IsThere(const Future& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

LookMaps::LookMaps(const std::filesystem::path& folder,
                   const TexturedModel& textured,
                   const Survey& survey,
                   const Visibility& visibility,
                   std::function<void()> on_done)
    : folder_(folder),
      textured_(textured),
      survey_(survey),
      visibility_(visibility),
      on_done_(std::move(on_done)) {}

LookMaps::~LookMaps() {
  is_ending_ = true;
  for (auto& [map, made] : maps_) made.wait();
}

std::shared_ptr<const LookMaps::Asked> LookMaps::AskAll() const {
  auto asked = std::make_shared<Asked>();
  try {
    auto cells = MapSurvey(survey_, visibility_, is_ending_);
    if (!cells) return nullptr;
    asked->cells = std::move(*cells);
  } catch (const std::exception& error) {
    asked->fault = error.what();
    return asked;
  }
  try {
    if (!folder_.empty()) asked->texels = ReadTexelSources(folder_, textured_);
  } catch (const std::exception& error) {
    asked->texels_fault = error.what();
  }
  return asked;
}

std::shared_ptr<const ColouredModel> LookMaps::Colour(LookMap map, const Asked& asked) const {
  if (!asked.fault.empty()) throw Error(asked.fault);
  if (map == LookMap::kProvenance && !asked.texels_fault.empty()) throw Error(asked.texels_fault);
  return ColourModel(map,
                     {&textured_, &survey_, &asked.cells, asked.texels ? &*asked.texels : nullptr});
}

std::shared_ptr<const ColouredModel> LookMaps::Find(LookMap map) {
  if (!asked_.valid()) {
    asked_ = std::async(std::launch::async, [this] { return AskAll(); }).share();
  }
  auto& made = maps_[map];
  if (!made.valid()) {
    made = std::async(std::launch::async, [this, map, from = asked_] {
             // Also where it ends in an error, which Find() throws.
             const std::shared_ptr<void> told(nullptr, [this](void*) { on_done_(); });
             const auto& asked = from.get();
             return asked ? Colour(map, *asked) : nullptr;
           }).share();
  }
  return IsThere(made) ? made.get() : nullptr;
}

const std::vector<FaceCells>* LookMaps::Cells() const {
  if (!IsThere(asked_) || !asked_.get() || !asked_.get()->fault.empty()) return nullptr;
  return &asked_.get()->cells;
}

}  // namespace groundglass
