// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/seams.h"

#include "invrender/select/binary_cut.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// The energy of a choice: a data cost for each block, and one for each side between two blocks that
// differ.
class SeamEnergy {
 public:
  SeamEnergy(const ChartBlocks& blocks,
             int chart,
             const ColourModel& colour,
             const ChartChoice& choice,
             const SeamOptions& options)
      : blocks_(blocks), options_(options), num_photos_(blocks.photos.size()) {
    data_.assign(blocks.views.size(), options.max_data_cost);
    colours_.resize(blocks.views.size(), Eigen::Array3f::Zero());
    for (int block = 0; block < blocks.NumBlocks(); ++block) {
      const BlockView* views = blocks.ViewsOf(block);
      double best = 0;
      for (size_t k = 0; k < num_photos_; ++k) {
        best = std::max<double>(best, views[k].quality * choice.consistency[Index(block, k)]);
      }
      for (size_t k = 0; k < num_photos_; ++k) {
        if (views[k].quality <= 0) continue;
        const double score = views[k].quality * choice.consistency[Index(block, k)];
        data_[Index(block, k)] = std::min(options.max_data_cost, -std::log(score / best + 1e-30));
        colours_[Index(block, k)] =
            colour.Corrected(blocks.photos[k], chart, static_cast<int>(k), views[k]);
      }
    }
  }

  const ChartBlocks& blocks() const { return blocks_; }
  bool IsSeen(int block, int k) const { return blocks_.ViewsOf(block)[k].quality > 0; }
  double DataCost(int block, int k) const { return data_[Index(block, k)]; }

  // A metric in (k, l) for each block, as expansion needs: a capped norm.
  double Difference(int block, int k, int l) const {
    if (k == l) return 0;
    if (!IsSeen(block, k) || !IsSeen(block, l)) return options_.max_difference;
    const float squared = (colours_[Index(block, k)] - colours_[Index(block, l)]).square().mean();
    return std::min(options_.max_difference, std::sqrt(static_cast<double>(squared)));
  }
  // Of a side whose two blocks have these differences between the photographs that they take.
  double SeamCost(double difference, double other_difference) const {
    return options_.seam_cost + options_.difference_cost * (difference + other_difference) / 2;
  }

 private:
  size_t Index(int block, size_t k) const { return block * num_photos_ + k; }

  const ChartBlocks& blocks_;
  const SeamOptions& options_;
  size_t num_photos_;
  std::vector<double> data_;
  std::vector<Eigen::Array3f> colours_;
};

// One expansion: every block keeps its photograph or takes `alpha`, whichever makes the energy
// least.
class Expansion {
 public:
  Expansion(const SeamEnergy& energy, int alpha, const std::vector<int>& labels)
      : energy_(energy),
        alpha_(alpha),
        labels_(labels),
        node_(labels.size(), -1),
        to_alpha_(labels.size(), 0) {
    for (size_t i = 0; i < labels.size(); ++i) {
      const int block = static_cast<int>(i);
      if (labels[i] < 0) continue;
      to_alpha_[i] = energy.Difference(block, labels[i], alpha);
      if (labels[i] != alpha && energy.IsSeen(block, alpha)) node_[i] = num_nodes_++;
    }
  }

  bool IsEmpty() const { return num_nodes_ == 0; }

  // The blocks that take alpha.
  std::vector<int> Solve() const {
    const ChartBlocks& blocks = energy_.blocks();
    BinaryCut cut(num_nodes_);
    for (int block = 0; block < blocks.NumBlocks(); ++block) {
      if (node_[block] < 0) continue;
      cut.AddCosts(
          node_[block], energy_.DataCost(block, labels_[block]), energy_.DataCost(block, alpha_));
    }
    for (int y = 0; y < blocks.height; ++y) {
      for (int x = 0; x < blocks.width; ++x) {
        const int block = y * blocks.width + x;
        if (x + 1 < blocks.width) AddSeam(block, block + 1, cut);
        if (y + 1 < blocks.height) AddSeam(block, block + blocks.width, cut);
      }
    }
    cut.Solve();
    std::vector<int> taking;
    for (int block = 0; block < blocks.NumBlocks(); ++block) {
      if (node_[block] >= 0 && cut.IsOne(node_[block])) taking.push_back(block);
    }
    return taking;
  }

 private:
  // Of the side between two neighbours.
  void AddSeam(int block, int other, BinaryCut& cut) const {
    const int k = labels_[block];
    const int l = labels_[other];
    if (k < 0 || l < 0) return;
    if (node_[block] < 0 && node_[other] < 0) return;
    const double both_keep =
        k == l ? 0
               : energy_.SeamCost(energy_.Difference(block, k, l), energy_.Difference(other, k, l));
    const auto to_alpha_from = [&](int label) {
      if (label == alpha_) return 0.0;
      return energy_.SeamCost(
          label == k ? to_alpha_[block] : energy_.Difference(block, label, alpha_),
          label == l ? to_alpha_[other] : energy_.Difference(other, label, alpha_));
    };
    if (node_[other] < 0) {
      cut.AddCosts(node_[block], both_keep, to_alpha_from(l));
    } else if (node_[block] < 0) {
      cut.AddCosts(node_[other], both_keep, to_alpha_from(k));
    } else {
      const double other_takes = to_alpha_from(k);
      const double block_takes = k == l ? other_takes : to_alpha_from(l);
      cut.AddPairCosts(node_[block], node_[other], both_keep, other_takes, block_takes);
    }
  }

  const SeamEnergy& energy_;
  int alpha_;
  const std::vector<int>& labels_;
  std::vector<int> node_;         // of each block; -1: it has nothing to decide
  std::vector<double> to_alpha_;  // asked for by each of a block's neighbours
  int num_nodes_ = 0;
};

}  // namespace

void SmoothSeams(const ChartBlocks& blocks,
                 int chart,
                 const ColourModel& colour,
                 const SeamOptions& options,
                 ChartChoice& choice) {
  if (blocks.photos.size() < 2) return;
  const SeamEnergy energy(blocks, chart, colour, choice, options);
  // One round: on real scenes a second changed nothing that shows.
  for (int alpha = 0; alpha < static_cast<int>(blocks.photos.size()); ++alpha) {
    const Expansion expansion(energy, alpha, choice.best);
    if (expansion.IsEmpty()) continue;
    for (const int block : expansion.Solve()) choice.best[block] = alpha;
  }
}

}  // namespace groundglass
