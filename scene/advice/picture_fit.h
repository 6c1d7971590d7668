// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/advice/advice_parts.h"
#include "scene/feature_edges.h"

#include <optional>
#include <vector>

namespace groundglass {

// How another reading of a photograph fits its picture's edges (EdgeFit::Score); 0: not known.
struct AlternativeFit {
  double anywhere = 0;
  double nearby = 0;  // only within kTagReach of the tag's place, where `anywhere` is clear
};
// How the readings of one photograph fit its picture's edges.
struct PictureFit {
  bool is_explained = false;  // it is another photograph's tag, which is told
  double as_read = 0;
  double nearby = 0;  // as read, and only within kTagReach of the tag's place
  AlternativeFit upside_down;
  AlternativeFit mirrored;
  AlternativeFit vertical_angle;  // v taken as the angle up and down the frame
  AlternativeFit diagonal_angle;  // ... as the angle from corner to corner
  AlternativeFit half_angle;      // ... as the angle from the axis to the frame's edge
  AlternativeFit focal_length;    // ... as the lens's focal length in mm, before 35 mm film
};

// Scores of chance reach 4.5; those of photographs with their right tags lie between 3.2 and 7
// (bundled and outside scenes). A single picture is believed only far above chance.
constexpr double kClearScore = 5;
constexpr double kClearLead = 1.5;
// Of the reach: so near to its right tag's place a picture fits best. Of wrong tags' scores, only
// some one in a hundred lies above 4 there; their mean is 2.
constexpr double kTagReach = 0.35;

// Of all photographs, in their order.
std::vector<PictureFit> FitPictures(const AdviceContext& context);
// The picture is turned, mirrored or has the view angle of another side, as it tells by itself; or
// as most of them tell.
bool HasClearAlternative(const PictureFit& fit);
bool HaveCommonAlternative(const std::vector<PictureFit>& fits);
// Tells these.
void AdviseOnPictures(const AdviceContext& context, const std::vector<PictureFit>& fits);

// Sound tags that stand beside other photographs than their own. True if all do; what else was
// found of two that are exchanged is taken from `fits` and `doubts`.
bool AdviseOnOrder(const AdviceContext& context,
                   std::vector<PictureFit>& fits,
                   std::vector<TagDoubt>& doubts);

// Pictures that the model suits no more than by chance, and why if that can be told. True if so.
bool AdviseOnNoFit(const AdviceContext& context,
                   const std::vector<PictureFit>& fits,
                   const PictureJudge& judge);

// What the pictures say of the tags: slips that explain a tag are weighed, and found where the
// numbers alone are silent; a doubt about what is only unusual is dropped where the picture suits
// it.
void WeighTags(const AdviceContext& context,
               const std::vector<PictureFit>& fits,
               std::vector<TagDoubt>& doubts);

}  // namespace groundglass
