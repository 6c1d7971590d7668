// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice/advice_line.h"
#include "scene/advice/standpoint.h"
#include "scene/advice/tag_slips.h"
#include "scene/formats/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

class PictureJudge;

// What the parts of FindOddities share.
struct AdviceContext {
  const Scene& scene;
  const ModelOptions& options;
  Box bounds;
  const Visibility& visibility;
  std::vector<Standpoint> standpoints;  // of scene.photographs, in their order
  std::vector<Advice>& found;

  void Add(Advice::Severity severity,
           const std::string& subject,
           const std::string& message,
           const std::string& remedy) const {
    found.push_back({severity, subject, message, remedy});
  }
};

// Where a photograph's tag stands: its view file, or the table with the photograph's name.
std::string TagPlace(const Scene& scene, const Photograph& photograph);
// "s1, s2, s3 and 4 more".
std::string ListNames(const std::vector<std::string>& names);

// Nothing of the model is in its frame, or it stands where no camera can: a tag like that is wrong,
// or the model is.
bool IsImplausible(const Standpoint& standpoint);
// The look-at point lies on the model and the model fills some of the frame.
bool IsPlausible(const Standpoint& standpoint);

// The whole scene, read otherwise: another axis up, mirrored, another unit, another datum, x and y
// exchanged. Not kNone if one of these is clearly meant, or most tags are implausible for no reason
// that is known here; single tags are then no news.
enum class Misreading { kNone, kOfUnit, kOther };
Misreading AdviseOnReading(const AdviceContext& context, const PictureJudge* judge);
// True, and told, if its x and y are degrees of longitude and latitude.
bool AdviseOnDegrees(const AdviceContext& context);
// The model by itself: its size and unit (unless that is told already), its coordinates' steps.
void AdviseOnRaster(const AdviceContext& context);
void AdviseOnModel(const AdviceContext& context, Misreading misreading);
// Faces that show their backs: they run clockwise, or the model is mirrored about a line that its
// tags suit as well, which the pictures tell if there is a judge. True if that is so.
bool AdviseOnBacks(const AdviceContext& context, const PictureJudge* judge);
// Single faces that are turned, among others that are not. True if there are any.
bool AdviseOnWinding(const AdviceContext& context);
// A model that shows its fronts and is mirrored all the same, or tags whose axes are others though
// their cameras look at it, as the pictures tell. True if so.
bool AdviseOnMirror(const AdviceContext& context, const PictureJudge& judge);
// All heights in the tags off by the same, as the pictures tell. True if so.
bool AdviseOnDatum(const AdviceContext& context, const PictureJudge& judge);
// Cameras from elsewhere, most of which do not see the model: another unit, or another origin.
void AdviseOnGivenCameras(const AdviceContext& context, const PictureJudge& judge);
// The steps of the coordinates of a model whose faces could not be read.
void AdviseOnUnreadModel(const Scene& scene,
                         const ModelOptions& options,
                         std::vector<Advice>& found);
// A tag that cannot well be right by its own numbers and the other tags'.
struct TagDoubt {
  std::string wrong;             // for a person; empty: there is no doubt
  std::string remedy;            // where no slip explains it
  std::vector<MeantTag> meant;   // slips that explain it, the likelier ones first
  bool is_only_unusual = false;  // the picture may clear it
};
// Whether the slip changes a look-at point that the table has no numbers of.
bool ChangesWhatIsNotWritten(const Scene& scene, const MeantTag& meant);
// One for each photograph. None (empty list) if most tags have the same slip, which is told.
std::vector<TagDoubt> FindTagDoubts(const AdviceContext& context);
void AdviseOnTags(const AdviceContext& context, const std::vector<TagDoubt>& doubts);
// Shape and turn of the pictures against their tags.
bool SuitsPicture(const Photograph& photograph);
// A part of a picture with the whole frame's `a`, as the other photographs tell.
bool SeemsCropped(const Scene& scene, const Photograph& photograph);
void AdviseOnFrames(const AdviceContext& context);
// Masks that hide the building in place of what stands before it; it reads masks.
void AdviseOnMasks(const AdviceContext& context);
// Pictures that are there twice, and tags that were copied; it reads pictures.
void AdviseOnDoubles(const AdviceContext& context);

}  // namespace groundglass
