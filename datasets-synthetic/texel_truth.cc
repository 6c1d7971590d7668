// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/texel_truth.h"

#include "datasets-synthetic/noise.h"
#include "datasets-synthetic/texel_map.h"
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/image_io.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

// The square's sides: level and up on walls, east and north on floors and roofs.
struct SquareAxes {
  Eigen::Vector3d u, v;
  explicit SquareAxes(const Eigen::Vector3d& normal) {
    const bool is_level = std::abs(normal.z()) > 0.999;
    u = is_level ? Eigen::Vector3d::UnitX()
                 : Eigen::Vector3d(Eigen::Vector3d::UnitZ().cross(normal).normalized());
    v = is_level ? Eigen::Vector3d::UnitY() : Eigen::Vector3d(normal.cross(u));
  }
};

// A point of a face, evenly over its area.
Eigen::Vector3d PointOnFace(const PolygonModel& model,
                            const std::vector<std::array<int, 3>>& triangles,
                            const std::vector<double>& area_up_to,
                            uint64_t chance) {
  const double wanted = area_up_to.back() * UniformOf(HashOf(chance, 0));
  const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, wanted);
  const std::array<int, 3>& triangle = triangles[found - area_up_to.begin()];
  double s = UniformOf(HashOf(chance, 1));
  double t = UniformOf(HashOf(chance, 2));
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  const Eigen::Vector3d& a = model.points_in_world[triangle[0]];
  return a + s * (model.points_in_world[triangle[1]] - a) +
         t * (model.points_in_world[triangle[2]] - a);
}

// Whether a square lies on the face with all its corners, and open to the air before it.
bool IsOpenSquare(const Visibility& visibility,
                  int face,
                  const Eigen::Vector3d& normal,
                  const Eigen::Vector3d& middle) {
  constexpr double kBefore = 0.7;  // feet, more than a sill sticks out
  const SquareAxes axes(normal);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner =
        middle +
        kTexelSampleWidth / 2 * ((i % 2 == 0 ? -1 : 1) * axes.u + (i / 2 == 0 ? -1 : 1) * axes.v);
    const auto hit = visibility.FirstHit(corner + kBefore * normal, -normal);
    if (!hit || hit->face != face) return false;
  }
  return true;
}

// Mean linear colour of the page over the square, by 4 x 4 bilinear samples.
Eigen::Vector3d MeanTexel(const Image8& page,
                          const TexelMap& map,
                          const Eigen::Vector3d& normal,
                          const Eigen::Vector3d& middle) {
  constexpr int kSamples = 4;
  const SquareAxes axes(normal);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const double along_u = ((i % kSamples + 0.5) / kSamples - 0.5) * kTexelSampleWidth;
    const double along_v = ((i / kSamples + 0.5) / kSamples - 0.5) * kTexelSampleWidth;
    const Eigen::Vector2d at = map.TexelAt(middle + along_u * axes.u + along_v * axes.v);
    const double x = std::clamp(at.x() - 0.5, 0.0, page.width - 1.0);
    const double y = std::clamp(at.y() - 0.5, 0.0, page.height - 1.0);
    const int x0 = std::min(static_cast<int>(x), std::max(0, page.width - 2));
    const int y0 = std::min(static_cast<int>(y), std::max(0, page.height - 2));
    const int x1 = std::min(x0 + 1, page.width - 1);
    const int y1 = std::min(y0 + 1, page.height - 1);
    for (int c = 0; c < 3; ++c) {
      const auto light = [&](int column, int row) {
        return static_cast<double>(
            LinearFromSrgb(static_cast<float>(page.At(column, row)[c]) / 255));
      };
      sum[c] += std::lerp(std::lerp(light(x0, y0), light(x1, y0), x - x0),
                          std::lerp(light(x0, y1), light(x1, y1), x - x0),
                          y - y0);
    }
  }
  return sum / (kSamples * kSamples);
}

double Levels(double linear) {
  return 255.0 * SrgbFromLinear(std::clamp(static_cast<float>(linear), 0.0f, 1.0f));
}

}  // namespace

std::vector<TexelSample> SampleTexels(const SyntheticWorld& world,
                                      const PolygonModel& model,
                                      const Visibility& visibility,
                                      const SkyMap& sky_map,
                                      const Daylight& light,
                                      int count,
                                      uint64_t seed) {
  constexpr double kFewest = 6;
  double total_area = 0;
  for (int face = 0; face < world.num_model_faces; ++face) {
    total_area += ComputeFaceArea(model, face);
  }
  std::vector<TexelSample> samples;
  for (int face = 0; face < world.num_model_faces; ++face) {
    const Surface& surface = world.surfaces[face];
    if (surface.is_relief) continue;
    const std::vector<std::array<int, 3>> triangles = TriangulateFace(model, face);
    std::vector<double> area_up_to;
    for (const std::array<int, 3>& triangle : triangles) {
      const Eigen::Vector3d& a = model.points_in_world[triangle[0]];
      const Eigen::Vector3d b = model.points_in_world[triangle[1]] - a;
      const Eigen::Vector3d c = model.points_in_world[triangle[2]] - a;
      area_up_to.push_back(b.cross(c).norm() / 2 + (area_up_to.empty() ? 0 : area_up_to.back()));
    }
    const int wanted =
        static_cast<int>(std::max(kFewest, std::round(count * area_up_to.back() / total_area)));
    const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
    for (int i = 0; i < wanted; ++i) {
      const Eigen::Vector3d middle =
          PointOnFace(model, triangles, area_up_to, SeedFor(HashOf(seed, face), "texel", i));
      const Eigen::Vector2d at = surface.TextureOf(middle);
      const Appearance appearance =
          AppearanceAt(surface, at.x(), at.y(), kTexelSampleWidth, kTexelSampleWidth);
      if (appearance.gloss > 0 || !IsOpenSquare(visibility, face, normal, middle)) continue;
      const auto share = static_cast<float>(sky_map.SkyShare(surface, face, at.x(), at.y()));
      samples.push_back(
          {face, middle, appearance.albedo.cwiseProduct(IndirectIrradiance(light, share))});
    }
  }
  return samples;
}

