// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colmap_io.h"
#include "scene/formats/convert.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/pose_check.h"
#include "scene/formats/view_io.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// What other programs wrote.
const std::string kOutside = std::string(GROUNDGLASS_SOURCE_DIR) + "/tests/data/colmap/";
// The brick scene's true cameras, through COLMAP's model_converter.
const std::string kBinary = std::string(GROUNDGLASS_SOURCE_DIR) + "/tests/data/colmap_binary";

const std::string kImage = "1 1 0 0 0 1 2 3 1 a.jpg\n\n";

std::string Message(const std::string& cameras, const std::string& images = kImage) {
  const TemporaryFolder folder;
  folder.Write("cameras.txt", cameras);
  folder.Write("images.txt", images);
  return ThrownMessage([&] { ReadColmapModel(folder.path()); });
}

void ExpectSameLens(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.focal_x_px, b.focal_x_px);
  EXPECT_EQ(a.focal_y_px, b.focal_y_px);
  EXPECT_EQ(a.center_x_px, b.center_x_px);
  EXPECT_EQ(a.center_y_px, b.center_y_px);
  EXPECT_EQ(a.k1, b.k1);
  EXPECT_EQ(a.k2, b.k2);
  EXPECT_EQ(a.k3, b.k3);
  EXPECT_EQ(a.p1, b.p1);
  EXPECT_EQ(a.p2, b.p2);
}

TEST(ColmapLens, TangentialTermsAreRead) {
  const std::vector<NamedCamera> cameras = ReadColmapModel(kOutside + "opencv_small_tangential");
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[1].camera.k2, 0.003);
  EXPECT_EQ(cameras[1].camera.p1, 0.00012);
  EXPECT_EQ(cameras[1].camera.p2, -0.00031);
}

TEST(ColmapLens, FullOpencvWithAZeroTailIsOpencv) {
  const std::vector<NamedCamera> cameras = ReadColmapModel(kOutside + "full_opencv_zero_tail");
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[0].camera.k1, -0.012);
  EXPECT_EQ(cameras[0].camera.k3, 0);
}

TEST(ColmapLens, AllOfItSurvivesTheWayThroughFiles) {
  const TemporaryFolder folder;
  std::vector<NamedCamera> written = ReadColmapModel(kOutside + "opencv_small_tangential");
  written[2].camera.k3 = -0.0007;
  WriteColmapModel(folder / "a", written);
  EXPECT_THAT(ReadTextFile(folder / "a/cameras.txt"),
              AllOf(HasSubstr("1 OPENCV 1200"), HasSubstr("3 FULL_OPENCV 1200")));
  const std::vector<NamedCamera> read = ReadColmapModel(folder / "a");
  for (size_t i = 0; i < read.size(); ++i) ExpectSameLens(read[i].camera, written[i].camera);

  // As view files too.
  ConvertColmapToViews(folder / "a", folder / "views", 50);
  EXPECT_THAT(ReadTextFile(folder / "views/s7.view"),
              AllOf(HasSubstr("\nk3 -7e-04\n"), HasSubstr("\np1 0.00012\n")));
  const Camera again = CameraFromTag(ReadView(folder / "views/s7.view"), 1200, 800);
  EXPECT_EQ(again.k3, -0.0007);
  EXPECT_EQ(again.p2, -0.00031);
  EXPECT_NEAR(again.center_x_px, written[2].camera.center_x_px, 1e-9);
  EXPECT_LT((again.PositionInWorld() - written[2].camera.PositionInWorld()).norm(), 1e-10);
}

TEST(ColmapLens, WhatIsOutOfReachIsNamedWithTheCommandThatHelps) {
  const std::string fisheye = Message("1 OPENCV_FISHEYE 640 480 500 500 320 240 0 0 0 0");
  EXPECT_THAT(fisheye, HasSubstr("cameras.txt:1: camera model 'OPENCV_FISHEYE' is not read"));
  EXPECT_THAT(fisheye, HasSubstr("colmap image_undistorter --image_path"));
  EXPECT_THAT(Message("1 THIN_PRISM_FISHEYE 640 480 500 500 320 240 0 0 0 0 0 0 0 0"),
              HasSubstr("image_undistorter"));
  EXPECT_THAT(Message("1 FOV 640 480 500 500 320 240 0.9"), HasSubstr("image_undistorter"));
  EXPECT_THAT(Message("1 FULL_OPENCV 640 480 500 500 320 240 0 0 0 0 0 0.1 0 -0.2"),
              AllOf(HasSubstr("k4, k5 and k6 are 0; here they are 0.1, 0, -0.2"),
                    HasSubstr("image_undistorter")));
  // One that no picture was taken with does no harm.
  EXPECT_EQ(Message("2 FOV 640 480 500 500 320 240 0.9\n1 PINHOLE 640 480 500 500 320 240"),
            "nothing was thrown");
}

