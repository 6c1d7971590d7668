// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/camera_exchange.h"
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "exchange/xml_reader.h"
#include "scene/child_process.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "tests/exchange/test_camera.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace groundglass {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kSamePx = 1e-6;

Camera LensCamera() {
  Camera camera = OffCentreCamera();
  camera.k1 = -0.08;
  camera.k2 = 0.01;
  camera.p1 = 0.002;
  camera.p2 = -0.001;
  return camera;
}

// What a format writes of a camera, read again by our own reader.
Camera ThereAndBack(const CameraFormat& format, const Camera& camera) {
  const TemporaryFolder folder;
  const std::filesystem::path out =
      format.is_folder ? folder.path() : folder / ("cameras" + std::string(format.ending));
  const std::vector<FileToWrite> files = format.format(SceneOf(camera), out);
  WriteFilesAtomically(files);
  const std::vector<ForeignCamera> read = format.read(files.at(0).file);
  EXPECT_EQ(read.size(), 1u);
  EXPECT_EQ(read.at(0).fault, "");
  return read.at(0).named.camera;
}

TEST(CameraFormats, ThoseThatAreReadGiveTheCameraBack) {
  int num_read = 0;
  for (const CameraFormat& format : CameraFormats()) {
    if (!format.read) continue;
    ++num_read;
    const Camera camera = PreparedCamera(LensCamera(), format.needs);
    EXPECT_LT(LargestMiss(camera, ThereAndBack(format, camera)), kSamePx) << format.name;
  }
  EXPECT_EQ(num_read, 4);
}

// The formulas of the other programs' own sources, so that a mistake that reader and writer share
// is seen.

TEST(Nerfstudio, OpenGlAxesAndFocalLengthsGiveThePixel) {
  const Camera camera = OffCentreCamera();
  const Json json = Json::parse(FormatNerfstudio(SceneOf(camera), "/t/transforms.json")[0].bytes);
  const Json& frame = json["frames"][0];
  Eigen::Matrix4d world_from_gl;
  for (int i = 0; i < 16; ++i) {
    world_from_gl(i / 4, i % 4) = frame["transform_matrix"][i / 4][i % 4].get<double>();
  }
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    const Eigen::Vector4d in_gl = world_from_gl.inverse() * place.homogeneous();
    const double u =
        frame["cx"].get<double>() + frame["fl_x"].get<double>() * in_gl.x() / -in_gl.z();
    const double v =
        frame["cy"].get<double>() - frame["fl_y"].get<double>() * in_gl.y() / -in_gl.z();
    EXPECT_LT((Eigen::Vector2d(u, v) - *Project(camera, place)).norm(), kSamePx);
  }
  EXPECT_EQ(json["orientation_override"], "none");
  EXPECT_FALSE(json.contains("k1"));  // it would turn the frames' own off
}

TEST(Nerfstudio, WhatItsImporterTurnedTheWorldByIsUndone) {
  const Camera camera = OffCentreCamera();
  Json json = Json::parse(FormatNerfstudio(SceneOf(camera), "/t/transforms.json")[0].bytes);
  Eigen::Matrix4d applied = Eigen::Matrix4d::Identity();
  applied.topRows<3>() << 0, 1, 0, 2, 1, 0, 0, -3, 0, 0, -1, 4;
  Eigen::Matrix4d matrix = applied * WorldFromGlCam(camera);
  for (int i = 0; i < 16; ++i) {
    json["frames"][0]["transform_matrix"][i / 4][i % 4] = matrix(i / 4, i % 4);
    if (i < 12) json["applied_transform"][i / 4][i % 4] = applied(i / 4, i % 4);
  }
  const TemporaryFolder folder;
  const auto file = folder.Write("transforms.json", json.dump());
  EXPECT_LT(LargestMiss(camera, ReadNerfstudio(file)[0].named.camera), kSamePx);
}

