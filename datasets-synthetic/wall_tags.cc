// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/wall_tags.h"

#include "calibrate/april_tag_detection.h"
#include "datasets-synthetic/noise.h"
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// Paper is not quite white, and ink not quite black; linear light.
constexpr float kPaper = 0.75f;
constexpr float kInk = 0.03f;
// A white border of one cell is printed around the black square.
constexpr int kPaperCells = kAprilTagCells + 2;
// Fine beside any pixel that shows it.
constexpr int kTexelsPerCell = 16;
// How far before the wall nothing else may hang; feet.
constexpr double kFreeDepth = 2;
// Seen at a flatter angle a tag is hard to read.
constexpr double kLeastCosine = 0.35;

// A place on a wall where a tag could hang, and the photographs that would show it.
struct WallPlace {
  int face = 0;
  Eigen::Vector2d middle_in_texture = Eigen::Vector2d::Zero();
  Eigen::Vector3d middle_in_world = Eigen::Vector3d::Zero();
  std::vector<size_t> seen_by;
};

bool CarriesTags(const Surface& surface) {
  switch (surface.material) {
    case Material::kTile:
    case Material::kConcrete:
    case Material::kBrick:
    case Material::kStone:
    case Material::kPlaster:
    case Material::kPanel:
    case Material::kEven:
      return surface.mask_code == 0 && !surface.is_relief;
    default:
      return false;
  }
}

class TagHanger {
 public:
  TagHanger(const SynthRecipe& recipe,
            const std::vector<PhotographPlan>& photographs,
            SyntheticWorld& world)
      : recipe_(recipe),
        photographs_(photographs),
        world_(world),
        visibility_(world.geometry),
        paper_(recipe.april_tags.size * kPaperCells / kAprilTagCells),
        times_shown_(photographs.size(), 0) {
    for (int face = 0; face < world.num_model_faces; ++face) AddPlacesOn(face);
  }

  std::vector<WallTag> Hang() {
    std::vector<WallTag> tags;
    while (static_cast<int>(tags.size()) < recipe_.april_tags.count) {
      const auto best = std::max_element(
          places_.begin(), places_.end(), [&](auto& a, auto& b) { return Worth(a) < Worth(b); });
      if (best == places_.end()) break;
      tags.push_back(HangAt(*best, static_cast<int>(tags.size())));
    }
    return tags;
  }

 private:
  Eigen::Vector3d FacingOf(int face) const {
    const Surface& surface = world_.surfaces[face];
    return surface.axis_u.cross(surface.axis_v).normalized();
  }

  // The paper's corners, top left first, as it is looked at.
  std::array<Eigen::Vector3d, 4> PaperAt(int face, const Eigen::Vector3d& middle) const {
    const Surface& surface = world_.surfaces[face];
    const Eigen::Vector3d right = paper_ / 2 * surface.axis_u;
    const Eigen::Vector3d up = paper_ / 2 * surface.axis_v;
    return {middle - right + up, middle + right + up, middle + right - up, middle - right - up};
  }

  void AddPlacesOn(int face);
  bool HasRoom(const WallPlace& place) const;
  bool Shows(const PhotographPlan& photograph, const WallPlace& place) const;
  double Worth(const WallPlace& place) const;
  WallTag HangAt(const WallPlace& place, int id);

  const SynthRecipe& recipe_;
  const std::vector<PhotographPlan>& photographs_;
  SyntheticWorld& world_;
  Visibility visibility_;
  double paper_ = 0;  // how wide it is, feet
  std::vector<WallPlace> places_;
  std::vector<int> times_shown_;  // of each photograph, how many tags it shows
};

void TagHanger::AddPlacesOn(int face) {
  const Surface& surface = world_.surfaces[face];
  if (!CarriesTags(surface) || std::abs(FacingOf(face).z()) > 1e-6) return;
  const std::vector<int>& outline = world_.geometry.faces[face].points;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL);
  Eigen::Vector2d high = -low;
  for (const int point : outline) {
    const Eigen::Vector2d at = surface.TextureOf(world_.geometry.points_in_world[point]);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector3d start = world_.geometry.points_in_world[outline.front()];
  const Eigen::Vector2d start_in_texture = surface.TextureOf(start);
  for (double v = low.y() + paper_ / 2; v <= high.y() - paper_ / 2; v += paper_) {
    for (double u = low.x() + paper_ / 2; u <= high.x() - paper_ / 2; u += paper_) {
      WallPlace place{face, {u, v}, {}, {}};
      const Eigen::Vector2d off = place.middle_in_texture - start_in_texture;
      place.middle_in_world = start + off.x() * surface.axis_u + off.y() * surface.axis_v;
      if (!HasRoom(place)) continue;
      for (size_t i = 0; i < photographs_.size(); ++i) {
        if (Shows(photographs_[i], place)) place.seen_by.push_back(i);
      }
      if (!place.seen_by.empty()) places_.push_back(std::move(place));
    }
  }
}

