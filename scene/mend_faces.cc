// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/mend_faces.h"

#include "scene/check_face.h"
#include "scene/cut_faces.h"
#include "scene/double_faces.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/face_outline.h"
#include "scene/nested_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace groundglass {
namespace {

// Corners nearer to each other than this share of their face's size are at the same place.
constexpr double kSamePlaceShare = 1e-9;

class FaceMender {
 public:
  FaceMender(const std::filesystem::path& file,
             const std::vector<int>& lines,
             PolygonModel& model,
             std::vector<FaceTexture>& textures)
      : file_(file), lines_(lines), model_(model), textures_(textures) {}

  MendedFaces Mend() {
    for (int face = 0; face < static_cast<int>(model_.faces.size()); ++face) {
      if (!HasKnownPoints(face)) {
        AddFault(face, CheckFace(model_, face).fault);
        continue;
      }
      DropRepeatedCorners(face);
      TurnHoles(face);
      const FaceCheck check = CheckFace(model_, face);
      if (!check.fault.empty()) {
        AddFault(face, check.fault);
        continue;
      }
      if (!check.warning.empty()) bent_.emplace_back(face, check);
      mended_.usable.push_back(face);
    }
    PlaceUnknownPoints();
    TellBent();
    TellRepeated();
    TellTurned();
    DropDoubles();
    CutNested();
    return std::move(mended_);
  }

 private:
  const Eigen::Vector3d& Point(int index) const { return model_.points_in_world[index]; }

  void Warn(int line, const std::string& message) {
    mended_.warnings.push_back(line > 0 ? Error(file_, line, message).what()
                                        : Error(file_, message).what());
  }

  // "face 12 (east wall), line 80"
  std::string Place(int face) const {
    return DescribeFace(model_, face) +
           (lines_.empty() ? "" : ", line " + std::to_string(lines_[face]));
  }

  void AddFault(int face, const std::string& fault) {
    mended_.faults.push_back({face, DescribeFace(model_, face) + " " + fault});
  }

  bool HasKnownPoints(int face) const {
    const std::vector<int>& points = model_.faces[face].points;
    const int num_points = static_cast<int>(model_.points_in_world.size());
    return !points.empty() && std::all_of(points.begin(), points.end(), [&](int point) {
      return point >= 0 && point < num_points && Point(point).allFinite();
    });
  }

  // No face uses them any more; what goes over all points need not know of them.
  void PlaceUnknownPoints() {
    const auto is_known = [](const Eigen::Vector3d& point) { return point.allFinite(); };
    std::vector<Eigen::Vector3d>& points = model_.points_in_world;
    const auto known = std::find_if(points.begin(), points.end(), is_known);
    const Eigen::Vector3d place = known == points.end() ? Eigen::Vector3d::Zero() : *known;
    for (Eigen::Vector3d& point : points) {
      if (!is_known(point)) point = place;
    }
  }

  // Puts these corners (places in the outline) in place of the face's own.
  void TakeCorners(int face, const std::vector<int>& corners) {
    std::vector<int>& points = model_.faces[face].points;
    std::vector<int> taken;
    for (const int corner : corners) taken.push_back(points[corner]);
    if (!textures_.empty() && textures_[face].corners_texel.size() == points.size()) {
      std::vector<Eigen::Vector2d> texels;
      for (const int corner : corners) texels.push_back(textures_[face].corners_texel[corner]);
      textures_[face].corners_texel = std::move(texels);
    }
    points = std::move(taken);
  }

  void DropRepeatedCorners(int face) {
    const std::vector<int>& points = model_.faces[face].points;
    Eigen::Vector3d low = Point(points[0]);
    Eigen::Vector3d high = low;
    for (const int point : points) {
      low = low.cwiseMin(Point(point));
      high = high.cwiseMax(Point(point));
    }
    const double tolerance = kSamePlaceShare * (high - low).norm();
    const auto is_same = [&](int a, int b) {
      return points[a] == points[b] || (Point(points[a]) - Point(points[b])).norm() <= tolerance;
    };
    std::vector<int> kept;
    for (int corner = 0; corner < static_cast<int>(points.size()); ++corner) {
      if (kept.empty() || !is_same(kept.back(), corner)) kept.push_back(corner);
    }
    while (kept.size() > 1 && is_same(kept.back(), kept.front())) kept.pop_back();
    // What has no three corners is left for the check to name.
    if (kept.size() == points.size() || kept.size() < 3) return;
    TakeCorners(face, kept);
    repeated_.push_back(face);
  }

