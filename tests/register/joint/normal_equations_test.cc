// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/normal_equations.h"

#include "scene/error.h"

#include <gtest/gtest.h>

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

TEST(NormalEquations, KnowWhatMovesTheSolutionAndHowFar) {
  double x = 0, y = 0;
  ceres::Problem problem;
  const auto first = problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  const auto second = problem.AddResidualBlock(new Line(1, 1, 3), nullptr, &x, &y);
  const NormalEquations equations(problem, {&y, &x});
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
  const Eigen::MatrixXd covariance = equations.CovarianceColumns(0, 2);
  EXPECT_NEAR(covariance(0, 0), 1.25, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.25, 1e-12);
  EXPECT_NEAR(covariance(0, 1), -0.25, 1e-12);
}

TEST(NormalEquations, MoveWithoutIsWhatSolvingWithoutGives) {
  const auto solved = [](bool with_third) {
    Eigen::Matrix<double, 4, 2> a;
    Eigen::Vector4d c;
    a << 2, 0, 1, 1, 1, -3, 0.5, 0.2;
    c << 4, 3, 2, 7;
    if (!with_third) {
      a.row(2).setZero();
      c[2] = 0;
    }
    return Eigen::Vector2d((a.transpose() * a).ldlt().solve(a.transpose() * c));
  };
  const Eigen::Vector2d solution = solved(true);
  double x = solution[0], y = solution[1];
  ceres::Problem problem;
  problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  problem.AddResidualBlock(new Line(1, 1, 3), nullptr, &x, &y);
  const auto third = problem.AddResidualBlock(new Line(1, -3, 2), nullptr, &x, &y);
  problem.AddResidualBlock(new Line(0.5, 0.2, 7), nullptr, &x, &y);
  const NormalEquations equations(problem, {&x, &y});
  const Eigen::VectorXd move = equations.LeaveOutUpdate({equations.RowsOfCosts().at(third)});
  const Eigen::Vector2d expected = solved(false) - solution;
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_NEAR(move[0], expected[0], 1e-5);
  EXPECT_NEAR(move[1], expected[1], 1e-5);
}

TEST(NormalEquations, TheInformationOfPartsAddsUpToTheirs) {
  double x = 0, y = 0;
  ceres::Problem problem;
  const auto first = problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  const auto second = problem.AddResidualBlock(new Line(1, 1, 3), nullptr, &x, &y);
  const NormalEquations equations(problem, {&x, &y});
  const auto& rows = equations.RowsOfCosts();
  const Eigen::MatrixXd of_first = equations.InformationOf({rows.at(first)});
  EXPECT_EQ(of_first, Eigen::MatrixXd(Eigen::Vector2d(4, 0).asDiagonal()));
  const Eigen::MatrixXd of_both = equations.InformationOf({rows.at(first), rows.at(second)});
  EXPECT_LT((of_both * equations.CovarianceColumns(0, 2) - Eigen::MatrixXd::Identity(2, 2)).norm(),
            1e-12);
}

TEST(NormalEquations, RefuseWhatIsNotDetermined) {
  double x = 0, y = 0;
  ceres::Problem problem;
  problem.AddResidualBlock(new Line(2, 0, 4), nullptr, &x, &y);
  EXPECT_THROW(NormalEquations(problem, {&x, &y}), Error);
}

}  // namespace
}  // namespace groundglass
