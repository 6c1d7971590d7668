// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/city_gml.h"
#include "exchange/city_json.h"
#include "exchange/formats.h"
#include "exchange/geodetic.h"
#include "scene/formats/tags_csv.h"
#include "scene/formats/view_io.h"
#include "tests/exchange/test_camera.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace groundglass {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

ExchangeScene GeoScene() {
  ExchangeScene scene = SceneOf(OffCentreCamera());
  scene.georeference = Georeference{48.7771, 2.2970, 66, 14.5};
  return scene;
}

TEST(PlaceOnEarth, IsTheInverseOfSiteFromGeodetic) {
  const ExchangeScene scene = GeoScene();
  PolygonModel model;
  model.unit = scene.unit;
  model.georeference = scene.georeference;
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(120, -45, 7), Eigen::Vector3d(-900, 8000, 250)}) {
    const GeodeticPlace place = PlaceOnEarth(scene, point);
    const Eigen::Vector3d back = WorldFromSite(
        SiteFromGeodetic(model, place.latitude_deg, place.longitude_deg, place.height_m));
    EXPECT_LT((back - point).norm(), 1e-4);
  }
}

TEST(Kml, FieldsOfViewAreUnequalToBothSides) {
  ExchangeScene scene = GeoScene();
  scene.cameras[0].image_file = "/t/s3.jpg";
  const std::string kml = FormatKml(scene, "/t/stations.kml")[0].bytes;
  for (const char* part :
       {"<leftFov>-21.6", "<rightFov>32.5", "<bottomFov>-15.0", "<topFov>21.0"}) {
    EXPECT_THAT(kml, HasSubstr(part));
  }
}

TEST(GeoJson, TheStationsBearingIsFromTrueNorth) {
  const Json json = Json::parse(FormatGeoJson(GeoScene(), "/t/stations.geojson")[0].bytes);
  const Json& station = json["features"][0];
  // From (61, 93) to (20, 15) in site: 41 west and 78 north, 27.73 degrees west of the model's
  // north, which lies 14.5 degrees east of true north.
  EXPECT_NEAR(station["properties"]["bearing_deg"].get<double>(),
              360 - std::atan2(41, 78) * kDegreesPerRadian + 14.5,
              1e-6);
  EXPECT_EQ(json["features"][1]["geometry"]["coordinates"][0].size(), 5u);
}

TEST(GeoJson, AModelThatDoesNotSayWhereItIsIsAnError) {
  EXPECT_THAT(ThrownMessage([] { FormatGeoJson(SceneOf(OffCentreCamera()), "s.geojson"); }),
              HasSubstr("does not say where on Earth it is"));
}

TEST(Sidecars, SayPlaceDirectionAndFocalLength) {
  const std::string xmp = FormatSidecars(GeoScene(), "/t")[0].bytes;
  EXPECT_THAT(xmp, HasSubstr("exif:FocalLengthIn35mmFilm=\"35\""));
  EXPECT_THAT(xmp, HasSubstr("exif:GPSLatitude=\"48,46."));
  EXPECT_THAT(xmp, HasSubstr("N\""));
}

// A wall with a window hole, and a roof without a texture.
TexturedModel WallAndRoof() {
  TexturedModel textured;
  textured.model.unit = LengthUnit::kMetre;
  textured.model.points_in_world = {{0, 0, 0},
                                    {6, 0, 0},
                                    {6, 0, 4},
                                    {0, 0, 4},
                                    {2, 0, 1},
                                    {2, 0, 3},
                                    {3, 0, 3},
                                    {3, 0, 1},
                                    {6, 3, 5},
                                    {0, 3, 5}};
  textured.model.faces = {{{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}, "wall"}, {{3, 2, 8, 9}, "roof"}};
  textured.faces.resize(2);
  textured.faces[0].page = 0;
  for (const int point : textured.model.faces[0].points) {
    const Eigen::Vector3d& p = textured.model.points_in_world[point];
    textured.faces[0].corners_texel.emplace_back(10 * p.x(), 40 - 10 * p.z());
  }
  textured.pages = {{Image8(60, 40, 3, 150), {}}};
  return textured;
}

