// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_coverage.h"

#include "invrender/plan/suggest_viewpoint.h"
#include "scene/face_number.h"
#include "scene/quantile.h"
#include "scene/textured_model.h"

#include <algorithm>

namespace groundglass {
namespace {

// Where the middle of what is missing of a face lies, and where to stand to see it; nothing where
// hardly anything is. The middle was a sum over texels so far.
void DescribeMissing(const PolygonModel& model,
                     const Visibility& visibility,
                     const CoverageOptions& options,
                     FaceCoverage& face) {
  if (face.area - face.covered_area <= options.least_missing_share * face.area) {
    face.missing.reset();
    return;
  }
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
  face.missing->stand_in_world = SuggestViewpoint(
      model, visibility, face.face, face.missing->centre_in_world, options.viewpoint);
}

}  // namespace

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
    if (!source.footprints.empty()) entry.footprint = UpperMedian(source.footprints);
  }
}

void FinishCoverage(const PolygonModel& model,
                    const Visibility& visibility,
                    const CoverageOptions& options,
                    Coverage& coverage) {
  for (FaceCoverage& face : coverage.faces) {
    if (face.num_texels > 0) {
      face.covered_area = face.area * static_cast<double>(face.num_covered_texels) /
                          static_cast<double>(face.num_texels);
    }
    DescribeMissing(model, visibility, options, face);
    std::stable_sort(face.sources.begin(), face.sources.end(), [](const auto& a, const auto& b) {
      return a.num_texels > b.num_texels;
    });
  }
}

}  // namespace groundglass