// All of the paper lies on the wall, with nothing before it and nothing else painted there.
bool TagHanger::HasRoom(const WallPlace& place) const {
  const Eigen::Vector3d out = FacingOf(place.face);
  std::array<Eigen::Vector3d, 4> corners = PaperAt(place.face, place.middle_in_world);
  for (const Eigen::Vector3d& corner : corners) {
    for (const double share : {0.0, 0.5, 0.99}) {
      const Eigen::Vector3d at =
          place.middle_in_world + share * (corner - place.middle_in_world) + kFreeDepth * out;
      const auto hit = visibility_.FirstHit(at, -out, 0, kFreeDepth + 0.01);
      if (!hit || hit->face != place.face) return false;
    }
  }
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(paper_ / 2);
  const Eigen::Vector2d low = place.middle_in_texture - half;
  const Eigen::Vector2d high = place.middle_in_texture + half;
  const std::vector<Decal>& decals = world_.surfaces[place.face].decals;
  return std::none_of(decals.begin(), decals.end(), [&](const Decal& decal) {
    return decal.low_u < high.x() && decal.high_u > low.x() && decal.low_v < high.y() &&
           decal.high_v > low.y();
  });
}

bool TagHanger::Shows(const PhotographPlan& photograph, const WallPlace& place) const {
  const Camera& camera = photograph.written_camera;
  const Eigen::Vector3d eye = camera.PositionInWorld();
  const Eigen::Vector3d towards_eye = (eye - place.middle_in_world).normalized();
  if (towards_eye.dot(FacingOf(place.face)) < kLeastCosine) return false;
  std::array<Eigen::Vector2d, 4> seen;
  const std::array<Eigen::Vector3d, 4> corners = PaperAt(place.face, place.middle_in_world);
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto at = Project(camera, corners[i]);
    if (!at || at->x() < 0 || at->y() < 0 || at->x() > camera.width_px ||
        at->y() > camera.height_px) {
      return false;
    }
    seen[i] = *at;
  }
  const Eigen::Vector2d first = seen[2] - seen[0];
  const Eigen::Vector2d second = seen[3] - seen[1];
  const double area = std::abs(first.x() * second.y() - first.y() * second.x()) / 2;
  const double tag_px = std::sqrt(area) * kAprilTagCells / kPaperCells;
  if (tag_px < recipe_.april_tags.least_px) return false;
  return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
    return visibility_.IsClear(eye, corner, visibility_.DefaultTolerance());
  });
}

double TagHanger::Worth(const WallPlace& place) const {
  double worth = 0;
  for (const size_t photograph : place.seen_by) worth += std::pow(0.25, times_shown_[photograph]);
  return worth;
}

WallTag TagHanger::HangAt(const WallPlace& place, int id) {
  ImageF picture(kPaperCells * kTexelsPerCell, kPaperCells * kTexelsPerCell, 4);
  const AprilTagPattern is_white = GetAprilTagPattern(id);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int row = y / kTexelsPerCell - 1;
      const int column = x / kTexelsPerCell - 1;
      const bool is_tag =
          row >= 0 && row < kAprilTagCells && column >= 0 && column < kAprilTagCells;
      std::fill_n(picture.At(x, y), 3, is_tag && !is_white(row, column) ? kInk : kPaper);
      picture.At(x, y)[3] = 1;
    }
  }
  const double half = paper_ / 2;
  const Eigen::Vector2d middle = place.middle_in_texture;
  world_.surfaces[place.face].decals.push_back(MakeDecal(
      picture, middle.x() - half, middle.y() - half, middle.x() + half, middle.y() + half));
  for (const size_t photograph : place.seen_by) ++times_shown_[photograph];
  WallTag tag{id, place.middle_in_world, FacingOf(place.face), place.middle_in_world};
  for (int axis = 0; axis < 3; ++axis) {
    const uint64_t seed = SeedFor(recipe_.seed, "survey", static_cast<uint64_t>(3 * id + axis));
    tag.surveyed_in_world[axis] += recipe_.april_tags.sigma * NormalOf(seed);
  }
  std::erase_if(places_, [&, used = place](const WallPlace& other) {
    return other.face == used.face &&
           (other.middle_in_world - used.middle_in_world).norm() < 2 * paper_;
  });
  return tag;
}

}  // namespace

std::vector<WallTag> HangWallTags(const SynthRecipe& recipe,
                                  const std::vector<PhotographPlan>& photographs,
                                  SyntheticWorld& world) {
  if (recipe.april_tags.count == 0) return {};
  std::vector<WallTag> tags = TagHanger(recipe, photographs, world).Hang();
  if (tags.empty()) {
    throw Error(fmt::format(
        "no photograph would show an AprilTag of {} ft on a wall at {} px; give larger tags "
        "(recipe field april_tags/size) or larger photographs (--size)",
        recipe.april_tags.size,
        recipe.april_tags.least_px));
  }
  return tags;
}

std::string FormatWallTags(const std::vector<WallTag>& tags,
                           const SynthRecipe::AprilTags& recipe,
                           bool is_truth) {
  std::string text = "id,x,y,z,nx,ny,nz,size,sigma\n";
  for (const WallTag& tag : tags) {
    const Eigen::Vector3d at =
        SiteFromWorld(is_truth ? tag.middle_in_world : tag.surveyed_in_world);
    const Eigen::Vector3d normal = SiteFromWorld(tag.normal_in_world);
    text += fmt::format("{},{:.5f},{:.5f},{:.5f},{:.6f},{:.6f},{:.6f},{},{}\n",
                        tag.id,
                        at.x(),
                        at.y(),
                        at.z(),
                        normal.x(),
                        normal.y(),
                        normal.z(),
                        recipe.size,
                        recipe.sigma);
  }
  return text;
}

}  // namespace groundglass
