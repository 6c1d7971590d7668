// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/oracle.h"

#include "datasets-synthetic/occluders.h"
#include "scene/cubic_weights.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/photograph_name.h"
#include "scene/srgb.h"
#include "scene/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

constexpr int kSamplesPerSide = 2;  // samples along a pixel's side
constexpr int kSamplesPerPixel = kSamplesPerSide * kSamplesPerSide;

// Where one sample of a pixel meets the model.
struct SeenPlace {
  int face = -1;
  Eigen::Vector3d point_in_world;
  Eigen::Vector3d normal_in_world;
};

class Tracer {
 public:
  Tracer(const PolygonModel& model, const Visibility& visibility)
      : visibility_(visibility), tolerance_(visibility.DefaultTolerance()) {
    for (size_t face = 0; face < model.faces.size(); ++face) {
      normals_.push_back(ComputeFacePlane(model, static_cast<int>(face)).normal_in_world);
    }
  }

  // Nothing where the sample shows no face's front.
  std::optional<SeenPlace> Trace(const Camera& camera, int x, int y, int sample) const {
    const int column = sample % kSamplesPerSide;
    const int row = sample / kSamplesPerSide;
    const Eigen::Vector2d px(x + (column + 0.5) / kSamplesPerSide,
                             y + (row + 0.5) / kSamplesPerSide);
    const Eigen::Vector3d position = camera.PositionInWorld();
    const Eigen::Vector3d direction = UnprojectToWorld(camera, px);
    const auto hit = visibility_.FirstHit(position, direction);
    if (!hit || !hit->is_front) return std::nullopt;
    return SeenPlace{hit->face, position + hit->distance * direction, normals_[hit->face]};
  }

  // Pixels of the photograph for one model unit at the place, in the direction with the fewest; 0
  // if it lies outside the frame or shows its back.
  double Resolution(const Camera& camera, const SeenPlace& place) const {
    const Eigen::Vector3d& normal = place.normal_in_world;
    const Eigen::Vector3d to_camera = camera.PositionInWorld() - place.point_in_world;
    if (to_camera.dot(normal) <= 0) return 0;
    const auto px = Project(camera, place.point_in_world);
    if (!px || !IsInsideFrame(camera, *px)) return 0;
    const double step = 1e-4 * to_camera.norm();
    const Eigen::Vector3d right = normal.unitOrthogonal();
    const auto px_right = Project(camera, place.point_in_world + step * right);
    const auto px_down = Project(camera, place.point_in_world + step * normal.cross(right));
    if (!px_right || !px_down) return 0;
    Eigen::Matrix2d px_from_plane;
    px_from_plane << (*px_right - *px) / step, (*px_down - *px) / step;
    const double sum = px_from_plane.squaredNorm();
    const double det = px_from_plane.determinant();
    const double root = std::sqrt(std::max(0.0, sum * sum - 4 * det * det));
    return std::sqrt(std::max(0.0, (sum - root) / 2));
  }

  // Whether no other face stands between, and the place is not behind the slide's mount.
  bool IsShown(const Camera& camera, const Image8& mount, const SeenPlace& place) const {
    const auto px = Project(camera, place.point_in_world);
    if (!px || !IsInsideFrame(camera, *px)) return false;
    if (!mount.Empty()) {
      const int x = std::min(static_cast<int>(px->x()), mount.width - 1);
      const int y = std::min(static_cast<int>(px->y()), mount.height - 1);
      if (*mount.At(x, y) != 0) return false;
    }
    return visibility_.IsClear(camera.PositionInWorld(), place.point_in_world, tolerance_);
  }

 private:
  const Visibility& visibility_;
  double tolerance_;
  std::vector<Eigen::Vector3d> normals_;
};

// Pixels of the slide's mount; empty if the photograph has no mask.
Image8 ReadMount(const OraclePhotograph& photograph, size_t num_faces) {
  if (!photograph.occlusion_mask_file) return {};
  const Image16 codes = ReadLabels(*photograph.occlusion_mask_file);
  const int mount = kMount + (num_faces < kPerson ? 0 : kLargeModelOffset);
  Image8 is_mount(codes.width, codes.height, 1);
  for (size_t i = 0; i < codes.values.size(); ++i) is_mount.values[i] = codes.values[i] == mount;
  return is_mount;
}

// Radiance between pixels.
Eigen::Array3f LookUp(const ImageF& radiance, const Eigen::Vector2d& px) {
  const double fx = std::floor(px.x() - 0.5);
  const double fy = std::floor(px.y() - 0.5);
  const std::array<float, 4> wx = CubicWeights(static_cast<float>(px.x() - 0.5 - fx));
  const std::array<float, 4> wy = CubicWeights(static_cast<float>(px.y() - 0.5 - fy));
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int j = 0; j < 4; ++j) {
    const int y = std::clamp(static_cast<int>(fy) - 1 + j, 0, radiance.height - 1);
    for (int i = 0; i < 4; ++i) {
      const int x = std::clamp(static_cast<int>(fx) - 1 + i, 0, radiance.width - 1);
      sum += wy[j] * wx[i] * Eigen::Map<const Eigen::Array3f>(radiance.At(x, y));
    }
  }
  return sum.max(0.0f);
}

