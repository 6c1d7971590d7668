// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// All heights of the tags off by the same. Cameras all about as high are held by people, who stand
// near the model's foot; where they would not, the pictures tell whether the tags are wrong or were
// taken from a terrace or from a ditch.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace groundglass {
namespace {

constexpr size_t kFewestHeights = 4;
constexpr double kEyeMetres = 1.6;
// Between these above the model's foot, slopes explain a camera that is held by hand.
constexpr double kLowestUsualMetres = 0.6;
constexpr double kHighestUsualMetres = 3.2;
// So far from the median are heights of cameras that were held alike, and so many are.
constexpr double kAlikeMetres = 1;
constexpr double kAlikeShare = 0.6;
// Only near the tag's own place: farther off, a wrong height is mended by turning the camera.
constexpr double kNearness = 0.35;
// The model's foot may lie on a plinth or in a cellar: these are tried about its height.
constexpr std::array<double, 5> kFeetMetres = {0, -1, 1, -2, 2};

}  // namespace

bool AdviseOnDatum(const AdviceContext& context, const PictureJudge& judge) {
  if (context.standpoints.size() < kFewestHeights) return false;
  const PolygonModel& model = context.scene.model;
  const double metres = MetresPerUnit(model.unit);
  std::vector<double> eyes_m;
  for (const Standpoint& standpoint : context.standpoints) {
    eyes_m.push_back((standpoint.position_in_site.z() - context.bounds.min.z()) * metres);
  }
  std::sort(eyes_m.begin(), eyes_m.end());
  const double eye_m = eyes_m[eyes_m.size() / 2];
  const auto num_alike = std::count_if(eyes_m.begin(), eyes_m.end(), [&](double height_m) {
    return std::abs(height_m - eye_m) <= kAlikeMetres;
  });
  if ((eye_m >= kLowestUsualMetres && eye_m <= kHighestUsualMetres) ||
      static_cast<double>(num_alike) < kAlikeShare * static_cast<double>(eyes_m.size())) {
    return false;
  }
  const std::vector<double> as_read = judge.Fit(model, {}, kNearness);
  double best_datum = 0;
  std::vector<double> best_fits = as_read;
  for (const double foot_m : kFeetMetres) {
    const double datum = (eye_m - kEyeMetres + foot_m) / metres;
    const auto retag = [datum](ViewTag tag) {
      tag.position_in_site.z() -= datum;
      tag.lookat_in_site.z() -= datum;
      return tag;
    };
    const std::vector<double> fits = judge.Fit(model, retag, kNearness);
    if (std::reduce(fits.begin(), fits.end()) <= std::reduce(best_fits.begin(), best_fits.end())) {
      continue;
    }
    best_fits = fits;
    best_datum = datum;
  }
  if (best_datum == 0 || !PictureJudge::IsClearlyBetter(best_fits, as_read)) return false;
  const auto height = [&](double height_m) { return FormatLength(height_m / metres, model.unit); };
  context.Add(Advice::Severity::kScene,
              context.scene.model_file.string(),
              "most cameras stand about " + height(std::abs(eye_m)) +
                  (eye_m < 0 ? " below" : " above") +
                  " the model's foot, and the pictures' edges suit the model better if all heights "
                  "in the tags were about " +
                  FormatLength(std::abs(best_datum), model.unit) +
                  (best_datum > 0 ? " less" : " more") + ": they count from another zero",
              "count both from the same height: change z and k of every tag by about " +
                  FormatNumber(-std::round(best_datum * 10) / 10) + ", or move the model");
  return true;
}

}  // namespace groundglass
