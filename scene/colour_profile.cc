// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/colour_profile.h"

#include "scene/error.h"

#include <lcms2.h>
#include <tbb/parallel_for.h>

#include <cstdlib>

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

// The row in place. Transforms have no cache of their own, so that threads may share one.
template <typename Code>
void TransformRows(void* transform, bool is_grey, Raster<Code>& colour) {
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

}  // namespace

struct ColourProfile::Impl {
  bool is_grey = false;  // the profile's numbers
  Transform srgb8_from_file;
  Transform srgb16_from_file;
};

ColourProfile::ColourProfile(std::span<const uint8_t> icc,
                             bool is_grey,
                             const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>()) {
  const Profile from(cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size())));
  const std::string remedy = "; convert the image to sRGB, or remove its profile";
  if (!from) throw Error(file, "its ICC profile is damaged" + remedy);
  const cmsColorSpaceSignature space = cmsGetColorSpace(from.get());
  impl_->is_grey = space == cmsSigGrayData;
  if ((space != cmsSigRgbData && space != cmsSigGrayData) || (impl_->is_grey && !is_grey)) {
    throw Error(file,
                std::string("its ICC profile is for ") + KindOf(space) + ", its pixels are " +
                    (is_grey ? "grey" : "RGB") + remedy);
  }
  const Profile to(cmsCreate_sRGBProfile());
  const auto make = [&](cmsUInt32Number grey_type, cmsUInt32Number rgb_type) {
    return Transform(cmsCreateTransform(from.get(),
                                        impl_->is_grey ? grey_type : rgb_type,
                                        to.get(),
                                        rgb_type,
                                        INTENT_RELATIVE_COLORIMETRIC,
                                        cmsFLAGS_NOCACHE | cmsFLAGS_BLACKPOINTCOMPENSATION));
  };
  impl_->srgb8_from_file = make(TYPE_GRAY_8, TYPE_RGB_8);
  impl_->srgb16_from_file = make(TYPE_GRAY_16, TYPE_RGB_16);
  if (!impl_->srgb8_from_file || !impl_->srgb16_from_file) {
    throw Error(file, "its ICC profile does not say what its colours are" + remedy);
  }
  // The colours of a cube: a profile that leaves them where they are is sRGB by any name.
  constexpr int kSteps = 9;
  Image8 cube(kSteps * kSteps * kSteps, 1, 3);
  for (int i = 0; i < cube.width; ++i) {
    const int steps[] = {i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps};
    for (int c = 0; c < 3; ++c) {
      cube.At(i, 0)[c] = static_cast<uint8_t>(255 * steps[impl_->is_grey ? 0 : c] / (kSteps - 1));
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
  TransformRows(impl_->srgb8_from_file.get(), impl_->is_grey, colour);
}

void ColourProfile::ToSrgb(Image16& colour) const {
  TransformRows(impl_->srgb16_from_file.get(), impl_->is_grey, colour);
}

}  // namespace groundglass
