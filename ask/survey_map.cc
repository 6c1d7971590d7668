// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey_map.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_folder.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Two directions in a plane, at right angles and of unit length; the first is level.
std::array<Eigen::Vector3d, 2> LevelAxes(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(normal);
  const Eigen::Vector3d across =
      level.norm() > 1e-6 ? level.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  return {across, normal.cross(across)};
}

// A face with room for its cells, none of which is filled in.
FaceCells LayOutCells(const PolygonModel& model, int face, double cell_size) {
  const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
  const auto [across, up] = LevelAxes(normal);
  const Eigen::Vector3d& first = model.points_in_world[model.faces[face].points[0]];
  Eigen::Array2d least(0, 0);
  Eigen::Array2d most(0, 0);
  for (const int point : model.faces[face].points) {
    const Eigen::Vector3d from_first = model.points_in_world[point] - first;
    const Eigen::Array2d at(from_first.dot(across), from_first.dot(up));
    least = least.min(at);
    most = most.max(at);
  }
  constexpr int kMostCells = 512;  // of one face, each way
  FaceCells cells;
  const auto count = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / cell_size)), 1, kMostCells);
  };
  cells.columns = count(most.x() - least.x());
  cells.rows = count(most.y() - least.y());
  cells.corner_in_world = first + least.x() * across + least.y() * up;
  cells.across_in_world = across * (most.x() - least.x()) / cells.columns;
  cells.up_in_world = up * (most.y() - least.y()) / cells.rows;
  cells.cells.resize(static_cast<size_t>(cells.columns) * cells.rows);
  return cells;
}

// Whether a point of the face's plane lies on the face.
class FaceInside {
 public:
  FaceInside(const PolygonModel& model, int face)
      : model_(model),
        normal_(ComputeFacePlane(model, face).normal_in_world),
        triangles_(TriangulateFace(model, face)) {}

  bool Holds(const Eigen::Vector3d& point) const {
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const auto& triangle) {
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d& start = model_.points_in_world[triangle[i]];
        const Eigen::Vector3d& end = model_.points_in_world[triangle[(i + 1) % 3]];
        if (normal_.cross(end - start).dot(point - start) < 0) return false;
      }
      return true;
    });
  }
  // One that does, for faces that are narrower than a cell.
  Eigen::Vector3d APoint() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int point : triangles_.front()) sum += model_.points_in_world[point];
    return sum / 3;
  }
  bool IsEmpty() const { return triangles_.empty(); }

 private:
  const PolygonModel& model_;
  Eigen::Vector3d normal_;
  std::vector<std::array<int, 3>> triangles_;
};

// Asks all photographs about single places.
class CellAsker {
 public:
  CellAsker(const Survey& survey, const Visibility& visibility, const SurveyMapOptions& options)
      : survey_(survey), visibility_(visibility), options_(options), masks_(survey) {
    const double sigma = ModelSigma(survey.model);
    model_covariance_ = Eigen::Matrix3d::Identity() * sigma * sigma;
  }

  MapCell Ask(const Eigen::Vector3d& point_in_world, int face) {
    Place place;
    place.point_in_world = point_in_world;
    place.faces = {face};
    place.sources.push_back({ErrorKind::kModel, 0, Eigen::Matrix3d::Identity(), model_covariance_});
    MapCell cell;
    double least_variance = std::numeric_limits<double>::infinity();
    double least_area = std::numeric_limits<double>::infinity();
    for (int i = 0; i < static_cast<int>(survey_.photographs.size()); ++i) {
      const Sighting sighting =
          FindSighting(survey_, visibility_, place, i, masks_, options_.sighting);
      if (sighting.state != SightingState::kShown) continue;
      ++cell.num_photographs;
      // The finest by its area, as FindSightings orders them.
      const double area = sighting.pixel_size[0] * sighting.pixel_size[1];
      if (area < least_area) {
        least_area = area;
        cell.finest = i;
        cell.pixel_size = sighting.pixel_size[0];
      }
      least_variance = std::min(least_variance, VarianceIn(i, *sighting.image_px, face));
    }
    if (std::isfinite(least_variance)) cell.sigma = std::sqrt(std::max(0.0, least_variance));
    return cell;
  }

 private:
  double VarianceIn(int photograph, const Eigen::Vector2d& image_px, int face) const {
    try {
      const Place place =
          PlaceInPhotograph(survey_, visibility_, photograph, image_px, 0, options_.pick);
      if (place.nearest_face == face) return place.Covariance().trace();
    } catch (const Error&) {
      // A ray past the border of what it was aimed at.
    }
    return std::numeric_limits<double>::infinity();
  }

