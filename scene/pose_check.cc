// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/pose_check.h"

#include "scene/error.h"
#include "scene/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace groundglass {
namespace {

// Rays through the frame; whether this share of them meets a face's front.
bool SeesModel(
    const Visibility& visibility, const Camera& camera, int columns, int rows, double share) {
  const Eigen::Vector3d position = camera.PositionInWorld();
  int num_hits = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d px((column + 0.5) / columns * camera.width_px,
                               (row + 0.5) / rows * camera.height_px);
      const auto hit = visibility.FirstHit(position, UnprojectToWorld(camera, px));
      num_hits += hit && hit->is_front;
    }
  }
  return num_hits > 0 && num_hits >= share * columns * rows;
}

// What a program may have written in place of cam_from_world, and how to get back from it.
struct Mistake {
  const char* remark;
  RigidTransform (*undo)(const RigidTransform& written);
};

RigidTransform FromOpenGl(const RigidTransform& written) {
  const Eigen::Vector3d flip(1, -1, -1);
  return {flip.asDiagonal() * written.rotation, flip.asDiagonal() * written.translation};
}

RigidTransform FromPosition(const RigidTransform& written) {
  return {written.rotation, -(written.rotation * written.translation)};
}

RigidTransform FromWLast(const RigidTransform& written) {
  const Eigen::Quaterniond read(written.rotation);
  return {Eigen::Quaterniond(read.z(), read.w(), read.x(), read.y()).toRotationMatrix(),
          written.translation};
}

constexpr Mistake kMistakes[] = {
    {"if they were turned around: they look like world_from_cam (camera to world); COLMAP wants "
     "cam_from_world",
     [](const RigidTransform& written) { return Inverse(written); }},
    {"if TX TY TZ were the cameras' positions; COLMAP wants -R * position there",
     [](const RigidTransform& written) { return FromPosition(written); }},
    {"if the quaternions had their w last; COLMAP wants QW QX QY QZ",
     [](const RigidTransform& written) { return FromWLast(written); }},
    {"if their axes were OpenGL's (y up, looking along -z); COLMAP's camera has y down and looks "
     "along +z",
     [](const RigidTransform& written) { return FromOpenGl(written); }},
    {"if they were turned around and their axes were OpenGL's: they look like Blender's or NeRF's "
     "camera to world; COLMAP wants cam_from_world with y down and z forward",
     [](const RigidTransform& written) { return FromOpenGl(Inverse(written)); }},
    {"if TX TY TZ were the cameras' positions and the axes OpenGL's; COLMAP wants cam_from_world "
     "with y down and z forward",
     [](const RigidTransform& written) { return FromOpenGl(FromPosition(written)); }},
    {"if they were turned around and had w last; COLMAP wants cam_from_world and QW QX QY QZ",
     [](const RigidTransform& written) { return Inverse(FromWLast(written)); }},
};

}  // namespace

PoseCheck CheckPoses(const PolygonModel& model, const std::vector<Camera>& cameras) {
  PoseCheck check;
  check.num_cameras = static_cast<int>(cameras.size());
  const Visibility visibility(model);
  const auto count_seeing = [&](auto change) {
    std::atomic<int> count = 0;
    tbb::parallel_for(size_t{0}, cameras.size(), [&](size_t i) {
      Camera camera = cameras[i];
      camera.cam_from_world = change(camera.cam_from_world);
      count += SeesModel(visibility, camera, 15, 10, 0.02);
    });
    return count.load();
  };
  check.num_seeing = count_seeing([](const RigidTransform& written) { return written; });
  if (cameras.empty() || 2 * check.num_seeing >= check.num_cameras) return check;

  const std::string of_all = " of " + std::to_string(check.num_cameras) + " cameras";
  const std::string seen = (check.num_seeing == 0 ? "none" : std::to_string(check.num_seeing)) +
                           of_all + (check.num_seeing == 1 ? " sees" : " see") + " the model";
  int most = 0;
  const Mistake* likely = nullptr;
  for (const Mistake& mistake : kMistakes) {
    const int count = count_seeing(mistake.undo);
    if (count <= most) continue;
    most = count;
    likely = &mistake;
  }
  if (likely != nullptr && 5 * most >= 3 * check.num_cameras && most > 2 * check.num_seeing) {
    check.fault = seen + ", but " + std::to_string(most) + " would " + likely->remark;
    return check;
  }
  // A small thing far off, before all is called wrong.
  const bool is_any_seeing = check.num_seeing > 0 ||
                             std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
                               return SeesModel(visibility, camera, 150, 100, 0);
                             });
  if (!is_any_seeing) {
    check.fault = seen +
                  "; are they in its frame and unit (x east, y north, z up)? COLMAP's own frame is "
                  "arbitrary: colmap model_aligner brings it into the site's";
  }
  return check;
}

void RequireSoundPoses(const Scene& scene) {
  if (scene.camera_files.empty()) return;
  std::vector<Camera> cameras;
  for (const Photograph& photograph : scene.photographs) {
    cameras.push_back(CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height));
  }
  const std::string fault = CheckPoses(scene.model, cameras).fault;
  if (!fault.empty()) throw Error(scene.camera_files.back(), fault);
}

}  // namespace groundglass