TEST(ColmapPoses, SwappedColumnsAreTold) {
  EXPECT_THAT(
      ThrownMessage([] { ReadColmapModel(kOutside + "quaternion_and_translation_swapped"); }),
      AllOf(HasSubstr("images.txt:2: the quaternion QW QX QY QZ has length 78"),
            HasSubstr("columns swapped? TX TY TZ seem to stand before it")));
  const std::string camera = "1 PINHOLE 640 480 500 500 320 240";
  EXPECT_THAT(Message(camera, "1 1 1 0 0 1 2 3 1 a.jpg\n\n"), HasSubstr("columns swapped?"));
  EXPECT_EQ(Message(camera, "1 0.999 0 0 0 1 2 3 1 a.jpg\n\n"), "nothing was thrown");
}

std::vector<Camera> PosesOf(const std::vector<NamedCamera>& named) {
  std::vector<Camera> cameras;
  for (const NamedCamera& camera : named) cameras.push_back(camera.camera);
  return cameras;
}

TEST(ColmapPoses, TheWrongWayRoundIsTold) {
  const PolygonModel model = ReadOsu(kBrick / "model.osu").model;
  const PoseCheck check = CheckPoses(model, PosesOf(ReadColmapModel(kOutside + "camera_to_world")));
  EXPECT_EQ(check.num_seeing, 0);
  EXPECT_THAT(check.fault,
              AllOf(HasSubstr("none of 3 cameras see the model, but 3 would"),
                    HasSubstr("they look like world_from_cam"),
                    HasSubstr("COLMAP wants cam_from_world")));
}

TEST(ColmapPoses, OtherHabitsAreToldApart) {
  const PolygonModel model = ReadOsu(kBrick / "model.osu").model;
  const std::vector<Camera> truth = PosesOf(ReadColmapModel(kBrick / "truth/cameras"));
  const auto fault = [&](auto spoil) {
    std::vector<Camera> cameras = truth;
    for (Camera& camera : cameras) spoil(camera.cam_from_world);
    return CheckPoses(model, cameras).fault;
  };
  EXPECT_EQ(fault([](RigidTransform&) {}), "");
  EXPECT_THAT(fault([](RigidTransform& pose) { pose = Inverse(pose); }),
              HasSubstr("they look like world_from_cam"));
  EXPECT_THAT(fault([](RigidTransform& pose) { pose.translation = Inverse(pose).translation; }),
              HasSubstr("TX TY TZ were the cameras' positions"));
  EXPECT_THAT(fault([](RigidTransform& pose) {
                const Eigen::Vector3d flip(1, -1, -1);
                pose = {flip.asDiagonal() * pose.rotation, flip.asDiagonal() * pose.translation};
              }),
              HasSubstr("OpenGL"));
  EXPECT_THAT(fault([](RigidTransform& pose) {
                const Eigen::Quaterniond q(pose.rotation);
                // Written x y z w and read as w x y z.
                pose.rotation = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
              }),
              HasSubstr("w last"));
  // COLMAP's own frame: another place, turn and scale altogether.
  EXPECT_THAT(
      fault([](RigidTransform& pose) { pose.translation += Eigen::Vector3d(1e4, 2e4, -3e4); }),
      HasSubstr("colmap model_aligner"));
}

TEST(ColmapBinary, IsReadAsTheTextIs) {
  const std::vector<NamedCamera> text = ReadColmapModel(kBrick / "truth/cameras");
  const std::vector<NamedCamera> binary = ReadColmapModel(kBinary);
  ASSERT_EQ(binary.size(), text.size());
  for (const NamedCamera& a : binary) {
    for (const NamedCamera& b : text) {
      if (a.name != b.name) continue;
      ExpectSameLens(a.camera, b.camera);
      EXPECT_LT((a.camera.PositionInWorld() - b.camera.PositionInWorld()).norm(), 1e-9);
      EXPECT_LT((a.camera.cam_from_world.rotation - b.camera.cam_from_world.rotation).norm(),
                1e-12);
    }
  }
}

