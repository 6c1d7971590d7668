// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/blender.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

BlockWeights::BlockWeights(int x, int y, const ChartBlocks& grid, bool is_smooth) {
  if (!is_smooth) {
    std::fill_n(blocks, 4, y / kBlockTexels * grid.width + x / kBlockTexels);
    std::fill_n(weights, 4, 0.25);
    return;
  }
  const double cx = std::clamp((x + 0.5) / kBlockTexels - 0.5, 0.0, grid.width - 1.0);
  const double cy = std::clamp((y + 0.5) / kBlockTexels - 0.5, 0.0, grid.height - 1.0);
  const int x0 = static_cast<int>(cx);
  const int y0 = static_cast<int>(cy);
  const int x1 = std::min(x0 + 1, grid.width - 1);
  const int y1 = std::min(y0 + 1, grid.height - 1);
  const double tx = cx - x0;
  const double ty = cy - y0;
  blocks[0] = y0 * grid.width + x0;
  blocks[1] = y0 * grid.width + x1;
  blocks[2] = y1 * grid.width + x0;
  blocks[3] = y1 * grid.width + x1;
  weights[0] = (1 - tx) * (1 - ty);
  weights[1] = tx * (1 - ty);
  weights[2] = (1 - tx) * ty;
  weights[3] = tx * ty;
}

Blender::Blender(const ComposeInputs& inputs, const BlendOptions& options)
    : chart_(inputs.chart),
      texels_(inputs.texels),
      photos_(inputs.photos),
      blocks_(inputs.blocks),
      choice_(inputs.choice),
      options_(options),
      border_margin_px_(inputs.border_margin_px) {
  for (const int photo : blocks_.photos) {
    views_.push_back(photos_[photo].View(chart_, inputs.chart_index));
  }
}

int Blender::ChosenByAll(int x, int y) const {
  const BlockWeights blend(x, y, blocks_, options_.across_seams);
  const int k = choice_.best[blend.blocks[0]];
  for (int corner = 1; corner < 4; ++corner) {
    if (choice_.best[blend.blocks[corner]] != k) return -1;
  }
  return k;
}

bool Blender::SeesClear(int k, int x, int y, SurfaceObservation& observation) const {
  const auto seen = photos_[blocks_.photos[k]].Observe(
      views_[k], chart_.texel_size * texels_.PointAt(x, y), texels_.FaceAt(x, y));
  if (!seen || seen->border_px < border_margin_px_ + options_.clear_px) return false;
  observation = *seen;
  return true;
}

void Blender::ChooseRow(int y, std::vector<int>& chosen) const {
  chosen.assign(texels_.width(), -1);
  // The blocks around change in the middle of a block only, where seams are hard at its start.
  int k = -1;
  for (int x = 0; x < texels_.width(); ++x) {
    const int in_block = x % kBlockTexels;
    if (x == 0 || in_block == 0 || in_block == kBlockTexels / 2) k = ChosenByAll(x, y);
    if (texels_.FaceAt(x, y) >= 0) chosen[x] = k;
  }
}

int Blender::GatherRun(int x,
                       int y,
                       const std::vector<int>& chosen,
                       std::array<SurfaceObservation, kRunTexels>& run) const {
  const int last = x + kRunTexels - 1;
  if (last >= texels_.width()) return 0;
  const int k = chosen[x];
  // Masks painted by hand may part faces of one plane without a border.
  if (k < 0 || photos_[blocks_.photos[k]].IsHandPainted()) return 0;
  for (int i = x; i <= last; ++i) {
    if (!texels_.IsCentreInside(i, y) || texels_.FaceAt(i, y) != texels_.FaceAt(x, y) ||
        chosen[i] != k) {
      return 0;
    }
  }
  SurfaceObservation& first = run.front();
  if (!SeesClear(k, x, y, first) || !SeesClear(k, last, y, run.back())) return 0;
  const double half_length = (run.back().image_px - first.image_px).norm() / 2;
  if (std::min(first.border_px, run.back().border_px) <
      border_margin_px_ + options_.clear_px + half_length) {
    return 0;
  }
  for (int i = 1; i < kRunTexels - 1; ++i) {
    const double t = static_cast<double>(i) / (kRunTexels - 1);
    run[i] = first;  // no borders near, whose distances would matter
    run[i].px_from_unit = (1 - t) * first.px_from_unit + t * run.back().px_from_unit;
    run[i].image_px = photos_[blocks_.photos[k]].Locate(
        views_[k], chart_.texel_size * Eigen::Vector2d(x + i + 0.5, y + 0.5));
  }
  return kRunTexels;
}

