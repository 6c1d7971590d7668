// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/given_cameras.h"

#include "scene/formats/image_paths.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(NamePhotographs, TakeTheirFoldersWhereTheStemIsNotEnough) {
  EXPECT_THAT(NamePhotographs({"s1.jpg", "north/s2.jpg"}), ElementsAre("s1", "s2"));
  EXPECT_THAT(NamePhotographs({"north/0001.jpg", "east/0001.jpg", "east/0002.jpg"}),
              ElementsAre("north_0001", "east_0001", "0002"));
  EXPECT_THAT(NamePhotographs({"a/b/0001.jpg", "0001.jpg"}), ElementsAre("a_b_0001", "0001"));
  // A name that is taken already stays with whom it belongs to.
  EXPECT_THAT(NamePhotographs({"north/0001.jpg", "east/0001.jpg", "north_0001.jpg"}),
              ElementsAre("north_0001_2", "east_0001", "north_0001"));
  EXPECT_THAT(NamePhotographs({"a.jpg", "a.png"}), ElementsAre("a", "a"));
}

TEST(ImagePathFinder, FoldersAndExtensionHelpAsFarAsTheyCan) {
  const std::vector<std::string> paths = {"north/0001.jpg", "east/0001.jpg", "s5.JPG"};
  const ImagePathFinder finder(paths);
  EXPECT_EQ(finder.Find("north/0001.jpg"), 0u);
  EXPECT_EQ(finder.Find("east\\0001.jpg"), 1u);
  EXPECT_EQ(finder.Find("/home/me/project/images/east/0001.jpg"), 1u);
  EXPECT_EQ(finder.Find("east/0001.png"), 1u);
  EXPECT_EQ(finder.Find("0001.jpg"), std::nullopt);
  EXPECT_EQ(finder.Find("s5.jpg"), 2u);
  EXPECT_EQ(finder.Find("s5"), 2u);
  EXPECT_EQ(finder.Find("s6.jpg"), std::nullopt);
}

Camera SampleCamera(int width, int height) {
  Camera camera;
  camera.width_px = width;
  camera.height_px = height;
  camera.focal_x_px = camera.focal_y_px = width;
  camera.center_x_px = width / 2.0;
  camera.center_y_px = height / 2.0;
  return camera;
}

TEST(FitCamera, ScalesToTheSameShapeAndRefusesAnother) {
  EXPECT_EQ(FitCamera(SampleCamera(600, 400), {600, 400}, "a.jpg").change, "");
  const FittedCamera half = FitCamera(SampleCamera(600, 400), {301, 200}, "a.jpg");
  EXPECT_NEAR(half.camera.focal_x_px, 301, 1e-9);
  EXPECT_NEAR(half.camera.focal_y_px, 300, 1e-9);
  EXPECT_THAT(half.change, HasSubstr("scaled from 600 x 400 to 301 x 200"));
  EXPECT_THAT(ThrownMessage([] {
                FitCamera(SampleCamera(600, 400), {640, 480}, "a.jpg");
              }),
              HasSubstr("a.jpg: is 640 x 480 pixels, but its camera is for 600 x 400"));
}

TEST(FitCamera, TurnsAsExifSays) {
  // An upright picture that lies in its file, as COLMAP takes it.
  const Camera lying = SampleCamera(600, 400);
  const FittedCamera upright = FitCamera(lying, {400, 600, 6}, "a.jpg");
  EXPECT_EQ(upright.camera.width_px, 400);
  EXPECT_EQ(upright.camera.focal_x_px, 600);
  EXPECT_THAT(upright.change, HasSubstr("EXIF"));
  const Eigen::Vector3d point(0.1, 0.05, 1);
  const Eigen::Vector2d px = *Project(lying, point);
  const Eigen::Vector2d turned = *Project(upright.camera, point);
  EXPECT_NEAR(turned.x(), 400 - px.y(), 1e-9);
  EXPECT_NEAR(turned.y(), px.x(), 1e-9);
  // A program that did turn it first.
  EXPECT_EQ(FitCamera(SampleCamera(400, 600), {400, 600, 6}, "a.jpg").change, "");
}

