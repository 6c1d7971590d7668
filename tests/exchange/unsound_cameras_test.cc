// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What other programs' files say and no camera can be costs the photograph, and the file's others
// are read.
#include "exchange/camera_exchange.h"
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "tests/exchange/test_camera.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>

namespace groundglass {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

ExchangeScene TwoCameras() {
  ExchangeScene scene = SceneOf(OffCentreCamera());
  scene.cameras.push_back({"s4", "s4.jpg", OffCentreCamera(), {}});
  return scene;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// The one warning of a file in which one of two cameras is spoilt.
std::string WarningOf(const std::filesystem::path& file) {
  const ExchangeSource source = ReadExchangeSource(file, {});
  EXPECT_EQ(source.cameras.size(), 1u);
  EXPECT_EQ(source.warnings.size(), 1u);
  return source.warnings.empty() ? "" : source.warnings[0];
}

TEST(UnsoundCameras, OfNerfstudioCostTheirFrame) {
  const TemporaryFolder folder;
  const Json good =
      Json::parse(FormatNerfstudio(TwoCameras(), folder / "transforms.json")[0].bytes);
  const auto warning = [&](const std::function<void(Json&)>& spoil) {
    Json json = good;
    spoil(json["frames"][1]);
    return WarningOf(folder.Write("transforms.json", json.dump()));
  };
  EXPECT_THAT(warning([](Json& frame) { frame["fl_x"] = 0; }),
              HasSubstr("transforms.json: frame 2 (s4): the focal length must be above 0 and "
                        "finite; here it is 0; image 's4' is left out"));
  EXPECT_THAT(warning([](Json& frame) { frame["fl_x"] = "wide"; }),
              HasSubstr("frame 2 (s4): expected a number, found a string"));
  EXPECT_THAT(warning([](Json& frame) { frame.erase("fl_x"); }), HasSubstr("'fl_x' is missing"));
  EXPECT_THAT(warning([](Json& frame) { frame["w"] = 0; }),
              HasSubstr("an image of 0 x 800 pixels cannot be; expected whole numbers from 1"));
  EXPECT_THAT(warning([](Json& frame) { frame["h"] = 1e12; }), HasSubstr("cannot be"));
  EXPECT_THAT(warning([](Json& frame) { frame["cx"] = 1e9; }), HasSubstr("the principal point"));
  EXPECT_THAT(warning([](Json& frame) { frame["k4"] = 0.1; }), HasSubstr("k4 is no part"));
  EXPECT_THAT(warning([](Json& frame) { frame["camera_model"] = "OPENCV_FISHEYE"; }),
              HasSubstr("camera_model is 'OPENCV_FISHEYE'"));
  EXPECT_THAT(warning([](Json& frame) {
                for (Json& row : frame["transform_matrix"]) row[0] = -row[0].get<double>();
              }),
              HasSubstr("mirrors"));
  EXPECT_THAT(warning([](Json& frame) {
                frame["transform_matrix"][0] = {0, 0, 0, 0};
              }),
              HasSubstr("is no rotation"));
}

TEST(UnsoundCameras, OfMetashapeAndMeshLabAreNamedByTheirLine) {
  const TemporaryFolder folder;
  const std::string metashape = FormatMetashape(TwoCameras(), folder / "c.xml")[0].bytes;
  const auto of_metashape = [&](const std::string& from, const std::string& to) {
    return WarningOf(folder.Write("c.xml", Replaced(metashape, from, to)));
  };
  EXPECT_THAT(of_metashape("<resolution width=\"1200\"", "<resolution width=\"wide\""),
              HasSubstr("c.xml:5: <resolution>: 'wide' is not a finite number"));
  EXPECT_THAT(of_metashape("<resolution width=\"1200\"", "<resolution width=\"12.5\""),
              HasSubstr("c.xml:9: an image of 12.5 x 800 pixels cannot be"));
  EXPECT_THAT(of_metashape("<f>1220.574</f>", "<f>0</f>"), HasSubstr("c.xml:9: the focal length"));
  EXPECT_THAT(of_metashape("type=\"frame\">", "type=\"fisheye\">"),
              HasSubstr("c.xml:5: a sensor of type 'fisheye'; expected frame; image 's3.jpg'"));
  const std::string meshlab = FormatMeshLab(TwoCameras(), folder / "p.mlp")[0].bytes;
  const auto of_meshlab = [&](const std::string& from, const std::string& to) {
    return WarningOf(folder.Write("p.mlp", Replaced(meshlab, from, to)));
  };
  EXPECT_THAT(of_meshlab("ViewportPx=\"1200 800\"", "ViewportPx=\"1200 0\""),
              HasSubstr("p.mlp:7: an image of 1200 x 0 pixels cannot be"));
  EXPECT_THAT(of_meshlab("PixelSizeMm=\"0.03 ", "PixelSizeMm=\"0 "),
              HasSubstr("p.mlp:7: the focal length"));
  EXPECT_THAT(of_meshlab("0 0 0 1\" CameraType", "0 0 0\" CameraType"),
              HasSubstr("RotationMatrix has 15 numbers, not 16; image 's3' is left out"));
}

TEST(UnsoundCameras, OrthographicOnesAndMovedMeshesOfMeshLabAreRefused) {
  const TemporaryFolder folder;
  const std::string meshlab = FormatMeshLab(TwoCameras(), folder / "p.mlp")[0].bytes;
  EXPECT_THAT(
      WarningOf(folder.Write("p.mlp", Replaced(meshlab, "CameraType=\"0\"", "CameraType=\"1\""))),
      HasSubstr("p.mlp:7: <VCGCamera> is orthographic"));
  const auto matrix = [&](const std::string& numbers) {
    return folder.Write("p.mlp",
                        Replaced(meshlab,
                                 "<RasterGroup>",
                                 "<MeshGroup><MLMesh><MLMatrix44>" + numbers +
                                     "</MLMatrix44></MLMesh></MeshGroup><RasterGroup>"));
  };
  EXPECT_EQ(ReadMeshLab(matrix("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")).size(), 2u);
  EXPECT_THAT(ThrownMessage([&] { ReadMeshLab(matrix("1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1")); }),
              HasSubstr("the project moves its mesh (MLMatrix44)"));
}

TEST(UnsoundCameras, APictureThatIsThereTwiceHasItsFirstCamera) {
  const TemporaryFolder folder;
  Json json = Json::parse(FormatNerfstudio(TwoCameras(), folder / "transforms.json")[0].bytes);
  json["frames"][1]["file_path"] = "./" + json["frames"][0]["file_path"].get<std::string>();
  json["frames"][1]["fl_x"] = 777;
  const auto file = folder.Write("transforms.json", json.dump());
  const ExchangeSource source = ReadExchangeSource(file, {});
  ASSERT_EQ(source.cameras.size(), 1u);
  EXPECT_NE(source.cameras[0].camera.focal_x_px, 777);
  EXPECT_THAT(
      source.warnings,
      ElementsAre(HasSubstr("transforms.json: pictures that have more than one camera: './s3'")));
}

TEST(UnsoundCameras, AllOfThemAreAnError) {
  const TemporaryFolder folder;
  Json json = Json::parse(
      FormatNerfstudio(SceneOf(OffCentreCamera()), folder / "transforms.json")[0].bytes);
  json["frames"][0]["fl_y"] = -3;
  const auto file = folder.Write("transforms.json", json.dump());
  EXPECT_THAT(
      ThrownMessage([&] { ReadExchangeSource(file, {}); }),
      HasSubstr("frame 1 (s3): the focal length must be above 0 and finite; here it is -3"));
  EXPECT_THAT(ThrownMessage([&] {
                ReadExchangeSource(folder.Write("b/transforms.json", "{\"frames\": []}"), {});
              }),
              HasSubstr("has no frames"));
}

TEST(ForeignPoses, AMatrixThatScalesIsTheSameRotation) {
  const Camera camera = OffCentreCamera();
  Eigen::Matrix4d matrix = WorldFromGlCam(camera);
  matrix.topLeftCorner<3, 3>() *= 2.5;
  Camera found = camera;
  SetPoseFromGlCam(matrix, found);
  EXPECT_LT(LargestMiss(camera, found), 1e-6);
  // Six digits are what most programs write.
  matrix = (WorldFromGlCam(camera) * 1e6).array().round().matrix() / 1e6;
  SetPoseFromGlCam(matrix, found);
  EXPECT_LT(LargestMiss(camera, found), 0.02);
  matrix.row(2) *= -1;
  EXPECT_THAT(ThrownMessage([&] { SetPoseFromGlCam(matrix, found); }), HasSubstr("mirrors"));
  matrix = WorldFromGlCam(camera);
  matrix.col(0) *= 1.2;
  EXPECT_THAT(ThrownMessage([&] { SetPoseFromGlCam(matrix, found); }), HasSubstr("right angles"));
}

TEST(ForeignPoses, NerfstudiosScaleIsUndoneAfterItsTransform) {
  const Camera camera = OffCentreCamera();
  Json json = Json::parse(FormatNerfstudio(SceneOf(camera), "/t/transforms.json")[0].bytes);
  Eigen::Matrix4d applied = Eigen::Matrix4d::Identity();
  applied.topRows<3>() << 0, 1, 0, 2, 1, 0, 0, -3, 0, 0, -1, 4;
  Eigen::Matrix4d matrix = applied * WorldFromGlCam(camera);
  matrix.topRightCorner<3, 1>() *= 0.125;
  for (int i = 0; i < 16; ++i) {
    json["frames"][0]["transform_matrix"][i / 4][i % 4] = matrix(i / 4, i % 4);
    if (i < 12) json["applied_transform"][i / 4][i % 4] = applied(i / 4, i % 4);
  }
  json["applied_scale"] = 0.125;
  const TemporaryFolder folder;
  const auto file = folder.Write("transforms.json", json.dump());
  EXPECT_LT(LargestMiss(camera, ReadNerfstudio(file)[0].named.camera), 1e-6);
  json["applied_scale"] = 0;
  EXPECT_THAT(ReadNerfstudio(folder.Write("transforms.json", json.dump()))[0].fault,
              HasSubstr("applied_scale must be above 0, not 0"));
}

TEST(ForeignPoses, TheTransformOfMetashapesChunkOrComponentPlacesTheCameras) {
  const Camera camera = OffCentreCamera();
  const TemporaryFolder folder;
  const std::string text = FormatMetashape(SceneOf(camera), folder / "c.xml")[0].bytes;
  // A quarter turn about z, twice as large, moved.
  const std::string transform =
      "<transform><rotation>0 -1 0 1 0 0 0 0 1</rotation><translation>10 20 30</translation>"
      "<scale>2</scale></transform>";
  const auto read = [&](const std::string& more, const std::string& of_camera = "") {
    std::string changed = text;
    changed.replace(changed.find("</cameras>"), 10, "</cameras>" + more);
    if (!of_camera.empty()) changed.replace(changed.find("<camera id"), 7, "<camera" + of_camera);
    return ReadMetashape(folder.Write("c.xml", changed))[0];
  };
  const Eigen::Vector3d before = camera.PositionInWorld();
  const Eigen::Vector3d placed(10 - 2 * before.y(), 20 + 2 * before.x(), 30 + 2 * before.z());
  const std::string component =
      "<components><component id=\"4\">" + transform + "</component></components>";
  for (const ForeignCamera& found :
       {read(transform),
        read(transform + "<reference>LOCAL_CS[\"Local Coordinates (m)\"]</reference>"),
        read(component, " component_id=\"4\""),
        read(component)}) {
    EXPECT_EQ(found.fault, "");
    EXPECT_LT((found.named.camera.PositionInWorld() - placed).norm(), 1e-9);
    const Eigen::Vector3d axis = camera.cam_from_world.rotation.row(2);
    const Eigen::Vector3d turned(-axis.y(), axis.x(), axis.z());
    EXPECT_LT((found.named.camera.cam_from_world.rotation.row(2).transpose() - turned).norm(),
              1e-9);
  }
  EXPECT_LT((read(component, " component_id=\"5\"").named.camera.PositionInWorld() - before).norm(),
            1e-9);
  // WGS 84 is what a chunk names if nobody chose: only one about the Earth's centre lies on it.
  const std::string globe = "<reference>GEOGCS[\"WGS 84\",1]</reference>";
  EXPECT_EQ(read(transform + globe).fault, "");
  std::string far = transform;
  far.replace(far.find("10 20 30"), 8, "4200000 900000 4700000");
  EXPECT_THAT(read(far + globe).fault, HasSubstr("the chunk is placed on the globe (WGS 84)"));
}

TEST(ForeignPoses, AFrameThatWouldBeHugeIsAnError) {
  Camera camera = OffCentreCamera();
  camera.center_x_px = 1e5;
  EXPECT_THAT(ThrownMessage([&] { PreparedCamera(camera, {.centred = true}); }),
              HasSubstr("longer than 131072 px"));
}

TEST(ExchangeFolders, FspyProjectsOfAFolderAreReadTogether) {
  const TemporaryFolder folder;
  const Camera camera = PreparedCamera(OffCentreCamera(), {true, true, false});
  ExchangeScene scene = SceneOf(camera);
  scene.cameras.push_back({"s10", "s10.jpg", camera, {}});
  WriteFilesAtomically(FormatFspy(scene, folder / "f"));
  folder.Write("f/s4.fspy", "fspy");
  folder.Write("photos/S10.JPG", "");
  EXPECT_TRUE(HasExchangeCameras(folder / "f"));
  const ExchangeSource source = ReadExchangeSource(folder / "f", folder / "photos");
  ASSERT_EQ(source.cameras.size(), 2u);
  EXPECT_EQ(source.cameras[0].name, "s3");
  EXPECT_EQ(source.cameras[1].name, "S10.JPG");
  EXPECT_THAT(source.warnings, ElementsAre(HasSubstr("s4.fspy: is no project of fSpy's")));
}

TEST(ExchangeFolders, AModelInPlaceOfCamerasIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    return ThrownMessage([&] { ReadExchangeSource(folder.Write(name, text), {}); });
  };
  EXPECT_THAT(message("a.city.json", R"({"type": "CityJSON", "vertices": []})"),
              HasSubstr("a.city.json: this is CityJSON, which is not read; export it as CityGML"));
  EXPECT_THAT(message("a.xml", "<CityModel/>"), HasSubstr("this is CityGML by its content"));
  EXPECT_THAT(message("transforms.json", R"({"vertices": []})"),
              HasSubstr("transforms.json: is not as nerfstudio writes"));
}

TEST(ExchangeFolders, ASceneIsReadByItsViewFilesAndImages) {
  const TemporaryFolder folder;
  ViewTag tag;
  tag.position_in_site = {61, 93, 5.5};
  tag.lookat_in_site = {20, 15, 18};
  folder.Write("hall/views/s3.view", FormatView(tag));
  WriteSrgb8(folder / "hall/images/s3.jpg", Image8(30, 20, 3, 128));
  for (const char* input : {"hall", "hall/", "hall/views", "hall/views/"}) {
    const ExchangeSource source = ReadExchangeSource(folder / input, {});
    ASSERT_EQ(source.cameras.size(), 1u) << input;
    EXPECT_EQ(source.images, folder / "hall/images") << input;
  }
  EXPECT_THAT(ThrownMessage([&] { ReadExchangeSource(folder / "hall/images", {}); }),
              HasSubstr("hall/images: holds no cameras: no view files, no COLMAP model"));
}

TEST(ExchangeFolders, NeitherTheInputNorASceneIsWrittenOver) {
  const TemporaryFolder folder;
  ExchangeSource source;
  source.cameras = {{"s3.jpg", OffCentreCamera()}};
  folder.Write("hall/model.osu", "");
  folder.Write("hall/images/s3.jpg", "");
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("colmap", source, folder / "hall"); }),
              HasSubstr("hall: is a scene's folder"));
  WriteCamerasAs("colmap", source, folder / "hall/cameras");
  const ExchangeSource read = ReadExchangeSource(folder / "hall/cameras", {});
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("colmap", read, folder / "hall/cameras"); }),
              HasSubstr("would be written over the input itself"));
  WriteCamerasAs("metashape", source, folder / "c.xml");
  const ExchangeSource metashape = ReadExchangeSource(folder / "c.xml", {});
  EXPECT_THAT(ThrownMessage([&] {
                WriteCamerasAs(
                    "metashape", metashape, folder / "../" / folder.path().filename() / "c.xml");
              }),
              HasSubstr("would be written over the input itself"));
}

}  // namespace
}  // namespace groundglass
