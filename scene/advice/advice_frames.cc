// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Pictures' sides against the frames that their tags speak of.
#include "scene/advice/advice_parts.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// NTSC frames have pixels 1.1 from square; beyond this somebody has turned something.
constexpr double kOddAspect = 1.3;
// Of frames of one lens.
constexpr double kSameAngleDeg = 0.05;
constexpr double kSameShape = 0.03;

bool Suits(double tag_aspect, double picture_aspect) {
  const double ratio = tag_aspect / picture_aspect;
  return ratio <= kOddAspect && ratio >= 1 / kOddAspect;
}

}  // namespace

bool SuitsPicture(const Photograph& photograph) {
  return Suits(photograph.tag.aspect,
               static_cast<double>(photograph.size.width) / photograph.size.height);
}

namespace {

// A photograph with the same view angle whose tag suits this one's picture: `a` is wrong then, and
// `v` is not.
bool HasTwinOfItsShape(const AdviceContext& context, const Photograph& photograph) {
  const double aspect = static_cast<double>(photograph.size.width) / photograph.size.height;
  return std::any_of(context.scene.photographs.begin(),
                     context.scene.photographs.end(),
                     [&](const Photograph& other) {
                       return &other != &photograph && SuitsPicture(other) &&
                              std::abs(other.tag.aspect / aspect - 1) < kSameShape &&
                              std::abs(other.tag.view_angle_deg - photograph.tag.view_angle_deg) <
                                  kSameAngleDeg;
                     });
}

void AdviseOnAspect(const AdviceContext& context, const Photograph& photograph) {
  const double tag_aspect = photograph.tag.aspect;
  const double aspect = static_cast<double>(photograph.size.width) / photograph.size.height;
  if (SuitsPicture(photograph)) return;
  const std::string picture = photograph.image_file.filename().string();
  std::string message = "aspect " + FormatNumber(tag_aspect) + " does not suit " + picture +
                        " of " + std::to_string(photograph.size.width) + " x " +
                        std::to_string(photograph.size.height) + " pixels";
  std::string remedy = "a is width / height of the whole frame: write " +
                       FormatNumber(std::round(1000 * aspect) / 1000);
  if (Suits(tag_aspect, 1 / aspect)) {
    const int orientation = photograph.size.orientation;
    if (orientation >= 5) {
      message += " after the turn that its EXIF asks for (orientation " +
                 std::to_string(orientation) + "), only before it";
      remedy =
          "if the picture lies on its side when it is shown, take the turn out (exiftool "
          "-Orientation=1 -n " +
          picture + "); if it stands upright, write a " +
          FormatNumber(std::round(1000 * aspect) / 1000) +
          " and in v the angle across the upright frame";
    } else if (HasTwinOfItsShape(context, photograph)) {
      remedy += ", as in the other tags with v " + FormatNumber(photograph.tag.view_angle_deg) +
                "; if the picture lies on its side when it is shown, turn it by 90 degrees instead";
    } else {
      message += "; is the picture turned?";
      remedy = "turn it by 90 degrees until it stands as it was taken, or write a " +
               FormatNumber(std::round(1000 * aspect) / 1000) +
               " and in v the angle across the upright frame";
    }
  }
  context.Add(Advice::Severity::kDetail, TagPlace(context.scene, photograph), message, remedy);
}

// The angle across a frame whose long side, up and down, has this one.
double AcrossFrom(double angle_deg, double aspect) {
  return DegreesFromRadians(2 * std::atan(std::tan(RadiansFromDegrees(angle_deg) / 2) * aspect));
}

// An upright photograph with the very view angle of those that lie: v is the angle across, and a
// camera that is turned upright shows less across.
void AdviseOnUprightAngles(const AdviceContext& context) {
  std::vector<std::string> names;
  const Photograph* first = nullptr;
  for (const Photograph& upright : context.scene.photographs) {
    const ViewTag& tag = upright.tag;
    // One that does not suit its own picture is told by itself.
    if (tag.aspect > 0.9 || !SuitsPicture(upright)) continue;
    const bool has_twin = std::any_of(
        context.scene.photographs.begin(), context.scene.photographs.end(), [&](const auto& lying) {
          return std::abs(lying.tag.view_angle_deg - tag.view_angle_deg) < kSameAngleDeg &&
                 std::abs(lying.tag.aspect * tag.aspect - 1) < kSameShape;
        });
    if (!has_twin) continue;
    names.push_back(upright.name);
    if (!first) first = &upright;
  }
  if (!first) return;
  const double angle_deg = first->tag.view_angle_deg;
  context.Add(Advice::Severity::kDetail,
              TagPlace(context.scene, *first),
              "v " + FormatNumber(angle_deg) + " in upright photographs (" + ListNames(names) +
                  ") as in those that lie: it suits as the vertical angle, and v is the "
                  "horizontal one",
              "if the lens was the same, write v " +
                  FormatNumber(std::round(100 * AcrossFrom(angle_deg, first->tag.aspect)) / 100) +
                  " in the upright ones");
}

}  // namespace

void AdviseOnFrames(const AdviceContext& context) {
  for (const Photograph& photograph : context.scene.photographs) {
    AdviseOnAspect(context, photograph);
  }
  AdviseOnUprightAngles(context);
}

}  // namespace groundglass
