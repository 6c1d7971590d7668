// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/plan/memory_plan.h"

#include "invrender/measure/texel_blocks.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// What the program takes, measured; none of it decides what a texel looks like.
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
// Choosing, for each block and photograph.
constexpr double kChoiceBytes = 56;
// A band of a chart's texels with their look-ups.
constexpr double kBandBytes = 80 * kMegabyte;
// What reading, masking and writing the mask of a photograph take for a pixel, in 8 bits.
constexpr double kReadingBytes = 12;
// A chart and how many photographs see it.
struct SeenChart {
  double width = 0;  // texels of the size that the photographs allow
  double height = 0;
  double num_views = 0;
};

std::vector<SeenChart> CountViews(const std::vector<Chart>& charts,
                                  const std::vector<PreparedPhoto>& photos) {
  std::vector<SeenChart> seen;
  for (size_t i = 0; i < charts.size(); ++i) {
    const Chart& chart = charts[i];
    if (chart.texel_size <= 0) continue;
    const std::vector<int> views = FindPhotosOfChart(chart, static_cast<int>(i), photos);
    seen.push_back({chart.width / chart.texel_size,
                    chart.height / chart.texel_size,
                    static_cast<double>(views.size())});
  }
  return seen;
}

double NumBlocks(double width_texels, double height_texels) {
  return (std::floor(width_texels / kBlockTexels) + 1) *
         (std::floor(height_texels / kBlockTexels) + 1);
}

double WorkBytes(double width_texels, double height_texels, double num_views, int bits) {
  return width_texels * height_texels * (kChartBytes + (bits == 16 ? kWideChartBytes : 0)) +
         NumBlocks(width_texels, height_texels) * num_views * kChoiceBytes;
}

// What pages, blocks and the largest chart at work take, with texels so many times as long.
struct ChartsBytes {
  double all = 0;
  double largest = 0;
  double Sum() const { return all + largest; }
};
ChartsBytes BytesAtScale(const std::vector<SeenChart>& charts,
                         double scale,
                         const PageOptions& pages) {
  const double page_bytes = kPageBytes + (pages.bits == 16 ? kWidePageBytes : 0);
  const double gutters = 2 * pages.gutter_texels;
  ChartsBytes bytes;
  for (const SeenChart& chart : charts) {
    const double width = std::ceil(chart.width / scale);
    const double height = std::ceil(chart.height / scale);
    bytes.all += (width + gutters) * (height + gutters) * page_bytes +
                 NumBlocks(width, height) * chart.num_views * sizeof(BlockView);
    bytes.largest = std::max(bytes.largest, WorkBytes(width, height, chart.num_views, pages.bits));
  }
  return bytes;
}

class Planner {
 public:
  Planner(const std::vector<Chart>& charts,
          const std::vector<PreparedPhoto>& photos,
          const PageOptions& pages,
          const MemoryOptions& options)
      : pages_(pages), options_(options), limit_(options.max_memory_mb * kMegabyte) {
    charts_ = CountViews(charts, photos);
    for (const PreparedPhoto& photo : photos) {
      all_photos_ += photo.NumPixelBytes();
      largest_photo_ = std::max(largest_photo_, photo.NumPixelBytes());
    }
    largest_reading_ = largest_photo_ / 4 * kReadingBytes;
  }

  // With masks and photographs that coarse; a scale above max_texel_scale if that does not fit.
  MemoryPlan Try(int num_dropped, int mask_halvings, double mask_bytes) {
    const double shrink = std::pow(4.0, num_dropped);
    const double kept = all_photos_ / shrink;
    const double fixed = kProgramBytes + mask_bytes;
    // Even photographs of which only coarse levels are kept are decoded whole, on each core.
    const double decoding = num_dropped > 0 ? kDecodedAtOnce * largest_photo_ : 0;
    const double photos = std::min(
        kept,
        std::max(options_.photo_share * limit_, options_.few_photos * largest_photo_ / shrink));
    const double taken = fixed + std::max(largest_reading_, kBandBytes + decoding + photos);
    MemoryPlan plan;
    plan.num_dropped = num_dropped;
    plan.mask_halvings = mask_halvings;
    const double left = limit_ - taken;
    plan.texel_scale = FitScale(std::pow(2.0, num_dropped), left);
    least_ =
        std::min(least_, taken + BytesAtScale(charts_, options_.max_texel_scale, pages_).Sum());
    if (!IsTexture(plan)) return plan;
    const ChartsBytes charts = BytesAtScale(charts_, plan.texel_scale, pages_);
    plan.chart_bytes = static_cast<size_t>(charts.largest);
    // One more is in memory while it takes another's place.
    const double for_photos = std::min(kept, options_.photo_share * limit_) + left - charts.Sum();
    plan.photo_bytes = static_cast<size_t>(std::max(0.0, for_photos - largest_photo_ / shrink));
    plan.num_at_once = static_cast<int>(
        std::clamp((limit_ - fixed - std::min(kept, for_photos)) / largest_reading_, 1.0, 64.0));
    return plan;
  }

