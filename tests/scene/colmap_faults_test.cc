// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/convert.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// At (5, -20, 2) in `world`, looking north.
constexpr const char* kNorth = " 0.7071067811865476 0.7071067811865476 0 0 -5 2 20 ";

std::string ImageLine(const std::string& id, const std::string& camera = "1") {
  return id + kNorth + camera + " s" + id + ".png\n";
}

// Three photographs without tags before a wall, and a model of them.
class ColmapScene : public TemporaryFolder {
 public:
  ColmapScene() {
    Write("model.osu", "4 1\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n4 1 2 3 4 % south wall\n");
    for (const char* name : {"s1", "s2", "s3"}) {
      WriteSrgb8(path() / "images" / (std::string(name) + ".png"), Image8(30, 20, 3, 128));
    }
  }
  Scene Read(const std::string& images,
             const std::string& cameras = "1 PINHOLE 30 20 40 40 15 10\n") const {
    Write("sparse/cameras.txt", cameras);
    Write("sparse/images.txt", images);
    SceneOptions options;
    options.views = path() / "sparse";
    return ReadScene(path(), options);
  }
};

std::vector<std::string> NamesIn(const Scene& scene) {
  std::vector<std::string> names;
  for (const Photograph& photograph : scene.photographs) names.push_back(photograph.name);
  return names;
}

TEST(ColmapFaults, OneBadImageCostsItsOwnPhotographOnly) {
  const ColmapScene folder;
  std::string repeated = ImageLine("2");
  for (const auto& [bad, fault] : {
           std::pair("2 1 0 0 0 1 2 x 1 s2.png\n", "images.txt:3: TZ: 'x' is not a finite number"),
           std::pair("2 0 0 0 0 1 2 3 1 s2.png\n", "images.txt:3: the quaternion is zero"),
           std::pair("2 1 0 0 0 1 2 nan 1 s2.png\n", "images.txt:3: TZ: 'nan'"),
           std::pair("2 1 0 0 0 1 2 3 9 s2.png\n", "images.txt:3: camera 9 is not in cameras.txt"),
           std::pair("2 1 0 0 0 1 2 s2.png\n", "images.txt:3: TZ: 's2.png'"),
           std::pair("two 1 0 0 0 1 2 3 1 s2.png\n", "images.txt:3: image number: 'two'"),
       }) {
    const Scene scene = folder.Read(ImageLine("1") + "\n" + bad + "\n" + ImageLine("3") + "\n");
    EXPECT_THAT(NamesIn(scene), ElementsAre("s1", "s3")) << bad;
    ASSERT_EQ(scene.unreadable.size(), 1u) << bad;
    EXPECT_EQ(scene.unreadable[0].photograph.name, "s2");
    EXPECT_THAT(scene.unreadable[0].reasons, ElementsAre(HasSubstr(fault)));
  }
}

TEST(ColmapFaults, OneBadCameraCostsItsImagesOnly) {
  const ColmapScene folder;
  const std::string images =
      ImageLine("1") + "\n" + ImageLine("2", "2") + "\n" + ImageLine("3") + "\n";
  const std::string good = "1 PINHOLE 30 20 40 40 15 10\n";
  for (const auto& [bad, fault] : {
           std::pair("2 PINHOLE 30 20 40 x 15 10\n", "cameras.txt:2: camera parameter: 'x'"),
           std::pair("2 PINHOLE 30 20 40\n", "cameras.txt:2: PINHOLE has 4 parameters, not 1"),
           std::pair("2 PINHOLE 30 20 -4 40 15 10\n", "cameras.txt:2: the focal length must be"),
           std::pair("2\n", "cameras.txt:2: expected camera model"),
           std::pair("2 PINHOLE 30 20 4 4 15 10\n2 PINHOLE 30 20 5 5 15 10\n",
                     "cameras.txt:3: camera 2 is repeated"),
           std::pair("two PINHOLE 30 20 40 40 15 10\n", "camera 2 is not in cameras.txt"),
       }) {
    const Scene scene = folder.Read(images, good + bad);
    EXPECT_THAT(NamesIn(scene), ElementsAre("s1", "s3")) << bad;
    ASSERT_EQ(scene.unreadable.size(), 1u) << bad;
    EXPECT_THAT(scene.unreadable[0].reasons, ElementsAre(HasSubstr(fault)));
  }
  EXPECT_THAT(folder.Read(images, good + "two PINHOLE 30 20 40 40 15 10\n").warnings,
              Contains(HasSubstr("cameras.txt:2: camera number: 'two' is not a whole number; this "
                                 "line is left out")));
}