TEST(Fspy, ThePrincipalPointIsOnAPlaneWithYUp) {
  // stuffmatic/fSpy, coordinates-util.ts: a wide picture's plane is -1 to 1 across.
  const Camera camera = PreparedCamera(OffCentreCamera(), {true, true, false});
  const std::string bytes = FormatFspy(SceneOf(camera), "/t")[0].bytes;
  ASSERT_TRUE(bytes.starts_with(std::string("fspy\x01\0\0\0", 8)));
  const Json parameters = Json::parse(bytes.substr(16))["cameraParameters"];
  const double w = parameters["imageWidth"];
  const double h = parameters["imageHeight"];
  const double px = parameters["principalPoint"]["x"];
  const double py = parameters["principalPoint"]["y"];
  const double focal = w / (2 * std::tan(parameters["horizontalFieldOfView"].get<double>() / 2));
  Eigen::Matrix4d view;
  for (int i = 0; i < 16; ++i) {
    view(i / 4, i % 4) = parameters["viewTransform"]["rows"][i / 4][i % 4].get<double>();
  }
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    const Eigen::Vector4d in_gl = view * place.homogeneous();
    const double x = px + 2 * focal / w * in_gl.x() / -in_gl.z();
    const double y = py + 2 * focal / w * in_gl.y() / -in_gl.z();
    const Eigen::Vector2d pixel((x + 1) * w / 2, h / 2 - y * w / 2);
    EXPECT_LT((pixel - *Project(camera, place)).norm(), kSamePx);
  }
}

TEST(MeshLab, VcgsShotProjectsToTheSamePixelFromBelow) {
  const Camera camera = OffCentreCamera();
  const TemporaryFolder folder;
  const auto file =
      folder.Write("p.mlp", FormatMeshLab(SceneOf(camera), folder / "p.mlp")[0].bytes);
  const XmlElement root = ReadXml(file);
  const XmlElement& shot = *root.Child("RasterGroup")->Child("MLRaster")->Child("VCGCamera");
  const auto numbers = [&](const char* name) {
    return ReadXmlNumbers(file, shot, shot.Attribute(name));
  };
  const std::vector<double> rotation = numbers("RotationMatrix");
  const std::vector<double> translation = numbers("TranslationVector");
  const std::vector<double> pixel_mm = numbers("PixelSizeMm");
  const std::vector<double> center = numbers("CenterPx");
  const double focal_mm = numbers("FocalMm")[0];
  EXPECT_EQ(center, (std::vector<double>{460.25, 329.25}));
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    // vcglib, shot.h: R (p - T'), T' = -translation; camera.ipp: mm on the film over the pixel.
    Eigen::Vector3d in_shot = Eigen::Vector3d::Zero();
    for (int i = 0; i < 9; ++i) {
      in_shot[i / 3] += rotation[4 * (i / 3) + i % 3] * (place[i % 3] + translation[i % 3]);
    }
    const double x = focal_mm * in_shot.x() / -in_shot.z() / pixel_mm[0] + center[0];
    const double y = focal_mm * in_shot.y() / -in_shot.z() / pixel_mm[1] + center[1];
    EXPECT_LT((Eigen::Vector2d(x, 800 - y) - *Project(camera, place)).norm(), kSamePx);
  }
}

TEST(Blender, LensAndShiftAreThoseOfItsOwnProjection) {
  const Camera camera = OffCentreCamera();
  const std::string script = FormatBlender(SceneOf(camera), "/t/cameras.py")[0].bytes;
  const size_t start = script.find("CAMERAS = ") + 10;
  const Json entry = Json::parse(script.substr(start, script.find("\n\n", start) - start))[0];
  // Blender, BKE_camera_params: with a horizontal fit the frame is 36 mm wide, and shifts count in
  // its width; pixels of aspect p are p times as wide in y.
  const double aspect =
      entry["pixel_aspect"][0].get<double>() / entry["pixel_aspect"][1].get<double>();
  const double shift_x = entry["shift"][0];
  const double shift_y = entry["shift"][1];
  const double per_tangent = entry["lens_mm"].get<double>() / 36 * 1200;
  Eigen::Matrix4d matrix_world;
  for (int i = 0; i < 16; ++i) {
    matrix_world(i / 4, i % 4) = entry["matrix_world"][i / 4][i % 4].get<double>();
  }
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    const Eigen::Vector4d in_gl = matrix_world.inverse() * place.homogeneous();
    const double x = per_tangent * in_gl.x() / -in_gl.z() - shift_x * 1200 + 600;
    const double y = (per_tangent * in_gl.y() / -in_gl.z() - shift_y * 1200) * aspect + 400;
    EXPECT_LT((Eigen::Vector2d(x, 800 - y) - *Project(camera, place)).norm(), kSamePx);
  }
}

