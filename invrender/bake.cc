// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"

#include "invrender/bake_coverage.h"
#include "invrender/charts/charts.h"
#include "invrender/charts/packing.h"
#include "invrender/compose/compose.h"
#include "invrender/compose/dilate.h"
#include "invrender/measure/patches.h"
#include "invrender/measure/texel_blocks.h"
#include "invrender/measure/texel_size.h"
#include "invrender/photos/earlier_model.h"
#include "invrender/photos/prepared_photo.h"
#include "invrender/plan/memory_plan.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/progress.h"
#include "scene/text.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// No more than so many at the same time; there is work for all cores in each of them.
void ForEach(int count, int num_at_once, const std::function<void(int)>& work) {
  if (num_at_once >= count) {
    tbb::parallel_for(0, count, work);
    return;
  }
  std::atomic<int> next = 0;
  tbb::parallel_for(0, num_at_once, [&](int) {
    for (int i = next++; i < count; i = next++) work(i);
  });
}

// Charts, side by side as far as `max_bytes` and, if these are limited, one band of ComposeChart
// go.
void ForEachChart(const std::vector<Chart>& charts,
                  const std::vector<ChartBlocks>& blocks,
                  const BakeOptions& options,
                  size_t max_bytes,
                  const std::function<void(int)>& work) {
  const int count = static_cast<int>(charts.size());
  const size_t max_texels = options.memory.max_memory_mb > 0 ? kBandTexels : max_bytes;
  for (int first = 0; first < count;) {
    int end = first;
    size_t num_bytes = 0;
    size_t num_texels = 0;
    for (; end < count; ++end) {
      const Chart& chart = charts[end];
      if (chart.page < 0) continue;
      num_bytes += ChartBytes(chart, blocks[end].photos.size(), options.pages.bits);
      num_texels += static_cast<size_t>(chart.width_texels) * chart.height_texels;
      if ((num_bytes > max_bytes || num_texels > max_texels) && end > first) break;
    }
    tbb::parallel_for(first, end, work);
    first = end;
  }
}

// No photograph may texture these faces.
void KeepFrom(const std::vector<int>& faces,
              size_t num_faces,
              std::vector<BakePhotograph>& photographs) {
  for (BakePhotograph& photograph : photographs) {
    if (!photograph.faces) {
      photograph.faces.emplace(num_faces);
      std::iota(photograph.faces->begin(), photograph.faces->end(), 0);
    }
    std::erase_if(*photograph.faces,
                  [&](int face) { return std::binary_search(faces.begin(), faces.end(), face); });
  }
}

std::vector<std::filesystem::path> ImageFiles(const std::vector<BakePhotograph>& photographs) {
  std::vector<std::filesystem::path> files;
  for (const BakePhotograph& photograph : photographs) files.push_back(photograph.image_file);
  return files;
}

TexturedModel MakeTexturedModel(const PolygonModel& model,
                                const std::vector<Chart>& charts,
                                const std::vector<int>& chart_of_face,
                                const std::vector<PageSize>& page_sizes,
                                int bits) {
  TexturedModel textured;
  textured.model = model;
  for (const PageSize& size : page_sizes) {
    TexturePage& page = textured.pages.emplace_back();
    page.srgb8 = Image8(size.width, size.height, 3);
    if (bits == 16) page.srgb16 = Image16(size.width, size.height, 3);
    page.provenance = Image16(size.width, size.height, 1);
  }
  textured.faces.resize(model.faces.size());
  for (size_t i = 0; i < model.faces.size(); ++i) {
    const Chart& chart = charts[chart_of_face[i]];
    if (chart.page < 0) continue;
    textured.faces[i].page = chart.page;
    for (const int point : model.faces[i].points) {
      textured.faces[i].corners_texel.push_back(chart.TexelFromWorld(model.points_in_world[point]) +
                                                Eigen::Vector2d(chart.x_on_page, chart.y_on_page));
    }
  }
  return textured;
}

std::vector<BakePhotograph> SortedByName(std::span<const BakePhotograph> photographs) {
  std::vector<BakePhotograph> sorted(photographs.begin(), photographs.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return NaturalLess(a.name, b.name);
  });
  return sorted;
}

double TexelsOf(const std::vector<Chart>& charts) {
  return std::accumulate(charts.begin(), charts.end(), 0.0, [](double sum, const Chart& chart) {
    return chart.texel_size > 0
               ? sum + static_cast<double>(chart.width_texels) * chart.height_texels
               : sum;
  });
}

constexpr size_t kNoLimit = std::numeric_limits<size_t>::max();

