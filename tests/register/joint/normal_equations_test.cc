// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/normal_equations.h"

#include "scene/error.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

// a x + b y - c, for two scalar blocks.
class Line : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  Line(double a, double b, double c) : a_(a), b_(b), c_(c) {}
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    residuals[0] = a_ * parameters[0][0] + b_ * parameters[1][0] - c_;
    if (!jacobians) return true;
    if (jacobians[0]) jacobians[0][0] = a_;
    if (jacobians[1]) jacobians[1][0] = b_;
    return true;
  }

 private:
  double a_, b_, c_;
};

// What is kept (three numbers) less by what a side says, after two numbers that are eliminated.
class Sum : public ceres::CostFunction {
 public:
  Sum(Eigen::VectorXd eliminated, Eigen::Vector3d kept, double side)
      : eliminated_(std::move(eliminated)), kept_(std::move(kept)), side_(side) {
    set_num_residuals(1);
    if (eliminated_.size() > 0) mutable_parameter_block_sizes()->push_back(2);
    mutable_parameter_block_sizes()->push_back(3);
  }
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const size_t last = parameter_block_sizes().size() - 1;
    residuals[0] = kept_.dot(Eigen::Map<const Eigen::Vector3d>(parameters[last])) - side_;
    if (last > 0) {
      residuals[0] += eliminated_.dot(Eigen::Map<const Eigen::Vector2d>(parameters[0]));
    }
    if (!jacobians) return true;
    if (last > 0 && jacobians[0]) std::copy_n(eliminated_.data(), 2, jacobians[0]);
    if (jacobians[last]) std::copy_n(kept_.data(), 3, jacobians[last]);
    return true;
  }

 private:
  Eigen::VectorXd eliminated_;
  Eigen::Vector3d kept_;
  double side_;
};

// Two blocks of two numbers that are eliminated and one of three that is kept, with random costs;
// the parameters are the solution. Beside it, the same with all in one dense matrix.
struct Network {
  static constexpr int kNumCosts = 15;

  Network() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    jacobian.setZero();
    for (int i = 0; i < kNumCosts; ++i) {
      for (int k = 0; k < 2 && i % 3 < 2; ++k) jacobian(i, 2 * (i % 3) + k) = number(random);
      for (int k = 4; k < 7; ++k) jacobian(i, k) = number(random);
      sides[i] = number(random);
    }
    const Eigen::Matrix<double, 7, 1> solution = SolutionWithout({});
    first = solution.segment<2>(0);
    second = solution.segment<2>(2);
    kept = solution.segment<3>(4);
    for (int i = 0; i < kNumCosts; ++i) {
      const Eigen::Vector3d of_kept = jacobian.block<1, 3>(i, 4);
      if (i % 3 == 2) {
        costs.push_back(
            problem.AddResidualBlock(new Sum({}, of_kept, sides[i]), nullptr, kept.data()));
      } else {
        Eigen::Vector2d& block = i % 3 == 0 ? first : second;
        const Eigen::VectorXd of_block = jacobian.block<1, 2>(i, 2 * (i % 3)).transpose();
        costs.push_back(problem.AddResidualBlock(
            new Sum(of_block, of_kept, sides[i]), nullptr, block.data(), kept.data()));
      }
    }
  }

  Eigen::Matrix<double, 7, 1> SolutionWithout(const std::vector<int>& left_out) const {
    auto rows = jacobian;
    for (const int i : left_out) rows.row(i).setZero();
    return (rows.transpose() * rows).ldlt().solve(rows.transpose() * sides);
  }
  Eigen::Matrix<double, 7, 7> Covariance() const {
    return (jacobian.transpose() * jacobian).inverse();
  }
  NormalEquations Equations() { return {problem, {first.data(), second.data()}, {kept.data()}}; }
  std::vector<NormalEquations::Rows> RowsOf(const NormalEquations& equations,
                                            const std::vector<int>& numbers) const {
    std::vector<NormalEquations::Rows> rows;
    for (const int i : numbers) rows.push_back(equations.RowsOfCosts().at(costs[i]));
    return rows;
  }

  Eigen::Matrix<double, kNumCosts, 7> jacobian;
  Eigen::Matrix<double, kNumCosts, 1> sides;
  Eigen::Vector2d first, second;
  Eigen::Vector3d kept;
  ceres::Problem problem;
  std::vector<ceres::ResidualBlockId> costs;
};

