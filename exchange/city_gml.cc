// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/city_gml.h"

#include "exchange/geographic_systems.h"
#include "exchange/xml_reader.h"
#include "scene/degrees.h"
#include "scene/error.h"
#include "scene/mend_faces.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

struct GmlPolygon {
  std::vector<Ring> rings;  // the outer one first
  std::string name;
  int line = 0;
  int object = 0;  // which object of the city it is part of: a building, or a part of one
  int lod = -1;    // its level of detail; -1 if nothing says
};

// What the elements around a polygon say of it.
struct GmlContext {
  std::string name;
  int object = 0;
  int lod = -1;
  bool is_turned = false;  // within an <OrientableSurface orientation="-">
  // Of an <ImplicitGeometry>, a shape that is drawn once and set up here.
  Eigen::Matrix4d model_from_drawn = Eigen::Matrix4d::Identity();
};

// What has levels of detail of its own.
bool IsCityObject(const std::string& name) {
  return name == "cityObjectMember" || name == "Building" || name.ends_with("Part") ||
         name.ends_with("Installation");
}

class CityGmlReader {
 public:
  explicit CityGmlReader(const std::filesystem::path& file) : file_(file) {}

  std::vector<GmlPolygon> Read() {
    Visit(ReadXml(file_), {});
    return std::move(polygons_);
  }

  // Shapes that are drawn elsewhere, and so not read.
  int num_elsewhere() const { return num_elsewhere_; }
  // The system of coordinates that the file names last; empty if it names none.
  const std::string& coordinate_system() const { return coordinate_system_; }

