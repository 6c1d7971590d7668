// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace groundglass {
namespace {

class OutlineParter {
 public:
  OutlineParter(const std::vector<Eigen::Vector2d>& outline, double tolerance)
      : outline_{outline, tolerance, WeldCorners(outline)}, sides_(AllSides(outline_.weld)) {}

  OutlineLoops Part(bool look_for_meeting) {
    OutlineLoops result;
    result.is_plain = !IsAnyRepeated(outline_.weld);
    if (!result.is_plain) {
      sides_ = WithoutBridges(sides_, outline_.weld);
      SplitSides();
      sides_ = WithoutBridges(sides_, outline_.weld);
    }
    if (look_for_meeting) result.meeting = FindMeetingSides(outline_, sides_);
    if (result.meeting) return result;
    if (result.is_plain) {
      result.loops.emplace_back().corners.resize(outline_.corners.size());
      std::iota(result.loops[0].corners.begin(), result.loops[0].corners.end(), 0);
      return result;
    }
    TraceLoops(outline_, sides_, result);
    if (!result.meeting) {
      OrientLoops(outline_, result);
    } else if (TurnTouchingRings()) {
      OutlineLoops turned = {{}, false, true, std::nullopt};
      TraceLoops(outline_, sides_, turned);
      if (turned.meeting) return result;
      OrientLoops(outline_, turned);
      turned.is_turned = true;
      return turned;
    }
    return result;
  }

 private:
  // Where a corner lies on a side, the side is two: bridges that coincide in part only, and holes
  // that touch, then have their ends in common.
  void SplitSides() {
    std::vector<OutlineSide> pieces;
    for (const OutlineSide& side : sides_) {
      const Eigen::Vector2d& a = outline_.At(side.start);
      const Eigen::Vector2d along = outline_.At(side.end) - a;
      const double length = along.norm();
      std::vector<std::pair<double, int>> between;
      for (int corner = 0; corner < static_cast<int>(outline_.weld.size()); ++corner) {
        if (outline_.weld[corner] != corner || corner == outline_.weld[side.start] ||
            corner == outline_.weld[side.end]) {
          continue;
        }
        const double t = (outline_.At(corner) - a).dot(along) / length;
        if (t <= outline_.tolerance || t >= length - outline_.tolerance) continue;
        if (std::abs(Cross2(along, outline_.At(corner) - a)) > outline_.tolerance * length)
          continue;
        between.emplace_back(t, corner);
      }
      std::sort(between.begin(), between.end());
      int start = side.start;
      for (const auto& [t, corner] : between) {
        pieces.push_back({start, corner});
        start = corner;
      }
      pieces.push_back({start, side.end});
    }
    sides_ = std::move(pieces);
  }

  // Where a hole that touches its outline runs the same way round, sides that come and sides that
  // leave do not alternate. Parts the outline into rings at the corners that it comes back to, and
  // turns those that run the wrong way. False if there are none.
  bool TurnTouchingRings() {
    std::map<int, std::vector<size_t>> leaving;
    for (size_t i = 0; i < sides_.size(); ++i) leaving[outline_.weld[sides_[i].start]].push_back(i);
    std::vector<char> is_used(sides_.size(), 0);
    // The next side from this one's end, in the order in which the outline was written.
    const auto next_after = [&](size_t side) {
      size_t best = sides_.size();
      size_t best_steps = sides_.size();
      for (const size_t candidate : leaving[outline_.weld[sides_[side].end]]) {
        const size_t steps = (candidate + sides_.size() - side) % sides_.size();
        if (is_used[candidate] || steps >= best_steps) continue;
        best = candidate;
        best_steps = steps;
      }
      return best;
    };
    OutlineLoops rings;
    for (size_t first = 0; first < sides_.size(); ++first) {
      if (is_used[first]) continue;
      std::vector<size_t> way;
      for (size_t side = first; side < sides_.size(); side = next_after(side)) {
        is_used[side] = 1;
        way.push_back(side);
        size_t start = way.size();
        while (start > 0 &&
               outline_.weld[sides_[way[start - 1]].start] != outline_.weld[sides_[side].end])
          --start;
        if (start == 0) continue;
        OutlineLoops::Loop& ring = rings.loops.emplace_back();
        for (size_t i = start - 1; i < way.size(); ++i) {
          ring.corners.push_back(sides_[way[i]].start);
        }
        way.resize(start - 1);
      }
      if (!way.empty()) return false;
    }
    OrientLoops(outline_, rings);
    if (!rings.is_turned) return false;
    sides_.clear();
    for (const OutlineLoops::Loop& ring : rings.loops) {
      for (size_t i = 0; i < ring.corners.size(); ++i) {
        sides_.push_back({ring.corners[i], ring.corners[(i + 1) % ring.corners.size()]});
      }
    }
    return true;
  }

  Outline outline_;
  std::vector<OutlineSide> sides_;
};

}  // namespace

OutlineLoops PartOutline(const std::vector<Eigen::Vector2d>& outline,
                         double tolerance,
                         bool look_for_meeting) {
  return OutlineParter(outline, tolerance).Part(look_for_meeting);
}

}  // namespace groundglass
