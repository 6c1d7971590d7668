// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "session/snap.h"

#include <string>

namespace groundglass {

void App::SnapPin() {
  Pins pins = session_.work(photograph_).pins;
  if (!HasPin(pins)) {
    message_ = "choose a pin first: S moves it onto what the photograph shows";
    return;
  }
  const auto picture = cache_.Find(photograph_);
  if (!picture) return;
  const size_t index = static_cast<size_t>(*pin_);
  bool has_snapped = false;
  const auto snap = [&](Eigen::Vector2d& at_px) {
    const auto found = SnapToPicture(*picture, at_px, session_.options().snap);
    if (!found) return;
    at_px = *found;
    has_snapped = true;
  };
  if (index < pins.points.size()) {
    snap(pins.points[index].image_px);
  } else {
    LinePin& line = pins.lines[index - pins.points.size()];
    if (line_end_ != 1) snap(line.first_px);
    if (line_end_ != 0) snap(line.second_px);
  }
  if (!has_snapped) {
    message_ = "the photograph shows no corner and no edge within 3 px of this pin";
    return;
  }
  message_.clear();
  session_.EndGesture();
  ChangePins(pins);
}

void App::ShowRival() {
  const auto& news = session_.work(photograph_).alignment;
  if (news && news->rival) {
    shows_rival_ = !shows_rival_;
    message_.clear();
    return;
  }
  shows_rival_ = false;
  message_ = !news ? "no rival is known: A aligns, and tells it of a camera in review"
             : news->verdict == Verdict::kReview
                 ? "no rival was found: what is in doubt is written at the right"
                 : "only a camera in review has a rival: this one is " +
                       std::string(VerdictName(news->verdict));
}

}  // namespace groundglass
