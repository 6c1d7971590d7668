// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/sparse_inverse.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace groundglass {
namespace {

using Factorization = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
using Factor = Eigen::SparseMatrix<double>;

// So many columns are solved for at once: an entry of the factor that is read serves all of them.
constexpr Eigen::Index kPanelWidth = 16;
using Panel = Eigen::Matrix<double, Eigen::Dynamic, kPanelWidth, Eigen::RowMajor>;

// Columns first to last - 1 of the inverse of L D L^T, its rows from `first` on: those above are
// rows of earlier columns, since it is symmetric. L has ones on its diagonal, which are not stored.
Panel SolvePanel(const Factor& lower,
                 const Eigen::VectorXd& diagonal,
                 Eigen::Index first,
                 Eigen::Index last) {
  const Eigen::Index size = lower.rows();
  Panel panel = Panel::Zero(size - first, kPanelWidth);
  for (Eigen::Index column = first; column < last; ++column) {
    panel(column - first, column - first) = 1;
  }
  for (Eigen::Index k = first; k < size; ++k) {
    for (Factor::InnerIterator entry(lower, k); entry; ++entry) {
      panel.row(entry.row() - first) -= entry.value() * panel.row(k - first);
    }
  }
  for (Eigen::Index k = size - 1; k >= first; --k) {
    panel.row(k - first) /= diagonal[k];
    for (Factor::InnerIterator entry(lower, k); entry; ++entry) {
      panel.row(k - first) -= entry.value() * panel.row(entry.row() - first);
    }
  }
  return panel;
}

}  // namespace

std::optional<Eigen::MatrixXd> InverseOfSparse(const Eigen::SparseMatrix<double>& matrix) {
  const Factorization factorization(matrix);
  if (factorization.info() != Eigen::Success || (factorization.vectorD().array() <= 0).any()) {
    return std::nullopt;
  }
  const Factor& lower = factorization.matrixL().nestedExpression();
  const Eigen::VectorXd diagonal = factorization.vectorD();
  // The factor's row and column number i is the matrix's number was_at[i].
  const Eigen::VectorXi was_at = factorization.permutationPinv().indices();
  const Eigen::Index size = matrix.rows();
  Eigen::MatrixXd inverse(size, size);
  const Eigen::Index num_panels = (size + kPanelWidth - 1) / kPanelWidth;
  tbb::parallel_for(Eigen::Index{0}, num_panels, [&](Eigen::Index i) {
    const Eigen::Index first = i * kPanelWidth;
    const Eigen::Index last = std::min(size, first + kPanelWidth);
    const Panel panel = SolvePanel(lower, diagonal, first, last);
    for (Eigen::Index column = first; column < last; ++column) {
      for (Eigen::Index row = column; row < size; ++row) {
        const double value = panel(row - first, column - first);
        inverse(was_at[row], was_at[column]) = value;
        inverse(was_at[column], was_at[row]) = value;
      }
    }
  });
  return inverse;
}

}  // namespace groundglass