TEST(CityJson, HolesTexturesAndSurfacesStandInStep) {
  const std::vector<FileToWrite> files = FormatCityJson(WallAndRoof(), "/t/hall.city.json");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].file, "/t/hall_0.jpg");
  const Json json = Json::parse(files[1].bytes);
  EXPECT_EQ(json["version"], "2.0");
  const Json& geometry = json["CityObjects"]["building"]["geometry"][0];
  ASSERT_EQ(geometry["boundaries"].size(), 2u);
  ASSERT_EQ(geometry["boundaries"][0].size(), 2u);  // the wall and its window
  EXPECT_EQ(geometry["boundaries"][0][0].size(), 4u);
  EXPECT_EQ(geometry["boundaries"][0][1].size(), 4u);
  EXPECT_EQ(geometry["semantics"]["surfaces"][0]["type"], "WallSurface");
  EXPECT_EQ(geometry["semantics"]["surfaces"][1]["type"], "RoofSurface");
  const Json& textures = geometry["texture"]["photographs"]["values"];
  ASSERT_EQ(textures.size(), 2u);
  EXPECT_EQ(textures[0][0].size(), 5u);  // the page, and a place for each corner
  EXPECT_TRUE(textures[1][0][0].is_null());
  // Every number names something: the schema does not look.
  const size_t num_places = json["appearance"]["vertices-texture"].size();
  for (const Json& ring : textures[0]) {
    for (size_t i = 1; i < ring.size(); ++i) EXPECT_LT(ring[i].get<size_t>(), num_places);
  }
  for (const Json& surface : geometry["boundaries"]) {
    for (const Json& ring : surface) {
      for (const Json& vertex : ring) EXPECT_LT(vertex.get<size_t>(), json["vertices"].size());
    }
  }
  // The wall's lower left corner is the page's, whose v counts from below.
  const size_t first = textures[0][0][1];
  EXPECT_EQ(json["appearance"]["vertices-texture"][first], Json({0.0, 0.0}));
}

constexpr char kGml[] = R"(<?xml version="1.0"?>
<core:CityModel xmlns:core="c" xmlns:gml="g" xmlns:bldg="b">
 <core:cityObjectMember><bldg:Building>
  <bldg:lod1Solid><gml:Polygon><gml:exterior><gml:LinearRing>
   <gml:posList>0 0 0 9 0 0 9 9 0 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>
  </bldg:lod1Solid>
  <bldg:boundedBy><bldg:WallSurface><gml:name>east wall</gml:name>
   <bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
    <gml:exterior><gml:LinearRing><gml:posList srsDimension="3">
     691000.25 5336000.5 500 691006.25 5336000.5 500 691006.25 5336000.5 504
     691000.25 5336000.5 504 691000.25 5336000.5 500</gml:posList></gml:LinearRing></gml:exterior>
    <gml:interior><gml:LinearRing>
     <gml:pos>691002.25 5336000.5 501</gml:pos><gml:pos>691002.25 5336000.5 503</gml:pos>
     <gml:pos>691003.25 5336000.5 503</gml:pos><gml:pos>691003.25 5336000.5 501</gml:pos>
     <gml:pos>691002.25 5336000.5 501</gml:pos></gml:LinearRing></gml:interior>
   </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface>
  </bldg:WallSurface></bldg:boundedBy>
 </bldg:Building></core:cityObjectMember>
</core:CityModel>
)";

TEST(CityGml, TheFinestPolygonsComeWithHolesAndNames) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadCityGml(folder.Write("hall.gml", kGml));
  ASSERT_EQ(reading.model.faces.size(), 1u);  // the coarser solid is left out
  EXPECT_EQ(reading.model.faces[0].name, "east wall");
  EXPECT_NEAR(ComputeFaceArea(reading.model, 0), 24 - 2, 1e-6);
  EXPECT_EQ(reading.model.unit, LengthUnit::kMetre);
  EXPECT_EQ(reading.model.points_in_world[0].x(), 691000.25);
}

