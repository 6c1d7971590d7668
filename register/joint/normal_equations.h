// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <ceres/ceres.h>

#include <map>
#include <vector>

namespace groundglass {

// A solved problem, linearised at its solution: what its parameters answer to what, and how well
// they are known. Losses are applied, as the solver has applied them. Most of the parameters are
// eliminated (the Schur complement: Triggs et al., Bundle Adjustment, 2000, section 6.1): what is
// said of the others takes them into account.
class NormalEquations {
 public:
  // Evaluates the problem. eliminated: blocks of which no cost holds two; kept: all its others, in
  // the order of their columns. Throws Error if it cannot be evaluated, or if something in it is
  // not determined at all.
  NormalEquations(ceres::Problem& problem,
                  const std::vector<double*>& eliminated,
                  const std::vector<double*>& kept);

  struct Rows {
    Eigen::Index first = 0;
    Eigen::Index size = 0;
  };
  const std::map<ceres::ResidualBlockId, Rows>& RowsOfCosts() const { return rows_of_costs_; }
  const Eigen::VectorXd& Residuals() const { return residuals_; }

  // Of a kept block, among the columns of all that are kept.
  Eigen::Index ColumnOf(const double* block) const { return column_of_block_.at(block); }
  Eigen::Index NumKept() const { return covariance_.cols(); }
  // Of all that is kept: the inverse of the reduced normal equations.
  const Eigen::MatrixXd& Covariance() const { return covariance_; }

  // Directions of a block's parameters: one in each column.
  struct Directions {
    const double* block = nullptr;
    Eigen::MatrixXd directions;
  };
  // Of sums of parameters, kept or eliminated: as many as each block has directions.
  Eigen::MatrixXd CovarianceOfSums(const std::vector<Directions>& sums) const;

  // How far what is kept moves for each of these columns, taken off the residuals.
  Eigen::MatrixXd LinearResponse(const Eigen::SparseMatrix<double>& pushes) const;
  // How far what is kept would move without these residuals: the jackknife, to first order. What
  // is left must determine all parameters.
  Eigen::VectorXd LeaveOutUpdate(const std::vector<Rows>& left_out) const;
  // What these residuals alone add to the normal equations, the others of which say where the
  // eliminated go: for columns C of the covariance, C^T information C is their part in it.
  Eigen::SparseMatrix<double> InformationOf(const std::vector<Rows>& rows) const;

 private:
  using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  // An eliminated block: its own part of the normal equations, and what it shares with the kept.
  struct Eliminated {
    Eigen::Index first_column = 0;
    Eigen::MatrixXd own;               // size x size
    std::vector<Eigen::Index> shared;  // columns among the kept, ascending
    Eigen::MatrixXd coupling;          // size x shared
    Eigen::MatrixXd answer;            // own^-1 coupling
  };
  // A part of what leaving out takes off the reduced normal equations: rows^T middle rows, at these
  // of the kept columns; and off their right side.
  struct Piece {
    std::vector<Eigen::Index> at;
    Eigen::MatrixXd rows;
    Eigen::MatrixXd middle;
    Eigen::VectorXd right_side;
  };
  // All of them, at their places among the columns that any touches.
  struct TakenOff {
    std::vector<Eigen::Index> columns;  // ascending
    std::vector<Piece> pieces;
    Eigen::VectorXd right_side;

    Eigen::VectorXd Times(const Eigen::VectorXd& vector) const;
  };

  void ReadBlocks(const Eigen::SparseMatrix<double>& normal,
                  const std::vector<Eigen::Index>& sizes);
  Eigen::SparseMatrix<double> Reduce(const Eigen::SparseMatrix<double>& normal) const;
  // Of rows that hold this eliminated block, or none (-1).
  std::vector<Piece> PiecesOf(int number, const std::vector<Eigen::Index>& rows) const;
  TakenOff TakeOff(const std::vector<Rows>& left_out) const;
  Eigen::MatrixXd CovarianceAt(const std::vector<Eigen::Index>& columns) const;

  std::map<ceres::ResidualBlockId, Rows> rows_of_costs_;
  std::map<const double*, Eigen::Index> column_of_block_;
  std::map<const double*, size_t> number_of_eliminated_;
  Eigen::VectorXd residuals_;
  RowMajorMatrix jacobian_;  // eliminated columns, then kept ones
  std::vector<Eliminated> eliminated_;
  std::vector<int> eliminated_of_column_;  // of each eliminated column
  Eigen::SparseMatrix<double> answers_;    // own^-1 coupling of all: eliminated x kept
  Eigen::MatrixXd covariance_;
};

}  // namespace groundglass
