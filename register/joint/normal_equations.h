// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Sparse>
#include <ceres/ceres.h>

#include <map>
#include <vector>

namespace groundglass {

// A solved problem, linearised at its solution: what its parameters answer to what, and how well
// they are known. Losses are applied, as the solver has applied them.
class NormalEquations {
 public:
  // Evaluates the problem; blocks are all its parameter blocks, in the order of their columns.
  // Throws Error if it cannot be evaluated, or if something in it is not determined at all.
  NormalEquations(ceres::Problem& problem, const std::vector<double*>& blocks);

  struct Rows {
    Eigen::Index first = 0;
    Eigen::Index size = 0;
  };
  const std::map<ceres::ResidualBlockId, Rows>& RowsOfCosts() const { return rows_of_costs_; }
  const Eigen::VectorXd& Residuals() const { return residuals_; }

  Eigen::Index ColumnOf(const double* block) const { return column_of_block_.at(block); }
  Eigen::Index NumColumns() const { return jacobian_.cols(); }
  // How far the solution moves for each of these columns, taken off the residuals.
  Eigen::MatrixXd LinearResponse(const Eigen::SparseMatrix<double>& pushes) const;
  // How far the solution would move without these residuals: the jackknife, to first order. What
  // is left must determine all parameters.
  Eigen::VectorXd LeaveOutUpdate(const std::vector<Rows>& left_out) const;
  // What these residuals alone add to the normal equations: their part of the information.
  Eigen::SparseMatrix<double> InformationOf(const std::vector<Rows>& rows) const;
  // The inverse normal equations times these columns.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& columns) const;
  // The inverse normal equations' columns first to first + size - 1.
  Eigen::MatrixXd CovarianceColumns(Eigen::Index first, Eigen::Index size) const;

 private:
  using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  // Adds J^T J vector to the sum, J these rows of the Jacobian.
  void AddSquare(const std::vector<Rows>& rows,
                 const Eigen::VectorXd& vector,
                 Eigen::VectorXd& sum) const;

  std::map<ceres::ResidualBlockId, Rows> rows_of_costs_;
  std::map<const double*, Eigen::Index> column_of_block_;
  Eigen::VectorXd residuals_;
  RowMajorMatrix jacobian_;
  Eigen::SparseMatrix<double> normal_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inverse_;
};

}  // namespace groundglass