TEST(NormalEquations, KnowWhatMovesTheSolutionAndHowFar) {
  double x = 0, y = 0;
  ceres::Problem problem;
  const auto first = problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  const auto second = problem.AddResidualBlock(new Line(1, 1, 3), nullptr, &x, &y);
  const NormalEquations equations(problem, {}, {&y, &x});
  EXPECT_EQ(equations.ColumnOf(&y), 0);
  EXPECT_EQ(equations.ColumnOf(&x), 1);
  EXPECT_EQ(equations.Residuals()[equations.RowsOfCosts().at(first).first], -4);
  // x = c1 / 2 and y = c2 - x: a residual less by 1 is a c greater by 1.
  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(2, 2);
  pushes(equations.RowsOfCosts().at(first).first, 0) = 1;
  pushes(equations.RowsOfCosts().at(second).first, 1) = 1;
  const Eigen::MatrixXd answer = equations.LinearResponse(pushes.sparseView());
  EXPECT_NEAR(answer(0, 0), -0.5, 1e-12);
  EXPECT_NEAR(answer(1, 0), 0.5, 1e-12);
  EXPECT_NEAR(answer(0, 1), 1, 1e-12);
  EXPECT_NEAR(answer(1, 1), 0, 1e-12);
  EXPECT_NEAR(equations.Covariance()(0, 0), 1.25, 1e-12);
  EXPECT_NEAR(equations.Covariance()(1, 1), 0.25, 1e-12);
  EXPECT_NEAR(equations.Covariance()(0, 1), -0.25, 1e-12);
}

TEST(NormalEquations, WhatIsEliminatedCountsAsBefore) {
  Network network;
  const NormalEquations equations = network.Equations();
  const Eigen::MatrixXd whole = network.Covariance();
  EXPECT_LT((equations.Covariance() - whole.bottomRightCorner(3, 3)).norm(), 1e-10);
  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(Network::kNumCosts, 2);
  pushes.col(0).setOnes();
  pushes.col(1) = network.sides;
  const Eigen::MatrixXd moved = whole * network.jacobian.transpose() * pushes;
  EXPECT_LT((equations.LinearResponse(pushes.sparseView()) - moved.bottomRows(3)).norm(), 1e-10);
}

TEST(NormalEquations, SumsOfWhatIsEliminatedAndKeptAreKnownAsWell) {
  Network network;
  const NormalEquations equations = network.Equations();
  Eigen::MatrixXd of_second(2, 2), of_kept(3, 2);
  of_second << 1, 2, 0, -1;
  of_kept << 0, 1, 3, 0, 0, 2;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(7, 2);
  sums.middleRows(2, 2) = of_second;
  sums.bottomRows(3) = of_kept;
  const Eigen::MatrixXd expected = sums.transpose() * network.Covariance() * sums;
  const Eigen::MatrixXd found = equations.CovarianceOfSums(
      {{network.second.data(), of_second}, {network.kept.data(), of_kept}});
  EXPECT_LT((found - expected).norm(), 1e-10);
}

TEST(NormalEquations, MoveWithoutIsWhatSolvingWithoutGives) {
  Network network;
  const NormalEquations equations = network.Equations();
  // Of one eliminated block, of both and of none.
  for (const std::vector<int>& left_out :
       std::vector<std::vector<int>>{{0, 3}, {2}, {1, 2, 5}, {0, 1, 2, 4}}) {
    const Eigen::VectorXd move = equations.LeaveOutUpdate(network.RowsOf(equations, left_out));
    const Eigen::Vector3d expected = network.SolutionWithout(left_out).tail<3>() - network.kept;
    EXPECT_GT(expected.norm(), 0.01);
    EXPECT_LT((move - expected).norm(), 1e-4 * expected.norm());
  }
}

TEST(NormalEquations, TheInformationOfPartsAddsUpToTheirs) {
  Network network;
  const NormalEquations equations = network.Equations();
  const std::vector<int> some = {0, 1, 2, 7, 9};
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(Network::kNumCosts, 7);
  for (const int i : some) rows.row(i) = network.jacobian.row(i);
  const Eigen::MatrixXd columns = network.Covariance().rightCols(3);
  const Eigen::MatrixXd expected = (rows * columns).transpose() * (rows * columns);
  const Eigen::MatrixXd information = equations.InformationOf(network.RowsOf(equations, some));
  EXPECT_LT((equations.Covariance() * information * equations.Covariance() - expected).norm(),
            1e-10);
  std::vector<int> all;
  for (int i = 0; i < Network::kNumCosts; ++i) all.push_back(i);
  const Eigen::MatrixXd whole = equations.InformationOf(network.RowsOf(equations, all));
  EXPECT_LT((equations.Covariance() * whole - Eigen::Matrix3d::Identity()).norm(), 1e-10);
}

TEST(NormalEquations, RefuseWhatIsNotDetermined) {
  double x = 0, y = 0;
  ceres::Problem problem;
  problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  EXPECT_THROW(NormalEquations(problem, {}, {&x, &y}), Error);
  EXPECT_THROW(NormalEquations(problem, {&y}, {&x}), Error);
  EXPECT_THROW(NormalEquations(problem, {&x}, {&y}), Error);
}

}  // namespace
}  // namespace groundglass
