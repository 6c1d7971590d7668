// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/seams.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// Costs are natural logarithms of quality: 0.7 is half the resolution.
constexpr double kWorst = 12;
// A cell's side of seam where nothing shows.
constexpr double kSeam = 0.15;
// For each log unit that the two photographs differ there, up to kMostDifferent.
constexpr double kSeamPerUnit = 4;
constexpr double kMostDifferent = 1;

class SeamProblem {
 public:
  SeamProblem(const ChartCells& cells,
              int chart,
              const ColourModel& colour,
              const ChartChoice& choice)
      : cells_(cells), num_photos_(cells.photos.size()) {
    data_.assign(cells.views.size(), kWorst);
    colours_.resize(cells.views.size(), Eigen::Array3f::Zero());
    for (int cell = 0; cell < cells.NumCells(); ++cell) {
      const CellView* views = cells.ViewsOf(cell);
      double best = 0;
      for (size_t k = 0; k < num_photos_; ++k) {
        best = std::max<double>(best, views[k].quality * choice.acceptance[Index(cell, k)]);
      }
      for (size_t k = 0; k < num_photos_; ++k) {
        if (views[k].quality <= 0) continue;
        const double score = views[k].quality * choice.acceptance[Index(cell, k)];
        data_[Index(cell, k)] = std::min(kWorst, -std::log(score / best + 1e-30));
        colours_[Index(cell, k)] =
            colour.Corrected(cells.photos[k], chart, static_cast<int>(k), views[k]);
      }
    }
  }

  // One expansion: every cell keeps its photograph or takes `alpha`.
  void Expand(int alpha, std::vector<int>& labels) const {
    std::vector<int> node(cells_.NumCells(), -1);
    int num_nodes = 0;
    for (int cell = 0; cell < cells_.NumCells(); ++cell) {
      if (labels[cell] >= 0 && labels[cell] != alpha && IsSeen(cell, alpha)) {
        node[cell] = num_nodes++;
      }
    }
    if (num_nodes == 0) return;
    // What a seam to alpha costs a cell; asked for by each of its neighbours.
    std::vector<double> to_alpha(cells_.NumCells(), 0);
    for (int cell = 0; cell < cells_.NumCells(); ++cell) {
      if (labels[cell] >= 0) to_alpha[cell] = Difference(cell, labels[cell], alpha);
    }
    cv::detail::GCGraph<double> graph(num_nodes + 2, 4 * num_nodes + 2);
    for (int i = 0; i < num_nodes + 2; ++i) graph.addVtx();
    graph.addEdges(num_nodes, num_nodes + 1, 0, 0);  // it insists on an edge
    // Where a cell takes alpha it ends up on the sink's side, and pays what the source sends.
    const auto add = [&](int i, double keep, double take) {
      const double less = std::min(keep, take);
      graph.addTermWeights(i, take - less, keep - less);
    };
    for (int cell = 0; cell < cells_.NumCells(); ++cell) {
      if (node[cell] < 0) continue;
      add(node[cell], data_[Index(cell, labels[cell])], data_[Index(cell, alpha)]);
    }
    for (int y = 0; y < cells_.height; ++y) {
      for (int x = 0; x < cells_.width; ++x) {
        const int cell = y * cells_.width + x;
        if (x + 1 < cells_.width)
          Connect(cell, cell + 1, alpha, labels, node, to_alpha, add, graph);
        if (y + 1 < cells_.height) {
          Connect(cell, cell + cells_.width, alpha, labels, node, to_alpha, add, graph);
        }
      }
    }
    graph.maxFlow();
    for (int cell = 0; cell < cells_.NumCells(); ++cell) {
      if (node[cell] < 0 || graph.inSourceSegment(node[cell])) continue;
      labels[cell] = alpha;
    }
  }

 private:
  size_t Index(int cell, size_t k) const { return cell * num_photos_ + k; }
  bool IsSeen(int cell, int k) const { return cells_.ViewsOf(cell)[k].quality > 0; }

  // A metric in (k, l) for each cell, as expansion needs: a capped norm.
  double Difference(int cell, int k, int l) const {
    if (k == l) return 0;
    if (!IsSeen(cell, k) || !IsSeen(cell, l)) return kMostDifferent;
    const float squared = (colours_[Index(cell, k)] - colours_[Index(cell, l)]).square().mean();
    return std::min(kMostDifferent, std::sqrt(static_cast<double>(squared)));
  }
  double Seam(int cell, int other, int k, int l) const {
    if (k == l) return 0;
    return kSeam + kSeamPerUnit * (Difference(cell, k, l) + Difference(other, k, l)) / 2;
  }

  template <typename Add>
  void Connect(int cell,
               int other,
               int alpha,
               const std::vector<int>& labels,
               const std::vector<int>& node,
               const std::vector<double>& to_alpha,
               const Add& add,
               cv::detail::GCGraph<double>& graph) const {
    const int k = labels[cell];
    const int l = labels[other];
    if (k < 0 || l < 0) return;
    if (node[cell] < 0 && node[other] < 0) return;
    const double both_keep = Seam(cell, other, k, l);
    const auto to_alpha_from = [&](int label) {
      if (label == alpha) return 0.0;
      const double at_cell = label == k ? to_alpha[cell] : Difference(cell, label, alpha);
      const double at_other = label == l ? to_alpha[other] : Difference(other, label, alpha);
      return kSeam + kSeamPerUnit * (at_cell + at_other) / 2;
    };
    if (node[other] < 0) {
      add(node[cell], both_keep, to_alpha_from(l));
      return;
    }
    if (node[cell] < 0) {
      add(node[other], both_keep, to_alpha_from(k));
      return;
    }
    // Kolmogorov and Zabih (PAMI 2004): two terms and one edge.
    const double other_takes = to_alpha_from(k);
    const double cell_takes = k == l ? other_takes : to_alpha_from(l);
    add(node[cell], both_keep, cell_takes);
    add(node[other], cell_takes, 0);
    graph.addEdges(node[cell], node[other], std::max(0.0, other_takes + cell_takes - both_keep), 0);
  }

  const ChartCells& cells_;
  size_t num_photos_;
  std::vector<double> data_;
  std::vector<Eigen::Array3f> colours_;
};

}  // namespace

void SmoothSeams(const ChartCells& cells,
                 int chart,
                 const ColourModel& colour,
                 ChartChoice& choice) {
  if (cells.photos.size() < 2) return;
  const SeamProblem problem(cells, chart, colour, choice);
  // One round: on real scenes a second changed nothing that shows.
  for (size_t alpha = 0; alpha < cells.photos.size(); ++alpha) {
    problem.Expand(static_cast<int>(alpha), choice.best);
  }
}

}  // namespace groundglass