  const Survey& survey_;
  const Visibility& visibility_;
  const SurveyMapOptions& options_;
  SurveyMasks masks_;
  Eigen::Matrix3d model_covariance_;
};

// Cells whose middle is not on the face take what the nearest one has that is.
void FillFromNearest(const std::vector<char>& is_inside, FaceCells& face) {
  std::vector<MapCell> filled = face.cells;
  for (int row = 0; row < face.rows; ++row) {
    for (int column = 0; column < face.columns; ++column) {
      const int cell = row * face.columns + column;
      if (is_inside[cell]) continue;
      int nearest = std::numeric_limits<int>::max();
      for (int other = 0; other < face.rows * face.columns; ++other) {
        const int by_row = other / face.columns - row;
        const int by_column = other % face.columns - column;
        const int distance = by_row * by_row + by_column * by_column;
        if (!is_inside[other] || distance >= nearest) continue;
        nearest = distance;
        filled[cell] = face.cells[other];
      }
    }
  }
  face.cells = std::move(filled);
}

void AskCells(const Survey& survey,
              int face,
              const std::atomic<bool>& stop,
              CellAsker& asker,
              FaceCells& cells) {
  const FaceInside inside(survey.model, face);
  if (inside.IsEmpty()) return;
  std::vector<char> is_inside(cells.cells.size(), 0);
  bool has_any = false;
  for (int row = 0; row < cells.rows && !stop; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      const Eigen::Vector3d middle = cells.corner_in_world +
                                     (column + 0.5) * cells.across_in_world +
                                     (row + 0.5) * cells.up_in_world;
      if (!inside.Holds(middle)) continue;
      const int cell = row * cells.columns + column;
      is_inside[cell] = 1;
      has_any = true;
      cells.cells[cell] = asker.Ask(middle, face);
    }
  }
  if (has_any) {
    FillFromNearest(is_inside, cells);
  } else {
    std::fill(cells.cells.begin(), cells.cells.end(), asker.Ask(inside.APoint(), face));
  }
}

}  // namespace

void SurveyMapOptions::Check() const {
  sighting.Check();
  pick.Check();
  CheckFromTo(num_cells, 1, 10000000, "survey map options: num_cells");
}

const MapCell& FaceCells::AtPoint(const Eigen::Vector3d& point_in_world) const {
  const Eigen::Vector3d from_corner = point_in_world - corner_in_world;
  const auto place = [&](const Eigen::Vector3d& step, int count) {
    const double at = from_corner.dot(step) / std::max(step.squaredNorm(), 1e-300);
    return static_cast<int>(std::clamp(std::floor(at), 0.0, count - 1.0));
  };
  return At(place(across_in_world, columns), place(up_in_world, rows));
}

std::optional<std::vector<FaceCells>> MapSurvey(const Survey& survey,
                                                const Visibility& visibility,
                                                const std::atomic<bool>& stop,
                                                const SurveyMapOptions& options) {
  options.Check();
  const int num_faces = static_cast<int>(survey.model.faces.size());
  double area = 0;
  for (int face = 0; face < num_faces; ++face) area += ComputeFaceArea(survey.model, face);
  const double cell_size = std::sqrt(std::max(area, 1e-12) / options.num_cells);
  CellAsker asker(survey, visibility, options);
  std::vector<FaceCells> map;
  for (int face = 0; face < num_faces && !stop; ++face) {
    map.push_back(LayOutCells(survey.model, face, cell_size));
    AskCells(survey, face, stop, asker, map.back());
  }
  if (stop) return std::nullopt;
  return map;
}

std::optional<TexelSources> ReadTexelSources(const fs::path& folder,
                                             const TexturedModel& textured) {
  TexelSources sources;
  sources.photographs = NumberedPhotographs(folder);
  for (size_t i = 0; i < textured.pages.size(); ++i) {
    const fs::path file = folder / ("provenance_" + std::to_string(i) + ".png");
    if (!fs::exists(file)) return std::nullopt;
    sources.pages.push_back(ReadLabels(file));
    const Image8& page = textured.pages[i].srgb8;
    const Image16& numbers = sources.pages.back();
    if (numbers.width != page.width || numbers.height != page.height) return std::nullopt;
    const auto is_known = [&](uint16_t number) {
      return number == kProvenanceFilled || number <= sources.photographs.size();
    };
    if (!std::all_of(numbers.values.begin(), numbers.values.end(), is_known)) return std::nullopt;
  }
  if (sources.pages.empty()) return std::nullopt;
  return sources;
}

}  // namespace groundglass
