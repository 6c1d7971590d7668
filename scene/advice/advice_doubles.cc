// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Photographs that are there twice, and tags that were copied from another's.
#include "scene/advice/advice_parts.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "scene/reduce.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

namespace groundglass {
namespace {

bool IsSameFile(const Photograph& a, const Photograph& b) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(a.image_file, ignored);
  if (ignored || size != std::filesystem::file_size(b.image_file, ignored) || ignored) return false;
  return ReadFileBytes(a.image_file) == ReadFileBytes(b.image_file);
}

bool HasSameNumbers(const ViewTag& a, const ViewTag& b) {
  return a.position_in_site == b.position_in_site && a.lookat_in_site == b.lookat_in_site;
}

// How alike two pictures are, much reduced: 1 for one view from one tripod.
double Likeness(const Photograph& a, const Photograph& b) {
  constexpr int kSize = 24;
  const Image8 first = ReducedInLight(ReadSrgb8(a.image_file), kSize, kSize);
  const Image8 second = ReducedInLight(ReadSrgb8(b.image_file), kSize, kSize);
  double sum_first = 0;
  double sum_second = 0;
  double squares_first = 0;
  double squares_second = 0;
  double products = 0;
  const double count = static_cast<double>(first.values.size());
  for (size_t i = 0; i < first.values.size(); ++i) {
    const double x = first.values[i];
    const double y = second.values[i];
    sum_first += x;
    sum_second += y;
    squares_first += x * x;
    squares_second += y * y;
    products += x * y;
  }
  const double variances = (squares_first - sum_first * sum_first / count) *
                           (squares_second - sum_second * sum_second / count);
  return variances > 0 ? (products - sum_first * sum_second / count) / std::sqrt(variances) : 1;
}

// Two exposures from one stand have one tag; two pictures of different things have not.
bool ShowsTheSame(const Photograph& a, const Photograph& b) {
  constexpr double kAlike = 0.8;
  try {
    return Likeness(a, b) > kAlike;
  } catch (const Error&) {
    return true;  // told by those who read them for their own sake
  }
}

}  // namespace

void AdviseOnDoubles(const AdviceContext& context) {
  const std::vector<Photograph>& photographs = context.scene.photographs;
  for (size_t i = 0; i < photographs.size(); ++i) {
    const Photograph& later = photographs[i];
    for (size_t k = 0; k < i; ++k) {
      const Photograph& earlier = photographs[k];
      if (IsSameFile(later, earlier)) {
        context.Add(Advice::Severity::kDetail,
                    later.image_file.string(),
                    "this is the very same picture as " + earlier.image_file.filename().string(),
                    "take one of them out, or put the picture here that was meant");
        break;
      }
      if (HasSameNumbers(later.tag, earlier.tag) && !ShowsTheSame(later, earlier)) {
        context.Add(Advice::Severity::kDetail,
                    TagPlace(context.scene, later),
                    "has the position and look-at point of " + earlier.name +
                        ", and the two pictures show different things",
                    "write its own numbers; one of the two was copied");
        break;
      }
    }
  }
}

}  // namespace groundglass
