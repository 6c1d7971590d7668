// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Pictures' sides against the frames that their tags speak of.
#include "scene/advice/advice_parts.h"
#include "scene/frames.h"
#include "scene/quantile.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {
namespace {

// NTSC frames have pixels 1.1 from square; beyond this somebody has turned something.
constexpr double kOddAspect = 1.3;
// Of frames of one lens.
constexpr double kSameAngleDeg = 0.05;
constexpr double kSameShape = 0.03;
// A half turn; lenses of less than 3.2 degrees are of 640 mm and more.
constexpr double kLargestInRadians = 3.2;

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

double PictureAspect(const Photograph& photograph) {
  return static_cast<double>(photograph.size.width) / photograph.size.height;
}

// How much wider than high each pixel would be.
double PixelShape(const Photograph& photograph) {
  return photograph.tag.aspect / PictureAspect(photograph);
}

// Frames whose pixels are oblong by design: digital video of NTSC and PAL, tapes of wide pictures.
bool IsVideoFrame(const ImageSize& size) {
  constexpr std::array<std::array<int, 2>, 18> kFrames = {{{720, 480},
                                                           {720, 486},
                                                           {720, 576},
                                                           {704, 480},
                                                           {704, 576},
                                                           {702, 576},
                                                           {640, 480},
                                                           {768, 576},
                                                           {544, 480},
                                                           {544, 576},
                                                           {480, 480},
                                                           {480, 576},
                                                           {352, 480},
                                                           {352, 576},
                                                           {352, 240},
                                                           {352, 288},
                                                           {1440, 1080},
                                                           {960, 720}}};
  return std::any_of(kFrames.begin(), kFrames.end(), [&](const auto& frame) {
    return size.width == frame[0] && size.height == frame[1];
  });
}

bool HasSameSize(const ImageSize& a, const ImageSize& b) {
  return (a.width == b.width && a.height == b.height) ||
         (a.width == b.height && a.height == b.width);
}

// The shape of nearly all other photographs' pixels; nothing where they do not agree.
std::optional<double> CommonPixelShape(const Scene& scene, const Photograph& photograph) {
  constexpr size_t kFewestOthers = 2;
  constexpr double kMost = 0.6;
  constexpr double kAlike = 0.02;
  std::vector<double> others;
  for (const Photograph& other : scene.photographs) {
    if (&other != &photograph) others.push_back(PixelShape(other));
  }
  if (others.size() < kFewestOthers) return std::nullopt;
  const double middle = UpperMedian(others);
  const auto num_alike = std::count_if(others.begin(), others.end(), [&](double other) {
    return std::abs(other / middle - 1) < kAlike;
  });
  if (static_cast<double>(num_alike) < kMost * static_cast<double>(others.size())) {
    return std::nullopt;
  }
  return middle;
}

}  // namespace

bool SeemsCropped(const Scene& scene, const Photograph& photograph) {
  // Scans of mounted slides are trimmed by a few hundredths.
  constexpr double kTrimmed = 1.06;
  // So many of one size are what a scanner or a camera makes.
  constexpr int kFewestOfAFormat = 3;
  const std::optional<double> common = CommonPixelShape(scene, photograph);
  if (!common || IsVideoFrame(photograph.size)) return false;
  const double ratio = PixelShape(photograph) / *common;
  if (ratio < kTrimmed && ratio > 1 / kTrimmed) return false;
  // Turned by 90 degrees: told as that.
  const double turned =
      PixelShape(photograph) * PictureAspect(photograph) * PictureAspect(photograph) / *common;
  if (turned < kTrimmed && turned > 1 / kTrimmed) return false;
  const auto num_of_its_size = std::count_if(
      scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& other) {
        return HasSameSize(other.size, photograph.size) &&
               std::abs(PixelShape(other) / PixelShape(photograph) - 1) < 0.02;
      });
  return num_of_its_size < kFewestOfAFormat;
}

