// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Pictures that the model does not suit at all though every tag by itself is sound: the model was
// read, drawn or placed otherwise, which the tags cannot tell where it stands about the same place.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/advice_readings.h"
#include "scene/advice/picture_fit.h"

#include <cmath>
#include <string>
#include <vector>

namespace groundglass {
namespace {

// Means of right tags' scores are above this, those of wrong models below (3.4 and more on 33 of 34
// made-up buildings, 2.9 and less on models that were turned, moved or of another size).
constexpr double kNoFit = 2.7;
// What another reading must reach to be named.
constexpr double kFits = 3.2;
constexpr size_t kFewest = 3;

// The model turned where it stands.
std::vector<Reading> Turned(const AdviceContext& context) {
  std::vector<Reading> readings;
  const auto add = [&](const Eigen::Matrix3d& turn, const std::string& message) {
    Reading& reading = readings.emplace_back();
    reading.model.linear = turn;
    const Eigen::Vector3d middle = context.bounds.Center();
    reading.model.offset = middle - turn * middle;
    reading.message = message;
    reading.remedy = "turn it in the program that drew it, or change the tags likewise";
  };
  for (const int degrees : {180, 90, 270}) {
    add(Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
        "it is turned by " + std::to_string(degrees) + " degrees about its middle");
  }
  add(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix(),
      "it stands on its head");
  return readings;
}

}  // namespace

bool AdviseOnNoFit(const AdviceContext& context,
                   const std::vector<PictureFit>& pictures,
                   const PictureJudge& judge) {
  std::vector<double> nearby;
  for (const PictureFit& fit : pictures) {
    if (fit.nearby > 0) nearby.push_back(fit.nearby);  // else it is not known
  }
  if (nearby.size() < kFewest || PictureJudge::Mean(nearby) >= kNoFit ||
      HaveCommonAlternative(pictures)) {
    return false;
  }
  const std::vector<double> as_read = judge.Fit(context.scene.model, {}, kTagReach);
  std::vector<Reading> readings = OtherAxes(context);
  for (const Reading& reading : Turned(context)) readings.push_back(reading);
  for (const Reading& reading : OtherAngles(context)) readings.push_back(reading);
  const Reading* best = FindClearlyBest(readings, context.scene.model, judge, as_read, kFits);
  const std::string file = context.scene.model_file.string();
  if (best) {
    context.Add(Advice::Severity::kScene,
                file,
                best->message + ": so the pictures' edges lie on its own, and not as it was read",
                best->remedy);
    return true;
  }
  context.Add(
      Advice::Severity::kScene,
      file,
      "the pictures' edges are not where the tags see the model's, no more than by chance",
      "look at the overlays (groundglass check SCENE -o DIR): is it this building, as large "
      "and as high, turned and placed as the tags have it, and are the tags these "
      "photographs'?");
  return true;
}

}  // namespace groundglass
