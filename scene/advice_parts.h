// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice.h"
#include "scene/standpoint.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

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

// The file that a photograph's tag stands in.
std::string TagFile(const Scene& scene, const Photograph& photograph);
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
Misreading AdviseOnReading(const AdviceContext& context);
// The model by itself: its size and unit (unless that is told already), its coordinates' steps.
void AdviseOnModel(const AdviceContext& context, Misreading misreading);
// Faces that show their backs: they run clockwise, or the model is mirrored about a line that its
// tags suit as well, which the pictures tell if they are looked at. True if that is so.
bool AdviseOnBacks(const AdviceContext& context, bool with_pictures);
// Each tag by itself.
void AdviseOnTags(const AdviceContext& context);
// Shape and turn of the pictures against their tags.
void AdviseOnFrames(const AdviceContext& context);
// What the pictures show: turned by 180 degrees, mirrored, the view angle of the other side.
void AdviseOnPictures(const AdviceContext& context);
// Whether the pictures' edges lie on a model that shows its backs as `mirrored` has it, or as it
// was read. None if they suit either.
std::optional<bool> FindWhetherMirrored(const AdviceContext& context, const OtherReading& mirrored);

}  // namespace groundglass