// A bake on the way: its steps in their order.
class Bake {
 public:
  // photographs: in name order, which provenance counts in.
  Bake(const PolygonModel& model,
       std::vector<BakePhotograph> photographs,
       const BakeOptions& options,
       const Progress& progress)
      : model_(model),
        options_(options),
        photographs_(std::move(photographs)),
        visibility_(model),
        charts_(MakeCharts(model, options.charts)),
        chart_of_face_(ChartOfFace(charts_, model.faces.size())),
        cache_(ImageFiles(photographs_), IsLimited() ? 0 : kNoLimit, options.pages.bits),
        steps_(progress, static_cast<int>(photographs_.size() + 2 + charts_.size())) {
    if (!options.as_photographed) return;
    earlier_.emplace(*options.as_photographed, model, options.earlier_model);
    result_.new_faces = earlier_->FindNewFaces();
    KeepFrom(result_.new_faces, model.faces.size(), photographs_);
  }

  // How much memory may go where, photographs made ready, and texels as small as they allow.
  void PreparePhotographs() {
    if (options_.pages.texel_size > ComputeBounds(model_).Diagonal()) {
      throw OptionError("page options: texel_size",
                        "a texel of " + FormatNumber(options_.pages.texel_size) + " " +
                            UnitName(model_.unit) + " is larger than the model");
    }
    plan_.num_at_once = static_cast<int>(photographs_.size());
    plan_.chart_bytes = kNoLimit;
    if (IsLimited()) MakePlan();
    photos_ = Prepare({.num_halvings = plan_.mask_halvings}, &steps_);
    ChooseTexelSizes(model_, photos_, options_.pages, charts_);
    if (IsLimited()) KeepToPlan();
    RemarkOnTexels();
  }

  // Each chart's place on the pages.
  void LayOut() {
    page_sizes_ = PackCharts(charts_, options_.pages.gutter_texels, options_.pages.max_page_texels);
    steps_.Tell("laid out " + std::to_string(std::lround(TexelsOf(charts_) / 1e6)) +
                " million texels, pages: " + std::to_string(page_sizes_.size()));
  }

  // Settles colour on blocks, and measures what photographs differ in.
  void ComparePhotographs() {
    blocks_ = ObserveBlocks(model_, charts_, photos_, options_.blocks);
    MeasureDetail();
    steps_.Tell("compared the photographs");
    neutral_ = MakeNeutralColour(blocks_, photos_.size());
    // Occluders are told from exposure even where the pages keep the photographs' own exposures.
    matched_ = options_.match_colour || options_.reject_occluders
                   ? options_.stages.estimate_colour(blocks_, photos_.size(), options_.colour)
                   : neutral_;
  }

  void FillPages() {
    result_.model =
        MakeTexturedModel(model_, charts_, chart_of_face_, page_sizes_, options_.pages.bits);
    result_.coverage = StartCoverage(model_, charts_, chart_of_face_);
    ForEachChart(charts_, blocks_, options_, plan_.chart_bytes, [&](int i) {
      if (charts_[i].page >= 0) TextureChart(i);
      steps_.Tell("textured chart " + std::to_string(i + 1));
    });
  }

  BakeResult Finish() {
    FinishCoverage(model_, visibility_, options_.coverage, result_.coverage);
    return std::move(result_);
  }

 private:
  bool IsLimited() const { return options_.memory.max_memory_mb > 0; }

  std::vector<PreparedPhoto> Prepare(const MaskDetail& detail, ProgressCounter* steps) {
    const PhotoContext context = {model_,
                                  visibility_,
                                  earlier_ ? &*earlier_ : nullptr,
                                  chart_of_face_,
                                  options_.photos,
                                  cache_,
                                  options_.on_face_mask};
    std::vector<std::optional<PreparedPhoto>> prepared(photographs_.size());
    ForEach(static_cast<int>(photographs_.size()), plan_.num_at_once, [&](int i) {
      prepared[i].emplace(PreparePhoto(photographs_[i], i, context, detail));
      if (steps) steps->Tell("read " + photographs_[i].name);
    });
    std::vector<PreparedPhoto> photos;
    for (std::optional<PreparedPhoto>& photo : prepared) photos.push_back(std::move(*photo));
    return photos;
  }

  void MakePlan() {
    const std::vector<PreparedPhoto> survey =
        Prepare({.num_halvings = kSurveyHalvings, .is_survey = true}, nullptr);
    ChooseTexelSizes(model_, survey, options_.pages, charts_);
    plan_ = PlanMemory(charts_, survey, options_.pages, options_.memory);
    cache_.SetMaxBytes(plan_.photo_bytes);
    cache_.SetNumDropped(plan_.num_dropped);
  }

