// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colmap_records.h"

#include "scene/camera_check.h"
#include "scene/error.h"
#include "scene/text.h"

#include <cmath>

namespace groundglass {
namespace {

// In the order of COLMAP's numbers. Those without a focal length here are not read.
constexpr ColmapCameraKind kKinds[] = {
    {0, "SIMPLE_PINHOLE", 3, 0, 0, 1, 2, -1, -1, -1, -1, -1},
    {1, "PINHOLE", 4, 0, 1, 2, 3, -1, -1, -1, -1, -1},
    {2, "SIMPLE_RADIAL", 4, 0, 0, 1, 2, 3, -1, -1, -1, -1},
    {3, "RADIAL", 5, 0, 0, 1, 2, 3, 4, -1, -1, -1},
    {4, "OPENCV", 8, 0, 1, 2, 3, 4, 5, 6, 7, -1},
    {5, "OPENCV_FISHEYE", 8, -1, -1, -1, -1, -1, -1, -1, -1, -1},
    {6, "FULL_OPENCV", 12, 0, 1, 2, 3, 4, 5, 6, 7, 8},
    {7, "FOV", 5, -1, -1, -1, -1, -1, -1, -1, -1, -1},
    {8, "SIMPLE_RADIAL_FISHEYE", 4, -1, -1, -1, -1, -1, -1, -1, -1, -1},
    {9, "RADIAL_FISHEYE", 5, -1, -1, -1, -1, -1, -1, -1, -1, -1},
    {10, "THIN_PRISM_FISHEYE", 12, -1, -1, -1, -1, -1, -1, -1, -1, -1},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, -1, -1, -1, -1, -1, -1, -1, -1, -1},
};
constexpr int kFirstRational = 9;  // of FULL_OPENCV: k4, k5, k6

std::string Remedy(const std::filesystem::path& folder) {
  return "; make pinhole pictures and a model of them with: colmap image_undistorter --image_path "
         "IMAGES --input_path " +
         folder.string() +
         " --output_path undistorted, and take undistorted/images and undistorted/sparse";
}

}  // namespace

const ColmapCameraKind* FindColmapCameraKind(std::string_view name) {
  for (const ColmapCameraKind& kind : kKinds) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

const ColmapCameraKind* FindColmapCameraKind(int id) {
  for (const ColmapCameraKind& kind : kKinds) {
    if (kind.id == id) return &kind;
  }
  return nullptr;
}

ColmapCamera UnreadColmapCamera(const std::string& kind,
                                const std::string& place,
                                const std::filesystem::path& folder) {
  return {{},
          place + ": camera model " + kind +
              " is not read; expected SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV or "
              "FULL_OPENCV" +
              Remedy(folder)};
}

ColmapCamera MakeColmapCamera(const ColmapCameraKind& kind,
                              long long width,
                              long long height,
                              const std::vector<double>& parameters,
                              const std::string& place,
                              const std::filesystem::path& folder) {
  const std::string size_fault =
      FindSizeFault(static_cast<double>(width), static_cast<double>(height));
  if (!size_fault.empty()) throw Error(place + ": " + size_fault);
  if (static_cast<int>(parameters.size()) != kind.num_parameters) {
    throw Error(place + ": " + std::string(kind.name) + " has " +
                std::to_string(kind.num_parameters) + " parameters, not " +
                std::to_string(parameters.size()));
  }
  for (const double parameter : parameters) {
    if (!std::isfinite(parameter)) {
      throw Error(place + ": camera parameter: not a finite number");
    }
  }
  if (kind.focal_x < 0) return UnreadColmapCamera(Quote(kind.name), place, folder);
  const auto value = [&](int index) {
    return index < 0 ? 0.0 : parameters[static_cast<size_t>(index)];
  };
  ColmapCamera result;
  Camera& camera = result.camera;
  camera.width_px = static_cast<int>(width);
  camera.height_px = static_cast<int>(height);
  camera.focal_x_px = value(kind.focal_x);
  camera.focal_y_px = value(kind.focal_y);
  camera.center_x_px = value(kind.center_x);
  camera.center_y_px = value(kind.center_y);
  camera.k1 = value(kind.k1);
  camera.k2 = value(kind.k2);
  camera.k3 = value(kind.k3);
  camera.p1 = value(kind.p1);
  camera.p2 = value(kind.p2);
  const std::string fault = FindCameraFault(camera);
  if (!fault.empty()) throw Error(place + ": " + fault);
  for (int i = kFirstRational; i < kind.num_parameters; ++i) {
    if (value(i) == 0) continue;
    result.fault = place + ": FULL_OPENCV is read where k4, k5 and k6 are 0; here they are " +
                   FormatNumber(value(9)) + ", " + FormatNumber(value(10)) + ", " +
                   FormatNumber(value(11)) + Remedy(folder);
    break;
  }
  return result;
}

}  // namespace groundglass
