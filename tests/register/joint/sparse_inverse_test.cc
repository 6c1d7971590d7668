// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/sparse_inverse.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

namespace groundglass {
namespace {

// A chain whose last link every other holds too, as a lens that all photographs share.
Eigen::SparseMatrix<double> ArrowChain(int size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.1, 1);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) matrix(i, i) = 3;
  for (int i = 0; i + 1 < size; ++i) {
    matrix(i, i + 1) = matrix(i + 1, i) = -number(random);
    matrix(i, size - 1) = matrix(size - 1, i) = 0.1 * number(random);
  }
  return matrix.sparseView();
}

TEST(InverseOfSparse, IsTheDenseOne) {
  for (const int size : {1, 15, 16, 17, 50}) {
    const Eigen::SparseMatrix<double> matrix = ArrowChain(size);
    const auto inverse = InverseOfSparse(matrix);
    ASSERT_TRUE(inverse);
    const Eigen::MatrixXd one = *inverse * Eigen::MatrixXd(matrix);
    EXPECT_LT((one - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-12) << size;
    EXPECT_EQ(*inverse, inverse->transpose());
  }
}

TEST(InverseOfSparse, IsTheSameWithOneThread) {
  const Eigen::SparseMatrix<double> matrix = ArrowChain(70);
  const auto with_all = InverseOfSparse(matrix);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(*with_all, *InverseOfSparse(matrix));
}

TEST(InverseOfSparse, IsNothingWhereThereIsNone) {
  Eigen::SparseMatrix<double> matrix = ArrowChain(5);
  matrix.coeffRef(2, 2) = -3;
  EXPECT_FALSE(InverseOfSparse(matrix));
  EXPECT_FALSE(InverseOfSparse(Eigen::SparseMatrix<double>(3, 3)));
}

}  // namespace
}  // namespace groundglass