constexpr const char* kModel = "4 1\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n4 1 2 3 4 % south wall\n";
// At (5, -20, 2) in `world`, looking north.
constexpr const char* kPose = " 0.7071067811865476 0.7071067811865476 0 0 -5 2 20 1 ";

// Photographs without any tag, and a COLMAP model of three images.
class UntaggedScene : public TemporaryFolder {
 public:
  UntaggedScene() {
    Write("model.osu", kModel);
    WriteSrgb8(path() / "images/north/0001.png", Image8(30, 20, 3, 128));
    WriteSrgb8(path() / "images/east/0001.png", Image8(60, 40, 3, 128));
    WriteSrgb8(path() / "images/s3.png", Image8(30, 20, 3, 128));
    WriteLabels(path() / "masks/north/0001.png", Image16(30, 20, 1));
    Write("sparse/0/cameras.txt", "1 OPENCV 30 20 40 40 15 10 0 0 0.001 0.002\n");
    const std::string pose(kPose);
    Write("sparse/0/images.txt",
          "1" + pose + "north/0001.jpg\n\n2" + pose + "east/0001.jpg\n\n3" + pose +
              "west/0007.jpg\n\n");
  }
};

TEST(ReadScene, AColmapModelStandsInForTags) {
  const UntaggedScene folder;
  SceneOptions options;
  options.views = folder / "sparse";
  const Scene scene = ReadScene(folder.path(), options);
  ASSERT_EQ(scene.photographs.size(), 2u);
  EXPECT_EQ(scene.photographs[0].name, "east_0001");
  EXPECT_EQ(scene.photographs[1].name, "north_0001");
  EXPECT_EQ(ImageName(scene, scene.photographs[1]), "north/0001.png");
  EXPECT_EQ(scene.photographs[1].mask_file, folder / "masks/north/0001.png");
  EXPECT_EQ(scene.photographs[1].tag.p2, 0.002);
  const Camera camera = CameraFromTag(scene.photographs[0].tag, 60, 40);
  EXPECT_NEAR(camera.focal_x_px, 80, 1e-9);  // for 60 x 40, where COLMAP had 30 x 20
  EXPECT_LT((camera.PositionInWorld() - Eigen::Vector3d(5, -20, 2)).norm(), 1e-9);
  EXPECT_EQ(scene.camera_files.size(), 2u);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("1 without a photograph in images/: west/0007")));
  EXPECT_THAT(scene.warnings,
              Contains(HasSubstr("1 of the photographs in images/ are not in this model: s3.png")));
  EXPECT_THAT(scene.warnings,
              Contains(HasSubstr("camera of east_0001 scaled from 30 x 20 to 60 x 40")));
}

TEST(ReadScene, AnotherFolderOfViewsStandsInForTags) {
  const UntaggedScene folder;
  folder.Write("found/views/s3.view", "x 5 y 20 z 2\ni 5 j 0 k 2\na 1.5 v 40\n");
  SceneOptions options;
  options.views = folder / "found";
  const Scene scene = ReadScene(folder.path(), options);
  ASSERT_EQ(scene.photographs.size(), 1u);
  EXPECT_EQ(scene.photographs[0].view_file, folder / "found/views/s3.view");
  EXPECT_THAT(scene.camera_files, IsEmpty());
}

TEST(ReadScene, WhatHoldsNoCamerasIsAnError) {
  const UntaggedScene folder;
  SceneOptions options;
  options.views = folder / "images";
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path(), options); }),
              HasSubstr("no cameras here; expected .view files"));
  options.views = folder / "elsewhere";
  folder.Write("elsewhere/cameras.txt", "1 PINHOLE 30 20 40 40 15 10\n");
  folder.Write("elsewhere/images.txt", "1" + std::string(kPose) + "other.jpg\n\n");
  EXPECT_THAT(
      ThrownMessage([&] { ReadScene(folder.path(), options); }),
      AllOf(HasSubstr("no photograph in images/ has the name of any of its images: its first is "
                      "'other.jpg', and the first in images/ is 'east/0001.png'"),
            HasSubstr("give both the same names")));
}

}  // namespace
}  // namespace groundglass
