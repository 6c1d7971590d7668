// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/material.h"

#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Where, and over how much, a texture is asked.
struct Place {
  double u, v, width_u, width_v;
};

double Noise(const Surface& surface, int layer, const Place& at, double frequency, int octaves) {
  return FilteredNoise(
      surface.seed + 101 * layer, at.u, at.v, frequency, octaves, at.width_u, at.width_v);
}

Rgb Mix(const Rgb& a, const Rgb& b, double share) {
  return a + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (b - a);
}

// A uniform number of the cell (column, row); fades to its mean once cells fall below a footprint.
double CellValue(const Surface& surface, int layer, double column, double row) {
  return UniformOf(HashOf(surface.seed + 7919 * layer,
                          static_cast<uint64_t>(static_cast<int64_t>(column)),
                          static_cast<uint64_t>(static_cast<int64_t>(row))));
}

double CellFade(const Place& at, double cell) {
  return std::clamp(2 - 2 * std::max(at.width_u, at.width_v) / cell, 0.0, 1.0);
}

double InRectangle(const Place& at, double low_u, double high_u, double low_v, double high_v) {
  return FilteredInterval(at.u, at.width_u, low_u, high_u) *
         FilteredInterval(at.v, at.width_v, low_v, high_v);
}

// Streaks that rain leaves below a coping, and splashes above the ground: a factor on the albedo.
double Weathering(const Surface& surface, const Place& at, double strength) {
  const double below_top = surface.coping_v - at.v;
  const double streak =
      FilteredNoise(surface.seed + 11, at.u, at.v * 0.06, 0.45, 4, at.width_u, at.width_v * 0.06);
  const double streaks = std::max(0.0, streak + 0.15) * std::exp(-below_top / 9) * 0.9;
  const double blotches = 0.5 + 0.5 * Noise(surface, 12, at, 0.035, 4);
  const double splash = std::exp(-(at.v - std::min(surface.low_v, 0.0)) / 1.2) *
                        (0.6 + 0.5 * Noise(surface, 13, at, 0.8, 3));
  return 1 - strength *
                 (0.45 * std::max(0.0, streaks) + 0.13 * blotches + 0.38 * std::max(0.0, splash));
}

Appearance TileAppearance(const Surface& surface, const Place& at) {
  constexpr double kTile = 5;
  constexpr double kJoint = 0.16;
  const double column = std::floor(at.u / kTile);
  const double row = std::floor(at.v / kTile);
  const double fade = CellFade(at, kTile);
  Rgb albedo = surface.color;
  double factor = 1 + fade * 0.05 * (CellValue(surface, 1, column, row) - 0.5);
  // One tile in fifty has been replaced, and never quite matches.
  if (CellValue(surface, 2, column, row) < 0.02) {
    albedo = Mix(albedo, Rgb(0.62f, 0.58f, 0.49f), 0.6 * fade);
  }
  factor *= 1 + 0.022 * Noise(surface, 3, at, 0.3, 3) + 0.02 * Noise(surface, 4, at, 3.0, 3);
  factor *= Weathering(surface, at, 1);
  albedo *= static_cast<float>(factor);
  const double joints = 1 - (1 - FilteredLines(at.u, at.width_u, kTile, kJoint)) *
                                (1 - FilteredLines(at.v, at.width_v, kTile, kJoint));
  const Rgb joint_color =
      Rgb(0.13f, 0.13f, 0.135f) * static_cast<float>(1 + 0.35 * Noise(surface, 5, at, 1.1, 3));
  albedo = Mix(albedo, joint_color, joints);
  // A louvred vent in one tile of thirty.
  if (CellValue(surface, 6, column, row) < 0.033) {
    const double u0 = column * kTile + 1.6;
    const double v0 = row * kTile + 1.9;
    const double frame = InRectangle(at, u0 - 0.12, u0 + 1.92, v0 - 0.12, v0 + 1.32);
    const double hole = InRectangle(at, u0, u0 + 1.8, v0, v0 + 1.2);
    const double slats = FilteredLines(at.v - v0, at.width_v, 0.2, 0.09);
    albedo = Mix(albedo, Rgb(0.42f, 0.42f, 0.41f), frame);
    albedo = Mix(albedo, Mix(Rgb(0.05f, 0.05f, 0.05f), Rgb(0.4f, 0.4f, 0.39f), slats), hole);
  }
  return {albedo, 0};
}