TEST(ColmapFaults, LinesThatAreOutOfStepAreToldAndTheRestIsRead) {
  const ColmapScene folder;
  // Without the empty lines between.
  Scene scene = folder.Read(ImageLine("1") + ImageLine("2") + ImageLine("3"));
  EXPECT_THAT(NamesIn(scene), ElementsAre("s1", "s2", "s3"));
  EXPECT_THAT(scene.warnings,
              Contains(HasSubstr("images.txt:2: expected the image's points (X Y POINT3D_ID ...) "
                                 "or an empty line, not the next image, which is read as such")));
  // Damaged points are nobody's loss.
  scene =
      folder.Read(ImageLine("1") + "10.5 20.5 -1 30\n" + ImageLine("2") + "\n" + ImageLine("3"));
  EXPECT_THAT(NamesIn(scene), ElementsAre("s1", "s2", "s3"));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("images.txt:2: expected the image's points")));
  // A line of another kind between two images.
  scene = folder.Read(ImageLine("1") + "\nrubbish\n" + ImageLine("2") + "\n" + ImageLine("3"));
  EXPECT_THAT(NamesIn(scene), ElementsAre("s1", "s2", "s3"));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("images.txt:3: image number: 'rubbish'")));
}

TEST(ColmapFaults, WhereNoImageIsLeftTheFirstFaultIsTheError) {
  const ColmapScene folder;
  EXPECT_THAT(ThrownMessage([&] { folder.Read("1 1 0 0 0 1 2 x 1 s1.png\n\n"); }),
              HasSubstr("images.txt:1: TZ: 'x' is not a finite number"));
}

TEST(ColmapFaults, ConvertLeavesABadImageOutWithAWarning) {
  const ColmapScene folder;
  folder.Read(ImageLine("1") + "\n2 1 0 0 0 1 2 x 1 s2.png\n\n" + ImageLine("3") + "\n");
  const ConvertResult result = ConvertColmapToViews(folder / "sparse", folder / "out", 50);
  EXPECT_THAT(result.summary, HasSubstr("2 view files"));
  EXPECT_THAT(result.warnings,
              ElementsAre(AllOf(HasSubstr("images.txt:3: TZ: 'x'"),
                                HasSubstr("; image 's2.png' is left out"))));
  EXPECT_FALSE(fs::exists(folder / "out/s2.view"));
}

TEST(WriteColmapModel, AFullDiskLeavesTheSetThatWasThere) {
  const TemporaryFolder folder;
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_x_px = camera.focal_y_px = 500;
  WriteColmapModel(folder.path(), {{"before.jpg", camera}});
  // cameras.txt has room, images.txt has none.
  std::vector<NamedCamera> cameras;
  for (int i = 0; i < 60; ++i) {
    cameras.push_back({std::string(120, 'n') + std::to_string(i) + ".jpg", camera});
  }
  const std::string message = [&] {
    const SmallDisk disk(4096);
    return ThrownMessage([&] { WriteColmapModel(folder.path(), cameras); });
  }();
  EXPECT_THAT(message, HasSubstr("images.txt: cannot write this file: File too large"));
  EXPECT_EQ(ReadColmapModel(folder.path())[0].name, "before.jpg");
  size_t num_files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++num_files;
  EXPECT_EQ(num_files, 3u);
}

}  // namespace
}  // namespace groundglass
