// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/normal_equations.h"

#include "scene/error.h"

namespace groundglass {
namespace {

// Another system's inverse, as a preconditioner.
struct ByInverse {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>* inverse = nullptr;
  ByInverse& analyzePattern(const Eigen::SparseMatrix<double>&) { return *this; }
  ByInverse& factorize(const Eigen::SparseMatrix<double>&) { return *this; }
  ByInverse& compute(const Eigen::SparseMatrix<double>&) { return *this; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const {
    return inverse->solve(right_side);
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }
};

}  // namespace

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

NormalEquations::RowMajorMatrix NormalEquations::JacobianOf(const std::vector<Rows>& rows) const {
  Eigen::Index num_rows = 0;
  for (const Rows& each : rows) num_rows += each.size;
  RowMajorMatrix theirs(num_rows, NumColumns());
  Eigen::Index next = 0;
  for (const Rows& each : rows) {
    theirs.middleRows(next, each.size) = jacobian_.middleRows(each.first, each.size);
    next += each.size;
  }
  return theirs;
}

Eigen::SparseMatrix<double> NormalEquations::InformationOf(const std::vector<Rows>& rows) const {
  // Not of a matrix of these rows, as for the few of a cluster: they may be nearly all.
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(jacobian_.rows());
  for (const Rows& each : rows) counts.segment(each.first, each.size).setOnes();
  const RowMajorMatrix theirs = counts.asDiagonal() * jacobian_;
  return jacobian_.transpose() * theirs;
}

Eigen::VectorXd NormalEquations::LeaveOutUpdate(const std::vector<Rows>& left_out) const {
  const RowMajorMatrix theirs = JacobianOf(left_out);
  Eigen::VectorXd residuals(theirs.rows());
  Eigen::Index next = 0;
  for (const Rows& rows : left_out) {
    residuals.segment(next, rows.size) = residuals_.segment(rows.first, rows.size);
    next += rows.size;
  }
  const Eigen::SparseMatrix<double> by_column = theirs;
  const Eigen::SparseMatrix<double> normal = normal_ - by_column.transpose() * by_column;
  // The inverse of the whole is nearly that of all but a few of its rows.
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, ByInverse>
      without;
  without.preconditioner().inverse = &inverse_;
  without.setTolerance(1e-6);
  without.compute(normal);
  return without.solve(theirs.transpose() * residuals);
}

Eigen::MatrixXd NormalEquations::CovarianceColumns(Eigen::Index first, Eigen::Index size) const {
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(NumColumns(), size);
  units.middleRows(first, size).setIdentity();
  return inverse_.solve(units);
}

}  // namespace groundglass