std::string FormatTexels(const std::vector<TexelSample>& samples) {
  std::string text = "face,x,y,z,red,green,blue\n";
  char line[160];
  for (const TexelSample& sample : samples) {
    const Eigen::Vector3d in_site = SiteFromWorld(sample.in_world);
    std::snprintf(line,
                  sizeof line,
                  "%d,%.3f,%.3f,%.3f,%.5f,%.5f,%.5f\n",
                  sample.face + 1,
                  in_site.x(),
                  in_site.y(),
                  in_site.z(),
                  sample.color[0],
                  sample.color[1],
                  sample.color[2]);
    text += line;
  }
  return text;
}

std::vector<TexelSample> ReadTexels(const std::filesystem::path& file) {
  std::string text = ReadTextFile(file);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<TexelSample> samples;
  for (const TextLine& line : SplitLines(text)) {
    if (line.number == 1 || line.tokens.empty()) continue;
    std::vector<double> numbers;
    for (const TextToken& token : line.tokens) {
      const auto number = ParseNumber(token.text);
      if (number && std::isfinite(*number)) numbers.push_back(*number);
    }
    if (numbers.size() != 7 || line.tokens.size() != 7 || numbers[0] < 1) {
      throw Error(file, line.number, "expected face,x,y,z,red,green,blue, the face from 1");
    }
    samples.push_back({static_cast<int>(numbers[0]) - 1,
                       WorldFromSite({numbers[1], numbers[2], numbers[3]}),
                       Eigen::Vector3d(numbers[4], numbers[5], numbers[6]).cast<float>()});
  }
  return samples;
}

TexelErrors MeasureTexels(const TexturedModel& model, const std::vector<TexelSample>& samples) {
  std::vector<TexelMap> maps;
  std::vector<Eigen::Vector3d> normals;
  for (size_t face = 0; face < model.model.faces.size(); ++face) {
    const int index = static_cast<int>(face);
    maps.push_back(face < model.faces.size() ? FitTexelMap(model.model, index, model.faces[face])
                                             : TexelMap());
    normals.push_back(ComputeFacePlane(model.model, index).normal_in_world);
  }
  TexelErrors errors;
  errors.num_samples = static_cast<long>(samples.size());
  struct Levels3 {
    int face;
    Eigen::Vector3d truth, found;
  };
  std::vector<Levels3> levels;
  for (const TexelSample& sample : samples) {
    if (sample.face >= static_cast<int>(maps.size()) || !maps[sample.face].has_texture) continue;
    const TexturePage& page = model.pages[model.faces[sample.face].page];
    if (!page.provenance.Empty()) {
      const Eigen::Vector2d at = maps[sample.face].TexelAt(sample.in_world);
      const uint16_t origin =
          *page.provenance.At(std::clamp(static_cast<int>(at.x()), 0, page.provenance.width - 1),
                              std::clamp(static_cast<int>(at.y()), 0, page.provenance.height - 1));
      if (origin == kProvenanceNone || origin == kProvenanceFilled) continue;
    }
    const Eigen::Vector3d found =
        MeanTexel(page.srgb8, maps[sample.face], normals[sample.face], sample.in_world);
    levels.push_back(
        {sample.face, sample.color.cast<double>().unaryExpr(&Levels), found.unaryExpr(&Levels)});
  }
  errors.faces.resize(maps.size());
  errors.num_covered = static_cast<long>(levels.size());
  if (levels.empty()) return errors;
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  for (int c = 0; c < 3; ++c) {
    double product = 0;
    double square = 0;
    for (const Levels3& sample : levels) {
      product += sample.truth[c] * sample.found[c];
      square += sample.found[c] * sample.found[c];
    }
    if (square > 0) gain[c] = product / square;
    errors.gain[c] = gain[c];
  }
  double sum_squares = 0;
  for (const Levels3& sample : levels) {
    const double square = (gain.cwiseProduct(sample.found) - sample.truth).squaredNorm();
    sum_squares += square;
    errors.faces[sample.face].rms_levels += square;
    ++errors.faces[sample.face].num_covered;
  }
  errors.rms_levels = std::sqrt(sum_squares / (3.0 * static_cast<double>(levels.size())));
  for (TexelErrors::OfFace& face : errors.faces) {
    if (face.num_covered == 0) continue;
    face.rms_levels = std::sqrt(face.rms_levels / (3.0 * static_cast<double>(face.num_covered)));
  }
  return errors;
}

}  // namespace groundglass