TEST(MvsTexturing, SharesOfTheLongerSideAndOfWidthAndHeight) {
  for (const int turns : {0, 1}) {  // wide and tall
    const Camera camera = TurnedCamera(OffCentreCamera(), turns);
    std::istringstream text(FormatMvsTexturing(SceneOf(camera), "/t")[0].bytes);
    Eigen::Vector3d t;
    Eigen::Matrix3d r;
    for (int i = 0; i < 3; ++i) text >> t[i];
    for (int i = 0; i < 9; ++i) text >> r(i / 3, i % 3);
    double f, d0, d1, aspect, ppx, ppy;
    text >> f >> d0 >> d1 >> aspect >> ppx >> ppy;
    const double w = camera.width_px;
    const double h = camera.height_px;
    // simonfuhrmann/mve, camera.cc: fill_calibration.
    const double ax = w / h * aspect < 1 ? f * h / aspect : f * w;
    const double ay = w / h * aspect < 1 ? f * h : f * w * aspect;
    EXPECT_EQ(d0, 0);
    EXPECT_EQ(d1, 0);
    for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
      const Eigen::Vector3d in_cam = r * place + t;
      const Eigen::Vector2d pixel(ax * in_cam.x() / in_cam.z() + w * ppx,
                                  ay * in_cam.y() / in_cam.z() + h * ppy);
      EXPECT_LT((pixel - *Project(camera, place)).norm(), 1e-3) << turns;
    }
  }
}

TEST(Metashape, ItsFrameCameraGivesThePixel) {
  const Camera camera = LensCamera();
  const TemporaryFolder folder;
  const auto file =
      folder.Write("c.xml", FormatMetashape(SceneOf(camera), folder / "c.xml")[0].bytes);
  const XmlElement root = ReadXml(file);
  const XmlElement& chunk = *root.Child("chunk");
  const XmlElement& lens = *chunk.Child("sensors")->Child("sensor")->Child("calibration");
  const XmlElement& transform = *chunk.Child("cameras")->Child("camera")->Child("transform");
  const std::vector<double> m = ReadXmlNumbers(file, transform, transform.text);
  const auto k = [&](const char* name) { return std::stod(lens.ChildText(name)); };
  Eigen::Matrix4d chunk_from_cam;
  for (int i = 0; i < 16; ++i) chunk_from_cam(i / 4, i % 4) = m[i];
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    // Metashape's manual, appendix C.
    const Eigen::Vector4d in_cam = chunk_from_cam.inverse() * place.homogeneous();
    const double x = in_cam.x() / in_cam.z();
    const double y = in_cam.y() / in_cam.z();
    const double r2 = x * x + y * y;
    const double s = 1 + k("k1") * r2 + k("k2") * r2 * r2 + k("k3") * r2 * r2 * r2;
    const double xd = x * s + k("p1") * (r2 + 2 * x * x) + 2 * k("p2") * x * y;
    const double yd = y * s + k("p2") * (r2 + 2 * y * y) + 2 * k("p1") * x * y;
    const Eigen::Vector2d pixel(600 + k("cx") + xd * k("f") + xd * k("b1"),
                                400 + k("cy") + yd * k("f"));
    EXPECT_LT((pixel - *Project(camera, place)).norm(), kSamePx);
  }
}

TEST(RealityCapture, ACentredPictureHasOneReadingOnly) {
  const Camera camera = PreparedCamera(OffCentreCamera(), {true, true, true});
  const TemporaryFolder folder;
  const auto file =
      folder.Write("s3.xmp", FormatRealityCapture(SceneOf(camera), folder.path())[0].bytes);
  const XmlElement root = ReadXml(file);
  const XmlElement& described = *root.Child("RDF")->Child("Description");
  const std::vector<double> r = ReadXmlNumbers(file, described, described.ChildText("Rotation"));
  const std::vector<double> c = ReadXmlNumbers(file, described, described.ChildText("Position"));
  const double focal = std::stod(described.Attribute("FocalLength35mm")) / 36 * camera.width_px;
  for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
    Eigen::Vector3d in_cam = Eigen::Vector3d::Zero();
    for (int i = 0; i < 9; ++i) in_cam[i / 3] += r[i] * (place[i % 3] - c[i % 3]);
    const Eigen::Vector2d pixel = focal * in_cam.head<2>() / in_cam.z() +
                                  Eigen::Vector2d(camera.width_px, camera.height_px) / 2;
    EXPECT_LT((pixel - *Project(camera, place)).norm(), kSamePx);
  }
}

Eigen::Matrix3d Turn(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(RadiansFromDegrees(degrees), axis).toRotationMatrix();
}

