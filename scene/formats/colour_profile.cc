// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colour_profile.h"

#include "scene/error.h"

#include <lcms2.h>
#include <tbb/parallel_for.h>

#include <cstdlib>
#include <limits>

namespace groundglass {
namespace {

// LittleCMS' handles, closed with their owner.
struct ProfileCloser {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, ProfileCloser>;
struct TransformDeleter {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Transform = std::unique_ptr<void, TransformDeleter>;

const char* KindOf(cmsColorSpaceSignature space) {
  switch (space) {
    case cmsSigRgbData:
      return "RGB";
    case cmsSigGrayData:
      return "grey";
    case cmsSigCmykData:
      return "CMYK";
    case cmsSigLabData:
      return "Lab";
    default:
      return "another kind of image";
  }
}

const char* NameOf(PixelKind kind) {
  return kind == PixelKind::kInks ? "CMYK" : kind == PixelKind::kGrey ? "grey" : "RGB";
}

// Four channels of inks become three, row by row.
template <typename Code, typename Convert>
void ReplaceInks(Raster<Code>& colour, const Convert& convert_row) {
  Raster<Code> srgb(colour.width, colour.height, 3);
  tbb::parallel_for(0, colour.height, [&](int y) { convert_row(colour.At(0, y), srgb.At(0, y)); });
  colour = std::move(srgb);
}

// In place. Transforms have no cache of their own, so that threads may share one.
template <typename Code>
void TransformRows(void* transform, cmsColorSpaceSignature space, Raster<Code>& colour) {
  if (space == cmsSigCmykData) {
    ReplaceInks(colour, [&](const Code* inks, Code* srgb) {
      cmsDoTransform(transform, inks, srgb, colour.width);
    });
    return;
  }
  const bool is_grey = space == cmsSigGrayData;
  tbb::parallel_for(0, colour.height, [&](int y) {
    Code* row = colour.At(0, y);
    if (is_grey) {
      for (int x = 1; x < colour.width; ++x) row[x] = row[3 * x];
      const std::vector<Code> grey(row, row + colour.width);
      cmsDoTransform(transform, grey.data(), row, colour.width);
    } else {
      cmsDoTransform(transform, row, row, colour.width);
    }
  });
}

template <typename Code>
void MixOverprints(Raster<Code>& colour) {
  // Bit by bit: cyan, magenta, yellow, black. Ghostscript's public SWOP profile, relative
  // colorimetric with black point compensation.
  constexpr uint8_t kOverprints[16][3] = {{255, 255, 255},
                                          {0, 174, 239},
                                          {236, 0, 140},
                                          {46, 48, 146},
                                          {255, 242, 0},
                                          {0, 166, 80},
                                          {237, 28, 36},
                                          {54, 54, 57},
                                          {35, 31, 32},
                                          {0, 14, 35},
                                          {35, 0, 0},
                                          {0, 0, 1},
                                          {27, 26, 0},
                                          {0, 18, 0},
                                          {34, 0, 0},
                                          {0, 0, 0}};
  constexpr float kFull = std::numeric_limits<Code>::max();
  ReplaceInks(colour, [&](const Code* inks, Code* srgb) {
    for (int x = 0; x < colour.width; ++x, inks += 4, srgb += 3) {
      float sum[3] = {};
      for (int print = 0; print < 16; ++print) {
        float area = 1;
        for (int ink = 0; ink < 4; ++ink) {
          const float covered = static_cast<float>(inks[ink]) / kFull;
          area *= (print >> ink & 1) != 0 ? covered : 1 - covered;
        }
        for (int c = 0; c < 3; ++c) sum[c] += area * kOverprints[print][c];
      }
      for (int c = 0; c < 3; ++c) srgb[c] = static_cast<Code>(sum[c] / 255 * kFull + 0.5f);
    }
  });
}

}  // namespace

struct ColourProfile::Impl {
  cmsColorSpaceSignature space = cmsSigRgbData;  // of the profile's numbers
  Transform srgb8_from_file;
  Transform srgb16_from_file;
};

ColourProfile::ColourProfile(std::span<const uint8_t> icc,
                             PixelKind kind,
                             const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>()) {
  const Profile from(cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size())));
  const std::string remedy = "; convert the image to sRGB, or remove its profile";
  if (!from) throw Error(file, "its ICC profile is damaged" + remedy);
  impl_->space = cmsGetColorSpace(from.get());
  // Grey pixels may have a profile for colours: equal parts of each.
  const bool suits = kind == PixelKind::kInks
                         ? impl_->space == cmsSigCmykData
                         : impl_->space == cmsSigRgbData ||
                               (impl_->space == cmsSigGrayData && kind == PixelKind::kGrey);
  if (!suits) {
    throw Error(file,
                std::string("its ICC profile is for ") + KindOf(impl_->space) +
                    ", its pixels are " + NameOf(kind) + remedy);
  }
  const Profile to(cmsCreate_sRGBProfile());
  const auto make =
      [&](cmsUInt32Number grey_type, cmsUInt32Number ink_type, cmsUInt32Number rgb_type) {
        return Transform(cmsCreateTransform(from.get(),
                                            impl_->space == cmsSigGrayData   ? grey_type
                                            : impl_->space == cmsSigCmykData ? ink_type
                                                                             : rgb_type,
                                            to.get(),
                                            rgb_type,
                                            INTENT_RELATIVE_COLORIMETRIC,
                                            cmsFLAGS_NOCACHE | cmsFLAGS_BLACKPOINTCOMPENSATION));
      };
  impl_->srgb8_from_file = make(TYPE_GRAY_8, TYPE_CMYK_8, TYPE_RGB_8);
  impl_->srgb16_from_file = make(TYPE_GRAY_16, TYPE_CMYK_16, TYPE_RGB_16);
  if (!impl_->srgb8_from_file || !impl_->srgb16_from_file) {
    throw Error(file, "its ICC profile does not say what its colours are" + remedy);
  }
  if (impl_->space == cmsSigCmykData) return;
  // The colours of a cube: a profile that leaves them where they are is sRGB by any name.
  constexpr int kSteps = 9;
  Image8 cube(kSteps * kSteps * kSteps, 1, 3);
  for (int i = 0; i < cube.width; ++i) {
    const int steps[] = {i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps};
    for (int c = 0; c < 3; ++c) {
      cube.At(i, 0)[c] =
          static_cast<uint8_t>(255 * steps[impl_->space == cmsSigGrayData ? 0 : c] / (kSteps - 1));
    }
  }
  Image8 converted = cube;
  ToSrgb(converted);
  is_srgb_ = true;
  for (size_t i = 0; i < cube.values.size(); ++i) {
    is_srgb_ = is_srgb_ && std::abs(cube.values[i] - converted.values[i]) <= 1;
  }
}

ColourProfile::~ColourProfile() = default;
ColourProfile::ColourProfile(ColourProfile&&) noexcept = default;
ColourProfile& ColourProfile::operator=(ColourProfile&&) noexcept = default;

void ColourProfile::ToSrgb(Image8& colour) const {
  TransformRows(impl_->srgb8_from_file.get(), impl_->space, colour);
}

void ColourProfile::ToSrgb(Image16& colour) const {
  TransformRows(impl_->srgb16_from_file.get(), impl_->space, colour);
}

void InksToSrgb(Image8& colour) { MixOverprints(colour); }
void InksToSrgb(Image16& colour) { MixOverprints(colour); }

}  // namespace groundglass
