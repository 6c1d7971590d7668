// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// Metashape's cameras in XML: the frame camera of its manual, appendix C, whose tangential terms
// P1 and P2 are OpenCV's in the other order.
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "exchange/xml_reader.h"
#include "scene/error.h"
#include "scene/formats/xml_text.h"
#include "scene/text.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

std::string Tag(const char* name, double value) {
  return std::string("<") + name + ">" + FormatNumber(value + 0.0) + "</" + name + ">";
}

std::string MetashapeSensor(const ExchangeCamera& each, size_t id) {
  const Camera& camera = each.camera;
  const std::string size = "<resolution width=\"" + std::to_string(camera.width_px) +
                           "\" height=\"" + std::to_string(camera.height_px) + "\"/>";
  const Eigen::Vector2d center = CenterFromMiddle(camera);
  return "   <sensor id=\"" + std::to_string(id) + "\" label=\"" + XmlEscaped(each.name) +
         "\" type=\"frame\">" + size + "<calibration type=\"frame\" class=\"adjusted\">" + size +
         Tag("f", camera.focal_y_px) + Tag("cx", center.x()) + Tag("cy", center.y()) +
         Tag("b1", camera.focal_x_px - camera.focal_y_px) + Tag("k1", camera.k1) +
         Tag("k2", camera.k2) + Tag("k3", camera.k3) + Tag("p1", camera.p2) + Tag("p2", camera.p1) +
         "</calibration></sensor>\n";
}

std::string MetashapeCamera(const ExchangeCamera& each, size_t id) {
  const RigidTransform world_from_cam = Inverse(each.camera.cam_from_world);
  std::string transform;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      transform += FormatNumber(world_from_cam.rotation(row, column) + 0.0) + " ";
    }
    transform += FormatNumber(world_from_cam.translation[row] + 0.0) + " ";
  }
  return "   <camera id=\"" + std::to_string(id) + "\" sensor_id=\"" + std::to_string(id) +
         "\" label=\"" + XmlEscaped(each.image_name) + "\"><transform>" + transform +
         "0 0 0 1</transform></camera>\n";
}

double SensorNumber(const std::filesystem::path& file,
                    const XmlElement& calibration,
                    const char* name) {
  const XmlElement* child = calibration.Child(name);
  if (child == nullptr) return 0;
  const std::vector<double> numbers = ReadXmlNumbers(file, *child, child->text);
  if (numbers.size() != 1) throw Error(file, child->line, "expected one number");
  return numbers[0];
}

// A sensor's camera without a pose; the adjusted calibration where there is one.
Camera ReadSensor(const std::filesystem::path& file, const XmlElement& sensor) {
  const std::string type = sensor.Attribute("type");
  if (!type.empty() && type != "frame") {
    throw Error(file, sensor.line, "a sensor of type " + Quote(type) + "; expected frame");
  }
  const XmlElement* calibration = nullptr;
  for (const XmlElement& child : sensor.children) {
    if (child.name != "calibration") continue;
    if (calibration == nullptr || child.Attribute("class") == "adjusted") calibration = &child;
  }
  const XmlElement* size = sensor.Child("resolution");
  if (calibration == nullptr || size == nullptr) {
    throw Error(file, sensor.line, "<sensor> has no <calibration> or no <resolution>");
  }
  Camera camera;
  const auto side = [&](const char* name) {
    const std::vector<double> numbers = ReadXmlNumbers(file, *size, size->Attribute(name));
    if (numbers.size() != 1) {
      throw Error(file, size->line, "<resolution> has no " + std::string(name));
    }
    return numbers[0];
  };
  SetSize(side("width"), side("height"), camera);
  const auto number = [&](const char* name) { return SensorNumber(file, *calibration, name); };
  if (number("b2") != 0 || number("k4") != 0) {
    throw Error(file, calibration->line, "b2 and k4 are no part of our lens; fix them at 0");
  }
  camera.focal_y_px = number("f");
  camera.focal_x_px = number("f") + number("b1");
  SetCenterFromMiddle({number("cx"), number("cy")}, camera);
  camera.k1 = number("k1");
  camera.k2 = number("k2");
  camera.k3 = number("k3");
  camera.p1 = number("p2");
  camera.p2 = number("p1");
  return camera;
}

struct MetashapeParts {
  std::map<std::string, const XmlElement*> sensors;  // by id
  // With the chunk that each is part of; null if there is none.
  std::vector<std::pair<const XmlElement*, const XmlElement*>> cameras;
};
void CollectParts(const XmlElement& element, const XmlElement* chunk, MetashapeParts& parts) {
  if (element.name == "chunk") chunk = &element;
  if (element.name == "sensor") {
    parts.sensors[element.Attribute("id")] = &element;
    return;
  }
  // Without a transform it is not aligned.
  if (element.name == "camera" && element.Child("transform")) {
    parts.cameras.emplace_back(&element, chunk);
  }
  for (const XmlElement& child : element.children) CollectParts(child, chunk, parts);
}

// Where a chunk's or a component's own frame, in which its cameras are written, lies in the world:
// world = scale * rotation * point + translation.
struct ChunkPlacement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double scale = 1;
};