TEST(RealityCaptureCsv, ItsTableGivesThePixelOfACentredPicture) {
  // Off the middle, with oblong pixels and a lens: what is written is the picture made anew. Level,
  // where heading and roll are one, too.
  Camera level = OffCentreCamera();
  level.cam_from_world.rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  for (const Camera& given : {LensCamera(), TurnedCamera(OffCentreCamera(), 1), level}) {
    const Camera camera = PreparedCamera(given, {true, true, true});
    std::istringstream text(FormatRealityCaptureCsv(SceneOf(camera), "/t")[0].bytes);
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "#name,x,y,alt,heading,pitch,roll,f,px,py,k1,k2,k3,k4,t1,t2");
    std::getline(text, line, ',');
    EXPECT_EQ(line, "s3.jpg");
    std::vector<double> v;
    while (std::getline(text, line, ',')) v.push_back(std::stod(line));
    ASSERT_EQ(v.size(), 15u);
    const Eigen::Matrix3d world_from_gl = Turn(Eigen::Vector3d::UnitZ(), -v[3]) *
                                          Turn(Eigen::Vector3d::UnitX(), v[4]) *
                                          Turn(Eigen::Vector3d::UnitY(), v[5]);
    const double focal = v[6] / 36 * std::max(camera.width_px, camera.height_px);
    for (const Eigen::Vector3d& place : PlacesBefore(camera)) {
      const Eigen::Vector3d in_gl =
          world_from_gl.transpose() * (place - Eigen::Vector3d(v[0], v[1], v[2]));
      const Eigen::Vector2d pixel(camera.width_px / 2.0 + focal * in_gl.x() / -in_gl.z(),
                                  camera.height_px / 2.0 - focal * in_gl.y() / -in_gl.z());
      EXPECT_LT((pixel - *Project(camera, place)).norm(), kSamePx);
    }
    for (size_t i = 7; i < 15; ++i) EXPECT_EQ(v[i], 0);
  }
}

TEST(RealityCaptureCsv, AnExportOfItsOwnHasTheseAngles) {
  // One camera as its XMP and its table had it (its maker's forum, thread 710449).
  Camera camera = OffCentreCamera();
  Eigen::Matrix3d& r = camera.cam_from_world.rotation;
  r.row(0) << 0.982594073038806, 0.185426733553445, -0.0112166890261935;
  r.row(1) << -0.032113633044729, 0.11008102707942, -0.993403685341366;
  r.row(2) = r.row(0).cross(r.row(1));
  const HeadingPitchRoll angles = HeadingPitchRollOf(camera);
  EXPECT_NEAR(angles.heading_deg, 163.736597399311, 1e-9);
  EXPECT_NEAR(angles.pitch_deg, 83.4154313461628, 1e-9);
  EXPECT_NEAR(angles.roll_deg, 174.386496244756, 1e-9);
}

TEST(ColmapBinary, IsWhatTheTextModelSays) {
  const TemporaryFolder folder;
  ExchangeScene scene = SceneOf(LensCamera());
  scene.cameras.push_back({"a", "north/a.jpg", OffCentreCamera(), {}});
  scene.cameras.back().camera.k3 = 0.001;
  WriteColmapModel(folder / "text",
                   {{"s3.jpg", scene.cameras[0].camera}, {"north/a.jpg", scene.cameras[1].camera}});
  WriteFilesAtomically(FormatColmapBinary(scene, folder / "binary"));
  const std::vector<NamedCamera> text = ReadColmapModel(folder / "text");
  const std::vector<NamedCamera> binary = ReadColmapModel(folder / "binary");
  ASSERT_EQ(binary.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(binary[i].name, text[i].name);
    EXPECT_LT(LargestMiss(text[i].camera, binary[i].camera), kSamePx);
    EXPECT_EQ(binary[i].camera.k3, text[i].camera.k3);
  }
}

