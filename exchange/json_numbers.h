// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <string>

namespace groundglass {

// Matrices as rows of numbers, as most formats have them.
template <typename Matrix>
nlohmann::ordered_json RowsJson(const Matrix& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int row = 0; row < matrix.rows(); ++row) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (int column = 0; column < matrix.cols(); ++column) {
      values.push_back(matrix(row, column) + 0.0);
    }
    rows.push_back(std::move(values));
  }
  return rows;
}

// Throws the JSON library's error where there are not as many.
template <int kRows, int kColumns>
Eigen::Matrix<double, kRows, kColumns> MatrixFromJson(const nlohmann::ordered_json& rows) {
  Eigen::Matrix<double, kRows, kColumns> matrix;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      matrix(row, column) =
          rows.at(static_cast<size_t>(row)).at(static_cast<size_t>(column)).template get<double>();
    }
  }
  return matrix;
}

inline std::string DumpJson(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace groundglass
