// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/pose_check.h"

#include "scene/error.h"
#include "scene/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace groundglass {
namespace {

// Of rays through the frame, the share that meets a face's front.
double ShareOfModel(const Visibility& visibility, const Camera& camera, int columns, int rows) {
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
  return static_cast<double>(num_hits) / (columns * rows);
}

// How many cameras see the model, and how much of their frames it fills, all together.
struct Sight {
  int num_seeing = 0;
  double share = 0;
};

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
  const auto look = [&](auto change) {
    std::vector<double> shares(cameras.size());
    tbb::parallel_for(size_t{0}, cameras.size(), [&](size_t i) {
      Camera camera = cameras[i];
      camera.cam_from_world = change(camera.cam_from_world);
      shares[i] = ShareOfModel(visibility, camera, 15, 10);
    });
    Sight sight;
    for (const double share : shares) {
      sight.num_seeing += share >= 0.02;
      sight.share += share;
    }
    return sight;
  };
  const Sight written = look([](const RigidTransform& pose) { return pose; });
  check.num_seeing = written.num_seeing;
  if (cameras.empty()) return check;

  const std::string of_all = " of " + std::to_string(check.num_cameras) + " cameras";
  const std::string seen = (check.num_seeing == 0 ? "none" : std::to_string(check.num_seeing)) +
                           of_all + (check.num_seeing == 1 ? " sees" : " see") + " the model";
  Sight most;
  const Mistake* likely = nullptr;
  for (const Mistake& mistake : kMistakes) {
    const Sight sight = look(mistake.undo);
    if (sight.num_seeing < most.num_seeing ||
        (sight.num_seeing == most.num_seeing && sight.share <= most.share)) {
      continue;
    }
    most = sight;
    likely = &mistake;
  }
  // Where some see it as they are, perhaps by chance, nearly all must if they are read otherwise,
  // and much more of it.
  const bool is_likely = most.num_seeing > 2 * written.num_seeing
                             ? 5 * most.num_seeing >= 3 * check.num_cameras
                             : 10 * most.num_seeing >= 9 * check.num_cameras &&
                                   most.share > 1.5 * written.share &&
                                   most.num_seeing > written.num_seeing;
  if (likely != nullptr && is_likely) {
    check.fault = seen + ", but " + std::to_string(most.num_seeing) + " would " + likely->remark;
    return check;
  }
  if (5 * check.num_seeing >= check.num_cameras) return check;
  // A small thing far off, before all is called wrong.
  const bool is_any_seeing = check.num_seeing > 0 ||
                             std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
                               return ShareOfModel(visibility, camera, 150, 100) > 0;
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
