// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Each tag by itself: where no camera can have stood, and the slip of the pen that explains it.
#include "scene/advice/advice_parts.h"
#include "scene/advice/tag_slips.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace groundglass {
namespace {

// Where the model takes less of the frame's width than this, no edge can be placed.
constexpr double kSmallestApparentSize = 0.03;

Standpoint Locate(const AdviceContext& context, const Photograph& photograph, const ViewTag& tag) {
  return FindStandpoint(
      context.bounds, context.visibility, context.scene.model, tag, photograph.size);
}

// True if the look-at point cannot be what was looked at: it lies on faces that turn their backs,
// or far from all of them.
bool IsLookatWrong(const Standpoint& standpoint) {
  return standpoint.looks_at_back || standpoint.lookat_gap > 0.15 || IsImplausible(standpoint);
}

// The slip that explains a tag which cannot be right; null if none does. A single number may make
// a wrong tag look right by chance, so the corrected one must meet the model where it says.
const TagSlip* FindSlip(const AdviceContext& context,
                        const Photograph& photograph,
                        const Standpoint& as_read) {
  if (!IsLookatWrong(as_read)) return nullptr;
  for (const TagSlip& slip : kTagSlips) {
    ViewTag tag = photograph.tag;
    slip.correct(tag);
    if (tag == photograph.tag || FindTagFault(tag)) continue;
    const Standpoint standpoint = Locate(context, photograph, tag);
    if (IsPlausible(standpoint) && standpoint.front_share > 0.7 && standpoint.lookat_error < 0.02) {
      return &slip;
    }
  }
  return nullptr;
}

// A height with a minus before it that suits the others' without: the camera stands just below the
// model's foot, where a slope might have it, but the sign is likelier.
bool HasMinusBeforeHeight(const AdviceContext& context, size_t index) {
  const double foot = context.bounds.min.z();
  const double z = context.standpoints[index].position_in_site.z();
  if (z >= foot || z >= 0 || context.standpoints.size() < 4) return false;
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (size_t i = 0; i < context.standpoints.size(); ++i) {
    if (i == index) continue;
    lowest = std::min(lowest, context.standpoints[i].position_in_site.z());
    highest = std::max(highest, context.standpoints[i].position_in_site.z());
  }
  return lowest > 0 && lowest >= foot && -z >= 0.8 * lowest && -z <= 1.2 * highest;
}

bool IsBehind(const AdviceContext& context, const Photograph& photograph) {
  const Camera camera =
      CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
  for (const Eigen::Vector3d& point : context.scene.model.points_in_world) {
    if ((camera.cam_from_world * point).z() > 0) return false;
  }
  return true;
}

// What is wrong with where it stands or looks; empty: nothing.
std::string FindWrong(const AdviceContext& context,
                      const Photograph& photograph,
                      const Standpoint& standpoint) {
  const double z = standpoint.position_in_site.z();
  const LengthUnit unit = context.scene.model.unit;
  if (standpoint.is_inside) return "the camera stands inside the model, which shows it backs only";
  if (standpoint.is_below_ground) {
    const double depth = context.bounds.min.z() - z;
    return "the camera stands below the ground" +
           (depth > 0 ? ", " + FormatLength(depth, unit) + " under the model's foot"
                      : std::string(", under a face of the model that looks up"));
  }
  if (standpoint.apparent_size < kSmallestApparentSize) {
    return "the camera stands " + FormatLength(standpoint.distance, unit) +
           " from the model, which takes " +
           FormatNumber(std::round(1000 * standpoint.apparent_size) / 10) + " % of its view angle";
  }
  if (standpoint.model_share > 0) return "";
  return IsBehind(context, photograph) ? "the whole model lies behind this camera"
                                       : "nothing of the model lies in this frame";
}

}  // namespace

void AdviseOnTags(const AdviceContext& context) {
  const std::vector<Photograph>& photographs = context.scene.photographs;
  std::vector<const TagSlip*> slips;
  for (size_t i = 0; i < photographs.size(); ++i) {
    slips.push_back(FindSlip(context, photographs[i], context.standpoints[i]));
  }
  // The same slip in most tags is how all of them were written.
  for (const TagSlip& slip : kTagSlips) {
    const size_t count = static_cast<size_t>(std::count(slips.begin(), slips.end(), &slip));
    if (count < 3 || 2 * count < photographs.size()) continue;
    context.Add(Advice::Severity::kScene,
                (context.scene.folder / "views").string(),
                std::to_string(count) + " of " + std::to_string(photographs.size()) +
                    " tags do not look at the model where they say, and would with " + slip.name,
                "in view files x counts east, y south and z up: change all of them");
    return;
  }
  for (size_t i = 0; i < photographs.size(); ++i) {
    const std::string file = TagPlace(context.scene, photographs[i]);
    const std::string wrong = FindWrong(context, photographs[i], context.standpoints[i]);
    if (slips[i]) {
      context.Add(
          Advice::Severity::kDetail,
          file,
          wrong.empty() ? "the camera does not see the point that it is said to look at" : wrong,
          std::string("with ") + slips[i]->name + " it would look at the model");
    } else if (!wrong.empty()) {
      context.Add(Advice::Severity::kDetail,
                  file,
                  wrong,
                  "look at x, y, z and i, j, k (x east, y south, z up, in " +
                      UnitName(context.scene.model.unit) +
                      "), and whether it is this photograph's tag");
    } else if (HasMinusBeforeHeight(context, i)) {
      context.Add(Advice::Severity::kDetail,
                  file,
                  "the camera stands below the ground, at z " +
                      FormatNumber(context.standpoints[i].position_in_site.z()),
                  "without the minus it would stand as high as the others");
    }
  }
}

}  // namespace groundglass
