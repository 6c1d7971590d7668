// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tags_csv.h"

#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/tag_columns.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"
#include "scene/frames.h"
#include "scene/nearest_word.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// All columns that are read.
std::vector<std::string> KnownColumns() {
  std::vector<std::string> columns = {"image"};
  columns.insert(columns.end(), kTagKeyNames.begin(), kTagKeyNames.end());
  for (const char* other : {"yaw", "pitch", "lat", "lon", "height", "camera"}) {
    columns.push_back(other);
  }
  for (const SigmaKey& key : kSigmaKeys) columns.emplace_back(key.name);
  return columns;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Earth-centred coordinates in metres (WGS 84). Ours, since these six lines are exact, and all that
// is asked of geodesy here, so that no library need be there for it: GeographicLib's local frame is
// the same to 1e-8 m (tests/calibrate/geoid_test.cc), and PROJ brings a database of datums.
Eigen::Vector3d EarthCentred(double latitude_deg, double longitude_deg, double height_m) {
  constexpr double kSemiMajor = 6378137.0;
  constexpr double kFlattening = 1 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double latitude = RadiansFromDegrees(latitude_deg);
  const double longitude = RadiansFromDegrees(longitude_deg);
  const double sin_latitude = std::sin(latitude);
  const double curvature = kSemiMajor / std::sqrt(1 - kEccentricity2 * sin_latitude * sin_latitude);
  return {(curvature + height_m) * std::cos(latitude) * std::cos(longitude),
          (curvature + height_m) * std::cos(latitude) * std::sin(longitude),
          (curvature * (1 - kEccentricity2) + height_m) * sin_latitude};
}

// Reads the rows one by one, each by way of the view file that says the same.
class TableReader {
 public:
  TableReader(const std::filesystem::path& file, const PolygonModel& model)
      : file_(file), model_(model), center_in_site_(SiteFromWorld(ComputeBounds(model).Center())) {}

  TagTable Read() {
    std::vector<std::string> faults;
    const CsvTable csv(file_, &faults);
    table_.warnings = csv.warnings();
    if (csv.header().empty()) {
      table_.faults.push_back(Error(file_, "no header; expected image,x,y,z,i,j,k,a,v").what());
    } else if (ReadHeader(csv.header_line(), csv.header())) {
      table_.faults = std::move(faults);
      for (const CsvRow& row : csv.rows()) ReadRow(csv, row);
    }
    table_.has_angles = has_angles_;
    return std::move(table_);
  }

 private:
  void Fail(int line, const std::string& message) {
    table_.faults.push_back(Error(file_, line, message).what());
  }

  bool Has(const std::string& column) const { return columns_.count(column) > 0; }
  bool HasField(const std::vector<std::string>& fields, const std::string& column) const {
    return Has(column) && !fields[columns_.at(column)].empty();
  }

  // The columns that a table has to have.
  static std::vector<std::string> RequiredColumns(bool has_angles, bool is_geodetic) {
    std::vector<std::string> required = {"image", "a", "v"};
    const auto add = [&](std::initializer_list<const char*> columns) {
      required.insert(required.end(), columns.begin(), columns.end());
    };
    if (has_angles) {
      add({"yaw", "pitch"});
    } else {
      add({"i", "j", "k"});
    }
    if (is_geodetic) {
      add({"lat", "lon", "height"});
    } else {
      add({"x", "y", "z"});
    }
    return required;
  }

  // A remark of a spreadsheet's own spoils nothing; a known column that is mistyped would be
  // missed.
  void TellUnknownColumn(int line,
                         size_t column,
                         const std::vector<std::string>& names,
                         const std::vector<std::string>& known) {
    const std::string& name = names[column];
    std::vector<std::string> absent = known;
    std::erase_if(absent, [&](const std::string& one) {
      return std::find(names.begin(), names.end(), one) != names.end();
    });
    if (const std::string advice = AdviceOnColumn(name, absent); !advice.empty()) {
      // A compass's bearing beside look-at points may be a remark.
      const auto has_any = [&](std::initializer_list<const char*> columns) {
        return std::any_of(columns.begin(), columns.end(), [&](const char* one) {
          return std::find(names.begin(), names.end(), one) != names.end();
        });
      };
      std::vector<std::string> needed =
          RequiredColumns(!has_any({"i", "j", "k"}), has_any({"lat", "lon"}));
      std::erase_if(needed, [&](const std::string& one) {
        return std::find(absent.begin(), absent.end(), one) == absent.end();
      });
      if (!AdviceOnColumn(name, needed).empty()) {
        Fail(line, "unknown column " + Quote(name) + "; " + advice);
      } else {
        table_.warnings.push_back(Error(file_,
                                        line,
                                        "unknown column " + Quote(name) +
                                            " is not read; if it is what is meant, " + advice)
                                      .what());
      }
      return;
    }
    // One letter is near to every other.
    if (const auto meant = name.size() < 2 ? std::nullopt : FindNearest(name, absent)) {
      Fail(line, "unknown column " + Quote(name) + "; did you mean " + Quote(*meant) + "?");
      return;
    }
    const std::string what = name.empty()
                                 ? "column " + std::to_string(column + 1) + " has no name and"
                                 : "unknown column " + Quote(name);
    table_.warnings.push_back(
        Error(file_, line, what + " is not read; the columns are " + Joined(known)).what());
  }

  bool ReadHeader(int line, const std::vector<std::string>& names) {
    const size_t faults_before = table_.faults.size();
    const std::vector<std::string> known = KnownColumns();
    const auto num_known = std::count_if(names.begin(), names.end(), [&](const auto& name) {
      return std::find(known.begin(), known.end(), name) != known.end() ||
             !AdviceOnColumn(name, known).empty();
    });
    // One may be a word of a title.
    if (num_known < 2) {
      Fail(line,
           "expected the first line to name the columns, parted by commas, semicolons or tabs: "
           "image,x,y,z,i,j,k,a,v; it begins with " +
               Quote(names.front()) + (names.size() > 1 ? " and " + Quote(names[1]) : ""));
      return false;
    }
    for (size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        TellUnknownColumn(line, i, names, known);
      } else if (!columns_.emplace(name, i).second) {
        Fail(line, "column " + Quote(name) + " is repeated");
      }
    }
    has_angles_ = Has("yaw") || Has("pitch");
    is_geodetic_ = Has("lat") || Has("lon");
    if (Has("height") && !is_geodetic_) {
      table_.warnings.push_back(
          Error(file_, line, "column 'height' is not read without lat and lon").what());
    }
    for (const std::string& name : RequiredColumns(has_angles_, is_geodetic_)) {
      if (!Has(name)) Fail(line, "column " + Quote(name) + " is missing");
    }
    const auto refuse = [&](std::initializer_list<const char*> refused, const char* other) {
      for (const char* name : refused) {
        if (Has(name)) Fail(line, "column " + Quote(name) + " says the same as " + other);
      }
    };
    if (has_angles_) refuse({"i", "j", "k"}, "yaw,pitch");
    if (is_geodetic_) {
      refuse({"x", "y", "z"}, "lat,lon,height");
      if (!model_.georeference) {
        Fail(line,
             "lat,lon,height need a model that says where it stands; expected a comment "
             "'% origin: LATITUDE LONGITUDE HEIGHT' in it");
      }
    }
    return table_.faults.size() == faults_before;
  }

  void ReadRow(const CsvTable& csv, const CsvRow& csv_row) {
    const std::vector<std::string>& fields = csv_row.fields;
    const size_t image_column = columns_.at("image");
    const std::string image = image_column < fields.size() ? fields[image_column] : "";
    TagRow row;
    row.line = csv_row.line;
    std::vector<std::string> faults;
    const auto fail = [&](const std::string& message) {
      faults.push_back(
          Error(file_, csv_row.line, (image.empty() ? "" : row.name + ": ") + message).what());
    };
    const bool has_digit = std::any_of(fields.begin(), fields.end(), [](const std::string& field) {
      return field.find_first_of("0123456789") != std::string::npos;
    });
    if (image.empty() && csv_row.fault.empty() && !has_digit) {
      table_.warnings.push_back(
          Error(file_, csv_row.line, "left out: it names no photograph and gives no number")
              .what());
      return;
    }
    if (image.empty()) {
      row.name = file_.filename().string() + ":" + std::to_string(csv_row.line);
      fail("column 'image' is empty");
    } else {
      // "s5.jpg" and "s5" both name s5; so does "images/s5.jpg".
      row.name = ImageStem(image);
      if (!csv_row.fault.empty()) {
        fail(csv_row.fault);
      } else if (const auto [first, is_new] = line_of_.emplace(row.name, row.line); !is_new) {
        fail("has a row already, on line " + std::to_string(first->second) +
             "; keep one of the two");
      } else {
        ReadTag(csv, fields, row, fail);
      }
    }
    if (faults.empty()) {
      table_.rows.push_back(std::move(row));
      return;
    }
    for (const std::string& fault : faults) {
      table_.row_faults.push_back({row.name, row.line, fault});
    }
  }

  // The tag that a row's fields give, or what is wrong with it.
  template <typename Fail>
  void ReadTag(const CsvTable& csv,
               const std::vector<std::string>& fields,
               TagRow& row,
               const Fail& fail) {
    const bool has_numbers = std::any_of(columns_.begin(), columns_.end(), [&](const auto& column) {
      return column.first != "image" && column.first != "camera" && !fields[column.second].empty();
    });
    if (!has_numbers) {
      row.text = "";
      return;
    }
    bool is_sound = true;
    const auto number = [&](const std::string& column) {
      const std::string& field = fields[columns_.at(column)];
      std::string why_not;
      const std::optional<double> value = csv.Number(field, &why_not);
      if (value && std::isfinite(*value)) return *value;
      fail("key " + Quote(column) + ": " +
           (why_not.empty() ? WhyNoNumber(field, csv.decimal_mark() == ',' ? ',' : '.')
                            : Quote(field) + " " + why_not));
      is_sound = false;
      return 0.0;
    };
    std::string view_text;
    for (const auto& [column, index] : columns_) {
      if (column == "image" || column == "yaw" || column == "pitch" || column == "lat" ||
          column == "lon" || column == "height" || fields[index].empty()) {
        continue;
      }
      view_text +=
          column + " " + (column == "camera" ? fields[index] : FormatNumber(number(column))) + " ";
    }
    if (!is_sound) return;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    if (is_geodetic_) {
      position = SiteFromGeodetic(model_, number("lat"), number("lon"), number("height"));
      view_text += FormatPoint("x", "y", "z", position);
    } else if (has_angles_) {
      position = {number("x"), number("y"), number("z")};
    }
    if (has_angles_) {
      const double yaw = RadiansFromDegrees(number("yaw"));
      const double pitch = RadiansFromDegrees(number("pitch"));
      const Eigen::Vector3d axis(
          std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch));
      const double distance = std::max(1.0, (center_in_site_ - position).norm());
      view_text += FormatPoint("i", "j", "k", position + distance * axis);
    }
    if (!is_sound) return;
    const bool is_whole = HasField(fields, "a") && HasField(fields, "v");
    // The view file's own checks; its line 1 is this row.
    const std::vector<std::string> faults =
        is_whole ? FindViewFaults(view_text, "") : ReadSomePairs(view_text, "").faults;
    for (const std::string& fault : faults) {
      const size_t colon = fault.find(": ");
      fail(fault.substr(colon + 2));
      is_sound = false;
    }
    if (!is_sound) return;
    if (is_whole) {
      row.tag = ParseView(view_text, file_);
    } else {
      row.text = view_text;
    }
  }

  static std::string FormatPoint(const char* x,
                                 const char* y,
                                 const char* z,
                                 const Eigen::Vector3d& point) {
    return std::string(x) + " " + FormatNumber(point.x()) + " " + y + " " +
           FormatNumber(point.y()) + " " + z + " " + FormatNumber(point.z()) + " ";
  }

  std::filesystem::path file_;
  const PolygonModel& model_;
  Eigen::Vector3d center_in_site_;
  std::map<std::string, size_t> columns_;
  std::map<std::string, int> line_of_;  // the rows' names
  bool has_angles_ = false;
  bool is_geodetic_ = false;
  TagTable table_;
};

}  // namespace

