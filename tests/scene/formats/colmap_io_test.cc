// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colmap_io.h"

#include "scene/formats/colmap_names.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/visibility.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>

namespace groundglass {
namespace {

using testing::HasSubstr;

std::vector<NamedCamera> SampleCameras() {
  std::vector<NamedCamera> cameras;
  for (int i = 0; i < 3; ++i) {
    ViewTag tag = ParseView("x 232 y -104 z 4.5 i 104 j -2 k 33.1 a 1.5 v 58", "s5.view");
    tag.position_in_site.x() += i;
    tag.roll_deg = 100 * i;
    tag.shift_x = 0.01 / 3;
    tag.k1 = -0.01 * i;
    tag.k2 = 0.001;
    cameras.push_back({"s " + std::to_string(i) + ".jpg", CameraFromTag(tag, 1500, 1000)});
  }
  return cameras;
}

TEST(ColmapModel, RoundTrips) {
  const TemporaryFolder folder;
  const std::vector<NamedCamera> written = SampleCameras();
  WriteColmapModel(folder / "cameras", written);
  const std::vector<NamedCamera> read = ReadColmapModel(folder / "cameras");
  ASSERT_EQ(read.size(), written.size());
  for (size_t i = 0; i < read.size(); ++i) {
    const Camera& a = written[i].camera;
    const Camera& b = read[i].camera;
    EXPECT_EQ(read[i].name, written[i].name);
    EXPECT_EQ(b.width_px, a.width_px);
    EXPECT_EQ(b.height_px, a.height_px);
    EXPECT_EQ(b.focal_x_px, a.focal_x_px);
    EXPECT_EQ(b.focal_y_px, a.focal_y_px);
    EXPECT_EQ(b.center_x_px, a.center_x_px);
    EXPECT_EQ(b.center_y_px, a.center_y_px);
    EXPECT_EQ(b.k1, a.k1);
    EXPECT_EQ(b.k2, a.k2);
    EXPECT_EQ(b.cam_from_world.translation, a.cam_from_world.translation);
    EXPECT_LT((b.cam_from_world.rotation - a.cam_from_world.rotation).norm(), 1e-14);
  }
  // Once it has been through a quaternion nothing moves any more.
  WriteColmapModel(folder / "again", read);
  WriteColmapModel(folder / "third", ReadColmapModel(folder / "again"));
  EXPECT_EQ(ReadTextFile(folder / "again/cameras.txt"), ReadTextFile(folder / "third/cameras.txt"));
}

TEST(ColmapModel, NumbersImagesAsColmapsDatabaseDoes) {
  // By the byte order of their names, whatever the order of the lines.
  const TemporaryFolder folder;
  const Camera camera = SampleCameras()[0].camera;
  WriteColmapModel(folder.path(), {{"s2.jpg", camera}, {"s10.jpg", camera}});
  const std::string images = ReadTextFile(folder / "images.txt");
  EXPECT_THAT(images, HasSubstr("\n2 "));
  EXPECT_THAT(images, HasSubstr(" 2 s2.jpg\n\n1 "));
  EXPECT_THAT(images, HasSubstr(" 1 s10.jpg\n"));
  EXPECT_EQ(ReadColmapModel(folder.path())[0].name, "s2.jpg");
}

TEST(ColmapModel, NamesWithBlanksAreTold) {
  EXPECT_TRUE(TellNamesWithBlanks("out", {"s1.jpg", "north/s2.jpg"}).empty());
  EXPECT_THAT(TellNamesWithBlanks("out", {"a b.jpg", "s1.jpg", "c d.jpg", "e f.jpg", "g h.jpg"}),
              testing::ElementsAre(testing::AllOf(
                  testing::HasSubstr("out/images.txt: COLMAP itself reads names of images only up "
                                     "to a blank: 'a b.jpg', 'c d.jpg', 'e f.jpg' and 1 more"),
                  testing::HasSubstr("--to colmap-binary"))));
}

TEST(ColmapModel, ColmapItselfReadsIt) {
  if (std::system("command -v colmap > /dev/null 2>&1") != 0) GTEST_SKIP() << "no colmap here";
  const TemporaryFolder folder;
  WriteColmapModel(folder / "cameras", SampleCameras());
  const std::string command = "QT_QPA_PLATFORM=offscreen colmap model_analyzer --path '" +
                              (folder / "cameras").string() + "' > '" + (folder / "log").string() +
                              "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string log = ReadTextFile(folder / "log");
  EXPECT_THAT(log, HasSubstr("Cameras: 3"));
  EXPECT_THAT(log, HasSubstr("Registered images: 3"));
}

TEST(ColmapModel, ReadsEveryCameraModelThatFits) {
  const TemporaryFolder folder;
  folder.Write(
      "cameras.txt",
      "# comment\n1 SIMPLE_PINHOLE 640 480 500 320 240\n2 PINHOLE 640 480 500 510 320 240\n"
      "3 SIMPLE_RADIAL 640 480 500 320 240 -0.1\n4 RADIAL 640 480 500 320 240 -0.1 0.01\n"
      "5 OPENCV 640 480 500 510 320 240 -0.1 0.01 0 0\n");
  std::string images = "# comment\n";
  for (int i = 1; i <= 5; ++i) {
    const std::string id = std::to_string(i);
    images += id + " 1 0 0 0 1 2 3 " + id + " " + id + ".jpg\n10.5 20.5 -1 30 40 7\n";
  }
  folder.Write("images.txt", images);
  const std::vector<NamedCamera> cameras = ReadColmapModel(folder.path());
  ASSERT_EQ(cameras.size(), 5u);
  EXPECT_EQ(cameras[0].camera.focal_y_px, 500);
  EXPECT_EQ(cameras[1].camera.focal_y_px, 510);
  EXPECT_EQ(cameras[2].camera.k1, -0.1);
  EXPECT_EQ(cameras[3].camera.k2, 0.01);
  EXPECT_EQ(cameras[4].camera.center_y_px, 240);
}

TEST(ColmapModel, BadOnesGiveOneLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& cameras, const std::string& images) {
    folder.Write("cameras.txt", cameras);
    folder.Write("images.txt", images);
    return ThrownMessage([&] { ReadColmapModel(folder.path()); });
  };
  const std::string good_camera = "1 PINHOLE 640 480 500 510 320 240\n";
  const std::string good_image = "1 1 0 0 0 1 2 3 1 a.jpg\n\n";
  EXPECT_EQ(message(good_camera, good_image), "nothing was thrown");
  EXPECT_THAT(message("1 FISHEYE 640 480 1 2 3", good_image),
              HasSubstr("cameras.txt:1: camera model 'FISHEYE' is not read"));
  EXPECT_THAT(message("1 PINHOLE 640 480 1 2 3", good_image),
              HasSubstr("cameras.txt:1: PINHOLE has 4 parameters, not 3"));
  EXPECT_THAT(message("1 PINHOLE 640 99999999999 1 2 3 4", good_image),
              HasSubstr("cameras.txt:1: an image of 640 x 99999999999 pixels cannot be"));
  EXPECT_THAT(message(good_camera + good_camera, good_image),
              HasSubstr("cameras.txt:2: camera 1 is repeated"));
  EXPECT_THAT(message(good_camera, "1 1 0 0 0 1 2 3 9 a.jpg\n\n"),
              HasSubstr("images.txt:1: camera 9 is not in cameras.txt"));
  EXPECT_THAT(message(good_camera, "1 0 0 0 0 1 2 3 1 a.jpg\n\n"),
              HasSubstr("images.txt:1: the quaternion is zero"));
  EXPECT_THAT(message(good_camera, "1 1 0 0 0 1 2 x 1 a.jpg\n\n"),
              HasSubstr("images.txt:1: TZ: 'x' is not a finite number"));
  EXPECT_THAT(message(good_camera, "1 1 0 0 0 1 2 3 1\n\n"),
              HasSubstr("images.txt:1: expected image name"));
  EXPECT_THAT(message(good_camera, good_image + good_image),
              HasSubstr("images.txt:3: image 'a.jpg' is repeated"));
  EXPECT_THAT(message(good_camera, "1 1 0 0 0 1 2 3 1 a.jpg\n2 1 0 0 0 1 2 3 1 b.jpg\n"),
              HasSubstr("images.txt:2: expected the image's points"));
  EXPECT_THAT(message(good_camera, "# none\n"), HasSubstr("no images in this model"));
}

// The brick scene's truth, made by another program, ties our frames to the world outside.

TEST(BrickTruth, CamerasAgreeWithTheMatricesFromSiteToScan) {
  const PolygonModel model = ReadOsu(kBrick / "model.osu").model;
  std::ifstream in(kBrick / "truth/truth.json");
  const nlohmann::json truth = nlohmann::json::parse(in);
  const std::vector<NamedCamera> cameras = ReadColmapModel(kBrick / "truth/cameras");
  ASSERT_EQ(cameras.size(), 12u);
  for (const NamedCamera& named : cameras) {
    const nlohmann::json* view = nullptr;
    for (const nlohmann::json& candidate : truth.at("views")) {
      if (candidate.at("name").get<std::string>() + ".jpg" == named.name) view = &candidate;
    }
    ASSERT_NE(view, nullptr) << named.name;
    Eigen::Matrix<double, 3, 4> image_from_site;
    const nlohmann::json& rows = view->at("P34_LHworld_to_scan_px");
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        image_from_site(row, column) = rows.at(row).at(column).get<double>();
      }
    }
    for (const Eigen::Vector3d& point : model.points_in_world) {
      const auto image = Project(named.camera, point);
      if (!image || !IsInsideFrame(named.camera, *image)) continue;
      const Eigen::Vector3d expected = image_from_site * SiteFromWorld(point).homogeneous();
      // COLMAP's cameras have no skew; leaving it out costs up to 0.08 px.
      EXPECT_LT((*image - expected.hnormalized()).norm(), 0.1) << named.name;
    }
  }
}

