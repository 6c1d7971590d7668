// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/bake_options.h"
#include "invrender/charts/charts.h"
#include "invrender/photos/prepared_photo.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace groundglass {

// A camera straight before the wall below, 10 away, that has 20 px for one unit of it and sees 5
// units to each side.
inline Camera CameraBefore(double x, double z = 2) {
  return LookAt({x, -10, z}, {x, 0, z}, 200, 100, 200);
}

// A wall of 8 x 4 with a chart of 64 x 32 texels, in photographs that each show it in one grey.
struct PreparedWall {
  PreparedWall(const std::vector<Camera>& cameras, const std::vector<float>& greys)
      : model(MakeModel()),
        photographs(Take(model, cameras, greys, folder.path())),
        visibility(model),
        charts(MakeCharts(model)),
        chart_of_face(ChartOfFace(charts, model.faces.size())),
        cache(FilesOf(photographs), std::numeric_limits<size_t>::max(), 8) {
    charts[0].SetTexelSize(0.125);
    charts[0].page = 0;
    for (size_t i = 0; i < photographs.size(); ++i) {
      photos.push_back(
          PreparePhoto(photographs[i],
                       static_cast<int>(i),
                       {model, visibility, nullptr, chart_of_face, options.photos, cache},
                       MaskDetail()));
    }
  }

  TemporaryFolder folder;
  PolygonModel model;
  std::vector<BakePhotograph> photographs;
  BakeOptions options;
  Visibility visibility;
  std::vector<Chart> charts;
  std::vector<int> chart_of_face;
  PhotoCache cache;
  std::vector<PreparedPhoto> photos;

 private:
  static PolygonModel MakeModel() {
    PolygonModel model;
    AddWall(model, 0, 8, 0, 4);
    return model;
  }
  static std::vector<BakePhotograph> Take(const PolygonModel& model,
                                          const std::vector<Camera>& cameras,
                                          const std::vector<float>& greys,
                                          const std::filesystem::path& folder) {
    std::vector<BakePhotograph> photographs;
    for (size_t i = 0; i < cameras.size(); ++i) {
      const float grey = greys[i];
      photographs.push_back(PhotographPainted(
          model,
          cameras[i],
          [grey](int, const Eigen::Vector3d&) -> Eigen::Array3f {
            return Eigen::Array3f::Constant(grey);
          },
          folder,
          "s" + std::to_string(i + 1)));
    }
    return photographs;
  }
  static std::vector<std::filesystem::path> FilesOf(const std::vector<BakePhotograph>& all) {
    std::vector<std::filesystem::path> files;
    for (const BakePhotograph& photograph : all) files.push_back(photograph.image_file);
    return files;
  }
};

}  // namespace groundglass