// Panes between mullions; each has a blind drawn to a height of its own.
Appearance GlazingAppearance(const Surface& surface,
                             const Place& at,
                             double bay,
                             double mullion,
                             double transom_height,
                             bool has_blinds) {
  const double column = std::floor(at.u / bay);
  const double height = surface.high_v - surface.low_v;
  const double above_sill = at.v - surface.low_v;
  const double fade = CellFade(at, bay);
  Rgb inside = Rgb(0.035f, 0.04f, 0.045f) *
               static_cast<float>(1 + fade * (CellValue(surface, 1, column, 0) - 0.3));
  if (has_blinds) {
    const double chance = CellValue(surface, 2, column, 0);
    const double drawn = chance < 0.45 ? 0.06 : chance * 0.75;
    const double blind = FilteredInterval(above_sill, at.width_v, height * (1 - drawn), height);
    const double slats = 1 - 0.25 * FilteredLines(above_sill, at.width_v, 0.17, 0.05);
    const Rgb blind_color =
        Rgb(0.4f, 0.385f, 0.34f) *
        static_cast<float>(slats * (0.85 + 0.3 * CellValue(surface, 3, column, 0)));
    inside = Mix(inside, blind_color, blind);
    // Things on some sills: books, plants.
    if (CellValue(surface, 4, column, 0) < 0.4) {
      const double start = column * bay + bay * (0.15 + 0.4 * CellValue(surface, 5, column, 0));
      const double size = 0.5 + 0.7 * CellValue(surface, 6, column, 0);
      const Rgb thing(0.05f + 0.3f * static_cast<float>(CellValue(surface, 7, column, 0)),
                      0.12f,
                      0.05f + 0.2f * static_cast<float>(CellValue(surface, 8, column, 0)));
      inside = Mix(
          inside, thing, InRectangle(at, start, start + size, surface.low_v, surface.low_v + size));
    }
  } else {
    // Something of the lobby shows through: columns and lights.
    inside *= static_cast<float>(1 + 0.8 * Noise(surface, 9, at, 0.25, 3));
    inside += Rgb(0.16f, 0.14f, 0.1f) *
              static_cast<float>(
                  InRectangle({std::fmod(std::abs(at.u), 9.0), above_sill, at.width_u, at.width_v},
                              3,
                              5.5,
                              height - 1.6,
                              height - 1.2));
  }
  const double mullions = FilteredLines(at.u, at.width_u, bay, mullion);
  const double transom =
      FilteredInterval(above_sill, at.width_v, transom_height - 0.1, transom_height + 0.1);
  const double edge = 1 - FilteredInterval(above_sill, at.width_v, 0.22, height - 0.22);
  const double frame = 1 - (1 - mullions) * (1 - transom) * (1 - edge);
  const Rgb frame_color =
      surface.color * static_cast<float>(1 + 0.1 * Noise(surface, 10, at, 1.5, 3));
  return {Mix(inside, frame_color, frame), static_cast<float>(1 - frame)};
}

Appearance ConcreteAppearance(const Surface& surface, const Place& at) {
  double factor = 1 + 0.06 * Noise(surface, 1, at, 0.12, 5);
  // Marks of the boards that it was cast against.
  const double board = std::floor(at.v / 0.6);
  factor *= 1 + 0.05 * CellFade(at, 0.6) * (CellValue(surface, 2, 0, board) - 0.5);
  factor *= 1 - 0.25 * FilteredLines(at.v, at.width_v, 0.6, 0.025);
  factor *= Weathering(surface, at, 0.8);
  Rgb albedo = surface.color * static_cast<float>(factor);
  const double ties = FilteredLines(at.u - 1.5, at.width_u, 3, 0.12) *
                      FilteredLines(at.v - 1.5, at.width_v, 3, 0.12);
  return {Mix(albedo, Rgb(0.12f, 0.11f, 0.1f), ties), 0};
}