TEST(BrickTruth, ModelSeenThroughTheTrueCamerasCoversTheTrueMasks) {
  const PolygonModel model = ReadOsu(kBrick / "model.osu").model;
  const Visibility visibility(model);
  for (const NamedCamera& named : ReadColmapModel(kBrick / "truth/cameras")) {
    if (named.name != "s1.jpg" && named.name != "s8.jpg") continue;
    const std::string stem = named.name.substr(0, named.name.size() - 4);
    const Image16 truth = ReadLabels(kBrick / "truth/masks_model" / (stem + ".png"));
    const Image16 labels = visibility.FaceLabels(named.camera);
    ASSERT_EQ(labels.values.size(), truth.values.size());
    size_t num_equal = 0;
    for (size_t i = 0; i < labels.values.size(); ++i)
      num_equal += labels.values[i] == truth.values[i];
    // Pixels on the border of two faces may fall to either.
    EXPECT_GT(static_cast<double>(num_equal), 0.998 * static_cast<double>(truth.values.size()))
        << named.name;
  }
}

TEST(SceauxTruth, TagsLookTheWayOfTheReferenceCameras) {
  const char* data = std::getenv("GROUNDGLASS_DATA");
  const std::filesystem::path folder =
      (data != nullptr ? std::filesystem::path(data)
                       : std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "../shared/data") /
      "sceaux";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no " << folder;
  const Scene scene = ReadScene(folder);
  EXPECT_EQ(scene.model.unit, LengthUnit::kMetre);
  const std::vector<NamedCamera> cameras = ReadColmapModel(folder / "truth/cameras");
  ASSERT_EQ(scene.photographs.size(), cameras.size());
  for (const Photograph& photograph : scene.photographs) {
    const Camera measured =
        CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height);
    for (const NamedCamera& named : cameras) {
      if (named.name != photograph.image_file.filename()) continue;
      // Hand tags: a fraction of a metre and a few degrees at most.
      EXPECT_LT((measured.PositionInWorld() - named.camera.PositionInWorld()).norm(), 0.7);
      EXPECT_GT(measured.ForwardInWorld().dot(named.camera.ForwardInWorld()), 0.999);
    }
  }
}

}  // namespace
}  // namespace groundglass