Eigen::Vector3d SiteFromGeodetic(const PolygonModel& model,
                                 double latitude_deg,
                                 double longitude_deg,
                                 double height_m) {
  const Georeference& place = *model.georeference;
  const Eigen::Vector3d offset =
      EarthCentred(latitude_deg, longitude_deg, height_m) -
      EarthCentred(place.latitude_deg, place.longitude_deg, place.height_m);
  const double latitude = RadiansFromDegrees(place.latitude_deg);
  const double longitude = RadiansFromDegrees(place.longitude_deg);
  const Eigen::Vector3d east_axis(-std::sin(longitude), std::cos(longitude), 0);
  const Eigen::Vector3d up_axis(std::cos(latitude) * std::cos(longitude),
                                std::cos(latitude) * std::sin(longitude),
                                std::sin(latitude));
  const double east = east_axis.dot(offset);
  const double north = up_axis.cross(east_axis).dot(offset);
  // The model's +Y in `world` points along this bearing, clockwise from true north.
  const double bearing = RadiansFromDegrees(place.north_deg);
  const Eigen::Vector3d in_world(east * std::cos(bearing) - north * std::sin(bearing),
                                 east * std::sin(bearing) + north * std::cos(bearing),
                                 up_axis.dot(offset));
  return SiteFromWorld(in_world / MetresPerUnit(model.unit));
}

TagTable ReadTagTable(const std::filesystem::path& file, const PolygonModel& model) {
  return TableReader(file, model).Read();
}

}  // namespace groundglass