TEST(ColmapBinary, CutAnywhereItIsAOneLineError) {
  const std::string cameras = ReadFileBytes(kBinary + "/cameras.bin");
  const std::string images = ReadFileBytes(kBinary + "/images.bin");
  const TemporaryFolder folder;
  for (const bool cut_images : {false, true}) {
    const std::string& whole = cut_images ? images : cameras;
    folder.Write("cameras.bin", cameras);
    folder.Write("images.bin", images);
    for (size_t size = 0; size < whole.size(); size += 7) {
      folder.Write(cut_images ? "images.bin" : "cameras.bin", whole.substr(0, size));
      const std::string message = ThrownMessage([&] { ReadColmapModel(folder.path()); });
      EXPECT_THAT(message, HasSubstr("cut short"));
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
  folder.Write("images.bin", images + "more");
  EXPECT_THAT(ThrownMessage([&] { ReadColmapModel(folder.path()); }),
              HasSubstr("4 bytes follow the last record"));
}

TEST(ColmapBinary, CountsAndKindsThatCannotBeAreErrors) {
  const TemporaryFolder folder;
  std::string cameras = ReadFileBytes(kBinary + "/cameras.bin");
  folder.Write("images.bin", ReadFileBytes(kBinary + "/images.bin"));
  std::memset(cameras.data(), 0xff, 8);  // 2^64 - 1 cameras
  folder.Write("cameras.bin", cameras);
  EXPECT_THAT(ThrownMessage([&] { ReadColmapModel(folder.path()); }), HasSubstr("cut short"));
  cameras = ReadFileBytes(kBinary + "/cameras.bin");
  cameras[12] = 99;  // the first camera's model
  folder.Write("cameras.bin", cameras);
  EXPECT_THAT(ThrownMessage([&] { ReadColmapModel(folder.path()); }),
              HasSubstr("camera model number 99 is not read"));
}

TEST(FindColmapModel, LooksWhereColmapPutsIt) {
  const TemporaryFolder folder;
  EXPECT_FALSE(FindColmapModel(folder.path()));
  EXPECT_FALSE(FindColmapModel(folder / "nowhere"));
  const auto copy = [&](const std::string& to) {
    fs::create_directories(folder / to);
    for (const char* name : {"cameras.bin", "images.bin"}) {
      fs::copy_file(fs::path(kBinary) / name, folder / to / name);
    }
  };
  copy("project/sparse/0");
  const fs::path expected = folder / "project/sparse/0/images.bin";
  for (const char* given : {"project", "project/sparse", "project/sparse/0"}) {
    ASSERT_TRUE(FindColmapModel(folder / given)) << given;
    EXPECT_EQ(FindColmapModel(folder / given)->images_file, expected);
  }
  copy("project/sparse/1");
  EXPECT_THAT(ThrownMessage([&] { FindColmapModel(folder / "project"); }),
              AllOf(HasSubstr("holds 2 COLMAP models"), HasSubstr("sparse/0")));
  copy("half");
  fs::remove(folder / "half/cameras.bin");
  EXPECT_THAT(ThrownMessage([&] { FindColmapModel(folder / "half"); }),
              HasSubstr("has images.bin but no cameras.bin"));
  copy("both");
  folder.Write("both/cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  folder.Write("both/images.txt", kImage);
  EXPECT_EQ(FindColmapModel(folder / "both")->images_file, folder / "both/images.txt");
  EXPECT_EQ(FindColmapModel(folder / "both")->warnings.size(), 1u);
}

TEST(ConvertCameras, EqualNamesInFoldersGetTwoNames) {
  const TemporaryFolder folder;
  ConvertColmapToViews(kOutside + "same_name_in_two_folders", folder / "views", 50);
  const Camera north = CameraFromTag(ReadView(folder / "views/north_0001.view"), 1200, 800);
  const Camera east = CameraFromTag(ReadView(folder / "views/east_0001.view"), 1200, 800);
  const Camera south = CameraFromTag(ReadView(folder / "views/south_0001.view"), 1200, 800);
  EXPECT_GT((north.PositionInWorld() - east.PositionInWorld()).norm(), 1);
  EXPECT_GT((south.PositionInWorld() - east.PositionInWorld()).norm(), 1);
}

TEST(ConvertCameras, AFaultLeavesNothingWritten) {
  const TemporaryFolder folder;
  folder.Write("in/cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  folder.Write("in/images.txt",
               "1 1 0 0 0 1 2 3 1 b.jpg\n\n2 1 0 0 0 1 2 3 1 a.jpg\n\n3 1 0 0 0 1 2 3 1 a.png\n\n");
  EXPECT_THAT(ThrownMessage([&] { ConvertColmapToViews(folder / "in", folder / "out", 50); }),
              HasSubstr("images 'a.jpg' and 'a.png' would have the same view file"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace groundglass
