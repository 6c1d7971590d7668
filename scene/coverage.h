// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What no photograph shows of a face.
struct MissingCoverage {
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  // From where it could be photographed: nothing of the model stands between.
  std::optional<Eigen::Vector3d> stand_in_world;
};

// How much of one face the photographs show.
struct FaceCoverage {
  int face = -1;   // in the model, from 0
  int number = 0;  // in the model's file, from 1; 0: its place counts
  std::string name;
  double area = 0;  // model's unit, squared
  double covered_area = 0;
  long num_texels = 0;
  long num_covered_texels = 0;
  double texel_size = 0;  // model's unit
  struct Source {
    std::string photograph;
    long num_texels = 0;
    double footprint = 0;  // median size of the photograph's pixel on the face, model's unit
  };
  std::vector<Source> sources;  // most texels first
  // What no photograph shows, if it is more than a hundredth of the face.
  std::optional<MissingCoverage> missing;
};

struct Coverage {
  std::vector<FaceCoverage> faces;
  double CoveredShare() const {
    double area = 0;
    double covered = 0;
    for (const FaceCoverage& face : faces) {
      area += face.area;
      covered += face.covered_area;
    }
    return area > 0 ? covered / area : 0;
  }
};

// coverage.json (docs/coverage-json.md).
std::string FormatCoverage(const Coverage& coverage);
// Gives it back, its faces by number only. Nothing if there is no such file, or somebody else's.
std::optional<Coverage> ReadCoverage(const std::filesystem::path& file);

}  // namespace groundglass
