// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/formats.h"
#include "scene/error.h"

#include <bit>
#include <cstdint>
#include <map>

namespace groundglass {
namespace {

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

template <typename T>
void AppendBytes(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

constexpr int32_t kOpencv = 4;      // fx fy cx cy k1 k2 p1 p2
constexpr int32_t kFullOpencv = 6;  // and k3 k4 k5 k6

std::string CamerasBin(const std::vector<ExchangeCamera>& cameras,
                       const std::vector<uint32_t>& ids) {
  std::string bytes;
  AppendBytes<uint64_t>(bytes, cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i].camera;
    AppendBytes<uint32_t>(bytes, ids[i]);
    AppendBytes<int32_t>(bytes, camera.k3 == 0 ? kOpencv : kFullOpencv);
    AppendBytes<uint64_t>(bytes, static_cast<uint64_t>(camera.width_px));
    AppendBytes<uint64_t>(bytes, static_cast<uint64_t>(camera.height_px));
    for (const double value : {camera.focal_x_px,
                               camera.focal_y_px,
                               camera.center_x_px,
                               camera.center_y_px,
                               camera.k1,
                               camera.k2,
                               camera.p1,
                               camera.p2}) {
      AppendBytes(bytes, value);
    }
    if (camera.k3 == 0) continue;
    for (const double value : {camera.k3, 0.0, 0.0, 0.0}) AppendBytes(bytes, value);
  }
  return bytes;
}

std::string ImagesBin(const std::vector<ExchangeCamera>& cameras,
                      const std::vector<uint32_t>& ids,
                      const std::vector<std::string>& names) {
  std::string bytes;
  AppendBytes<uint64_t>(bytes, cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) {
    const RigidTransform& pose = cameras[i].camera.cam_from_world;
    Eigen::Quaterniond q = Eigen::Quaterniond(pose.rotation).normalized();
    if (q.w() < 0) q.coeffs() *= -1;
    AppendBytes<uint32_t>(bytes, ids[i]);
    for (const double value : {q.w(),
                               q.x(),
                               q.y(),
                               q.z(),
                               pose.translation.x(),
                               pose.translation.y(),
                               pose.translation.z()}) {
      AppendBytes(bytes, value);
    }
    AppendBytes<uint32_t>(bytes, ids[i]);
    bytes += names[i] + '\0';
    AppendBytes<uint64_t>(bytes, 0);  // points
  }
  return bytes;
}

// Numbered by the byte order of names, as COLMAP's database numbers a folder's images.
std::vector<uint32_t> IdsByName(const std::vector<std::string>& names,
                                const std::filesystem::path& out) {
  std::map<std::string, uint32_t> id_of_name;
  for (const std::string& name : names) {
    if (!id_of_name.emplace(name, 0).second) throw Error(out, "two images are called " + name);
  }
  uint32_t last = 0;
  for (auto& [name, id] : id_of_name) id = ++last;
  std::vector<uint32_t> ids;
  for (const std::string& name : names) ids.push_back(id_of_name.at(name));
  return ids;
}

}  // namespace

std::vector<FileToWrite> FormatColmapBinary(const ExchangeScene& scene,
                                            const std::filesystem::path& out) {
  std::vector<std::string> names;
  for (const ExchangeCamera& camera : scene.cameras) names.push_back(camera.image_name);
  const std::vector<uint32_t> ids = IdsByName(names, out);
  return {{out / "cameras.bin", CamerasBin(scene.cameras, ids)},
          {out / "images.bin", ImagesBin(scene.cameras, ids, names)},
          {out / "points3D.bin", std::string(8, '\0')}};
}

}  // namespace groundglass