Appearance PavingAppearance(const Surface& surface, const Place& at) {
  constexpr double kPaver = 4;
  const double column = std::floor(at.u / kPaver);
  const double row = std::floor(at.v / kPaver);
  double factor = 1 + CellFade(at, kPaver) * 0.16 * (CellValue(surface, 1, column, row) - 0.5);
  factor *= 1 + 0.06 * Noise(surface, 2, at, 0.05, 4) + 0.07 * Noise(surface, 3, at, 1.2, 4);
  Rgb albedo = surface.color * static_cast<float>(factor);
  const double joints = 1 - (1 - FilteredLines(at.u, at.width_u, kPaver, 0.08)) *
                                (1 - FilteredLines(at.v, at.width_v, kPaver, 0.08));
  // Every twentieth foot a band of darker stone.
  const double bands = 1 - (1 - FilteredLines(at.u, at.width_u, 24, 1)) *
                               (1 - FilteredLines(at.v, at.width_v, 24, 1));
  albedo = Mix(albedo, albedo * 0.62f, bands);
  return {Mix(albedo, Rgb(0.1f, 0.1f, 0.095f), joints * 0.8), 0};
}

Appearance GrassAppearance(const Surface& surface, const Place& at) {
  const double patches = Noise(surface, 1, at, 0.02, 4);
  const double blades = Noise(surface, 2, at, 1.1, 6);
  Rgb albedo = Mix(surface.color, Rgb(0.15f, 0.15f, 0.055f), 0.35 + 0.6 * patches);
  return {albedo * static_cast<float>(1 + 0.4 * blades), 0};
}

Appearance FacadeAppearance(const Surface& surface, const Place& at) {
  const double pane =
      FilteredLines(at.u - 6, at.width_u, 12, 6.4) * FilteredLines(at.v - 7, at.width_v, 12.5, 6.5);
  const double column = std::floor(at.u / 12);
  const double row = std::floor(at.v / 12.5);
  Rgb albedo = surface.color * static_cast<float>(1 + 0.1 * Noise(surface, 1, at, 0.05, 4));
  albedo *= static_cast<float>(1 - 0.3 * FilteredLines(at.v, at.width_v, 12.5, 0.8));
  const Rgb glass = Rgb(0.06f, 0.07f, 0.085f) *
                    static_cast<float>(0.6 + 1.2 * CellValue(surface, 2, column, row));
  return {Mix(albedo, glass, pane), static_cast<float>(0.5 * pane)};
}

Appearance BrickAppearance(const Surface& surface, const Place& at) {
  constexpr double kLength = 0.667;
  constexpr double kCourseHeight = 0.222;
  constexpr double kMortar = 0.035;
  const double course = std::floor(at.v / kCourseHeight);
  const double shift = std::fmod(std::abs(course), 2.0) * kLength / 2;
  const double column = std::floor((at.u + shift) / kLength);
  const double fade = CellFade(at, kCourseHeight);
  const double chance = CellValue(surface, 1, column, course);
  Rgb albedo = surface.color * static_cast<float>(1 + 0.5 * fade * (chance - 0.5));
  if (CellValue(surface, 2, column, course) < 0.12) {
    albedo = Mix(albedo, Rgb(0.09f, 0.05f, 0.045f), 0.6 * fade);
  }
  // Patches fired together, seen from afar.
  albedo *= static_cast<float>(1 + 0.14 * Noise(surface, 3, at, 0.25, 5));
  const double mortar = 1 - (1 - FilteredLines(at.v, at.width_v, kCourseHeight, kMortar)) *
                                (1 - FilteredLines(at.u + shift, at.width_u, kLength, kMortar));
  albedo = Mix(albedo, Rgb(0.42f, 0.4f, 0.36f), mortar);
  return {albedo * static_cast<float>(Weathering(surface, at, 0.9)), 0};
}

