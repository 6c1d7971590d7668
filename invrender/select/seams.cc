// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/seams.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

class SeamProblem {
 public:
  SeamProblem(const ChartBlocks& blocks,
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
        data_[Index(block, k)] = std::min(options_.max_data_cost, -std::log(score / best + 1e-30));
        colours_[Index(block, k)] =
            colour.Corrected(blocks.photos[k], chart, static_cast<int>(k), views[k]);
      }
    }
  }

  // One expansion: every block keeps its photograph or takes `alpha`.
  void Expand(int alpha, std::vector<int>& labels) const {
    std::vector<int> node(blocks_.NumBlocks(), -1);
    int num_nodes = 0;
    for (int block = 0; block < blocks_.NumBlocks(); ++block) {
      if (labels[block] >= 0 && labels[block] != alpha && IsSeen(block, alpha)) {
        node[block] = num_nodes++;
      }
    }
    if (num_nodes == 0) return;
    // What a seam to alpha costs a block; asked for by each of its neighbours.
    std::vector<double> to_alpha(blocks_.NumBlocks(), 0);
    for (int block = 0; block < blocks_.NumBlocks(); ++block) {
      if (labels[block] >= 0) to_alpha[block] = Difference(block, labels[block], alpha);
    }
    cv::detail::GCGraph<double> graph(num_nodes + 2, 4 * num_nodes + 2);
    for (int i = 0; i < num_nodes + 2; ++i) graph.addVtx();
    graph.addEdges(num_nodes, num_nodes + 1, 0, 0);  // it insists on an edge
    // Where a block takes alpha it ends up on the sink's side, and pays what the source sends.
    const auto add = [&](int i, double keep, double take) {
      const double less = std::min(keep, take);
      graph.addTermWeights(i, take - less, keep - less);
    };
    for (int block = 0; block < blocks_.NumBlocks(); ++block) {
      if (node[block] < 0) continue;
      add(node[block], data_[Index(block, labels[block])], data_[Index(block, alpha)]);
    }
    for (int y = 0; y < blocks_.height; ++y) {
      for (int x = 0; x < blocks_.width; ++x) {
        const int block = y * blocks_.width + x;
        if (x + 1 < blocks_.width)
          Connect(block, block + 1, alpha, labels, node, to_alpha, add, graph);
        if (y + 1 < blocks_.height) {
          Connect(block, block + blocks_.width, alpha, labels, node, to_alpha, add, graph);
        }
      }
    }
    graph.maxFlow();
    for (int block = 0; block < blocks_.NumBlocks(); ++block) {
      if (node[block] < 0 || graph.inSourceSegment(node[block])) continue;
      labels[block] = alpha;
    }
  }

 private:
  size_t Index(int block, size_t k) const { return block * num_photos_ + k; }
  bool IsSeen(int block, int k) const { return blocks_.ViewsOf(block)[k].quality > 0; }

  // A metric in (k, l) for each block, as expansion needs: a capped norm.
  double Difference(int block, int k, int l) const {
    if (k == l) return 0;
    if (!IsSeen(block, k) || !IsSeen(block, l)) return options_.max_difference;
    const float squared = (colours_[Index(block, k)] - colours_[Index(block, l)]).square().mean();
    return std::min(options_.max_difference, std::sqrt(static_cast<double>(squared)));
  }
  double Seam(int block, int other, int k, int l) const {
    if (k == l) return 0;
    return options_.seam_cost +
           options_.difference_cost * (Difference(block, k, l) + Difference(other, k, l)) / 2;
  }

  template <typename Add>
  void Connect(int block,
               int other,
               int alpha,
               const std::vector<int>& labels,
               const std::vector<int>& node,
               const std::vector<double>& to_alpha,
               const Add& add,
               cv::detail::GCGraph<double>& graph) const {
    const int k = labels[block];
    const int l = labels[other];
    if (k < 0 || l < 0) return;
    if (node[block] < 0 && node[other] < 0) return;
    const double both_keep = Seam(block, other, k, l);
    const auto to_alpha_from = [&](int label) {
      if (label == alpha) return 0.0;
      const double at_block = label == k ? to_alpha[block] : Difference(block, label, alpha);
      const double at_other = label == l ? to_alpha[other] : Difference(other, label, alpha);
      return options_.seam_cost + options_.difference_cost * (at_block + at_other) / 2;
    };
    if (node[other] < 0) {
      add(node[block], both_keep, to_alpha_from(l));
      return;
    }
    if (node[block] < 0) {
      add(node[other], both_keep, to_alpha_from(k));
      return;
    }
    // Kolmogorov and Zabih (PAMI 2004): two terms and one edge.
    const double other_takes = to_alpha_from(k);
    const double block_takes = k == l ? other_takes : to_alpha_from(l);
    add(node[block], both_keep, block_takes);
    add(node[other], block_takes, 0);
    graph.addEdges(
        node[block], node[other], std::max(0.0, other_takes + block_takes - both_keep), 0);
  }

  const ChartBlocks& blocks_;
  const SeamOptions& options_;
  size_t num_photos_;
  std::vector<double> data_;
  std::vector<Eigen::Array3f> colours_;
};

}  // namespace

void SmoothSeams(const ChartBlocks& blocks,
                 int chart,
                 const ColourModel& colour,
                 const SeamOptions& options,
                 ChartChoice& choice) {
  if (blocks.photos.size() < 2) return;
  const SeamProblem problem(blocks, chart, colour, choice, options);
  // One round: on real scenes a second changed nothing that shows.
  for (size_t alpha = 0; alpha < blocks.photos.size(); ++alpha) {
    problem.Expand(static_cast<int>(alpha), choice.best);
  }
}

}  // namespace groundglass
