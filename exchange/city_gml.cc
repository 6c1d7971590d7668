// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/city_gml.h"

#include "exchange/xml_reader.h"
#include "scene/error.h"
#include "scene/mend_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace groundglass {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

struct GmlPolygon {
  std::vector<Ring> rings;  // the outer one first
  std::string name;
  int line = 0;
  int member = 0;  // which object of the city it is part of
  int lod = -1;    // its level of detail; -1 if nothing says
};

// What the elements around a polygon say of it.
struct GmlContext {
  std::string name;
  int member = 0;
  int lod = -1;
};

class CityGmlReader {
 public:
  explicit CityGmlReader(const std::filesystem::path& file) : file_(file) {}

  std::vector<GmlPolygon> Read() {
    Visit(ReadXml(file_), {});
    return std::move(polygons_);
  }

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
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    return ring;
  }

  void AddPolygon(const XmlElement& element, const GmlContext& context) {
    GmlPolygon polygon;
    polygon.name = context.name;
    polygon.line = element.line;
    polygon.member = context.member;
    polygon.lod = context.lod;
    for (const XmlElement& child : element.children) {
      if (child.name == "exterior") polygon.rings.insert(polygon.rings.begin(), ReadRing(child));
      if (child.name == "interior") polygon.rings.push_back(ReadRing(child));
    }
    if (!polygon.rings.empty()) polygons_.push_back(std::move(polygon));
  }

  void Visit(const XmlElement& element, GmlContext context) {
    if (element.name == "cityObjectMember") context.member = ++num_members_;
    if (element.name.size() > 3 && element.name.starts_with("lod") && element.name[3] >= '0' &&
        element.name[3] <= '4') {
      context.lod = element.name[3] - '0';
    }
    const std::string name = element.ChildText("name");
    if (!name.empty()) {
      context.name = name;
    } else if (element.name.ends_with("Surface") && !element.name.starts_with("lod") &&
               element.name != "MultiSurface" && element.name != "CompositeSurface") {
      context.name = element.name;  // "RoofSurface"
    }
    if (element.name == "Polygon") {
      AddPolygon(element, context);
      return;
    }
    for (const XmlElement& child : element.children) Visit(child, context);
  }

  const std::filesystem::path& file_;
  std::vector<GmlPolygon> polygons_;
  int num_members_ = 0;
};

// Of each object the finest level only: the others show it again.
size_t KeepFinest(std::vector<GmlPolygon>& polygons) {
  std::map<int, int> finest;
  for (const GmlPolygon& polygon : polygons) {
    const auto [place, is_new] = finest.emplace(polygon.member, polygon.lod);
    if (!is_new) place->second = std::max(place->second, polygon.lod);
  }
  return std::erase_if(
      polygons, [&](const GmlPolygon& polygon) { return polygon.lod < finest.at(polygon.member); });
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

}  // namespace

ModelReading ReadCityGml(const std::filesystem::path& file) {
  std::vector<GmlPolygon> polygons = CityGmlReader(file).Read();
  if (polygons.empty())
    throw Error(file, "holds no gml:Polygon, and so no face of a CityGML model");
  ModelReading reading;
  PolygonModel& model = reading.model;
  model.unit = LengthUnit::kMetre;
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
  std::vector<FaceTexture> no_textures;
  MendedFaces mended = MendFaces(file, lines, model, no_textures);
  WarnOfFaults(file, lines, mended);
  if (mended.usable.empty()) throw Error(mended.warnings.back());
  reading.warnings.insert(reading.warnings.end(), mended.warnings.begin(), mended.warnings.end());
  reading.left_out = KeepFaces(mended.usable, model, no_textures);
  return reading;
}

}  // namespace groundglass