std::string GmlPolygon(const std::string& points, const std::string& element = "Polygon") {
  return "<gml:" + element + "><gml:exterior><gml:LinearRing><gml:posList>" + points +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:" + element + ">";
}

ModelReading ReadCity(const TemporaryFolder& folder,
                      const std::string& members,
                      const std::string& srs_name = "EPSG:25832") {
  return ReadCityGml(folder.Write(
      "city.gml",
      "<core:CityModel xmlns:core=\"c\" xmlns:gml=\"g\"><gml:boundedBy><gml:Envelope srsName=\"" +
          srs_name + "\"/></gml:boundedBy>" + members + "</core:CityModel>"));
}

constexpr char kSquare[] = "0 0 0 4 0 0 4 4 0 0 4 0 0 0 0";

TEST(CityGml, ASurfaceThatIsTurnedRunsTheOtherWay) {
  const TemporaryFolder folder;
  const ModelReading reading =
      ReadCity(folder,
               "<a><OrientableSurface orientation=\"-\"><gml:baseSurface>" + GmlPolygon(kSquare) +
                   "</gml:baseSurface></OrientableSurface></a>");
  ASSERT_EQ(reading.model.faces.size(), 1u);
  EXPECT_LT(DoubledVectorArea(reading.model, 0).z(), 0);
  EXPECT_EQ(reading.model.faces[0].name, "") << "baseSurface is no name";
}

TEST(CityGml, AShapeThatIsSetUpElsewhereStandsThere) {
  const TemporaryFolder folder;
  const ModelReading reading =
      ReadCity(folder,
               "<a><ImplicitGeometry><transformationMatrix>0 -1 0 0  1 0 0 0  0 0 2 0  0 0 0 1"
               "</transformationMatrix><relativeGMLGeometry>" +
                   GmlPolygon("0 0 1 4 0 1 4 3 1 0 0 1") +
                   "</relativeGMLGeometry><referencePoint><gml:Point><gml:pos>100 200 30</gml:pos>"
                   "</gml:Point></referencePoint></ImplicitGeometry></a>");
  ASSERT_EQ(reading.model.points_in_world.size(), 3u);
  EXPECT_EQ(reading.model.points_in_world[1], Eigen::Vector3d(100, 204, 32));
  EXPECT_EQ(reading.model.points_in_world[2], Eigen::Vector3d(97, 204, 32));
}

TEST(CityGml, CoordinatesOfAnEarlierGmlAreRead) {
  const TemporaryFolder folder;
  const ModelReading reading =
      ReadCity(folder,
               "<gml:Polygon><gml:exterior><gml:LinearRing><gml:coordinates>0,0,0 4,0,0 4,3,0 0,0,0"
               "</gml:coordinates></gml:LinearRing></gml:exterior></gml:Polygon>");
  ASSERT_EQ(reading.model.faces.size(), 1u);
  EXPECT_EQ(reading.model.points_in_world[2], Eigen::Vector3d(4, 3, 0));
  EXPECT_THAT(ThrownMessage([&] { ReadCity(folder, GmlPolygon(kSquare), "EPSG:4979"); }),
              HasSubstr("counts in degrees of latitude and longitude"));
}

TEST(CityGml, TerrainOfTrianglesIsRead) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadCity(folder, GmlPolygon("0 0 0 4 0 0 4 4 1 0 0 0", "Triangle"));
  EXPECT_EQ(reading.model.faces.size(), 1u);
}

