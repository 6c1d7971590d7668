// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One row of tags.csv: the photograph as the table calls it, without folder and an image's
// extension, and its tag.
struct TagRow {
  std::string name;
  int line = 0;
  ViewTag tag;
  // The same as a view file's, where `a` or `v` is empty: the picture's metadata may tell. Without
  // any number where the row has none.
  std::optional<std::string> text;
};

// What could be read of a tags.csv, and one line for each fault.
struct TagTable {
  std::vector<TagRow> rows;
  std::vector<std::string> faults;  // of the table as a whole
  // Of single rows, in their order, by photograph; by "tags.csv:7" where the row does not say which
  // one.
  struct RowFault {
    std::string name;
    int line = 0;
    std::string text;
  };
  std::vector<RowFault> row_faults;
  std::vector<std::string> warnings;
  bool has_angles = false;  // yaw,pitch in place of i,j,k
};

// Reads tags.csv (docs/scene-folder.md): a view file's keys as columns; `yaw,pitch` may stand for
// i,j,k (the look-at point is then put as far away as the model's middle), and `lat,lon,height`
// for x,y,z where the model says its origin.
TagTable ReadTagTable(const std::filesystem::path& file, const PolygonModel& model);

// A place on Earth (WGS 84, degrees and metres above the same datum as the model's origin) in
// `site`, in the model's unit. The model must have a georeference.
Eigen::Vector3d SiteFromGeodetic(const PolygonModel& model,
                                 double latitude_deg,
                                 double longitude_deg,
                                 double height_m);

}  // namespace groundglass
