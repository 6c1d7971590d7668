// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// Stations on the globe: KML 2.3 (OGC 12-007r2) and GeoJSON (RFC 7946).
#include "exchange/formats.h"
#include "exchange/geodetic.h"
#include "exchange/json_numbers.h"
#include "exchange/rules.h"
#include "exchange/xml_reader.h"
#include "scene/formats/xml_text.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// How far ahead a field of view is drawn, metres.
constexpr double kViewLengthM = 30;

// To a hundredth of a millimetre, which no one measures on the globe.
double Rounded(double value, double step) { return std::round(value / step) * step; }
std::string Degrees(double value) { return FormatNumber(Rounded(value, 1e-9)); }

// The station, and the level outline of what it sees from left to right, closed.
std::vector<GeodeticPlace> ViewOutline(const ExchangeScene& scene, const Camera& camera) {
  const FieldOfView view = FieldOfViewOf(camera);
  const Eigen::Vector3d forward = camera.ForwardInWorld();
  const double bearing = std::atan2(forward.x(), forward.y());
  const double length = kViewLengthM / MetresPerUnit(scene.unit);
  std::vector<GeodeticPlace> outline = {PlaceOnEarth(scene, camera.PositionInWorld())};
  for (const double side_deg : {view.left_deg, 0.0, view.right_deg}) {
    const double angle = bearing + RadiansFromDegrees(side_deg);
    outline.push_back(PlaceOnEarth(
        scene,
        camera.PositionInWorld() + length * Eigen::Vector3d(std::sin(angle), std::cos(angle), 0)));
  }
  outline.push_back(outline.front());
  return outline;
}

std::string KmlCoordinates(const std::vector<GeodeticPlace>& places) {
  std::string text;
  for (const GeodeticPlace& place : places) {
    text += (text.empty() ? "" : " ") + Degrees(place.longitude_deg) + "," +
            Degrees(place.latitude_deg) + "," + FormatNumber(Rounded(place.height_m, 1e-4));
  }
  return text;
}

std::string KmlTag(const char* name, const std::string& value) {
  return std::string("<") + name + ">" + value + "</" + name + ">";
}

// Google Earth's own picture in space, with unequal angles; other readers skip it.
std::string KmlPhotoOverlay(const ExchangeScene& scene,
                            const ExchangeCamera& each,
                            const std::filesystem::path& folder) {
  const Camera& camera = each.camera;
  const GeodeticPlace place = PlaceOnEarth(scene, camera.PositionInWorld());
  const FieldOfView view = FieldOfViewOf(camera);
  const Eigen::Vector3d forward = camera.ForwardInWorld();
  // How far the picture's right leans below level, seen from behind.
  const Eigen::Vector3d right = camera.cam_from_world.rotation.row(0);
  const Eigen::Vector3d level = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const double roll_deg =
      DegreesFromRadians(std::atan2(right.dot(level.cross(forward)), right.dot(level)));
  return "<PhotoOverlay>" + KmlTag("name", XmlEscaped(each.name)) + "<Camera>" +
         KmlTag("longitude", Degrees(place.longitude_deg)) +
         KmlTag("latitude", Degrees(place.latitude_deg)) +
         KmlTag("altitude", FormatNumber(Rounded(place.height_m, 1e-4))) +
         KmlTag("heading", Degrees(TrueBearingDeg(scene, forward))) +
         // From straight down: 90 is level.
         KmlTag("tilt", Degrees(90 + ElevationDeg(forward))) + KmlTag("roll", Degrees(roll_deg)) +
         KmlTag("altitudeMode", "absolute") + "</Camera>" + "<Icon>" +
         KmlTag("href", XmlEscaped(each.image_file.lexically_proximate(folder).generic_string())) +
         "</Icon><ViewVolume>" + KmlTag("leftFov", Degrees(view.left_deg)) +
         KmlTag("rightFov", Degrees(view.right_deg)) +
         KmlTag("bottomFov", Degrees(view.bottom_deg)) + KmlTag("topFov", Degrees(view.top_deg)) +
         KmlTag("near", "10") + "</ViewVolume>" + "<Point>" +
         KmlTag("coordinates", KmlCoordinates({place})) + "</Point></PhotoOverlay>\n";
}

