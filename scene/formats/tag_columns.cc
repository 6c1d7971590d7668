// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tag_columns.h"

#include "scene/text.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace groundglass {
namespace {

// Names that people give to columns, and what is to stand there in their place.
struct OtherColumn {
  std::string_view name;
  std::string_view column;
  std::string_view remark;
};

constexpr std::string_view kToTheNorth = ", with the other sign: y counts to the south";
constexpr std::string_view kOfFocalLength =
    ", the view angle in degrees: before 35 mm film 2 atan(18 / f)";

constexpr std::array<OtherColumn, 40> kOtherColumns = {{{"photo", "image", ""},
                                                        {"photograph", "image", ""},
                                                        {"picture", "image", ""},
                                                        {"slide", "image", ""},
                                                        {"file", "image", ""},
                                                        {"filename", "image", ""},
                                                        {"name", "image", ""},
                                                        {"label", "image", ""},
                                                        {"foto", "image", ""},
                                                        {"bild", "image", ""},
                                                        {"e", "x", ""},
                                                        {"east", "x", ""},
                                                        {"easting", "x", ""},
                                                        {"rechtswert", "x", ""},
                                                        {"s", "y", ""},
                                                        {"south", "y", ""},
                                                        {"n", "y", kToTheNorth},
                                                        {"north", "y", kToTheNorth},
                                                        {"northing", "y", kToTheNorth},
                                                        {"hochwert", "y", kToTheNorth},
                                                        {"h", "z", ""},
                                                        {"up", "z", ""},
                                                        {"alt", "z", ""},
                                                        {"altitude", "z", ""},
                                                        {"elevation", "z", ""},
                                                        {"aspect", "a", ", width / height"},
                                                        {"ratio", "a", ", width / height"},
                                                        {"fov", "v", ", in degrees"},
                                                        {"hfov", "v", ", in degrees"},
                                                        {"angle", "v", ", in degrees"},
                                                        {"view angle", "v", ", in degrees"},
                                                        {"bildwinkel", "v", ", in degrees"},
                                                        {"f", "v", kOfFocalLength},
                                                        {"f35", "v", kOfFocalLength},
                                                        {"focal", "v", kOfFocalLength},
                                                        {"focal length", "v", kOfFocalLength},
                                                        {"brennweite", "v", kOfFocalLength},
                                                        {"heading", "yaw", ""},
                                                        {"azimuth", "yaw", ""},
                                                        {"tilt", "pitch", ""}}};

// "x (m)" and "x [ft]" without the unit; others as they are.
std::string WithoutUnit(const std::string& name) {
  const size_t open = name.find_first_of("([");
  if (open == std::string::npos || open == 0) return name;
  return std::string(TrimBlanks(name.substr(0, open)));
}

}  // namespace

std::string AdviceOnColumn(const std::string& name, const std::vector<std::string>& absent) {
  const auto is_absent = [&](std::string_view column) {
    return std::find(absent.begin(), absent.end(), column) != absent.end();
  };
  const std::string plain = WithoutUnit(name);
  if (plain != name && is_absent(plain)) {
    return "write " + Quote(plain) +
           " alone; the unit is the model's, which its file says (% unit: m), or --unit";
  }
  const auto other = std::find_if(kOtherColumns.begin(),
                                  kOtherColumns.end(),
                                  [&](const OtherColumn& one) { return one.name == plain; });
  if (other == kOtherColumns.end() || !is_absent(other->column)) return "";
  return "call it " + Quote(other->column) + std::string(other->remark);
}

}  // namespace groundglass
