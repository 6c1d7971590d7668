// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"

#include <imgui/imgui.h>

namespace groundglass {
namespace {

constexpr int kCropRadius = 24;
constexpr int kCropSize = 96;
constexpr int kMostCrops = 6;

void DrawMeasure(const char* what, const Measure& measure, const std::string& unit) {
  ImGui::TextWrapped("%s %.3f \u00B1 %.3f %s", what, measure.value, measure.sigma, unit.c_str());
  ImGui::TextWrapped("   camera %.3f, pointing %.3f,\n   model %.3f",
                     measure.camera_sigma,
                     measure.pixel_sigma,
                     measure.model_sigma);
}

}  // namespace

void App::DrawAskPanel() {
  if (!answer_) {
    ImGui::TextWrapped(
        "Click anywhere on the model or in a photograph: where it is, how sure that is, and who "
        "shows it. Shift adds a second place for a distance, a third for an area.");
    return;
  }
  const std::string unit = UnitName(survey_.model.unit);
  if (answer_->distance) DrawMeasure("distance", *answer_->distance, unit);
  if (answer_->area) DrawMeasure("area", *answer_->area, "square " + unit);
  const Place& place = answer_->places.back();
  const Eigen::Vector3d site = SiteFromWorld(place.point_in_world);
  const Eigen::Vector3d sigma = place.Covariance().diagonal().cwiseMax(0).cwiseSqrt();
  ImGui::Text("x %.3f \u00B1 %.3f\ny %.3f \u00B1 %.3f\nz %.3f \u00B1 %.3f %s",
              site.x(),
              sigma.x(),
              site.y(),
              sigma.y(),
              site.z(),
              sigma.z(),
              unit.c_str());
  for (const int face : place.faces) {
    ImGui::TextWrapped("on %s", DescribeFace(survey_.model, face).c_str());
  }
  ImGui::Separator();
  int num_crops = 0;
  for (const Sighting& sighting : answer_->sightings.back()) {
    const SurveyPhotograph& photograph = survey_.photographs[sighting.photograph];
    if (sighting.state != SightingState::kShown) {
      ImGui::TextWrapped("%s: %s", photograph.name.c_str(), sighting.reason.c_str());
      continue;
    }
    const auto in_session = session_.FindPhotograph(photograph.name);
    if (in_session && num_crops++ < kMostCrops) {
      TexturePtr& crop = crops_[sighting.photograph];
      if (!crop) {
        if (const auto picture = cache_.Find(*in_session)) {
          crop =
              window_.MakeTexture(CropAround(*picture, *sighting.image_px, kCropRadius, kCropSize));
        }
      }
      if (crop) {
        ImGui::Image(crop.get(), ImVec2(kCropSize, kCropSize));
        ImGui::SameLine();
      }
    }
    ImGui::Text("%s\n%.1f, %.1f px\n\u00B1 %.2f px\nseen at %.0f\u00B0\n%.3f %s a px",
                photograph.name.c_str(),
                sighting.image_px->x(),
                sighting.image_px->y(),
                sighting.camera_sigma_px,
                sighting.angle_deg,
                sighting.pixel_size[0],
                unit.c_str());
  }
}

}  // namespace groundglass