Appearance StoneAppearance(const Surface& surface, const Place& at) {
  constexpr double kLength = 3;
  constexpr double kCourseHeight = 1.5;
  const double course = std::floor(at.v / kCourseHeight);
  const double shift = std::fmod(std::abs(course), 2.0) * kLength / 2;
  const double column = std::floor((at.u + shift) / kLength);
  double factor =
      1 + 0.24 * CellFade(at, kCourseHeight) * (CellValue(surface, 1, column, course) - 0.5);
  factor *= 1 + 0.1 * Noise(surface, 2, at, 0.6, 5);
  const double joints = 1 - (1 - FilteredLines(at.v, at.width_v, kCourseHeight, 0.06)) *
                                (1 - FilteredLines(at.u + shift, at.width_u, kLength, 0.06));
  Rgb albedo = surface.color * static_cast<float>(factor * Weathering(surface, at, 1));
  return {Mix(albedo, albedo * 0.4f, joints), 0};
}

Appearance PlasterAppearance(const Surface& surface, const Place& at) {
  double factor = 1 + 0.05 * Noise(surface, 1, at, 0.15, 5) + 0.05 * Noise(surface, 2, at, 2.5, 3);
  factor *= Weathering(surface, at, 0.8);
  return {surface.color * static_cast<float>(factor), 0};
}

Appearance SlateAppearance(const Surface& surface, const Place& at) {
  constexpr double kWidth = 0.8;
  constexpr double kCourseHeight = 0.7;
  const double course = std::floor(at.v / kCourseHeight);
  const double shift = std::fmod(std::abs(course), 2.0) * kWidth / 2;
  const double column = std::floor((at.u + shift) / kWidth);
  double factor =
      1 + 0.6 * CellFade(at, kCourseHeight) * (CellValue(surface, 1, column, course) - 0.5);
  factor *= 1 + 0.15 * Noise(surface, 2, at, 0.08, 5);
  const double shadows = FilteredLines(at.v, at.width_v, kCourseHeight, 0.07);
  const double gaps = FilteredLines(at.u + shift, at.width_u, kWidth, 0.04);
  Rgb albedo = surface.color * static_cast<float>(factor);
  return {albedo * static_cast<float>(1 - 0.55 * (1 - (1 - shadows) * (1 - gaps))), 0};
}

// Noise alone: strength and frequency tell gravel from asphalt, leaves and bark.
Appearance GrainyAppearance(const Surface& surface,
                            const Place& at,
                            double frequency,
                            double strength) {
  const double factor =
      1 + strength * Noise(surface, 1, at, frequency, 4) + 0.12 * Noise(surface, 2, at, 0.04, 4);
  return {surface.color * static_cast<float>(std::max(0.05, factor)), 0};
}

// Blotches without a single line, which reach full strength 3 ft inside a rectangular face's border
// and have died out a foot before it: nothing near an edge of the model pulls at that edge.
Appearance PanelAppearance(const Surface& surface, const Place& at) {
  const double inside = std::min(std::min(at.u - surface.low_u, surface.high_u - at.u),
                                 std::min(at.v - surface.low_v, surface.high_v - at.v));
  const double ramp = std::clamp((inside - 1) / 2, 0.0, 1.0);
  const double strength = 0.25 * ramp * ramp * (3 - 2 * ramp);
  return {surface.color * static_cast<float>(1 + strength * Noise(surface, 1, at, 0.3, 4)), 0};
}

Appearance BareAppearance(const Surface& surface, const Place& at) {
  switch (surface.material) {
    case Material::kTile:
      return TileAppearance(surface, at);
    case Material::kWindowBand:
      return GlazingAppearance(surface, at, 5, 0.28, 1.3, true);
    case Material::kStorefront:
      return GlazingAppearance(surface, at, 4, 0.24, 8, false);
    case Material::kConcrete:
      return ConcreteAppearance(surface, at);
    case Material::kPaving:
      return PavingAppearance(surface, at);
    case Material::kGrass:
      return GrassAppearance(surface, at);
    case Material::kFacade:
      return FacadeAppearance(surface, at);
    case Material::kBrick:
      return BrickAppearance(surface, at);
    case Material::kStone:
      return StoneAppearance(surface, at);
    case Material::kPlaster:
      return PlasterAppearance(surface, at);
    case Material::kSlate:
      return SlateAppearance(surface, at);
    case Material::kRoof:
      return GrainyAppearance(surface, at, 2.5, 0.35);
    case Material::kAsphalt:
      return GrainyAppearance(surface, at, 1.5, 0.2);
    case Material::kFoliage:
      return GrainyAppearance(surface, at, 3, 0.5);
    case Material::kBark:
      return GrainyAppearance(surface, at, 4, 0.5);
    case Material::kPaint:
      return {surface.color, 0.6f};
    case Material::kGlass:
      return {surface.color, 1};
    case Material::kEven:
      return {surface.color, 0};
    case Material::kPanel:
      return PanelAppearance(surface, at);
    case Material::kPlain:
      return GrainyAppearance(surface, at, 0.7, 0.05);
  }
  return {};
}

