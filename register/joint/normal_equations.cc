// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/normal_equations.h"

#include "register/joint/sparse_inverse.h"
#include "scene/error.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace groundglass {
namespace {

using Columns = std::vector<Eigen::Index>;

[[noreturn]] void ThrowNotDetermined() {
  throw Error("register: the photographs' common solution is not determined");
}

void SortAndMakeUnique(Columns& columns) {
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

// Where in sorted columns one of them is.
Eigen::Index PlaceOf(Eigen::Index column, const Columns& columns) {
  return std::distance(columns.begin(), std::lower_bound(columns.begin(), columns.end(), column));
}

}  // namespace

NormalEquations::NormalEquations(ceres::Problem& problem,
                                 const std::vector<double*>& eliminated,
                                 const std::vector<double*>& kept) {
  std::vector<ceres::ResidualBlockId> costs;
  problem.GetResidualBlocks(&costs);
  Eigen::Index row = 0;
  for (const ceres::ResidualBlockId cost : costs) {
    const Eigen::Index size = problem.GetCostFunctionForResidualBlock(cost)->num_residuals();
    rows_of_costs_[cost] = {row, size};
    row += size;
  }
  std::vector<Eigen::Index> sizes;
  for (const double* block : eliminated) {
    number_of_eliminated_[block] = sizes.size();
    sizes.push_back(problem.ParameterBlockSize(block));
  }
  Eigen::Index column = 0;
  for (const double* block : kept) {
    column_of_block_[block] = column;
    column += problem.ParameterBlockSize(block);
  }
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = costs;
  options.parameter_blocks = eliminated;
  options.parameter_blocks.insert(options.parameter_blocks.end(), kept.begin(), kept.end());
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
  const Eigen::SparseMatrix<double> normal = jacobian_.transpose() * jacobian_;
  ReadBlocks(normal, sizes);
  std::optional<Eigen::MatrixXd> covariance = InverseOfSparse(Reduce(normal));
  if (!covariance) ThrowNotDetermined();
  covariance_ = std::move(*covariance);
}

void NormalEquations::ReadBlocks(const Eigen::SparseMatrix<double>& normal,
                                 const std::vector<Eigen::Index>& sizes) {
  using Entries = Eigen::SparseMatrix<double>::InnerIterator;
  for (const Eigen::Index size : sizes) {
    Eliminated block;
    block.first_column = static_cast<Eigen::Index>(eliminated_of_column_.size());
    eliminated_of_column_.insert(
        eliminated_of_column_.end(), size, static_cast<int>(eliminated_.size()));
    eliminated_.push_back(std::move(block));
  }
  const auto num_eliminated = static_cast<Eigen::Index>(eliminated_of_column_.size());
  std::vector<Eigen::Triplet<double>> answers;
  for (size_t i = 0; i < eliminated_.size(); ++i) {
    Eliminated& block = eliminated_[i];
    const Eigen::Index first = block.first_column;
    const Eigen::Index size = sizes[i];
    for (Eigen::Index k = 0; k < size; ++k) {
      for (Entries entry(normal, first + k); entry; ++entry) {
        if (entry.row() >= num_eliminated) block.shared.push_back(entry.row() - num_eliminated);
      }
    }
    SortAndMakeUnique(block.shared);
    const auto num_shared = static_cast<Eigen::Index>(block.shared.size());
    block.own = Eigen::MatrixXd::Zero(size, size);
    block.coupling = Eigen::MatrixXd::Zero(size, num_shared);
    for (Eigen::Index k = 0; k < size; ++k) {
      for (Entries entry(normal, first + k); entry; ++entry) {
        if (entry.row() >= num_eliminated) {
          block.coupling(k, PlaceOf(entry.row() - num_eliminated, block.shared)) = entry.value();
        } else {
          assert(entry.row() >= first && entry.row() < first + size);
          block.own(entry.row() - first, k) = entry.value();
        }
      }
    }
    const auto own = block.own.ldlt();
    if (own.info() != Eigen::Success || !(own.vectorD().minCoeff() > 0)) ThrowNotDetermined();
    block.answer = own.solve(block.coupling);
    for (Eigen::Index k = 0; k < size; ++k) {
      for (Eigen::Index j = 0; j < num_shared; ++j) {
        answers.emplace_back(first + k, block.shared[j], block.answer(k, j));
      }
    }
  }
  answers_.resize(num_eliminated, normal.cols() - num_eliminated);
  answers_.setFromTriplets(answers.begin(), answers.end());
}

// The Schur complement.
Eigen::SparseMatrix<double> NormalEquations::Reduce(
    const Eigen::SparseMatrix<double>& normal) const {
  const Eigen::Index num_eliminated = answers_.rows();
  const Eigen::Index num_kept = answers_.cols();
  const Eigen::SparseMatrix<double> of_kept =
      normal.block(num_eliminated, num_eliminated, num_kept, num_kept);
  const Eigen::SparseMatrix<double> coupling =
      normal.block(0, num_eliminated, num_eliminated, num_kept);
  const Eigen::SparseMatrix<double> through_eliminated = coupling.transpose() * answers_;
  return of_kept - through_eliminated;
}

Eigen::MatrixXd NormalEquations::LinearResponse(const Eigen::SparseMatrix<double>& pushes) const {
  const Eigen::MatrixXd pushed = Eigen::SparseMatrix<double>(jacobian_.transpose() * pushes);
  return covariance_ *
         (pushed.bottomRows(NumKept()) - answers_.transpose() * pushed.topRows(answers_.rows()));
}

Eigen::SparseMatrix<double> NormalEquations::InformationOf(const std::vector<Rows>& rows) const {
  // Not of a matrix of these rows, as for the few of a cluster: they may be nearly all.
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(jacobian_.rows());
  for (const Rows& each : rows) counts.segment(each.first, each.size).setOnes();
  const RowMajorMatrix theirs = counts.asDiagonal() * jacobian_;
  const Eigen::SparseMatrix<double> information = jacobian_.transpose() * theirs;
  const Eigen::Index num_eliminated = answers_.rows();
  const Eigen::SparseMatrix<double> of_kept =
      information.block(num_eliminated, num_eliminated, NumKept(), NumKept());
  const Eigen::SparseMatrix<double> of_eliminated =
      information.block(0, 0, num_eliminated, num_eliminated);
  const Eigen::SparseMatrix<double> coupling =
      information.block(0, num_eliminated, num_eliminated, NumKept());
  const Eigen::SparseMatrix<double> half = 0.5 * of_eliminated * answers_ - coupling;
  const Eigen::SparseMatrix<double> through = answers_.transpose() * half;
  return of_kept + through + Eigen::SparseMatrix<double>(through.transpose());
}

Eigen::MatrixXd NormalEquations::CovarianceAt(const Columns& columns) const {
  const auto size = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = 0; i < size; ++i) covariance(i, j) = covariance_(columns[i], columns[j]);
  }
  return covariance;
}

