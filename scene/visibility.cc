// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/visibility.h"

#include "scene/building_bounds.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <mutex>
#include <new>
#include <vector>

namespace groundglass {

namespace {

// Embree holds all of TBB to the most threads that any of its devices asks for, as long as they
// live. Ours ask for one, since the BVH's layout must not depend on how many there are; once one is
// built, a device without a scene asks for all, so that the rest of the program may use them.
class ThreadLimit {
 public:
  // While one is built: one thread.
  static std::unique_lock<std::mutex> Lower() {
    std::unique_lock<std::mutex> lock(Mutex());
    if (Lifter()) rtcReleaseDevice(Lifter());
    Lifter() = nullptr;
    return lock;
  }
  static void Lift(const std::unique_lock<std::mutex>&, int num_built) {
    NumBuilt() += num_built;
    if (NumBuilt() > 0) Lifter() = rtcNewDevice(nullptr);
  }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static RTCDevice& Lifter() {
    static RTCDevice lifter = nullptr;
    return lifter;
  }
  static int& NumBuilt() {
    static int num_built = 0;
    return num_built;
  }
};

}  // namespace

struct Visibility::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<int> face_of_triangle;
  Box bounds;
  double building_size = 0;

  bool is_built = false;

  ~Impl() {
    const auto lock = ThreadLimit::Lower();
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
    ThreadLimit::Lift(lock, is_built ? -1 : 0);
  }
};

Visibility::Visibility(const PolygonModel& model) : impl_(std::make_unique<Impl>()) {
  impl_->bounds = ComputeBounds(model);
  impl_->building_size = ComputeBuildingBounds(model).Diagonal();
  std::vector<std::array<int, 3>> triangles;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
      triangles.push_back(triangle);
      impl_->face_of_triangle.push_back(face);
    }
  }
  const auto lock = ThreadLimit::Lower();
  impl_->device = rtcNewDevice("threads=1");
  if (!impl_->device) throw std::bad_alloc();
  impl_->scene = rtcNewScene(impl_->device);
  // Watertight along shared edges, so that no ray slips between two walls.
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                               RTC_BUFFER_TYPE_VERTEX,
                                                               0,
                                                               RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float),
                                                               model.points_in_world.size()));
    // Embree works in single precision: keep the numbers small by centring the model.
    const Eigen::Vector3d center = impl_->bounds.Center();
    for (size_t i = 0; i < model.points_in_world.size(); ++i) {
      const Eigen::Vector3d local = model.points_in_world[i] - center;
      for (int axis = 0; axis < 3; ++axis) points[3 * i + axis] = static_cast<float>(local[axis]);
    }
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry,
                                                                   RTC_BUFFER_TYPE_INDEX,
                                                                   0,
                                                                   RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned),
                                                                   triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        indices[3 * i + corner] = static_cast<unsigned>(triangles[i][corner]);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
  impl_->is_built = true;
  ThreadLimit::Lift(lock, 1);
}

Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;

namespace {

// Beyond this single precision overflows within Embree, which then ends the program.
constexpr double kFarthest = 1e12;

bool IsTraceable(const Eigen::Vector3d& local, const Eigen::Vector3d& direction) {
  return local.cwiseAbs().maxCoeff() < kFarthest && direction.allFinite();
}

}  // namespace

std::optional<Visibility::Hit> Visibility::FirstHit(const Eigen::Vector3d& origin_in_world,
                                                    const Eigen::Vector3d& direction_in_world,
                                                    double min_distance,
                                                    double max_distance) const {
  const Eigen::Vector3d local = origin_in_world - impl_->bounds.Center();
  if (!IsTraceable(local, direction_in_world)) return std::nullopt;
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(local.x());
  query.ray.org_y = static_cast<float>(local.y());
  query.ray.org_z = static_cast<float>(local.z());
  query.ray.dir_x = static_cast<float>(direction_in_world.x());
  query.ray.dir_y = static_cast<float>(direction_in_world.y());
  query.ray.dir_z = static_cast<float>(direction_in_world.z());
  query.ray.tnear = static_cast<float>(min_distance);
  query.ray.tfar = static_cast<float>(max_distance);
  query.ray.time = 0;
  query.ray.mask = 0xffffffffu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return Hit{impl_->face_of_triangle[query.hit.primID],
             query.ray.tfar,
             normal.dot(direction_in_world.cast<float>()) < 0};
}

bool Visibility::IsClear(const Eigen::Vector3d& from_in_world,
                         const Eigen::Vector3d& target_in_world,
                         double tolerance) const {
  const Eigen::Vector3d to_target = target_in_world - from_in_world;
  const double distance = to_target.norm();
  if (distance <= tolerance) return true;
  const Eigen::Vector3d direction = to_target / distance;
  const Eigen::Vector3d local = from_in_world - impl_->bounds.Center();
  if (!IsTraceable(local, direction)) return false;
  RTCRay ray;
  ray.org_x = static_cast<float>(local.x());
  ray.org_y = static_cast<float>(local.y());
  ray.org_z = static_cast<float>(local.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = 0;
  ray.tfar = static_cast<float>(distance - tolerance);
  ray.time = 0;
  ray.mask = 0xffffffffu;
  ray.id = 0;
  ray.flags = 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar >= 0;  // Embree marks an occluded ray with tfar = -inf
}

Image16 Visibility::FaceLabels(const Camera& camera) const {
  Image16 labels(camera.width_px, camera.height_px, 1);
  const Eigen::Vector3d position = camera.PositionInWorld();
  tbb::parallel_for(tbb::blocked_range<int>(0, camera.height_px, 16), [&](const auto& rows) {
    for (int y = rows.begin(); y != rows.end(); ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const auto hit = FirstHit(position, UnprojectToWorld(camera, {x + 0.5, y + 0.5}));
        if (hit && hit->is_front) *labels.At(x, y) = static_cast<uint16_t>(hit->face + 1);
      }
    }
  });
  return labels;
}

double Visibility::DefaultTolerance() const { return 1e-4 * impl_->building_size; }

}  // namespace groundglass
