// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/sightings.h"
#include "scene/image.h"

#include <Eigen/Dense>

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct SurveyMapOptions {
  SightingOptions sighting;
  PickOptions pick;
  // About so many cells on the whole model, each face having one at least. More are finer and take
  // longer, in proportion to the number of photographs.
  int num_cells = 6000;

  void Check() const;  // throws Error naming the first field out of range
};

// What the photographs of a survey say of one place of the model.
struct MapCell {
  int num_photographs = 0;  // that show it
  // The one that shows it finest, and how long one of its pixels is there, model's unit.
  std::optional<int> finest;
  double pixel_size = 0;
  // The least standard deviation with which a photograph that shows it tells where it is: all three
  // coordinates together, model's unit, as for a pixel that is pointed at (PlaceInPhotograph).
  double sigma = 0;
};

// A face in cells of one size: cell (column, row) has its middle at
// corner + (column + 1/2) across + (row + 1/2) up.
struct FaceCells {
  Eigen::Vector3d corner_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d across_in_world = Eigen::Vector3d::Zero();  // one cell long
  Eigen::Vector3d up_in_world = Eigen::Vector3d::Zero();
  int columns = 0;
  int rows = 0;
  std::vector<MapCell> cells;  // row by row

  const MapCell& At(int column, int row) const { return cells[row * columns + column]; }
  // The cell in which a point of the face's plane lies, the nearest beyond the border.
  const MapCell& AtPoint(const Eigen::Vector3d& point_in_world) const;
};

// A face for each of the model's. Where a cell's middle is not on the face the nearest cell's that
// is stands for it. Nothing if `stop` became true meanwhile. Throws Error for a mask that cannot be
// read.
std::optional<std::vector<FaceCells>> MapSurvey(const Survey& survey,
                                                const Visibility& visibility,
                                                const std::atomic<bool>& stop,
                                                const SurveyMapOptions& options = {});

// Which photograph each texel of an output folder comes from: its provenance_N.png, by page, and
// the photographs' names, the first of which is 1 there. Nothing where the folder has none for
// these pages.
struct TexelSources {
  std::vector<std::string> photographs;
  std::vector<Image16> pages;
};
std::optional<TexelSources> ReadTexelSources(const std::filesystem::path& folder,
                                             const TexturedModel& textured);

}  // namespace groundglass
