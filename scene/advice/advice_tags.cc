// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Each tag by itself: where no camera can have stood, and the slip of the pen that explains it.
#include "scene/advice/advice_parts.h"
#include "scene/quantile.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace groundglass {
namespace {

constexpr std::array<TagKey, 3> kLookatKeys = {TagKey::kI, TagKey::kJ, TagKey::kK};

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

// The slips that explain a tag which cannot be right. A single number may make a wrong tag look
// right by chance, so the corrected one must meet the model where it says.
std::vector<MeantTag> FindSlips(const AdviceContext& context,
                                const Photograph& photograph,
                                const Standpoint& as_read) {
  std::vector<MeantTag> explain;
  if (!IsLookatWrong(as_read)) return explain;
  for (const MeantTag& meant : FindMeantTags(photograph.tag)) {
    if (meant.is_of_digits || ChangesWhatIsNotWritten(context.scene, meant)) continue;
    const Standpoint standpoint = Locate(context, photograph, meant.tag);
    if (IsPlausible(standpoint) && standpoint.front_share > 0.7 && standpoint.lookat_error < 0.02) {
      explain.push_back(meant);
    }
  }
  return explain;
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

// The slips that bring one number to what the other tags have; `is_usual` judges it.
std::vector<MeantTag> FindSlipsOf(TagKey key,
                                  const ViewTag& tag,
                                  const std::function<bool(double)>& is_usual) {
  std::vector<MeantTag> explain;
  for (const MeantTag& meant : FindMeantTags(tag)) {
    const auto num_changed = std::count(meant.is_changed.begin(), meant.is_changed.end(), true);
    if (num_changed != 1 || !meant.is_changed[static_cast<size_t>(key)]) continue;
    if (is_usual(GetTagValue(meant.tag, key))) explain.push_back(meant);
  }
  return explain;
}

// Most of the other tags' numbers, if they are within `alike` times of each other; else 0. The
// numbers: above 0.
double FindCommon(const std::vector<double>& others, double alike, double most) {
  constexpr size_t kFewest = 4;
  if (others.size() < kFewest) return 0;
  const double middle = UpperMedian(others);
  const auto num_alike = std::count_if(others.begin(), others.end(), [&](double other) {
    return other <= alike * middle && other * alike >= middle;
  });
  return static_cast<double>(num_alike) >= most * static_cast<double>(others.size()) ? middle : 0;
}

// A camera that stands far lower than the others, who stand all alike, if a slip explains it.
// Higher ones stand at windows and on roofs.
TagDoubt DoubtHeight(const AdviceContext& context, size_t index) {
  constexpr double kAlike = 1.4;
  constexpr double kMost = 0.6;
  constexpr double kMuchLower = 0.4;
  const double foot = context.bounds.min.z();
  const auto height_of = [&](size_t i) {
    return context.standpoints[i].position_in_site.z() - foot;
  };
  std::vector<double> others;
  for (size_t i = 0; i < context.standpoints.size(); ++i) {
    if (i != index) others.push_back(height_of(i));
  }
  const double common = FindCommon(others, kAlike, kMost);
  if (!(common > 0) || height_of(index) < 0 || height_of(index) > kMuchLower * common) return {};
  TagDoubt doubt;
  doubt.is_only_unusual = true;
  doubt.meant = FindSlipsOf(TagKey::kZ, context.scene.photographs[index].tag, [&](double z) {
    return z - foot <= kAlike * common && (z - foot) * kAlike >= common;
  });
  if (doubt.meant.empty()) return {};
  const LengthUnit unit = context.scene.model.unit;
  doubt.wrong = "the camera stands " + FormatLength(height_of(index), unit) +
                " above the model's foot, most others about " + FormatLength(common, unit);
  return doubt;
}

// A view angle unlike that of nearly all others, if a slip brings it there.
TagDoubt DoubtAngle(const AdviceContext& context, size_t index) {
  constexpr double kSame = 1.001;
  constexpr double kMost = 0.8;
  const std::vector<Photograph>& photographs = context.scene.photographs;
  const ViewTag& tag = photographs[index].tag;
  std::vector<double> others;
  for (size_t i = 0; i < photographs.size(); ++i) {
    if (i != index) others.push_back(photographs[i].tag.view_angle_deg);
  }
  const double common = FindCommon(others, kSame, kMost);
  const auto is_common = [&](double v) { return v <= kSame * common && v * kSame >= common; };
  if (!(common > 0) || is_common(tag.view_angle_deg)) return {};
  TagDoubt doubt;
  doubt.is_only_unusual = true;
  doubt.meant = FindSlipsOf(TagKey::kV, tag, is_common);
  if (doubt.meant.empty()) return {};
  doubt.wrong = "v is " + FormatNumber(tag.view_angle_deg) + ", and " + FormatNumber(common) +
                " in the other tags";
  return doubt;
}

TagDoubt DoubtTag(const AdviceContext& context, size_t index) {
  const Photograph& photograph = context.scene.photographs[index];
  TagDoubt doubt;
  doubt.wrong = FindWrong(context, photograph, context.standpoints[index]);
  doubt.meant = FindSlips(context, photograph, context.standpoints[index]);
  doubt.remedy = std::string("look at x, y, z and ") +
                 (context.scene.tags_have_angles ? "yaw, pitch" : "i, j, k") +
                 " (x east, y south, z up, in " + UnitName(context.scene.model.unit) +
                 "), and whether it is this photograph's tag";
  if (doubt.wrong.empty() && !doubt.meant.empty()) {
    doubt.wrong = "the camera does not see the point that it is said to look at";
    doubt.is_only_unusual = true;
  }
  if (doubt.wrong.empty() && HasMinusBeforeHeight(context, index)) {
    doubt.wrong = "the camera stands below the ground, at z " +
                  FormatNumber(context.standpoints[index].position_in_site.z());
    doubt.remedy = "without the minus it would stand as high as the others";
  }
  if (doubt.wrong.empty()) doubt = DoubtHeight(context, index);
  if (doubt.wrong.empty()) doubt = DoubtAngle(context, index);
  return doubt;
}

}  // namespace

bool ChangesWhatIsNotWritten(const Scene& scene, const MeantTag& meant) {
  if (!scene.tags_have_angles) return false;
  return std::any_of(std::begin(kLookatKeys), std::end(kLookatKeys), [&](TagKey key) {
    return meant.is_changed[static_cast<size_t>(key)];
  });
}

std::vector<TagDoubt> FindTagDoubts(const AdviceContext& context) {
  const size_t total = context.scene.photographs.size();
  std::vector<TagDoubt> doubts;
  for (size_t i = 0; i < total; ++i) doubts.push_back(DoubtTag(context, i));
  // The same slip in most tags is how all of them were written.
  for (const TagSlip& slip : kTagSlips) {
    const size_t count =
        static_cast<size_t>(std::count_if(doubts.begin(), doubts.end(), [&](const auto& doubt) {
          return !doubt.meant.empty() && doubt.meant.front().slip == slip.name;
        }));
    if (count < 3 || 2 * count < total) continue;
    context.Add(Advice::Severity::kScene,
                (context.scene.folder / "views").string(),
                std::to_string(count) + " of " + std::to_string(total) +
                    " tags do not look at the model where they say, and would with " + slip.name,
                "in view files x counts east, y south and z up: change all of them");
    return {};
  }
  return doubts;
}

void AdviseOnTags(const AdviceContext& context, const std::vector<TagDoubt>& doubts) {
  constexpr size_t kMostNamed = 2;
  for (size_t i = 0; i < doubts.size(); ++i) {
    const TagDoubt& doubt = doubts[i];
    if (doubt.wrong.empty()) continue;
    std::string remedy = doubt.remedy;
    for (size_t k = 0; k < std::min(kMostNamed, doubt.meant.size()); ++k) {
      const std::string& slip = doubt.meant[k].slip;
      remedy =
          k == 0 ? "with " + slip + " it would look at the model" : remedy + ", or with " + slip;
    }
    context.Add(Advice::Severity::kDetail,
                TagPlace(context.scene, context.scene.photographs[i]),
                doubt.wrong,
                remedy);
  }
}

}  // namespace groundglass
