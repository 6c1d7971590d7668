// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "scene/error.h"

#include <algorithm>

namespace groundglass {

void App::AskAt(const Eigen::Vector2d& pane_px, bool adds) {
  if (!adds || places_.size() >= 3) places_.clear();
  const int index = static_cast<int>(places_.size());
  try {
    std::optional<int> asked;
    message_.clear();
    for (size_t i = 0; IsInside() && i < survey_.photographs.size(); ++i) {
      if (survey_.photographs[i].name == session_.photographs()[photograph_].name) {
        asked = static_cast<int>(i);
      }
    }
    if (asked) {
      places_.push_back(
          PlaceInPhotograph(survey_, visibility_, *asked, place_.InPhotograph(pane_px), index));
    } else if (IsInside()) {
      message_ = session_.photographs()[photograph_].name +
                 " has no camera yet that can be asked; ask on the model, or tag it first";
    } else if (const auto pick = PickFace(visibility_, PaneCamera(), pane_px)) {
      places_.push_back(PlaceOnModel(survey_, pick->point_in_world, index));
    }
  } catch (const Error& error) {
    message_ = error.what();
  }
  AskAgain();
}

void App::AskAgain() {
  crops_.clear();
  answer_.reset();
  if (places_.empty()) return;
  try {
    answer_ = AnswerPlaces(survey_, visibility_, places_);
  } catch (const Error& error) {
    message_ = error.what();
  }
}

}  // namespace groundglass
