// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/look_map.h"

#include "scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace groundglass {
namespace {

constexpr Srgb8Colour kNothing = {72, 72, 78};
constexpr Srgb8Colour kFilledIn = {190, 190, 196};

constexpr int kMostCounted = 5;
// None stands out by hue and by brightness; then the more, the darker.
constexpr std::array<Srgb8Colour, kMostCounted + 1> kCountColours = {{{213, 94, 0},
                                                                      {222, 235, 247},
                                                                      {158, 202, 225},
                                                                      {107, 174, 214},
                                                                      {49, 130, 189},
                                                                      {8, 69, 148}}};

// Each lighter than the one before, whatever one's colour vision.
constexpr std::array<Srgb8Colour, 5> kScale = {
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
constexpr double kScaleStartM = 0.001;
constexpr double kScaleDecades = 3;

Srgb8Colour MixColours(const Srgb8Colour& a, const Srgb8Colour& b, double share_of_b) {
  Srgb8Colour mixed;
  for (size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<uint8_t>(std::lround(a[i] + share_of_b * (b[i] - a[i])));
  }
  return mixed;
}

Srgb8Colour ScaleAt(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kScale.size() - 1);
  const size_t step = std::min(static_cast<size_t>(at), kScale.size() - 2);
  return MixColours(kScale[step], kScale[step + 1], at - static_cast<double>(step));
}

Legend LengthLegend(const std::string& title) {
  Legend legend;
  legend.title = title;
  legend.is_continuous = true;
  const std::array<const char*, 4> labels = {"1 mm", "1 cm", "10 cm", "1 m"};
  for (size_t i = 0; i < labels.size(); ++i) {
    legend.entries.push_back({ScaleAt(static_cast<double>(i) / (labels.size() - 1)), labels[i]});
  }
  return legend;
}

// Cells of faces as blocks of texels on one page, row by row.
class CellPage {
 public:
  explicit CellPage(const std::vector<FaceCells>& faces) {
    int x = 0;
    int y = 0;
    int row_height = 0;
    for (const FaceCells& face : faces) {
      const int width = kBlock * face.columns + 2 * kBorder;
      const int height = kBlock * face.rows + 2 * kBorder;
      if (x + width > kPageWidth && x > 0) {
        y += row_height;
        x = row_height = 0;
      }
      corners_.push_back({x + kBorder, y + kBorder});
      x += width;
      row_height = std::max(row_height, height);
      page_width_ = std::max(page_width_, x);
    }
    page_height_ = y + row_height;
  }

  TexturedModel Paint(const PolygonModel& model,
                      const std::vector<FaceCells>& faces,
                      const std::function<Srgb8Colour(int, const MapCell&)>& colour_of) const {
    TexturedModel painted;
    painted.model = model;
    TexturePage& page = painted.pages.emplace_back();
    page.srgb8 = Image8(std::max(1, page_width_), std::max(1, page_height_), 3, 72);
    for (size_t i = 0; i < faces.size(); ++i) {
      PaintFace(faces[i], corners_[i], static_cast<int>(i), colour_of, page.srgb8);
      FaceTexture& texture = painted.faces.emplace_back();
      texture.page = 0;
      for (const int point : model.faces[i].points) {
        const Eigen::Vector3d by = model.points_in_world[point] - faces[i].corner_in_world;
        const auto along = [&](const Eigen::Vector3d& step) {
          return kBlock * by.dot(step) / std::max(step.squaredNorm(), 1e-300);
        };
        texture.corners_texel.push_back({corners_[i][0] + along(faces[i].across_in_world),
                                         corners_[i][1] + along(faces[i].up_in_world)});
      }
    }
    return painted;
  }

 private:
  static constexpr int kBlock = 4;   // texels of a cell, each way, so that its borders are sharp
  static constexpr int kBorder = 3;  // texels around a face, which a smaller picture mixes in
  static constexpr int kPageWidth = 2048;

  static void PaintFace(const FaceCells& face,
                        const std::array<int, 2>& corner,
                        int index,
                        const std::function<Srgb8Colour(int, const MapCell&)>& colour_of,
                        Image8& page) {
    for (int y = -kBorder; y < kBlock * face.rows + kBorder; ++y) {
      for (int x = -kBorder; x < kBlock * face.columns + kBorder; ++x) {
        const int column = std::clamp(x / kBlock, 0, face.columns - 1);
        const int row = std::clamp(y / kBlock, 0, face.rows - 1);
        const Srgb8Colour colour = colour_of(index, face.At(column, row));
        std::copy(colour.begin(), colour.end(), page.At(corner[0] + x, corner[1] + y));
      }
    }
  }