TEST(ColmapBinary, ColmapItselfGivesTheTextBack) {
  const TemporaryFolder folder;
  const ExchangeScene scene = SceneOf(LensCamera());
  WriteFilesAtomically(FormatColmapBinary(scene, folder / "binary"));
  std::filesystem::create_directories(folder / "text");
  try {
    const ProgramResult result =
        RunProgram({"colmap",
                    "model_converter",
                    "--input_path",
                    folder / "binary",
                    "--output_path",
                    folder / "text",
                    "--output_type",
                    "TXT"},
                   {.environment = {{"QT_QPA_PLATFORM", "offscreen"}}, .package = {}});
    ASSERT_EQ(result.exit_code, 0) << LastWords(result);
  } catch (const Error&) {
    GTEST_SKIP() << "colmap is not installed";
  }
  const std::vector<NamedCamera> read = ReadColmapModel(folder / "text");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "s3.jpg");
  EXPECT_LT(LargestMiss(LensCamera(), read[0].camera), kSamePx);
}

TEST(CameraFormats, DamagedFilesAreErrorsWithTheirPlace) {
  const TemporaryFolder folder;
  const auto message = [&](const char* name, const std::string& text) {
    return ThrownMessage([&] { ReadExchangeSource(folder.Write(name, text), {}); });
  };
  EXPECT_THAT(message("a.json", "{\"frames\": [{}]}"),
              HasSubstr("a.json: frame 1: has no file_path"));
  EXPECT_THAT(message("a.json", "{\"frames\":\n [}"),
              HasSubstr("a.json: is not as nerfstudio writes transforms.json: line 2, column 3: "
                        "unexpected '}'"));
  EXPECT_THAT(message("a.json", "{}"), HasSubstr("'frames' is missing"));
  EXPECT_THAT(message("a.fspy", "fspy"), HasSubstr("does not begin with fspy"));
  EXPECT_THAT(message("a.mlp", "<a>\n<MLRaster/></a>"),
              HasSubstr("a.mlp:2: <MLRaster> has no <VCGCamera>"));
  EXPECT_THAT(
      message("a.xml", "<a>\n<camera sensor_id='7'><transform>1 2</transform></camera></a>"),
      HasSubstr("a.xml:2: <camera> names a sensor that is not there"));
  EXPECT_THAT(ThrownMessage([&] { ReadXml(folder.Write("b.xml", "<a>\n<b></a>")); }),
              HasSubstr("b.xml:2: </a> ends <b>"));
  EXPECT_THAT(ThrownMessage([&] { ReadXml(folder.Write("c.xml", "<a>&what;</a>")); }),
              HasSubstr("c.xml:1: no such entity"));
}

TEST(CameraExchange, PicturesThatAFormatCannotHoldAreWrittenAnewWithMasks) {
  const TemporaryFolder folder;
  WriteSrgb8(folder / "photos/s3.jpg", Image8(300, 200, 3, 128));
  ExchangeSource source;
  source.cameras = {{"s3.jpg", ResizedCamera(OffCentreCamera(), 300, 200)}};
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("realitycapture", source, folder / "rc"); }),
              HasSubstr("say with --images where the photographs are"));
  source.images = folder / "photos";
  const ExchangeResult result = WriteCamerasAs("realitycapture", source, folder / "rc");
  EXPECT_THAT(result.summary, HasSubstr("1 picture resampled"));
  const Image8 picture = ReadSrgb8(folder / "rc/s3.jpg");
  const Image8 mask = ReadSrgb8(folder / "rc/masks/s3.png");
  EXPECT_EQ(picture.width, mask.width);
  EXPECT_GT(picture.width, 300);
  // The camera looked 35 px left of the middle: what is added is at the left.
  EXPECT_EQ(*mask.At(5, picture.height / 2), 0);
  EXPECT_EQ(*mask.At(picture.width - 5, picture.height / 2), 255);
  EXPECT_TRUE(std::filesystem::exists(folder / "rc/s3.xmp"));
  // Files that lie in one folder have pictures of their own.
  source.cameras[0].camera.k1 = -0.1;
  WriteCamerasAs("meshlab", source, folder / "both/hall.mlp");
  WriteCamerasAs("blender", source, folder / "both/hall.py");
  EXPECT_TRUE(std::filesystem::exists(folder / "both/hall_meshlab_images/s3.jpg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "both/hall_meshlab_masks/s3.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "both/hall_blender_images/s3.jpg"));
  EXPECT_THAT(ReadTextFile(folder / "both/hall.mlp"), HasSubstr("hall_meshlab_images/s3.jpg"));
  // A format that can hold it takes the photograph as it is.
  WriteCamerasAs("nerfstudio", source, folder / "n/transforms.json");
  EXPECT_THAT(ReadTextFile(folder / "n/transforms.json"), HasSubstr("\"../photos/s3.jpg\""));
}

}  // namespace
}  // namespace groundglass