  void TurnHoles(int face) {
    const std::vector<int>& points = model_.faces[face].points;
    if (points.size() < 6) return;  // a triangle with a triangle in one of its corners
    const FacePlane plane = ComputeFacePlane(model_, face);
    const Eigen::Vector3d u = plane.normal_in_world.unitOrthogonal();
    const Eigen::Vector3d v = plane.normal_in_world.cross(u);
    std::vector<Eigen::Vector2d> outline;
    double size = 0;
    for (const int point : points) {
      const Eigen::Vector3d offset = Point(point) - Point(points[0]);
      size = std::max(size, offset.norm());
      outline.emplace_back(u.dot(offset), v.dot(offset));
    }
    const OutlineLoops loops = PartOutline(outline, kSamePlaceShare * size, true);
    if (loops.meeting || !loops.is_turned) return;
    const std::vector<std::vector<int>> outlines = BridgeHoles(outline, loops);
    if (outlines.size() != 1) return;
    TakeCorners(face, outlines[0]);
    turned_.push_back(face);
  }

  // One plan whose heights were rounded bends hundreds of faces: the worst stands for all.
  void TellBent() {
    if (bent_.empty()) return;
    const auto& [face, check] =
        *std::max_element(bent_.begin(), bent_.end(), [](const auto& a, const auto& b) {
          return a.second.out_of_plane_share < b.second.out_of_plane_share;
        });
    if (bent_.size() == 1) {
      Warn(lines_.empty() ? 0 : lines_[face], DescribeFace(model_, face) + " " + check.warning);
      return;
    }
    Warn(0,
         std::to_string(bent_.size()) +
             " faces are out of plane by more than 0.1 % of their size; their best planes are "
             "used; the worst: " +
             Place(face) + fmt::format(", {:.2g} %", 100 * check.out_of_plane_share));
  }

  void TellRepeated() {
    if (repeated_.empty()) return;
    const std::string count = std::to_string(repeated_.size());
    Warn(0,
         repeated_.size() == 1
             ? "1 face repeats a corner or closes its ring; the corner is dropped: " +
                   Place(repeated_[0])
             : count +
                   " faces repeat a corner or close their ring; these corners are dropped; "
                   "the first: " +
                   Place(repeated_[0]));
  }

  void TellTurned() {
    if (turned_.empty()) return;
    Warn(0,
         turned_.size() == 1
             ? "1 face has a hole that runs the same way round as its outline; it is turned: " +
                   Place(turned_[0])
             : std::to_string(turned_.size()) +
                   " faces have a hole that runs the same way round as its outline; it is turned; "
                   "the first: " +
                   Place(turned_[0]));
  }

  void DropDoubles() {
    const std::vector<int> first_of = FindDoubleFaces(model_, mended_.usable);
    int num_doubles = 0;
    int num_opposite = 0;
    int example = -1;
    for (const int face : mended_.usable) {
      if (first_of[face] < 0) continue;
      if (num_doubles++ == 0) example = face;
      if (ComputeFacePlane(model_, face)
              .normal_in_world.dot(ComputeFacePlane(model_, first_of[face]).normal_in_world) < 0) {
        ++num_opposite;
      }
    }
    if (num_doubles == 0) return;
    std::erase_if(mended_.usable, [&](int face) { return first_of[face] >= 0; });
    std::string message = std::to_string(num_doubles) +
                          (num_doubles == 1 ? " face lies twice and is kept once"
                                            : " faces lie twice and are kept once") +
                          ", the first of each: " + DescribeFace(model_, first_of[example]) +
                          " is also " + Place(example);
    if (num_opposite == num_doubles) {
      message += "; they lie back to back, and the first one's front counts";
    } else if (num_opposite > 0) {
      message += "; " + std::to_string(num_opposite) +
                 " of them lie back to back, and the first one's front counts";
    }
    Warn(0, message);
  }