Eigen::MatrixXd NormalEquations::CovarianceOfSums(const std::vector<Directions>& sums) const {
  Columns columns;
  for (const auto& [block, directions] : sums) {
    if (const auto kept = column_of_block_.find(block); kept != column_of_block_.end()) {
      for (Eigen::Index i = 0; i < directions.rows(); ++i) columns.push_back(kept->second + i);
    } else {
      const Columns& shared = eliminated_[number_of_eliminated_.at(block)].shared;
      columns.insert(columns.end(), shared.begin(), shared.end());
    }
  }
  SortAndMakeUnique(columns);
  const Eigen::Index num_sums = sums.front().directions.cols();
  Eigen::MatrixXd weights =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(columns.size()), num_sums);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(num_sums, num_sums);
  for (const auto& [block, directions] : sums) {
    if (const auto kept = column_of_block_.find(block); kept != column_of_block_.end()) {
      for (Eigen::Index i = 0; i < directions.rows(); ++i) {
        weights.row(PlaceOf(kept->second + i, columns)) += directions.row(i);
      }
      continue;
    }
    const Eliminated& eliminated = eliminated_[number_of_eliminated_.at(block)];
    covariance += directions.transpose() * eliminated.own.ldlt().solve(directions);
    const Eigen::MatrixXd answered = eliminated.answer.transpose() * directions;
    for (size_t i = 0; i < eliminated.shared.size(); ++i) {
      weights.row(PlaceOf(eliminated.shared[i], columns)) -=
          answered.row(static_cast<Eigen::Index>(i));
    }
  }
  return covariance + weights.transpose() * (CovarianceAt(columns) * weights);
}