 private:
  void AppendPoints(const XmlElement& element, Ring& ring) const {
    const std::vector<double> numbers = ReadXmlNumbers(file_, element, element.text);
    if (numbers.empty() || numbers.size() % 3 != 0) {
      throw Error(file_,
                  element.line,
                  "<" + element.name + "> has " + std::to_string(numbers.size()) +
                      " numbers, which are not points of three");
    }
    for (size_t i = 0; i < numbers.size(); i += 3) {
      ring.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
  }

  // A ring's points without the last, which is the first again.
  Ring ReadRing(const XmlElement& boundary) const {
    Ring ring;
    const XmlElement* linear_ring = boundary.Child("LinearRing");
    if (linear_ring == nullptr) {
      throw Error(file_, boundary.line, "<" + boundary.name + "> has no <LinearRing>");
    }
    for (const XmlElement& child : linear_ring->children) {
      if (child.name == "posList" || child.name == "pos") AppendPoints(child, ring);
      // As GML 2 has it: x,y,z x,y,z
      if (child.name == "coordinates") {
        XmlElement parted = child;
        std::replace(parted.text.begin(), parted.text.end(), ',', ' ');
        AppendPoints(parted, ring);
      }
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    return ring;
  }

  void AddPolygon(const XmlElement& element, const GmlContext& context) {
    GmlPolygon polygon;
    polygon.name = context.name;
    polygon.line = element.line;
    polygon.object = context.object;
    polygon.lod = context.lod;
    for (const XmlElement& child : element.children) {
      if (child.name == "exterior") polygon.rings.insert(polygon.rings.begin(), ReadRing(child));
      if (child.name == "interior") polygon.rings.push_back(ReadRing(child));
    }
    for (Ring& ring : polygon.rings) {
      for (Eigen::Vector3d& point : ring) {
        point = (context.model_from_drawn * point.homogeneous()).head<3>();
      }
      if (context.is_turned) std::reverse(ring.begin(), ring.end());
    }
    if (!polygon.rings.empty()) polygons_.push_back(std::move(polygon));
  }

  // A matrix by rows, then a place that is added.
  Eigen::Matrix4d ReadPlacement(const XmlElement& geometry) const {
    Eigen::Matrix4d model_from_drawn = Eigen::Matrix4d::Identity();
    if (const XmlElement* matrix = geometry.Child("transformationMatrix")) {
      const std::vector<double> numbers = ReadXmlNumbers(file_, *matrix, matrix->text);
      if (numbers.size() != 16) {
        throw Error(file_,
                    matrix->line,
                    "<transformationMatrix> has " + std::to_string(numbers.size()) +
                        " numbers; expected 16, by rows");
      }
      model_from_drawn =
          Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
    }
    const XmlElement* place = geometry.Child("referencePoint");
    const XmlElement* point = place ? place->Child("Point") : nullptr;
    if (const XmlElement* pos = point ? point->Child("pos") : nullptr) {
      Ring points;
      AppendPoints(*pos, points);
      model_from_drawn.topRightCorner<3, 1>() += points.front();
    }
    return model_from_drawn;
  }

  void Visit(const XmlElement& element, GmlContext context) {
    if (IsCityObject(element.name)) context.object = ++num_objects_;
    const std::string system = element.Attribute("srsName");
    if (!system.empty()) coordinate_system_ = system;
    if (element.name == "OrientableSurface" && element.Attribute("orientation") == "-") {
      context.is_turned = !context.is_turned;
    }
    if (element.name == "ImplicitGeometry") context.model_from_drawn = ReadPlacement(element);
    if (element.name == "libraryObject" ||
        (element.name == "relativeGMLGeometry" && element.children.empty())) {
      ++num_elsewhere_;
    }
    if (element.name.size() > 3 && element.name.starts_with("lod") && element.name[3] >= '0' &&
        element.name[3] <= '4') {
      context.lod = element.name[3] - '0';
    }
    const std::string name = element.ChildText("name");
    if (!name.empty()) {
      context.name = name;
    } else if (element.name.ends_with("Surface") && element.name.front() <= 'Z' &&
               element.name != "MultiSurface" && element.name != "CompositeSurface" &&
               element.name != "OrientableSurface" && element.name != "TriangulatedSurface") {
      context.name = element.name;  // "RoofSurface"
    }
    // Terrain is of triangles, which are written like polygons.
    if (element.name == "Polygon" || element.name == "Triangle" || element.name == "Rectangle") {
      AddPolygon(element, context);
      return;
    }
    for (const XmlElement& child : element.children) Visit(child, context);
  }

  const std::filesystem::path& file_;
  std::vector<GmlPolygon> polygons_;
  int num_objects_ = 0;
  int num_elsewhere_ = 0;
  std::string coordinate_system_;
};

// Of each object the finest level only: the others show it again.
size_t KeepFinest(std::vector<GmlPolygon>& polygons) {
  std::map<int, int> finest;
  for (const GmlPolygon& polygon : polygons) {
    const auto [place, is_new] = finest.emplace(polygon.object, polygon.lod);
    if (!is_new) place->second = std::max(place->second, polygon.lod);
  }
  return std::erase_if(
      polygons, [&](const GmlPolygon& polygon) { return polygon.lod < finest.at(polygon.object); });
}

void AddGmlFace(const GmlPolygon& polygon, PolygonModel& model) {
  Face face;
  face.name = polygon.name;
  for (const Ring& ring : polygon.rings) {
    const int first = static_cast<int>(model.points_in_world.size());
    for (size_t i = 0; i < ring.size(); ++i) {
      model.points_in_world.push_back(ring[i]);
      face.points.push_back(first + static_cast<int>(i));
    }
    // A hole is joined by a bridge from the outline's start and back (face_outline.h).
    if (polygon.rings.size() > 1 && !ring.empty()) face.points.push_back(first);
    if (&ring != &polygon.rings.front()) face.points.push_back(face.points.front());
  }
  // The last bridge leads to the start, where the outline begins again.
  if (polygon.rings.size() > 1) face.points.pop_back();
  model.faces.push_back(std::move(face));
}

// Points at exactly the same place become one.
void JoinPoints(PolygonModel& model) {
  std::map<std::array<double, 3>, int> place_of_point;
  std::vector<Eigen::Vector3d> joined;
  for (Face& face : model.faces) {
    for (int& corner : face.points) {
      const Eigen::Vector3d& point = model.points_in_world[corner];
      const auto [place, is_new] = place_of_point.try_emplace({point.x(), point.y(), point.z()},
                                                              static_cast<int>(joined.size()));
      if (is_new) joined.push_back(point);
      corner = place->second;
    }
  }
  model.points_in_world = std::move(joined);
}

// The state planes of the USA in survey feet, by their numbers in EPSG's register (NAD83, its HARN,
// NSRS2007 and 2011 versions), or by name.
bool IsInFeet(const std::string& coordinate_system) {
  const std::string lower = LowerCase(coordinate_system);
  if (lower.find("ftus") != std::string::npos || lower.find("foot") != std::string::npos) {
    return true;
  }
  const std::vector<int> codes = EpsgCodes(coordinate_system);
  return std::any_of(codes.begin(), codes.end(), [](int code) {
    return (code >= 2225 && code <= 2272) || (code >= 2276 && code <= 2280) ||
           (code >= 2283 && code <= 2289) || (code >= 3417 && code <= 3438) ||
           (code >= 3441 && code <= 3459);
  });
}

}  // namespace

ModelReading ReadCityGml(const std::filesystem::path& file) {
  CityGmlReader reader(file);
  std::vector<GmlPolygon> polygons = reader.Read();
  if (polygons.empty())
    throw Error(file, "holds no gml:Polygon, and so no face of a CityGML model");
  ModelReading reading;
  PolygonModel& model = reading.model;
  model.unit = LengthUnit::kMetre;
  if (IsGeographic(reader.coordinate_system())) {
    throw Error(
        file,
        reader.coordinate_system() +
            " counts in degrees of latitude and longitude, of which no model can be made; " +
            kProjectIt);
  }
  if (IsInFeet(reader.coordinate_system())) {
    model.unit = LengthUnit::kUsSurveyFoot;
    reading.warnings.push_back(
        Error(file,
              reader.coordinate_system() +
                  " counts in US survey feet: so is the model taken; its heights may be in metres")
            .what());
  }
  if (reader.num_elsewhere() > 0) {
    reading.warnings.push_back(
        Error(file,
              std::to_string(reader.num_elsewhere()) +
                  " shapes are left out that are drawn in another place or file (trees, lamps)")
            .what());
  }
  const size_t num_coarser = KeepFinest(polygons);
  if (num_coarser > 0) {
    reading.warnings.push_back(
        Error(file,
              std::to_string(num_coarser) +
                  " faces of coarser levels of detail are left out; the finest are read")
            .what());
  }
  std::vector<int> lines;
  for (const GmlPolygon& polygon : polygons) {
    AddGmlFace(polygon, model);
    lines.push_back(polygon.line);
  }
  JoinPoints(model);
  if (const Box bounds = ComputeBounds(model); SeemInDegrees(bounds)) {
    throw Error(file,
                "its coordinates are degrees of latitude and longitude, it seems, of which no "
                "model can be made: " +
                    DescribeDegrees(bounds) + "; " + kProjectIt);
  }
  std::vector<FaceTexture> no_textures;
  MendedFaces mended = MendFaces(file, lines, model, no_textures);
  WarnOfFaults(file, lines, mended);
  if (mended.usable.empty()) throw Error(mended.warnings.back());
  reading.warnings.insert(reading.warnings.end(), mended.warnings.begin(), mended.warnings.end());
  reading.left_out = KeepFaces(mended.usable, model, no_textures);
  return reading;
}

}  // namespace groundglass