  // A face that is laid on another one is what is meant there.
  void CutNested() {
    std::map<int, std::vector<int>> within;
    for (const NestedFace& nested : FindNestedFaces(model_, mended_.usable)) {
      within[nested.outer].push_back(nested.inner);
    }
    // All by the outlines as they are written. Corners of a textured face have places on its page
    // too, which nobody knows for new ones.
    std::map<int, std::vector<int>> cut;
    for (const auto& [outer, inner] : within) {
      if (!textures_.empty() && textures_[outer].page >= 0) continue;
      if (auto points = CutOutline(outer, inner, model_)) cut[outer] = std::move(*points);
    }
    std::map<int, int> outer_of_cut;
    std::map<int, int> outer_of_uncut;
    for (const auto& [outer, inner] : within) {
      const bool is_cut = cut.count(outer) > 0 && TakeIfSound(outer, std::move(cut[outer]));
      for (const int face : inner) (is_cut ? outer_of_cut : outer_of_uncut)[face] = outer;
    }
    TellNested(outer_of_cut, "; what lies within is cut out of the other");
    TellNested(outer_of_uncut,
               ", so that it is chance which of the two is seen there; cut a hole for it, move it "
               "off the plane, or leave out the one that is not meant");
  }

  bool TakeIfSound(int face, std::vector<int> points) {
    std::swap(model_.faces[face].points, points);
    if (!CheckFace(model_, face).fault.empty()) {
      std::swap(model_.faces[face].points, points);
      return false;
    }
    if (!textures_.empty()) textures_[face].corners_texel.clear();
    return true;
  }

  void TellNested(const std::map<int, int>& outer_of, const std::string& what_of_it) {
    if (outer_of.empty()) return;
    const auto& [inner, outer] = *outer_of.begin();
    const std::string first = Place(inner) + ", in " + DescribeFace(model_, outer);
    Warn(0,
         (outer_of.size() == 1
              ? "1 face lies within another one in the same plane: " + first
              : std::to_string(outer_of.size()) +
                    " faces lie within others in the same plane (the first: " + first + ")") +
             what_of_it);
  }

  const std::filesystem::path& file_;
  const std::vector<int>& lines_;
  PolygonModel& model_;
  std::vector<FaceTexture>& textures_;
  std::vector<std::pair<int, FaceCheck>> bent_;  // with each face's number
  std::vector<int> repeated_;
  std::vector<int> turned_;
  MendedFaces mended_;
};

}  // namespace

MendedFaces MendFaces(const std::filesystem::path& file,
                      const std::vector<int>& lines,
                      PolygonModel& model,
                      std::vector<FaceTexture>& textures) {
  return FaceMender(file, lines, model, textures).Mend();
}

void WarnOfFaults(const std::filesystem::path& file,
                  const std::vector<int>& lines,
                  MendedFaces& mended) {
  if (mended.faults.empty()) return;
  const MendedFaces::Fault& first = mended.faults.front();
  std::string message = mended.faults.size() == 1
                            ? std::string("1 face that cannot be used is left out: ")
                            : std::to_string(mended.faults.size()) +
                                  " faces that cannot be used are left out; the first: ";
  message += first.text;
  if (!lines.empty()) message += " (line " + std::to_string(lines[first.face]) + ")";
  mended.warnings.push_back(Error(file, message).what());
}

std::vector<int> KeepFaces(const std::vector<int>& faces,
                           PolygonModel& model,
                           std::vector<FaceTexture>& textures) {
  if (faces.size() == model.faces.size()) return {};
  std::vector<char> is_kept(model.faces.size(), 0);
  for (const int face : faces) is_kept[face] = 1;
  std::vector<int> left_out;
  for (int face = 0; face < static_cast<int>(is_kept.size()); ++face) {
    if (!is_kept[face]) left_out.push_back(FaceNumber(model, face));
  }
  std::vector<Face> kept;
  std::vector<FaceTexture> kept_textures;
  for (const int face : faces) {
    kept.push_back(std::move(model.faces[face]));
    if (!textures.empty()) kept_textures.push_back(std::move(textures[face]));
  }
  model.faces = std::move(kept);
  textures = std::move(kept_textures);
  return left_out;
}

}  // namespace groundglass