Eigen::VectorXd NormalEquations::TakenOff::Times(const Eigen::VectorXd& vector) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(vector.size());
  for (const Piece& piece : pieces) {
    Eigen::VectorXd part(static_cast<Eigen::Index>(piece.at.size()));
    for (size_t i = 0; i < piece.at.size(); ++i)
      part[static_cast<Eigen::Index>(i)] = vector[piece.at[i]];
    const Eigen::VectorXd answer =
        piece.rows.transpose() * (piece.middle * (piece.rows * part)).eval();
    for (size_t i = 0; i < piece.at.size(); ++i) {
      product[piece.at[i]] += answer[static_cast<Eigen::Index>(i)];
    }
  }
  return product;
}

std::vector<NormalEquations::Piece> NormalEquations::PiecesOf(
    int number, const std::vector<Eigen::Index>& rows) const {
  using Entries = RowMajorMatrix::InnerIterator;
  const Eigen::Index num_eliminated = answers_.rows();
  Piece kept;
  for (const Eigen::Index row : rows) {
    for (Entries entry(jacobian_, row); entry; ++entry) {
      if (entry.col() >= num_eliminated) kept.at.push_back(entry.col() - num_eliminated);
    }
  }
  SortAndMakeUnique(kept.at);
  const auto num_rows = static_cast<Eigen::Index>(rows.size());
  kept.rows = Eigen::MatrixXd::Zero(num_rows, static_cast<Eigen::Index>(kept.at.size()));
  kept.middle = Eigen::MatrixXd::Identity(num_rows, num_rows);
  const Eliminated* block = number < 0 ? nullptr : &eliminated_[number];
  Eigen::MatrixXd of_block = Eigen::MatrixXd::Zero(num_rows, block ? block->own.cols() : 0);
  Eigen::VectorXd residuals(num_rows);
  for (Eigen::Index i = 0; i < num_rows; ++i) {
    residuals[i] = residuals_[rows[i]];
    for (Entries entry(jacobian_, rows[i]); entry; ++entry) {
      if (entry.col() < num_eliminated) {
        of_block(i, entry.col() - block->first_column) = entry.value();
      } else {
        kept.rows(i, PlaceOf(entry.col() - num_eliminated, kept.at)) = entry.value();
      }
    }
  }
  kept.right_side = kept.rows.transpose() * residuals;
  if (!block) return {kept};

  // What the eliminated block makes of the kept, without these rows and with them.
  const Eigen::Index size = block->own.cols();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd coupling = block->coupling;
  const Eigen::MatrixXd coupling_of_rows = of_block.transpose() * kept.rows;
  for (size_t i = 0; i < kept.at.size(); ++i) {
    coupling.col(PlaceOf(kept.at[i], block->shared)) -=
        coupling_of_rows.col(static_cast<Eigen::Index>(i));
  }
  const Eigen::MatrixXd own = block->own - of_block.transpose() * of_block;
  const Eigen::MatrixXd own_inverse = own.ldlt().solve(identity);
  Piece through;
  through.at = block->shared;
  through.rows.resize(2 * size, coupling.cols());
  through.rows << coupling, block->coupling;
  through.middle = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  through.middle.topLeftCorner(size, size) = own_inverse;
  through.middle.bottomRightCorner(size, size) = -block->own.ldlt().solve(identity);
  through.right_side =
      -coupling.transpose() * (own_inverse * (of_block.transpose() * residuals)).eval();
  return {kept, through};
}

