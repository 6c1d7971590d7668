// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"

#include "invrender/charts/charts.h"
#include "invrender/charts/packing.h"
#include "invrender/colour/colour.h"
#include "invrender/compose/compose.h"
#include "invrender/compose/dilate.h"
#include "invrender/compose/fill.h"
#include "invrender/compose/grain.h"
#include "invrender/measure/patches.h"
#include "invrender/measure/sharpness.h"
#include "invrender/measure/texel_blocks.h"
#include "invrender/measure/texel_size.h"
#include "invrender/photos/earlier_model.h"
#include "invrender/photos/prepared_photo.h"
#include "invrender/plan/memory_plan.h"
#include "invrender/plan/suggest_viewpoint.h"
#include "invrender/select/choose.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/scene_folder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>

namespace groundglass {
namespace {

// Counts steps for a Progress, from any thread.
class Steps {
 public:
  Steps(const Progress& progress, int total) : progress_(progress), total_(total) {}
  void Tell(const std::string& what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, total_, what);
  }

 private:
  const Progress& progress_;
  int total_;
  int done_ = 0;
  std::mutex mutex_;
};

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
  const size_t max_texels = options.max_memory_mb > 0 ? kBandTexels : max_bytes;
  for (int first = 0; first < count;) {
    int end = first;
    size_t num_bytes = 0;
    size_t num_texels = 0;
    for (; end < count; ++end) {
      const Chart& chart = charts[end];
      if (chart.page < 0) continue;
      num_bytes += ChartBytes(chart, blocks[end].photos.size(), options);
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

std::vector<PreparedPhoto> PreparePhotos(const PolygonModel& model,
                                         const std::vector<BakePhotograph>& photographs,
                                         const Visibility& visibility,
                                         const EarlierModel* earlier,
                                         const std::vector<int>& chart_of_face,
                                         const BakeOptions& options,
                                         const MaskDetail& detail,
                                         int num_at_once,
                                         PhotoCache& cache,
                                         Steps* steps) {
  std::vector<std::optional<PreparedPhoto>> prepared(photographs.size());
  ForEach(static_cast<int>(photographs.size()), num_at_once, [&](int i) {
    prepared[i].emplace(
        photographs[i], i, model, visibility, earlier, chart_of_face, options, detail, cache);
    if (steps) steps->Tell("read " + photographs[i].name);
  });
  std::vector<PreparedPhoto> photos;
  for (std::optional<PreparedPhoto>& photo : prepared) photos.push_back(std::move(*photo));
  return photos;
}

// How many texels of each face have their centre in it (or, for slivers, touch it), and how many
// of those are covered.
void CountTexels(const Chart& chart,
                 const ChartTexels& texels,
                 const ChartPixels& pixels,
                 Coverage& coverage) {
  for (int y = 0; y < texels.height(); ++y) {
    for (int x = 0; x < texels.width(); ++x) {
      if (texels.FaceAt(x, y) < 0 || !texels.IsCentreInside(x, y)) continue;
      FaceCoverage& face = coverage.faces[texels.FaceAt(x, y)];
      ++face.num_texels;
      const uint16_t source = *pixels.provenance.At(x, y);
      if (source != kProvenanceNone && source != kProvenanceFilled) {
        ++face.num_covered_texels;
        continue;
      }
      // A sum for now.
      if (!face.missing) face.missing.emplace();
      face.missing->centre_in_world += chart.PointInWorld({x + 0.5, y + 0.5});
    }
  }
}

void AddSources(const std::vector<BakePhotograph>& photographs,
                ChartPixels& pixels,
                Coverage& coverage) {
  for (FaceSource& source : pixels.sources) {
    FaceCoverage::Source& entry = coverage.faces[source.face].sources.emplace_back();
    entry.photograph = photographs[source.photo].name;
    entry.num_texels = source.num_texels;
    std::vector<float>& footprints = source.footprints;
    if (!footprints.empty()) {
      std::nth_element(
          footprints.begin(), footprints.begin() + footprints.size() / 2, footprints.end());
      entry.footprint = footprints[footprints.size() / 2];
    }
  }
}

Coverage StartCoverage(const PolygonModel& model,
                       const std::vector<Chart>& charts,
                       const std::vector<int>& chart_of_face) {
  Coverage coverage;
  for (size_t i = 0; i < model.faces.size(); ++i) {
    FaceCoverage& face = coverage.faces.emplace_back();
    face.face = static_cast<int>(i);
    face.number = FaceNumber(model, face.face);
    face.name = model.faces[i].name;
    face.area = ComputeFaceArea(model, face.face);
    face.texel_size = charts[chart_of_face[i]].texel_size;
  }
  return coverage;
}

void FinishCoverage(const PolygonModel& model, const Visibility& visibility, Coverage& coverage) {
  constexpr double kWorthTelling = 0.01;  // of a face's area
  for (FaceCoverage& face : coverage.faces) {
    if (face.num_texels > 0) {
      face.covered_area = face.area * static_cast<double>(face.num_covered_texels) /
                          static_cast<double>(face.num_texels);
    }
    if (face.area - face.covered_area <= kWorthTelling * face.area) {
      face.missing.reset();
    } else {
      const long num_missing = face.num_texels - face.num_covered_texels;
      if (face.missing && num_missing > 0) {
        face.missing->centre_in_world /= static_cast<double>(num_missing);
      } else {
        const std::vector<int>& points = model.faces[face.face].points;
        face.missing.emplace();
        for (const int point : points) {
          face.missing->centre_in_world +=
              model.points_in_world[point] / static_cast<double>(points.size());
        }
      }
      face.missing->stand_in_world =
          SuggestViewpoint(model, visibility, face.face, face.missing->centre_in_world);
    }
    std::stable_sort(face.sources.begin(), face.sources.end(), [](const auto& a, const auto& b) {
      return a.num_texels > b.num_texels;
    });
  }
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
  // Name order, which provenance counts in.
  std::vector<BakePhotograph> sorted(photographs.begin(), photographs.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return NaturalLess(a.name, b.name);
  });

  const Visibility visibility(model);
  BakeResult result;
  std::optional<EarlierModel> earlier;
  if (options.as_photographed) {
    earlier.emplace(*options.as_photographed, model);
    result.new_faces = earlier->FindNewFaces();
    KeepFrom(result.new_faces, model.faces.size(), sorted);
  }
  std::vector<Chart> charts = MakeCharts(model);
  const std::vector<int> chart_of_face = ChartOfFace(charts, model.faces.size());
  const int num_charts = static_cast<int>(charts.size());
  Steps steps(progress, static_cast<int>(sorted.size()) + 1 + num_charts);
  const bool is_limited = options.max_memory_mb > 0;
  constexpr size_t kNoLimit = std::numeric_limits<size_t>::max();
  PhotoCache cache(ImageFiles(sorted), is_limited ? 0 : kNoLimit, options.bits);
  const auto prepare = [&](const MaskDetail& detail, int num_at_once, Steps* told) {
    return PreparePhotos(model,
                         sorted,
                         visibility,
                         earlier ? &*earlier : nullptr,
                         chart_of_face,
                         options,
                         detail,
                         num_at_once,
                         cache,
                         told);
  };
  const int num_photos = static_cast<int>(sorted.size());
  MemoryPlan plan;
  plan.num_at_once = num_photos;
  plan.chart_bytes = kNoLimit;
  if (is_limited) {
    const std::vector<PreparedPhoto> survey =
        prepare({.num_halvings = kSurveyHalvings, .is_survey = true}, num_photos, nullptr);
    ChooseTexelSizes(model, survey, options, charts);
    plan = PlanMemory(charts, survey, options);
    cache.SetMaxBytes(plan.photo_bytes);
    cache.SetNumDropped(plan.num_dropped);
  }
  const std::vector<PreparedPhoto> photos =
      prepare({.num_halvings = plan.mask_halvings}, plan.num_at_once, &steps);
  ChooseTexelSizes(model, photos, options, charts);
  if (is_limited) {
    plan = RevisePlan(plan, charts, photos, options);
    result.texel_scale = plan.texel_scale;
    for (Chart& chart : charts) {
      if (chart.texel_size > 0) chart.SetTexelSize(chart.texel_size * plan.texel_scale);
    }
    cache.SetMaxBytes(plan.photo_bytes);
  }
  const std::vector<PageSize> page_sizes =
      PackCharts(charts, options.gutter_texels, options.max_page_texels);

  // Settle colour and choice on blocks.
  const std::vector<ChartBlocks> blocks = ObserveBlocks(model, charts, photos);
  std::vector<Sharpness> sharpness;
  Grain grain;
  if (options.judge_sharpness || options.smooth_grain) {
    const std::vector<Patch> patches = SamplePatches(model, charts, photos);
    if (options.judge_sharpness) sharpness = MeasureSharpness(patches, photos.size());
    if (options.smooth_grain) grain = MeasureGrain(patches, charts.size(), photos.size());
  }
  steps.Tell("compared the photographs");
  // Occluders are told from exposure even where the pages keep the photographs' own exposures.
  const ColourModel neutral = MakeNeutralColour(blocks, photos.size());
  const ColourModel matched = options.match_colour || options.reject_occluders
                                  ? EstimateColour(blocks, photos.size())
                                  : neutral;
  const ColourModel& printed = options.match_colour ? matched : neutral;

  // Fill the pages.
  result.model = MakeTexturedModel(model, charts, chart_of_face, page_sizes, options.bits);
  result.coverage = StartCoverage(model, charts, chart_of_face);
  ForEachChart(charts, blocks, options, plan.chart_bytes, [&](int i) {
    const Chart& chart = charts[i];
    if (chart.page >= 0) {
      const ChartTexels texels(model, chart);
      const ChartChoice choice = ChooseBlocks(blocks[i], i, matched, sharpness, options);
      ChartPixels pixels =
          ComposeChart(chart, i, texels, photos, blocks[i], choice, printed, options);
      if (options.smooth_grain) SmoothGrain(chart, i, blocks[i], printed, grain, pixels);
      InpaintBorders(pixels);
      CloseHoles(pixels);
      // Faces and pages' rectangles of different charts do not overlap: no lock.
      CountTexels(chart, texels, pixels, result.coverage);
      AddSources(sorted, pixels, result.coverage);
      if (options.fill_gaps) FillOpenTexels(pixels);
      PlaceOnPage(chart, pixels, options.gutter_texels, result.model.pages[chart.page]);
    }
    steps.Tell("textured chart " + std::to_string(i + 1));
  });
  FinishCoverage(model, visibility, result.coverage);
  return result;
}

}  // namespace groundglass