ChunkPlacement ReadPlacement(const std::filesystem::path& file, const XmlElement& transform) {
  const auto numbers = [&](const char* name, size_t count) -> std::vector<double> {
    const XmlElement* child = transform.Child(name);
    if (child == nullptr) return {};
    std::vector<double> values = ReadXmlNumbers(file, *child, child->text);
    if (values.size() == count) return values;
    throw Error(file,
                child->line,
                "<" + child->name + "> of the chunk's transform has " +
                    std::to_string(values.size()) + " numbers, not " + std::to_string(count));
  };
  ChunkPlacement placement;
  if (const auto rotation = numbers("rotation", 9); !rotation.empty()) {
    placement.rotation = NearestRotation(
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data()));
  }
  if (const auto translation = numbers("translation", 3); !translation.empty()) {
    placement.translation = Eigen::Map<const Eigen::Vector3d>(translation.data());
  }
  if (const auto scale = numbers("scale", 1); !scale.empty()) placement.scale = scale[0];
  if (!(placement.scale > 0 && std::isfinite(placement.scale))) {
    throw Error(file,
                transform.line,
                "the chunk's scale must be above 0, not " + FormatNumber(placement.scale));
  }
  return placement;
}

// The transform of the camera's component, else of its chunk; null if neither has one.
const XmlElement* FindPlacement(const XmlElement& camera, const XmlElement& chunk) {
  if (const XmlElement* components = chunk.Child("components")) {
    const std::string id = camera.Attribute("component_id");
    for (const XmlElement& component : components->children) {
      const bool is_its =
          id.empty() ? components->children.size() == 1 : component.Attribute("id") == id;
      if (component.name == "component" && is_its && component.Child("transform")) {
        return component.Child("transform");
      }
    }
  }
  return chunk.Child("transform");
}

// What is placed on the globe has its cameras about the Earth's centre, where the model is not.
void RefuseGlobe(const std::filesystem::path& file, const XmlElement& chunk) {
  const std::string reference = chunk.ChildText("reference");
  if (reference.empty() || reference.starts_with("LOCAL_CS")) return;
  const size_t start = reference.find('"');
  const size_t end = reference.find('"', start + 1);
  throw Error(
      file,
      chunk.line,
      "the chunk is placed on the globe" +
          (end == std::string::npos ? std::string()
                                    : " (" + reference.substr(start + 1, end - start - 1) + ")") +
          ", and its cameras about the Earth's centre; set its coordinate system to Local "
          "Coordinates (Reference, Settings) and export cameras and model anew");
}

// From the chunk's own frame into the world.
void PlaceInWorld(const std::filesystem::path& file,
                  const XmlElement& element,
                  const XmlElement* chunk,
                  RigidTransform& world_from_cam) {
  const XmlElement* transform = chunk ? FindPlacement(element, *chunk) : nullptr;
  if (transform == nullptr) return;
  constexpr double kFarthestModel = 1e6;  // nearer than that nothing lies about the Earth's centre
  const ChunkPlacement placement = ReadPlacement(file, *transform);
  if (placement.translation.norm() > kFarthestModel) RefuseGlobe(file, *chunk);
  world_from_cam.rotation = placement.rotation * world_from_cam.rotation;
  world_from_cam.translation =
      placement.scale * (placement.rotation * world_from_cam.translation) + placement.translation;
}

Camera ReadAlignedCamera(const std::filesystem::path& file,
                         const XmlElement& element,
                         const XmlElement* chunk,
                         const MetashapeParts& parts) {
  const auto sensor = parts.sensors.find(element.Attribute("sensor_id"));
  if (sensor == parts.sensors.end()) throw Error("<camera> names a sensor that is not there");
  Camera camera = ReadSensor(file, *sensor->second);
  const XmlElement& transform = *element.Child("transform");
  const std::vector<double> numbers = ReadXmlNumbers(file, transform, transform.text);
  if (numbers.size() != 16) throw Error("<transform> has not 16 numbers");
  RigidTransform world_from_cam;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      world_from_cam.rotation(row, column) = numbers[static_cast<size_t>(4 * row + column)];
    }
    world_from_cam.translation[row] = numbers[static_cast<size_t>(4 * row + 3)];
  }
  world_from_cam.rotation = NearestRotation(world_from_cam.rotation);
  PlaceInWorld(file, element, chunk, world_from_cam);
  camera.cam_from_world = Inverse(world_from_cam);
  return camera;
}

}  // namespace

std::vector<FileToWrite> FormatMetashape(const ExchangeScene& scene,
                                         const std::filesystem::path& out) {
  std::string sensors;
  std::string cameras;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    sensors += MetashapeSensor(scene.cameras[i], i);
    cameras += MetashapeCamera(scene.cameras[i], i);
  }
  return {{out,
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document version=\"1.2.0\">\n"
           " <chunk label=\"Groundglass\" enabled=\"true\">\n  <sensors>\n" +
               sensors + "  </sensors>\n  <cameras>\n" + cameras +
               "  </cameras>\n </chunk>\n</document>\n"}};
}

std::vector<ForeignCamera> ReadMetashape(const std::filesystem::path& file) {
  const XmlElement root = ReadXml(file);
  MetashapeParts parts;
  CollectParts(root, nullptr, parts);
  std::vector<ForeignCamera> cameras;
  for (const auto& [camera, of_chunk] : parts.cameras) {
    const XmlElement* element = camera;
    const XmlElement* chunk = of_chunk;
    cameras.push_back(
        ReadForeignCamera(file, element->Attribute("label"), XmlPlace(file, *element), [&] {
          return ReadAlignedCamera(file, *element, chunk, parts);
        }));
  }
  if (cameras.empty()) throw Error(file, "has no aligned <camera>; is it Metashape's?");
  return cameras;
}

}  // namespace groundglass