// One novel view on its way.
struct OracleView {
  Image16 best;  // kSamplesPerPixel channels: the photograph, from 1
  ImageF sum;    // radiance over the samples that some photograph shows
};

void CheckSize(const OraclePhotograph& photograph, int width, int height) {
  if (width == photograph.camera.width_px && height == photograph.camera.height_px) return;
  throw Error(photograph.image_file,
              "is " + std::to_string(width) + "x" + std::to_string(height) +
                  " px, but its true camera is for " + std::to_string(photograph.camera.width_px) +
                  "x" + std::to_string(photograph.camera.height_px));
}

}  // namespace

std::vector<OraclePhotograph> FindOraclePhotographs(const Truth& truth) {
  const fs::path folder =
      fs::absolute(truth.folder / ".").lexically_normal().parent_path().parent_path() / "images";
  const std::vector<fs::path> files = ListImageFiles(folder);
  std::vector<PhotographName> names;
  for (const fs::path& file : files) names.push_back({ImageStem(file), file.filename().string()});
  std::vector<OraclePhotograph> photographs;
  for (const NamedCamera& named : truth.cameras) {
    OraclePhotograph& photograph = photographs.emplace_back();
    photograph.camera = named.camera;
    const std::optional<size_t> found = FindPhotograph(named.name, names);
    if (!found) throw Error(folder, "has no photograph called " + named.name);
    photograph.image_file = files[*found];
    if (!truth.masks_occ_folder.empty()) {
      const fs::path mask = truth.masks_occ_folder / (named.name + ".png");
      if (fs::exists(mask)) photograph.occlusion_mask_file = mask;
    }
  }
  return photographs;
}

std::vector<OraclePicture> RenderOracle(const PolygonModel& model,
                                        std::span<const OraclePhotograph> photographs,
                                        std::span<const Camera> cameras) {
  const Visibility visibility(model);
  const Tracer tracer(model, visibility);
  std::vector<Image8> mounts;
  for (const OraclePhotograph& photograph : photographs) {
    mounts.push_back(ReadMount(photograph, model.faces.size()));
    if (!mounts.back().Empty()) CheckSize(photograph, mounts.back().width, mounts.back().height);
  }
  std::vector<OracleView> views;
  for (const Camera& camera : cameras) {
    OracleView& view = views.emplace_back();
    view.best = Image16(camera.width_px, camera.height_px, kSamplesPerPixel);
    view.sum = ImageF(camera.width_px, camera.height_px, 3);
    tbb::parallel_for(0, camera.height_px, [&](int y) {
      std::vector<std::pair<double, size_t>> candidates;
      for (int x = 0; x < camera.width_px; ++x) {
        int face = -1;
        for (int sample = 0; sample < kSamplesPerPixel; ++sample) {
          const auto place = tracer.Trace(camera, x, y, sample);
          if (!place) continue;
          if (place->face != face) {  // their order is the same all over a pixel of one face
            face = place->face;
            candidates.clear();
            for (size_t i = 0; i < photographs.size(); ++i) {
              const double resolution = tracer.Resolution(photographs[i].camera, *place);
              if (resolution > 0) candidates.emplace_back(-resolution, i);
            }
            std::sort(candidates.begin(), candidates.end());
          }
          const auto best = std::find_if(candidates.begin(), candidates.end(), [&](const auto& c) {
            return tracer.IsShown(photographs[c.second].camera, mounts[c.second], *place);
          });
          if (best == candidates.end()) continue;
          view.best.At(x, y)[sample] = static_cast<uint16_t>(best->second + 1);
        }
      }
    });
  }
  for (size_t i = 0; i < photographs.size(); ++i) {
    const ImageF radiance = ReadRadiance(photographs[i].image_file);
    CheckSize(photographs[i], radiance.width, radiance.height);
    for (size_t v = 0; v < views.size(); ++v) {
      tbb::parallel_for(0, cameras[v].height_px, [&](int y) {
        for (int x = 0; x < cameras[v].width_px; ++x) {
          for (int sample = 0; sample < kSamplesPerPixel; ++sample) {
            if (views[v].best.At(x, y)[sample] != i + 1) continue;
            const auto place = tracer.Trace(cameras[v], x, y, sample);
            const auto px = Project(photographs[i].camera, place->point_in_world);
            Eigen::Map<Eigen::Array3f>(views[v].sum.At(x, y)) += LookUp(radiance, *px);
          }
        }
      });
    }
  }
  std::vector<OraclePicture> pictures;
  for (const OracleView& view : views) {
    OraclePicture& picture = pictures.emplace_back();
    picture.srgb8 = Image8(view.sum.width, view.sum.height, 3);
    picture.covered = Image8(view.sum.width, view.sum.height, 1);
    for (int y = 0; y < view.sum.height; ++y) {
      for (int x = 0; x < view.sum.width; ++x) {
        const uint16_t* best = view.best.At(x, y);
        const auto count =
            std::count_if(best, best + kSamplesPerPixel, [](uint16_t b) { return b != 0; });
        if (count == 0) continue;
        *picture.covered.At(x, y) = 255;
        for (int c = 0; c < 3; ++c) {
          const float mean = view.sum.At(x, y)[c] / static_cast<float>(count);
          picture.srgb8.At(x, y)[c] = Srgb8FromLinear(mean);
        }
      }
    }
  }
  return pictures;
}

}  // namespace groundglass