namespace {

// The frame that it may have been cut from: of a photograph with the same `a` and `v` whose `a`
// suits it, larger than this one. Nothing where these have several sizes.
const Photograph* FindWholeFrame(const Scene& scene, const Photograph& cropped) {
  const Photograph* found = nullptr;
  for (const Photograph& whole : scene.photographs) {
    if (std::abs(whole.tag.aspect / cropped.tag.aspect - 1) < kSameShape &&
        std::abs(whole.tag.view_angle_deg - cropped.tag.view_angle_deg) < kSameAngleDeg &&
        !SeemsCropped(scene, whole) && whole.size.width >= cropped.size.width &&
        whole.size.height >= cropped.size.height) {
      if (found && !HasSameSize(found->size, whole.size)) return nullptr;
      found = &whole;
    }
  }
  return found;
}

// What was cut off on one side moves the middle of the picture off the middle of the frame.
std::string ShiftOfACrop(const ImageSize& cropped, const ImageSize& whole) {
  const auto shift = [&](int whole_px, int left_px) {
    return FormatNumber(std::round(1000 * (whole_px - left_px) / 2.0 / cropped.width) / 1000);
  };
  std::string remedy = "; if it was cut more on one side, ";
  const bool is_narrower = whole.width > cropped.width;
  const bool is_lower = whole.height > cropped.height;
  if (is_narrower) {
    const std::string most = shift(whole.width, cropped.width);
    remedy += "shift_x too, from -" + most + " (all of it on the left) to " + most;
  }
  if (is_lower) {
    const std::string most = shift(whole.height, cropped.height);
    remedy += std::string(is_narrower ? ", and " : "") + "shift_y" + (is_narrower ? "" : " too") +
              ", from -" + most + " (all of it at the top) to " + most;
  }
  return remedy + ", or a larger sigma_shift";
}

void AdviseOnCrop(const AdviceContext& context, const Photograph& photograph) {
  const double pixel_shape = *CommonPixelShape(context.scene, photograph);
  const auto pixels = [](const Photograph& one) {
    return std::to_string(one.size.width) + " x " + std::to_string(one.size.height) + " pixels";
  };
  const double aspect = PictureAspect(photograph) * pixel_shape;
  const std::string own = FormatNumber(std::round(1000 * aspect) / 1000);
  const bool is_square = std::abs(pixel_shape - 1) < kSameShape;
  const std::string message =
      "a " + FormatNumber(photograph.tag.aspect) + " does not suit " + pixels(photograph) + " (" +
      FormatNumber(std::round(100 * aspect) / 100) +
      (is_square ? " for square pixels" : " for pixels as the other photographs have them") +
      "): a crop?";
  std::string remedy =
      "a and v are of what the picture shows, not of the whole frame: write a " + own;
  if (const Photograph* whole = FindWholeFrame(context.scene, photograph)) {
    const double half = std::tan(RadiansFromDegrees(photograph.tag.view_angle_deg) / 2) *
                        photograph.size.width / whole->size.width;
    remedy += " and, if it was cut from " + pixels(*whole) + " as those of " + whole->name +
              " and not made smaller, v " +
              FormatNumber(std::round(10 * DegreesFromRadians(2 * std::atan(half))) / 10) +
              ", or put the whole picture there";
    remedy += ShiftOfACrop(photograph.size, whole->size);
  } else {
    remedy +=
        " and in v the angle across what is left, or put the whole picture there; if it was "
        "cut more on one side, shift_x and shift_y too, or a larger sigma_shift";
  }
  context.Add(Advice::Severity::kDetail, TagPlace(context.scene, photograph), message, remedy);
}

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
  if (SeemsCropped(context.scene, photograph)) {
    AdviseOnCrop(context, photograph);
    return;
  }
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
          picture + "); if it is shown the right way up, write a " +
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

// Angles that only the longest lenses have, in every tag.
void AdviseOnRadians(const AdviceContext& context) {
  const std::vector<Photograph>& photographs = context.scene.photographs;
  const bool are_all = std::all_of(photographs.begin(), photographs.end(), [](const auto& one) {
    return one.tag.view_angle_deg < kLargestInRadians;
  });
  if (!are_all || photographs.empty()) return;
  const double v = photographs.front().tag.view_angle_deg;
  context.Add(
      Advice::Severity::kScene,
      context.scene.folder.string(),
      "v is " + FormatNumber(v) + " in " + photographs.front().name +
          " and as little in all others: an angle in radians, it seems",
      "write degrees: v " + FormatNumber(std::round(100 * DegreesFromRadians(v)) / 100) + " there");
}

// The frame's height / width in every tag, whichever way the pictures lie.
bool AdviseOnInvertedAspects(const AdviceContext& context) {
  constexpr size_t kFewest = 3;
  const std::vector<Photograph>& photographs = context.scene.photographs;
  const bool are_all = std::all_of(photographs.begin(), photographs.end(), [](const auto& one) {
    return one.size.orientation < 5 && !SuitsPicture(one) &&
           Suits(one.tag.aspect, 1 / PictureAspect(one));
  });
  if (photographs.size() < kFewest || !are_all) return false;
  const double aspect = photographs.front().tag.aspect;
  context.Add(Advice::Severity::kScene,
              context.scene.folder.string(),
              "a is height / width in every tag (" + FormatNumber(aspect) + " in " +
                  photographs.front().name + "), or every picture is turned on its side",
              "a is width / height: write " + FormatNumber(std::round(1000 / aspect) / 1000) +
                  " there; or turn the pictures");
  return true;
}

// A picture too small for any edge to be placed: a thumbnail in place of the photograph.
void AdviseOnThumbnail(const AdviceContext& context, const Photograph& photograph) {
  constexpr int kSmallest_px = 100;
  if (std::max(photograph.size.width, photograph.size.height) >= kSmallest_px) return;
  context.Add(Advice::Severity::kDetail,
              photograph.image_file.string(),
              "has only " + std::to_string(photograph.size.width) + " x " +
                  std::to_string(photograph.size.height) +
                  " pixels, too few to find the model's edges in",
              "put the photograph itself there: this is a thumbnail, it seems");
}

}  // namespace

void AdviseOnFrames(const AdviceContext& context) {
  AdviseOnRadians(context);
  for (const Photograph& photograph : context.scene.photographs) {
    AdviseOnThumbnail(context, photograph);
  }
  if (AdviseOnInvertedAspects(context)) return;
  for (const Photograph& photograph : context.scene.photographs) {
    AdviseOnAspect(context, photograph);
  }
  AdviseOnUprightAngles(context);
}

}  // namespace groundglass