// Mean premultiplied colour and alpha of a decal over a footprint.
Eigen::Vector4d DecalMean(const Decal& decal, const Place& at) {
  const int columns = decal.sums.width - 1;
  const int rows = decal.sums.height - 1;
  const double column_per_foot = columns / (decal.high_u - decal.low_u);
  const double row_per_foot = rows / (decal.high_v - decal.low_v);
  // At least one texel wide, or a footprint within a texel would have no area.
  const double half_x = std::max(at.width_u * column_per_foot, 1.0) / 2;
  const double half_y = std::max(at.width_v * row_per_foot, 1.0) / 2;
  const double x = (at.u - decal.low_u) * column_per_foot;
  const double y = (decal.high_v - at.v) * row_per_foot;
  // The running sum is piecewise bilinear, so it can be read between the lattice's points.
  const auto sum_at = [&](double sum_x, double sum_y) -> Eigen::Vector4d {
    sum_x = std::clamp(sum_x, 0.0, static_cast<double>(columns));
    sum_y = std::clamp(sum_y, 0.0, static_cast<double>(rows));
    const int x0 = std::min(static_cast<int>(sum_x), columns - 1);
    const int y0 = std::min(static_cast<int>(sum_y), rows - 1);
    const double tx = sum_x - x0;
    const double ty = sum_y - y0;
    using Sum = Eigen::Map<const Eigen::Vector4d>;
    return (1 - ty) *
               ((1 - tx) * Sum(decal.sums.At(x0, y0)) + tx * Sum(decal.sums.At(x0 + 1, y0))) +
           ty * ((1 - tx) * Sum(decal.sums.At(x0, y0 + 1)) +
                 tx * Sum(decal.sums.At(x0 + 1, y0 + 1)));
  };
  const Eigen::Vector4d total = sum_at(x + half_x, y + half_y) - sum_at(x - half_x, y + half_y) -
                                sum_at(x + half_x, y - half_y) + sum_at(x - half_x, y - half_y);
  return total / (4 * half_x * half_y);
}

}  // namespace

Decal MakeDecal(const ImageF& rgba, double low_u, double low_v, double high_u, double high_v) {
  Decal decal{low_u, low_v, high_u, high_v, Raster<double>(rgba.width + 1, rgba.height + 1, 4)};
  for (int y = 0; y < rgba.height; ++y) {
    for (int x = 0; x < rgba.width; ++x) {
      const float* pixel = rgba.At(x, y);
      for (int c = 0; c < 4; ++c) {
        const double value = c < 3 ? pixel[c] * pixel[3] : pixel[3];
        decal.sums.At(x + 1, y + 1)[c] = value + decal.sums.At(x, y + 1)[c] +
                                         decal.sums.At(x + 1, y)[c] - decal.sums.At(x, y)[c];
      }
    }
  }
  return decal;
}

Appearance AppearanceAt(
    const Surface& surface, double u, double v, double width_u, double width_v) {
  const Place at{u, v, width_u, width_v};
  Appearance appearance = BareAppearance(surface, at);
  for (const Decal& decal : surface.decals) {
    if (u + width_u < decal.low_u || u - width_u > decal.high_u || v + width_v < decal.low_v ||
        v - width_v > decal.high_v) {
      continue;
    }
    const Eigen::Vector4d mean = DecalMean(decal, at);
    const auto alpha = static_cast<float>(std::clamp(mean[3], 0.0, 1.0));
    appearance.albedo = (1 - alpha) * appearance.albedo + mean.head<3>().cast<float>();
    appearance.gloss *= 1 - alpha;
  }
  return appearance;
}

}  // namespace groundglass
