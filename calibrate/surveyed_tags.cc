// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/surveyed_tags.h"

#include "calibrate/april_tag_detection.h"
#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

namespace groundglass {
namespace {

constexpr double kSurveySigma_m = 0.01;
constexpr const char* kExpectedColumns =
    "expected the columns id,x,y,z,nx,ny,nz,size, or id and x1,y1,z1 to x4,y4,z4, and sigma if it "
    "is known";
// A tag's corners lie this near to a square's, as a share of its side.
constexpr double kSquareShare = 0.03;

// Where the square's corners lie from its middle, in halves of its side: right and down.
constexpr std::array<std::array<double, 2>, 4> kCornerPlaces = {
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

class SurveyReader {
 public:
  SurveyReader(const std::filesystem::path& file, LengthUnit unit)
      : file_(file),
        csv_(Present(file), &faults_),
        default_sigma_(kSurveySigma_m / MetresPerUnit(unit)) {
    if (csv_.header().empty()) throw Error(file_, std::string("it is empty; ") + kExpectedColumns);
    const std::vector<std::string>& names = csv_.header();
    for (size_t i = 0; i < names.size(); ++i) {
      if (!IsColumn(names[i])) {
        throw Error(file_, csv_.header_line(), "unknown column " + Quote(names[i]));
      }
      columns_[names[i]] = i;
    }
    has_corners_ = columns_.count("x1") > 0;
    Require({"id"});
    if (has_corners_) {
      Require({"x1", "y1", "z1", "x2", "y2", "z2", "x3", "y3", "z3", "x4", "y4", "z4"});
    } else {
      Require({"x", "y", "z", "nx", "ny", "nz", "size"});
    }
  }

  std::vector<SurveyedTag> Read() {
    std::vector<SurveyedTag> tags;
    for (const CsvRow& row : csv_.rows()) {
      row_ = &row;
      try {
        if (!row.fault.empty()) Fail(row.fault);
        tags.push_back(ReadRow());
      } catch (const Error& error) {
        faults_.push_back(error.what());
      }
    }
    if (!faults_.empty()) throw Error(fmt::format("{}", fmt::join(faults_, "\n")));
    if (tags.empty()) throw Error(file_, std::string("there is no tag in it; ") + kExpectedColumns);
    return tags;
  }

 private:
  static const std::filesystem::path& Present(const std::filesystem::path& file) {
    if (std::filesystem::exists(file)) return file;
    throw Error(file,
                std::string("no such file: the tags' survey is needed, a table with a line for "
                            "each tag (or give --tags FILE); ") +
                    kExpectedColumns);
  }

  static bool IsColumn(const std::string& name) {
    constexpr std::array<const char*, 9> kNames = {
        "id", "x", "y", "z", "nx", "ny", "nz", "size", "sigma"};
    if (std::find(kNames.begin(), kNames.end(), name) != kNames.end()) return true;
    return name.size() == 2 && name[0] >= 'x' && name[0] <= 'z' && name[1] >= '1' && name[1] <= '4';
  }

  SurveyedTag ReadRow() {
    SurveyedTag tag;
    tag.id = ReadId();
    if (lines_of_id_.count(tag.id) > 0) {
      Fail("tag " + std::to_string(tag.id) + " stands on line " +
           std::to_string(lines_of_id_[tag.id]) + " already");
    }
    lines_of_id_[tag.id] = row_->line;
    tag.corners_in_world = has_corners_ ? ReadCorners() : CornersFromMiddle();
    tag.sigma = HasField("sigma") ? Number("sigma") : default_sigma_;
    if (!(tag.sigma > 0)) Fail("sigma: a standard deviation must be above 0");
    return tag;
  }

  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(file_, row_->line, message);
  }

  void Require(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (columns_.count(name) > 0) continue;
      throw Error(
          file_, csv_.header_line(), "column " + Quote(name) + " is missing; " + kExpectedColumns);
    }
  }

  bool HasField(const std::string& column) const {
    return columns_.count(column) > 0 && !row_->fields[columns_.at(column)].empty();
  }

  double Number(const std::string& column) const {
    const std::string& field = row_->fields[columns_.at(column)];
    std::string why_not;
    const std::optional<double> value = csv_.Number(field, &why_not);
    if (value && std::isfinite(*value)) return *value;
    Fail(column + ": " + Quote(field) + " " + (why_not.empty() ? "is not a number" : why_not));
  }

  int ReadId() const {
    const double id = Number("id");
    if (id != std::floor(id) || id < 0 || id >= kNumAprilTagIds) {
      Fail("id must be a whole number from 0 to " + std::to_string(kNumAprilTagIds - 1));
    }
    return static_cast<int>(id);
  }

  Eigen::Vector3d PointInWorld(const std::array<std::string, 3>& columns) const {
    return WorldFromSite({Number(columns[0]), Number(columns[1]), Number(columns[2])});
  }

  Eigen::Matrix<double, 3, 4> ReadCorners() const {
    Eigen::Matrix<double, 3, 4> corners;
    for (int i = 0; i < 4; ++i) {
      const std::string number = std::to_string(i + 1);
      corners.col(i) = PointInWorld({"x" + number, "y" + number, "z" + number});
    }
    // Opposite sides of a square are the same vector, neighbouring ones as long and at right
    // angles.
    const Eigen::Vector3d right = corners.col(1) - corners.col(0);
    const Eigen::Vector3d down = corners.col(3) - corners.col(0);
    const double side = right.norm();
    const double misfit = std::max({(corners.col(2) - corners.col(3) - right).norm(),
                                    std::abs(down.norm() - side),
                                    std::abs(right.dot(down)) / std::max(side, 1e-12)});
    if (!(side > 0) || misfit > kSquareShare * side) {
      Fail(
          "these four corners make no square; they go top left, top right, bottom right, bottom "
          "left as the tag is looked at");
    }
    return corners;
  }

  Eigen::Matrix<double, 3, 4> CornersFromMiddle() const {
    const Eigen::Vector3d normal = PointInWorld({"nx", "ny", "nz"});
    if (!(normal.norm() > 0)) Fail("the normal nx,ny,nz is 0");
    const double size = Number("size");
    if (!(size > 0)) Fail("size must be above 0");
    const Eigen::Vector3d out = normal.normalized();
    if (std::abs(out.z()) > 0.99) {
      Fail("a tag that lies flat has no upright; give its corners x1,y1,z1 to x4,y4,z4");
    }
    // As one who looks at it sees it.
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(out).normalized();
    const Eigen::Vector3d down = right.cross(out).normalized();
    const Eigen::Vector3d middle = PointInWorld({"x", "y", "z"});
    Eigen::Matrix<double, 3, 4> corners;
    for (int i = 0; i < 4; ++i) {
      const auto& [across, below] = kCornerPlaces[static_cast<size_t>(i)];
      corners.col(i) = middle + size / 2 * (across * right + below * down);
    }
    return corners;
  }

  std::filesystem::path file_;
  std::vector<std::string> faults_;
  CsvTable csv_;
  double default_sigma_;
  std::map<std::string, size_t> columns_;
  bool has_corners_ = false;
  std::map<int, int> lines_of_id_;
  const CsvRow* row_ = nullptr;
};

}  // namespace

std::vector<SurveyedTag> ReadSurveyedTags(const std::filesystem::path& file, LengthUnit unit) {
  return SurveyReader(file, unit).Read();
}

}  // namespace groundglass