void Blender::Gather(int x, int y, std::vector<Contribution>& contributions) const {
  contributions.clear();
  const Eigen::Vector2d plane_point = chart_.texel_size * texels_.PointAt(x, y);
  const int face = texels_.FaceAt(x, y);
  const BlockWeights blend(x, y, blocks_, options_.across_seams);
  double chosen = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int k = choice_.best[blend.blocks[corner]];
    if (k < 0 || blend.weights[corner] <= 0) continue;
    Contribution& contribution = Find(k, plane_point, face, contributions);
    const double weight = blend.weights[corner] * BorderWeight(contribution);
    contribution.weight += weight;
    chosen += weight;
  }
  if (chosen < options_.enough_chosen) AddOthers(plane_point, face, blend, chosen, contributions);
  if (contributions.size() > 1 || chosen < options_.enough_chosen) {
    double largest = 0;
    for (const Contribution& i : contributions) largest = std::max(largest, i.weight);
    std::erase_if(contributions, [&](const Contribution& i) {
      return i.weight <= 0 || i.weight < options_.negligible * largest;
    });
  }
  double sum = 0;
  for (const Contribution& i : contributions) sum += i.weight;
  for (Contribution& i : contributions) i.weight /= sum;
}

bool Blender::IsGood(const std::vector<Contribution>& contributions) const {
  return std::any_of(contributions.begin(), contributions.end(), [&](const Contribution& i) {
    return i.weight > options_.good_weight && i.observation.border_px >= border_margin_px_;
  });
}

uint8_t Blender::ReachFromBorder(const SurfaceObservation& observation) const {
  const double det = std::abs(observation.px_from_unit.determinant());
  const double long_side = det > 0 ? observation.px_from_unit.norm() / det : 0;  // unit for one px
  const double reach =
      1 + (border_margin_px_ + options_.reach_beyond_px) * long_side / chart_.texel_size;
  return static_cast<uint8_t>(std::min<double>(options_.farthest_reach, std::ceil(reach)));
}

Contribution& Blender::Find(int k,
                            const Eigen::Vector2d& plane_point,
                            int face,
                            std::vector<Contribution>& contributions) const {
  for (Contribution& contribution : contributions) {
    if (contribution.k == k) return contribution;
  }
  Contribution& contribution = contributions.emplace_back();
  contribution.k = k;
  const auto observation = photos_[blocks_.photos[k]].Observe(views_[k], plane_point, face);
  contribution.is_seen = observation.has_value();
  if (observation) contribution.observation = *observation;
  return contribution;
}

void Blender::AddOthers(const Eigen::Vector2d& plane_point,
                        int face,
                        const BlockWeights& blend,
                        double chosen,
                        std::vector<Contribution>& contributions) const {
  double best = 0;
  std::vector<double> quality(blocks_.photos.size(), 0);
  for (size_t k = 0; k < blocks_.photos.size(); ++k) {
    const Contribution& contribution = Find(static_cast<int>(k), plane_point, face, contributions);
    if (!contribution.is_seen) continue;
    double consistency = 0;
    for (int corner = 0; corner < 4; ++corner) {
      consistency += blend.weights[corner] *
                     choice_.consistency[blend.blocks[corner] * blocks_.photos.size() + k];
    }
    quality[k] = photos_[blocks_.photos[k]].Quality(contribution.observation) *
                 (consistency + options_.least_consistency);
    best = std::max(best, quality[k]);
  }
  if (best <= 0) return;
  for (Contribution& contribution : contributions) {
    const double share = quality[contribution.k] / best;
    contribution.weight +=
        (options_.enough_chosen - chosen) * options_.others_weight * share * share * share * share;
  }
}

double Blender::BorderWeight(const Contribution& contribution) const {
  if (!contribution.is_seen) return 0;
  const double t =
      (contribution.observation.border_px - border_margin_px_ + options_.ramp_start_px) /
      options_.ramp_px;
  return std::clamp(t, options_.least_border_weight, 1.0);
}

}  // namespace groundglass