std::string KmlPlacemarks(const ExchangeScene& scene, const ExchangeCamera& each) {
  const std::vector<GeodeticPlace> outline = ViewOutline(scene, each.camera);
  const std::string name = KmlTag("name", XmlEscaped(each.name));
  return "<Placemark>" + name + "<Point>" + KmlTag("altitudeMode", "absolute") +
         KmlTag("coordinates", KmlCoordinates({outline.front()})) + "</Point></Placemark>\n" +
         "<Placemark>" + name + "<styleUrl>#view</styleUrl><Polygon>" +
         KmlTag("altitudeMode", "absolute") + "<outerBoundaryIs><LinearRing>" +
         KmlTag("coordinates", KmlCoordinates(outline)) +
         "</LinearRing></outerBoundaryIs></Polygon></Placemark>\n";
}

nlohmann::ordered_json Position(const GeodeticPlace& place) {
  return {Rounded(place.longitude_deg, 1e-9),
          Rounded(place.latitude_deg, 1e-9),
          Rounded(place.height_m, 1e-4)};
}

nlohmann::ordered_json StationFeature(const ExchangeScene& scene, const ExchangeCamera& each) {
  const Camera& camera = each.camera;
  const FieldOfView view = FieldOfViewOf(camera);
  return {{"type", "Feature"},
          {"properties",
           {{"name", each.name},
            {"what", "station"},
            {"image", each.image_name},
            {"bearing_deg", TrueBearingDeg(scene, camera.ForwardInWorld())},
            {"elevation_deg", ElevationDeg(camera.ForwardInWorld())},
            {"left_deg", view.left_deg},
            {"right_deg", view.right_deg},
            {"bottom_deg", view.bottom_deg},
            {"top_deg", view.top_deg}}},
          {"geometry",
           {{"type", "Point"},
            {"coordinates", Position(PlaceOnEarth(scene, camera.PositionInWorld()))}}}};
}

nlohmann::ordered_json ViewFeature(const ExchangeScene& scene, const ExchangeCamera& each) {
  nlohmann::ordered_json ring = nlohmann::ordered_json::array();
  std::vector<GeodeticPlace> outline = ViewOutline(scene, each.camera);
  // Outer rings run counterclockwise.
  std::reverse(outline.begin(), outline.end());
  for (const GeodeticPlace& place : outline) ring.push_back(Position(place));
  return {
      {"type", "Feature"},
      {"properties", {{"name", each.name}, {"what", "field of view"}}},
      {"geometry", {{"type", "Polygon"}, {"coordinates", nlohmann::ordered_json::array({ring})}}}};
}

}  // namespace

std::vector<FileToWrite> FormatKml(const ExchangeScene& scene, const std::filesystem::path& out) {
  NeedGeoreference(scene, out);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document><name>Groundglass</name>\n"
      "<Style id=\"view\"><PolyStyle><color>4000a5ff</color></PolyStyle></Style>\n";
  for (const ExchangeCamera& camera : scene.cameras) text += KmlPlacemarks(scene, camera);
  for (const ExchangeCamera& camera : scene.cameras) {
    if (!camera.image_file.empty()) text += KmlPhotoOverlay(scene, camera, out.parent_path());
  }
  return {{out, text + "</Document>\n</kml>\n"}};
}

std::vector<FileToWrite> FormatGeoJson(const ExchangeScene& scene,
                                       const std::filesystem::path& out) {
  NeedGeoreference(scene, out);
  nlohmann::ordered_json features = nlohmann::ordered_json::array();
  for (const ExchangeCamera& camera : scene.cameras) {
    features.push_back(StationFeature(scene, camera));
    features.push_back(ViewFeature(scene, camera));
  }
  return {{out, DumpJson({{"type", "FeatureCollection"}, {"features", features}})}};
}

}  // namespace groundglass
