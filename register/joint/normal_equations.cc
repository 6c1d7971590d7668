// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/normal_equations.h"

#include "scene/error.h"

namespace groundglass {

NormalEquations::NormalEquations(ceres::Problem& problem, const std::vector<double*>& blocks) {
  std::vector<ceres::ResidualBlockId> costs;
  problem.GetResidualBlocks(&costs);
  Eigen::Index row = 0;
  for (const ceres::ResidualBlockId cost : costs) {
    const Eigen::Index size = problem.GetCostFunctionForResidualBlock(cost)->num_residuals();
    rows_of_costs_[cost] = {row, size};
    row += size;
  }
  Eigen::Index column = 0;
  for (const double* block : blocks) {
    column_of_block_[block] = column;
    column += problem.ParameterBlockSize(block);
  }
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = costs;
  options.parameter_blocks = blocks;
  std::vector<double> residuals;
  ceres::CRSMatrix rows;
  if (!problem.Evaluate(options, nullptr, &residuals, nullptr, &rows)) {
    throw Error("register: the photographs' common solution left the cameras' range");
  }
  residuals_ = Eigen::Map<const Eigen::VectorXd>(residuals.data(), row);
  jacobian_ = Eigen::Map<const RowMajorMatrix>(rows.num_rows,
                                               rows.num_cols,
                                               static_cast<Eigen::Index>(rows.values.size()),
                                               rows.rows.data(),
                                               rows.cols.data(),
                                               rows.values.data());
  normal_ = jacobian_.transpose() * jacobian_;
  inverse_.compute(normal_);
  if (inverse_.info() != Eigen::Success) {
    throw Error("register: the photographs' common solution is not determined");
  }
}

Eigen::MatrixXd NormalEquations::LinearResponse(const Eigen::SparseMatrix<double>& pushes) const {
  const Eigen::SparseMatrix<double> by_column = jacobian_.transpose() * pushes;
  return inverse_.solve(Eigen::MatrixXd(by_column));
}

Eigen::SparseMatrix<double> NormalEquations::InformationOf(const std::vector<Rows>& rows) const {
  // Not of a matrix of these rows, as for the few of a cluster: they may be nearly all.
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(jacobian_.rows());
  for (const Rows& each : rows) counts.segment(each.first, each.size).setOnes();
  const RowMajorMatrix theirs = counts.asDiagonal() * jacobian_;
  return jacobian_.transpose() * theirs;
}

void NormalEquations::AddSquare(const std::vector<Rows>& rows,
                                const Eigen::VectorXd& vector,
                                Eigen::VectorXd& sum) const {
  using Entries = RowMajorMatrix::InnerIterator;
  for (const Rows& each : rows) {
    for (Eigen::Index row = each.first; row < each.first + each.size; ++row) {
      double product = 0;
      for (Entries entry(jacobian_, row); entry; ++entry) {
        product += entry.value() * vector[entry.col()];
      }
      for (Entries entry(jacobian_, row); entry; ++entry) {
        sum[entry.col()] += entry.value() * product;
      }
    }
  }
}

// Conjugate gradients with the inverse of the whole as a preconditioner, which is nearly that of
// all but a few of its rows. Of a direction, what the whole makes of it is known: the whole's
// inverse made it. So neither the whole nor what is left of it is ever multiplied by, or built.
Eigen::VectorXd NormalEquations::LeaveOutUpdate(const std::vector<Rows>& left_out) const {
  constexpr double kTolerance = 1e-6;
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(NumColumns());
  for (const Rows& rows : left_out) {
    for (Eigen::Index row = rows.first; row < rows.first + rows.size; ++row) {
      for (RowMajorMatrix::InnerIterator entry(jacobian_, row); entry; ++entry) {
        right_side[entry.col()] += entry.value() * residuals_[row];
      }
    }
  }
  Eigen::VectorXd update = Eigen::VectorXd::Zero(NumColumns());
  const double enough = kTolerance * kTolerance * right_side.squaredNorm();
  Eigen::VectorXd residual = right_side;
  Eigen::VectorXd direction = inverse_.solve(residual);
  Eigen::VectorXd whole_direction = residual;  // the whole times the direction
  double product = residual.dot(direction);
  for (Eigen::Index i = 0; i < NumColumns() && residual.squaredNorm() > enough; ++i) {
    Eigen::VectorXd taken_off = Eigen::VectorXd::Zero(NumColumns());
    AddSquare(left_out, direction, taken_off);
    const Eigen::VectorXd rest = whole_direction - taken_off;
    const double curvature = direction.dot(rest);
    if (!(curvature > 0)) break;  // what is left determines no more
    const double step = product / curvature;
    update += step * direction;
    residual -= step * rest;
    const Eigen::VectorXd next = inverse_.solve(residual);
    const double next_product = residual.dot(next);
    const double share = next_product / product;
    direction = next + share * direction;
    whole_direction = residual + share * whole_direction;
    product = next_product;
  }
  return update;
}

Eigen::MatrixXd NormalEquations::CovarianceColumns(Eigen::Index first, Eigen::Index size) const {
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(NumColumns(), size);
  units.middleRows(first, size).setIdentity();
  return Solve(units);
}

Eigen::MatrixXd NormalEquations::Solve(const Eigen::MatrixXd& columns) const {
  return inverse_.solve(columns);
}

}  // namespace groundglass