  void KeepToPlan() {
    plan_ = RevisePlan(plan_, charts_, photos_, options_.pages, options_.memory);
    result_.texel_scale = plan_.texel_scale;
    for (Chart& chart : charts_) {
      if (chart.texel_size > 0) chart.SetTexelSize(chart.texel_size * plan_.texel_scale);
    }
    cache_.SetMaxBytes(plan_.photo_bytes);
  }

  void RemarkOnTexels() {
    if (result_.texel_scale > 1) {
      result_.remarks.push_back("texels are " +
                                FormatNumber(std::round(100 * result_.texel_scale) / 100) +
                                " times as long as the photographs allow, to stay within --memory");
    }
    if (options_.pages.texel_size == 0) return;
    PageOptions as_resolved = options_.pages;
    as_resolved.texel_size = 0;
    std::vector<Chart> resolved = charts_;
    ChooseTexelSizes(model_, photos_, as_resolved, resolved);
    const double times = TexelsOf(charts_) / std::max(1.0, TexelsOf(resolved));
    if (times < options_.pages.needless_texels) return;
    result_.remarks.push_back(
        "--texel-size " + FormatNumber(options_.pages.texel_size) + " makes " +
        std::to_string(std::lround(times)) +
        " times as many texels as the photographs resolve, and no sharper texture; leave it out "
        "for texels as fine as the photographs");
  }

  void MeasureDetail() {
    const std::vector<Patch> patches = SamplePatches(model_, charts_, photos_, options_.patches);
    sharpness_ = options_.stages.measure_sharpness(patches, photos_.size(), options_.sharpness);
    grain_ = MeasureGrain(patches, charts_.size(), photos_.size(), options_.grain);
  }

  ChartChoice Choose(int i) const {
    const ChartBlocks& blocks = blocks_[i];
    const BakeStages& stages = options_.stages;
    std::vector<float> consistency =
        options_.reject_occluders
            ? stages.measure_consistency(blocks, i, matched_, options_.consistency)
            : std::vector<float>(blocks.views.size(), 1);
    if (!sharpness_.empty()) PreferSharp(blocks, sharpness_, options_.consistency, consistency);
    ChartChoice choice = stages.choose_blocks(blocks, std::move(consistency));
    stages.smooth_seams(blocks, i, matched_, options_.seams, choice);
    return choice;
  }

  // Faces and pages' rectangles of different charts do not overlap: no lock.
  void TextureChart(int i) {
    const Chart& chart = charts_[i];
    const ChartTexels texels(model_, chart);
    const ChartChoice choice = Choose(i);
    const ColourModel& printed = options_.match_colour ? matched_ : neutral_;
    const ComposeInputs inputs = {
        chart, i, texels, photos_, options_.photos.border_margin_px, blocks_[i], choice};
    ChartPixels pixels = ComposeChart(inputs, printed, options_.blend, options_.pages.bits);
    options_.stages.smooth_grain({chart, i, blocks_[i], printed, grain_}, options_.grain, pixels);
    InpaintBorders(pixels);
    CloseHoles(options_.dilate, pixels);
    CountTexels(chart, texels, pixels, result_.coverage);
    AddSources(photographs_, pixels, result_.coverage);
    if (options_.fill_gaps) options_.stages.fill_gaps(options_.fill, pixels);
    PlaceOnPage(chart, pixels, options_.pages.gutter_texels, result_.model.pages[chart.page]);
  }

  const PolygonModel& model_;
  const BakeOptions& options_;
  std::vector<BakePhotograph> photographs_;
  Visibility visibility_;
  std::optional<EarlierModel> earlier_;
  std::vector<Chart> charts_;
  std::vector<int> chart_of_face_;
  PhotoCache cache_;
  ProgressCounter steps_;
  MemoryPlan plan_;
  std::vector<PreparedPhoto> photos_;
  std::vector<PageSize> page_sizes_;
  std::vector<ChartBlocks> blocks_;
  std::vector<Sharpness> sharpness_;  // empty: all alike
  Grain grain_;
  ColourModel neutral_;
  ColourModel matched_;
  BakeResult result_;
};

}  // namespace

BakeResult BakeTextures(const PolygonModel& model,
                        std::span<const BakePhotograph> photographs,
                        const BakeOptions& options,
                        const Progress& progress) {
  options.Check();
  if (photographs.size() >= kProvenanceFilled) throw Error("more than 65534 photographs");
  // Face masks hold 16 bits.
  if (HighestFaceNumber(model) > 65535) {
    throw Error("the model has " + std::to_string(model.faces.size()) +
                " faces; no more than 65535 can be textured");
  }
  Bake bake(model, SortedByName(photographs), options, progress);
  bake.PreparePhotographs();
  bake.LayOut();
  bake.ComparePhotographs();
  bake.FillPages();
  return bake.Finish();
}

}  // namespace groundglass