  std::vector<std::array<int, 2>> corners_;
  int page_width_ = 0;
  int page_height_ = 0;
};

Legend CountLegend() {
  Legend legend;
  legend.title = "photographs that show it";
  for (int i = 0; i <= kMostCounted; ++i) {
    legend.entries.push_back(
        {kCountColours[i], i == kMostCounted ? std::to_string(i) + " or more" : std::to_string(i)});
  }
  return legend;
}

Legend PhotographLegend(const std::string& title, const std::vector<std::string>& names) {
  Legend legend;
  legend.title = title;
  for (size_t i = 0; i < names.size(); ++i) {
    legend.entries.push_back({PhotographColour(static_cast<int>(i)), names[i]});
  }
  legend.entries.push_back({kNothing, "none"});
  return legend;
}

// The texture's own pages, each texel in the colour of its photograph.
ColouredModel ColourTexels(const TexturedModel& textured, const TexelSources& texels) {
  ColouredModel coloured;
  coloured.textured.model = textured.model;
  coloured.textured.faces = textured.faces;
  bool has_filled = false;
  for (const Image16& numbers : texels.pages) {
    Image8& page = coloured.textured.pages.emplace_back().srgb8;
    page = Image8(numbers.width, numbers.height, 3);
    for (size_t i = 0; i < numbers.values.size(); ++i) {
      const uint16_t number = numbers.values[i];
      has_filled = has_filled || number == kProvenanceFilled;
      const Srgb8Colour colour = number == kProvenanceNone     ? kNothing
                                 : number == kProvenanceFilled ? kFilledIn
                                                               : PhotographColour(number - 1);
      std::copy(colour.begin(), colour.end(), &page.values[3 * i]);
    }
  }
  coloured.legend = PhotographLegend("texels come from", texels.photographs);
  if (has_filled) coloured.legend.entries.push_back({kFilledIn, "filled in"});
  return coloured;
}

std::vector<std::string> SurveyNames(const Survey& survey) {
  std::vector<std::string> names;
  for (const SurveyPhotograph& photograph : survey.photographs) names.push_back(photograph.name);
  return names;
}

}  // namespace

Srgb8Colour PhotographColour(int photograph) {
  constexpr std::array<Srgb8Colour, 7> kColours = {{{230, 159, 0},
                                                    {86, 180, 233},
                                                    {0, 158, 115},
                                                    {240, 228, 66},
                                                    {0, 114, 178},
                                                    {213, 94, 0},
                                                    {204, 121, 167}}};
  const int count = static_cast<int>(kColours.size());
  const Srgb8Colour& colour = kColours[photograph % count];
  const int round = photograph / count % 3;
  if (round == 0) return colour;
  // First light ones lighter and dark ones darker, which keeps them apart best.
  const bool is_light = Luma(colour[0], colour[1], colour[2]) > 140;
  return is_light == (round == 1) ? MixColours(colour, {255, 255, 255}, 0.55)
                                  : MixColours(colour, {0, 0, 0}, 0.5);
}

Srgb8Colour LengthColour(double length_m) {
  return ScaleAt(std::log10(std::max(length_m, 1e-9) / kScaleStartM) / kScaleDecades);
}

Srgb8Colour LengthScaleColour(double share) { return ScaleAt(share); }

std::shared_ptr<const ColouredModel> ColourModel(LookMap map, const MapSources& sources) {
  const TexturedModel& textured = *sources.textured;
  if (map == LookMap::kProvenance && sources.texels != nullptr) {
    return std::make_shared<ColouredModel>(ColourTexels(textured, *sources.texels));
  }
  const Survey& survey = *sources.survey;
  const double metres = MetresPerUnit(survey.model.unit);
  std::function<Srgb8Colour(int, const MapCell&)> colour_of;
  auto coloured = std::make_shared<ColouredModel>();
  switch (map) {
    case LookMap::kNone:
    case LookMap::kTiles1988:
      break;
    case LookMap::kCoverage:
      coloured->legend = CountLegend();
      colour_of = [](int, const MapCell& cell) {
        return kCountColours[std::min(cell.num_photographs, kMostCounted)];
      };
      break;
    case LookMap::kProvenance:
      coloured->legend = PhotographLegend("shown finest by", SurveyNames(survey));
      colour_of = [](int, const MapCell& cell) {
        return cell.finest ? PhotographColour(*cell.finest) : kNothing;
      };
      break;
    case LookMap::kTexelSize:
      if (textured.pages.empty()) {
        coloured->legend = LengthLegend("a pixel of the finest photograph");
        colour_of = [metres](int, const MapCell& cell) {
          return cell.finest ? LengthColour(metres * cell.pixel_size) : kNothing;
        };
      } else {
        coloured->legend = LengthLegend("a texel");
        colour_of = [metres, &survey](int face, const MapCell&) {
          const auto texel = TexelSize(survey, face);
          return texel ? LengthColour(metres * std::max((*texel)[0], (*texel)[1])) : kNothing;
        };
      }
      break;
    case LookMap::kUncertainty:
      coloured->legend = LengthLegend("one standard deviation");
      colour_of = [metres](int, const MapCell& cell) {
        return cell.num_photographs > 0 ? LengthColour(metres * cell.sigma) : kNothing;
      };
      break;
  }
  if (coloured->legend.is_continuous) coloured->legend.entries.push_back({kNothing, "none"});
  const CellPage page(*sources.cells);
  coloured->textured = page.Paint(textured.model, *sources.cells, colour_of);
  return coloured;
}

}  // namespace groundglass