NormalEquations::TakenOff NormalEquations::TakeOff(const std::vector<Rows>& left_out) const {
  // Rows of each eliminated block together; those of none under -1.
  std::map<int, std::vector<Eigen::Index>> rows_of_eliminated;
  for (const Rows& rows : left_out) {
    for (Eigen::Index row = rows.first; row < rows.first + rows.size; ++row) {
      // The first entry: of what is eliminated, if any is.
      const RowMajorMatrix::InnerIterator entry(jacobian_, row);
      const bool is_eliminated = entry && entry.col() < answers_.rows();
      rows_of_eliminated[is_eliminated ? eliminated_of_column_[entry.col()] : -1].push_back(row);
    }
  }
  TakenOff taken_off;
  for (const auto& [number, rows] : rows_of_eliminated) {
    for (Piece& piece : PiecesOf(number, rows)) taken_off.pieces.push_back(std::move(piece));
  }
  for (const Piece& piece : taken_off.pieces) {
    taken_off.columns.insert(taken_off.columns.end(), piece.at.begin(), piece.at.end());
  }
  SortAndMakeUnique(taken_off.columns);
  taken_off.right_side = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(taken_off.columns.size()));
  for (Piece& piece : taken_off.pieces) {
    for (Eigen::Index& at : piece.at) at = PlaceOf(at, taken_off.columns);
    for (size_t i = 0; i < piece.at.size(); ++i) {
      taken_off.right_side[piece.at[i]] += piece.right_side[static_cast<Eigen::Index>(i)];
    }
  }
  return taken_off;
}

// Conjugate gradients with the covariance of the whole as a preconditioner, which is nearly the
// inverse of all but a few of its rows, at the columns that these touch: the others go along with
// them. Of a direction, what the whole makes of it is known: its inverse made it. So neither the
// whole nor what is left of it is ever multiplied by, or built.
Eigen::VectorXd NormalEquations::LeaveOutUpdate(const std::vector<Rows>& left_out) const {
  constexpr double kTolerance = 1e-6;
  const TakenOff taken_off = TakeOff(left_out);
  const Eigen::MatrixXd covariance = CovarianceAt(taken_off.columns);
  Eigen::VectorXd update = Eigen::VectorXd::Zero(covariance.cols());
  const double enough = kTolerance * kTolerance * taken_off.right_side.squaredNorm();
  Eigen::VectorXd residual = taken_off.right_side;
  Eigen::VectorXd direction = covariance * residual;
  Eigen::VectorXd whole_direction = residual;  // the whole times the direction
  double product = residual.dot(direction);
  for (Eigen::Index i = 0; i < covariance.cols() && residual.squaredNorm() > enough; ++i) {
    const Eigen::VectorXd rest = whole_direction - taken_off.Times(direction);
    const double curvature = direction.dot(rest);
    if (!(curvature > 0)) break;  // what is left determines no more
    const double step = product / curvature;
    update += step * direction;
    residual -= step * rest;
    const Eigen::VectorXd next = covariance * residual;
    const double next_product = residual.dot(next);
    const double share = next_product / product;
    direction = next + share * direction;
    whole_direction = residual + share * whole_direction;
    product = next_product;
  }
  // Everything else follows what pulls at these columns.
  const Eigen::VectorXd pull = taken_off.right_side + taken_off.Times(update);
  Eigen::VectorXd of_all = Eigen::VectorXd::Zero(NumKept());
  for (size_t i = 0; i < taken_off.columns.size(); ++i) {
    of_all += pull[static_cast<Eigen::Index>(i)] * covariance_.col(taken_off.columns[i]);
  }
  return of_all;
}

}  // namespace groundglass
