// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/memory_plan.h"

#include "invrender/cells.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kMegabyte = 1e6;
// The program and its libraries, before it has read anything.
constexpr double kProgramBytes = 200 * kMegabyte;
// A page's texel: colour and provenance; charts do not fill their pages.
constexpr double kPageBytes = 5 * 1.2;
// What 16 bits add to it, and to a chart.
constexpr double kWidePageBytes = 6 * 1.2;
constexpr double kWideChartBytes = 6;
// The same again while a chart is laid out, with states, seams' graph and so on.
constexpr double kChartBytes = 31;
// Choosing, for each cell and photograph.
constexpr double kChoiceBytes = 56;
// Decoded photographs: all of them, as far as this share of the limit goes, but at least a few.
constexpr double kPhotoShare = 0.3;
constexpr double kFewPhotos = 3;
// A band of a chart's texels with their look-ups.
constexpr double kBandBytes = 80 * kMegabyte;
// Texels this much longer are no texture any more.
constexpr double kLargestScale = 8;

// Photographs are kept at an eighth of their sides at least.
constexpr int kMostDropped = 3;
// What decoding takes, of what a photograph takes once it is decoded.
constexpr double kDecodingShare = 1.75;
// Texels this much longer are a fair price for dropping a level.
constexpr double kWorthIt = 1.1;

}  // namespace

MemoryPlan PlanMemory(const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& photos,
                      size_t max_bytes,
                      int bits,
                      bool may_drop) {
  const bool is_wide = bits == 16;
  constexpr double kCellsOfTexel = 1.0 / (kCellTexels * kCellTexels);
  double all_charts = 0;
  double largest_chart = 0;
  for (size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].texel_size <= 0) continue;
    const double num_texels = static_cast<double>(charts[i].width_texels) * charts[i].height_texels;
    const auto num_views =
        static_cast<double>(FindPhotosOfChart(charts[i], static_cast<int>(i), photos).size());
    const double cells = num_texels * kCellsOfTexel * num_views;
    all_charts +=
        num_texels * (kPageBytes + (is_wide ? kWidePageBytes : 0)) + cells * sizeof(CellView);
    largest_chart = std::max(
        largest_chart,
        num_texels * (kChartBytes + (is_wide ? kWideChartBytes : 0)) + cells * kChoiceBytes);
  }
  double fixed = kProgramBytes + kBandBytes;
  double largest_photo = 0;
  double all_photos = 0;
  for (const PreparedPhoto& photo : photos) {
    fixed += static_cast<double>(photo.NumMaskBytes());
    largest_photo = std::max(largest_photo, photo.NumPixelBytes());
    all_photos += photo.NumPixelBytes();
  }
  const auto limit = static_cast<double>(max_bytes);
  const double needed = all_charts + largest_chart;
  MemoryPlan plan;
  plan.texel_scale = 1e9;
  double least = 1e300;
  for (int num_dropped = 0; num_dropped <= (may_drop ? kMostDropped : 0); ++num_dropped) {
    const double shrink = std::pow(4.0, num_dropped);
    const double kept = all_photos / shrink;
    if (num_dropped > 0 && 4 * kept <= kPhotoShare * limit) break;  // they fit as they are
    // Even a photograph of which only coarse levels are kept is decoded whole.
    const double decoding = num_dropped > 0 ? kDecodingShare * largest_photo : 0;
    const double taken =
        fixed + decoding +
        std::min(kept, std::max(kPhotoShare * limit, kFewPhotos * largest_photo / shrink));
    const double left = limit - taken;
    least = std::min(least, taken + needed / (kLargestScale * kLargestScale));
    if (left <= 0) continue;
    const double scale = std::max({1.0, std::sqrt(needed / left), std::pow(2.0, num_dropped)});
    // A little is worth having all photographs at hand.
    if (scale > kWorthIt * plan.texel_scale) continue;
    plan.texel_scale = scale;
    plan.num_dropped = num_dropped;
    // One more is in memory while it takes another's place.
    const double spare = left - needed / (scale * scale);
    const double for_photos = std::min(kept, kPhotoShare * limit) + std::max(0.0, spare);
    plan.photo_bytes = static_cast<size_t>(std::max(0.0, for_photos - largest_photo / shrink));
  }
  if (plan.texel_scale > kLargestScale) {
    throw Error("these photographs need at least " +
                std::to_string(static_cast<long>(std::ceil(least / kMegabyte))) +
                " MB of memory, the limit is " +
                std::to_string(static_cast<long>(limit / kMegabyte)));
  }
  return plan;
}

}  // namespace groundglass