  // Whether texels stay short enough to be one.
  bool IsTexture(const MemoryPlan& plan) const {
    return plan.texel_scale <= options_.max_texel_scale;
  }
  bool AllFit(int num_dropped) const {
    return all_photos_ / std::pow(4.0, num_dropped) <= options_.photo_share * limit_;
  }

  Error TooLittle() const {
    return Error("these photographs need at least " +
                 std::to_string(static_cast<long>(std::ceil(least_ / kMegabyte))) +
                 " MB of memory, the limit is " +
                 std::to_string(static_cast<long>(limit_ / kMegabyte)));
  }

 private:
  // The least scale with which the charts take no more; above max_texel_scale if there is none.
  double FitScale(double at_least, double num_bytes) const {
    const auto fits = [&](double scale) {
      return BytesAtScale(charts_, scale, pages_).Sum() <= num_bytes;
    };
    if (fits(at_least)) return at_least;
    if (!fits(options_.max_texel_scale)) return 2 * options_.max_texel_scale;
    double low = at_least;
    double high = options_.max_texel_scale;
    for (int i = 0; i < 12; ++i) {
      const double middle = std::sqrt(low * high);
      (fits(middle) ? high : low) = middle;
    }
    return high;
  }

  const PageOptions& pages_;
  const MemoryOptions& options_;
  double limit_;
  std::vector<SeenChart> charts_;
  double all_photos_ = 0;
  double largest_photo_ = 0;
  double largest_reading_ = 0;
  double least_ = 1e300;
};

}  // namespace

double EstimateMaskBytes(const std::vector<PreparedPhoto>& survey,
                         int num_halvings,
                         const MemoryOptions& options) {
  // Tiles become four times as many with each doubling, those that a border crosses twice.
  const double finer = std::pow(2.0, kSurveyHalvings - num_halvings);
  double sum = 0;
  for (const PreparedPhoto& photo : survey) {
    const VisibilityMap& mask = photo.Mask();
    if (photo.IsHandPainted()) {
      sum += static_cast<double>(mask.NumBytes());
    } else {
      sum += options.mask_estimate_factor *
             (finer * finer * static_cast<double>(mask.NumTileBytes()) +
              finer * static_cast<double>(mask.NumBytes() - mask.NumTileBytes()));
    }
  }
  return sum;
}

MemoryPlan PlanMemory(const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& survey,
                      const PageOptions& pages,
                      const MemoryOptions& options) {
  Planner planner(charts, survey, pages, options);
  const int most_dropped = pages.texel_size == 0 ? options.max_halvings : 0;
  MemoryPlan plan;
  plan.texel_scale = 2 * options.max_texel_scale;
  for (int num_dropped = 0; num_dropped <= most_dropped; ++num_dropped) {
    if (num_dropped > 0 && planner.AllFit(num_dropped - 1)) break;  // they fit as they are
    MemoryPlan best;
    for (int halvings = 0; halvings <= options.max_halvings; ++halvings) {
      const MemoryPlan next =
          planner.Try(num_dropped, halvings, EstimateMaskBytes(survey, halvings, options));
      if (halvings == 0 || options.worth_halving * next.texel_scale < best.texel_scale) best = next;
    }
    // A little is worth having all photographs at hand.
    if (best.texel_scale <= options.worth_dropping * plan.texel_scale) plan = best;
  }
  if (!planner.IsTexture(plan)) throw planner.TooLittle();
  return plan;
}

MemoryPlan RevisePlan(const MemoryPlan& plan,
                      const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& photos,
                      const PageOptions& pages,
                      const MemoryOptions& options) {
  Planner planner(charts, photos, pages, options);
  double mask_bytes = 0;
  for (const PreparedPhoto& photo : photos) {
    mask_bytes += static_cast<double>(photo.Mask().NumBytes());
  }
  const MemoryPlan revised = planner.Try(plan.num_dropped, plan.mask_halvings, mask_bytes);
  if (!planner.IsTexture(revised)) throw planner.TooLittle();
  return revised;
}

size_t ChartBytes(const Chart& chart, size_t num_views, int bits) {
  return static_cast<size_t>(
      WorkBytes(chart.width_texels, chart.height_texels, static_cast<double>(num_views), bits));
}

}  // namespace groundglass
