// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/normal_equations.h"

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
  jacobian_ = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
      rows.num_rows,
      rows.num_cols,
      static_cast<Eigen::Index>(rows.values.size()),
      rows.rows.data(),
      rows.cols.data(),
      rows.values.data());
  inverse_.compute(jacobian_.transpose() * jacobian_);
  if (inverse_.info() != Eigen::Success) {
    throw Error("register: the photographs' common solution is not determined");
  }
}

Eigen::MatrixXd NormalEquations::Answer(const Eigen::SparseMatrix<double>& pushes) const {
  const Eigen::SparseMatrix<double> by_column = jacobian_.transpose() * pushes;
  return inverse_.solve(Eigen::MatrixXd(by_column));
}

Eigen::MatrixXd NormalEquations::CovarianceColumns(Eigen::Index first, Eigen::Index size) const {
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(NumColumns(), size);
  units.middleRows(first, size).setIdentity();
  return inverse_.solve(units);
}

}  // namespace groundglass
