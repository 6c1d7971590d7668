// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// XMP (ISO 16684-1) beside a picture: what EXIF says of place and direction, and RealityCapture's
// camera ("RealityCapture XMP Camera Math").
#include "exchange/formats.h"
#include "exchange/geodetic.h"
#include "exchange/rules.h"
#include "exchange/xml_reader.h"
#include "scene/error.h"
#include "scene/text.h"

#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

std::string XmpPacket(const std::string& name_spaces,
                      const std::string& attributes,
                      const std::string& elements) {
  return "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
         "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
         " <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
         "  <rdf:Description rdf:about=\"\" " +
         name_spaces + attributes + ">\n" + elements +
         "  </rdf:Description>\n </rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>\n";
}

std::string XmpAttribute(const std::string& name, const std::string& value) {
  return "\n    " + name + "=\"" + value + "\"";
}

// "48,51.50400N": XMP's way to write degrees.
std::string XmpDegrees(double value, char positive, char negative) {
  const double magnitude = std::abs(value);
  const double degrees = std::floor(magnitude);
  char text[48];
  std::snprintf(text,
                sizeof text,
                "%.0f,%.7f%c",
                degrees,
                60 * (magnitude - degrees),
                value < 0 ? negative : positive);
  return text;
}

std::string Rational(double value, int denominator) {
  return std::to_string(std::llround(value * denominator)) + "/" + std::to_string(denominator);
}

// 36 mm are the frame's width.
double Focal35mm(const Camera& camera) { return 36 * camera.focal_x_px / camera.width_px; }

std::string SidecarText(const ExchangeScene& scene, const ExchangeCamera& each) {
  const Camera& camera = each.camera;
  const bool has_place = scene.georeference.has_value();
  const Eigen::Vector3d in_site = SiteFromWorld(camera.PositionInWorld());
  std::string attributes =
      XmpAttribute("exif:FocalLengthIn35mmFilm", std::to_string(std::lround(Focal35mm(camera))));
  attributes += XmpAttribute("exif:GPSImgDirection",
                             Rational(TrueBearingDeg(scene, camera.ForwardInWorld()), 100));
  attributes += XmpAttribute("exif:GPSImgDirectionRef", "T");
  if (has_place) {
    const GeodeticPlace place = PlaceOnEarth(scene, camera.PositionInWorld());
    attributes += XmpAttribute("exif:GPSLatitude", XmpDegrees(place.latitude_deg, 'N', 'S'));
    attributes += XmpAttribute("exif:GPSLongitude", XmpDegrees(place.longitude_deg, 'E', 'W'));
    attributes += XmpAttribute("exif:GPSAltitude", Rational(std::abs(place.height_m), 1000));
    attributes += XmpAttribute("exif:GPSAltitudeRef", place.height_m < 0 ? "1" : "0");
    attributes += XmpAttribute("exif:GPSMapDatum", "WGS-84");
  }
  // What EXIF has no words for, in the model's own frame.
  attributes +=
      XmpAttribute("groundglass:position_in_site",
                   FormatNumber(in_site.x() + 0.0) + " " + FormatNumber(in_site.y() + 0.0) + " " +
                       FormatNumber(in_site.z() + 0.0));
  attributes += XmpAttribute("groundglass:unit", UnitName(scene.unit));
  attributes +=
      XmpAttribute("groundglass:principal_point_px",
                   FormatNumber(camera.center_x_px) + " " + FormatNumber(camera.center_y_px));
  attributes +=
      XmpAttribute("groundglass:focal_px",
                   FormatNumber(camera.focal_x_px) + " " + FormatNumber(camera.focal_y_px));
  return XmpPacket(
      "xmlns:exif=\"http://ns.adobe.com/exif/1.0/\" "
      "xmlns:groundglass=\"urn:groundglass:1\"",
      attributes,
      "");
}

std::string RealityCaptureText(const ExchangeCamera& each) {
  const Camera& camera = each.camera;
  const Eigen::Vector3d position = camera.PositionInWorld();
  std::string rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation += (rotation.empty() ? "" : " ") +
                  FormatNumber(camera.cam_from_world.rotation(row, column) + 0.0);
    }
  }
  std::string attributes = XmpAttribute("xcr:Version", "3");
  attributes += XmpAttribute("xcr:PosePrior", "locked");
  attributes += XmpAttribute("xcr:Coordinates", "absolute");
  attributes += XmpAttribute("xcr:DistortionModel", "perspective");
  attributes += XmpAttribute("xcr:FocalLength35mm", FormatNumber(Focal35mm(camera)));
  attributes += XmpAttribute("xcr:Skew", "0");
  attributes += XmpAttribute("xcr:AspectRatio", "1");
  attributes += XmpAttribute("xcr:PrincipalPointU", "0");
  attributes += XmpAttribute("xcr:PrincipalPointV", "0");
  attributes += XmpAttribute("xcr:CalibrationPrior", "exact");
  const std::string elements =
      "   <xcr:Rotation>" + rotation + "</xcr:Rotation>\n   <xcr:Position>" +
      FormatNumber(position.x() + 0.0) + " " + FormatNumber(position.y() + 0.0) + " " +
      FormatNumber(position.z() + 0.0) +
      "</xcr:Position>\n   <xcr:DistortionCoeficients>0 0 0 0 0 0</xcr:DistortionCoeficients>\n";
  return XmpPacket(
      "xmlns:xcr=\"http://www.capturingreality.com/ns/xcr/1.1#\"", attributes, elements);
}

}  // namespace

std::vector<FileToWrite> FormatSidecars(const ExchangeScene& scene,
                                        const std::filesystem::path& out) {
  std::vector<FileToWrite> files;
  for (const ExchangeCamera& camera : scene.cameras) {
    files.push_back({out / (camera.name + ".xmp"), SidecarText(scene, camera)});
  }
  return files;
}

// The vendor's texts differ on what principal points and lengths are shares of; of a picture that
// is centred and wider than high all readings are the same.
std::vector<FileToWrite> FormatRealityCapture(const ExchangeScene& scene,
                                              const std::filesystem::path& out) {
  std::vector<FileToWrite> files;
  for (const ExchangeCamera& camera : scene.cameras) {
    files.push_back({out / (camera.name + ".xmp"), RealityCaptureText(camera)});
  }
  return files;
}

}  // namespace groundglass