TEST(CityGml, EachPartHasItsFinestLevel) {
  const TemporaryFolder folder;
  const auto part = [](const std::string& name, const std::string& polygons) {
    return "<BuildingPart><gml:name>" + name + "</gml:name>" + polygons + "</BuildingPart>";
  };
  const ModelReading reading = ReadCity(
      folder,
      "<core:cityObjectMember><Building>" +
          part("tower",
               "<lod1Solid>" + GmlPolygon("0 0 9 4 0 9 4 4 9 0 0 9") + "</lod1Solid><lod2Solid>" +
                   GmlPolygon(kSquare) + "</lod2Solid>") +
          part("shed", "<lod1Solid>" + GmlPolygon("9 0 0 9 4 0 9 4 4 9 0 0") + "</lod1Solid>") +
          "</Building></core:cityObjectMember>");
  ASSERT_EQ(reading.model.faces.size(), 2u);
  EXPECT_EQ(reading.model.faces[0].name, "tower");
  EXPECT_EQ(reading.model.faces[1].name, "shed");
  EXPECT_EQ(reading.warnings.size(), 1u);
}

TEST(CityGml, StatePlanesAreInFeet) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadCity(folder, GmlPolygon(kSquare), "urn:ogc:def:crs:EPSG::2263");
  EXPECT_EQ(reading.model.unit, LengthUnit::kUsSurveyFoot);
  EXPECT_THAT(reading.warnings, testing::Contains(HasSubstr("US survey feet")));
}

TEST(CityGml, SystemsOfDegreesAreRefused) {
  const TemporaryFolder folder;
  for (const char* degrees : {"EPSG:4326",
                              "EPSG:6668",
                              "http://www.opengis.net/def/crs/EPSG/0/6697",
                              "urn:ogc:def:crs:EPSG:9.8:7844",
                              "EPSG:7843",
                              "EPSG:4258+5621",
                              "urn:ogc:def:crs,crs:EPSG::4258,crs:EPSG::5621",
                              "http://www.opengis.net/gml/srs/epsg.xml#4979",
                              "urn:ogc:def:crs:OGC:1.3:CRS84"}) {
    EXPECT_THAT(
        ThrownMessage([&] { ReadCity(folder, GmlPolygon(kSquare), degrees); }),
        testing::AllOf(HasSubstr(std::string(degrees) + " counts in degrees"), HasSubstr("QGIS")));
  }
  // Their neighbours in the register count in metres.
  for (const char* metres : {"EPSG:25832",
                             "EPSG:4647",
                             "EPSG:4978",
                             "EPSG:6669",
                             "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837",
                             "EPSG:31467+5783"}) {
    EXPECT_EQ(ReadCity(folder, GmlPolygon(kSquare), metres).model.faces.size(), 1u) << metres;
  }
}

TEST(CityGml, DegreesAreToldByTheirNumbersToo) {
  const TemporaryFolder folder;
  const std::string wall =
      "35.65 139.74 0 35.6501 139.74 0 35.6501 139.74 8 35.65 139.74 8 35.65 139.74 0";
  EXPECT_THAT(
      ThrownMessage([&] { ReadCity(folder, GmlPolygon(wall), ""); }),
      testing::AllOf(HasSubstr("are degrees of latitude and longitude, it seems"),
                     HasSubstr("x from 35.65 to 35.6501, y from 139.74 to 139.74, 8 high")));
  // A mast near the origin, eight centimetres thick.
  const std::string mast = "35 39 0 35.08 39 0 35.08 39 8 35 39 8 35 39 0";
  EXPECT_EQ(ReadCity(folder, GmlPolygon(mast), "").model.faces.size(), 1u);
}

TEST(CityGml, AnotherXmlIsAnErrorThatSaysSo) {
  const TemporaryFolder folder;
  EXPECT_THAT(ThrownMessage([&] { ReadCityGml(folder.Write("a.gml", "<a/>")); }),
              HasSubstr("a.gml: holds no gml:Polygon"));
  EXPECT_THAT(ThrownMessage([&] {
                ReadCityGml(folder.Write("b.gml",
                                         "<a>\n<Polygon><exterior><LinearRing><posList>0 0 1 2"
                                         "</posList></LinearRing></exterior></Polygon></a>"));
              }),
              HasSubstr("b.gml:2: <posList> has 4 numbers, which are not points of three"));
}

}  // namespace
}  // namespace groundglass
