// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/atomic_file.h"

#include "scene/formats/image_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/tile_file.h"
#include "scene/formats/view_io.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <type_traits>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

// Nothing that packs well.
template <typename Picture>
Picture MakeNoise(int channels) {
  std::mt19937 random(1988);
  Picture picture(200, 150, channels);
  for (auto& value : picture.values)
    value = static_cast<std::remove_reference_t<decltype(value)>>(random());
  return picture;
}

// Writes where there is no room: an error that says so, the file that was there stays, and nothing
// else is left.
template <typename Write>
void ExpectNothingHalf(const std::string& name, const Write& write) {
  const TemporaryFolder folder;
  folder.Write(name, "before");
  const std::string message = [&] {
    const SmallDisk disk(4096);
    return ThrownMessage([&] { write(folder / name); });
  }();
  EXPECT_THAT(message, HasSubstr(name + ": cannot write this file: File too large"));
  EXPECT_EQ(NamesIn(folder.path()), std::vector<std::string>{name});
  EXPECT_EQ(ReadTextFile(folder / name), "before");
}

TEST(WriteFileAtomically, AFullDiskIsAnErrorAndLeavesNothingHalf) {
  ExpectNothingHalf("report.html", [](const fs::path& file) {
    WriteFileAtomically(file, std::string(100000, 'x'));
  });
  ExpectNothingHalf("s1.tiles", [](const fs::path& file) {
    WriteTiles(file, [](const TileSink& append) {
      for (int i = 0; i < 100; ++i) append(std::vector<Tile>(1));
    });
  });
}

TEST(WriteFileAtomically, APictureThatDoesNotFitIsAnErrorWhateverItsFormat) {
  const Image8 srgb8 = MakeNoise<Image8>(3);
  const Image16 srgb16 = MakeNoise<Image16>(3);
  for (const char* name : {"s1.jpg", "s1.png", "s1.tif", "s1.exr"}) {
    ExpectNothingHalf(name, [&](const fs::path& file) { WriteSrgb8(file, srgb8); });
  }
  for (const char* name : {"s1.png", "s1.tif", "s1.exr"}) {
    ExpectNothingHalf(name, [&](const fs::path& file) { WriteSrgb16(file, srgb16); });
  }
  ExpectNothingHalf("faces.png",
                    [](const fs::path& file) { WriteLabels(file, MakeNoise<Image16>(1)); });
  ExpectNothingHalf("radiance.exr", [](const fs::path& file) {
    ImageF noise(200, 150, 3);
    std::mt19937 random(1988);
    for (float& value : noise.values) value = static_cast<float>(random() % 1000) / 1000;
    WriteRadiance(file, noise);
  });
}

TEST(WriteFileAtomically, AModelThatDoesNotFitIsAnError) {
  TexturedModel model;
  model.model.points_in_world = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  model.model.faces.resize(1);
  model.model.faces[0].points = {0, 1, 2};
  model.pages.resize(1);
  model.pages[0].srgb8 = MakeNoise<Image8>(3);
  model.faces.resize(1);
  model.faces[0].page = 0;
  model.faces[0].corners_texel = {
      Eigen::Vector2d(0, 0), Eigen::Vector2d(100, 0), Eigen::Vector2d(100, 100)};
  ExpectNothingHalf("model.glb", [&](const fs::path& file) { WriteGlb(file, model); });
}

TEST(WriteFileAtomically, AnotherProgramsFailureLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(ThrownMessage([&] {
              WriteFileAtomically(folder / "film.mp4", [](const fs::path& temporary) {
                std::ofstream(temporary) << "half";
                throw Error("the program failed");
              });
            }),
            "the program failed");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(WriteFileAtomically, MakesFoldersAndReplacesWhatWasThere) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder / "a/b/c.txt", "one");
  WriteFileAtomically(folder / "a/b/c.txt", "two");
  EXPECT_EQ(ReadTextFile(folder / "a/b/c.txt"), "two");
  EXPECT_EQ(NamesIn(folder / "a/b"), std::vector<std::string>{"c.txt"});
  folder.Write("file", "");
  EXPECT_THAT(ThrownMessage([&] { WriteFileAtomically(folder / "file/c.txt", "x"); }),
              HasSubstr("cannot make this folder"));
}

TEST(IsTemporaryName, KnowsOurOwnNamesAndNobodyElses) {
  for (const char* ours :
       {".a.part12-0.png", ".a.b.part1-23.jpg", ".report.part7-1", "x/.a.part1-2.c"}) {
    EXPECT_TRUE(IsTemporaryName(ours)) << ours;
  }
  for (const char* theirs : {"a.part12-0.png",
                             ".a.part12.png",
                             ".a.part-0.png",
                             ".a.part12-.png",
                             ".a.part1-2.tar.gz",
                             ".part1-2",
                             ".a.partx1-2",
                             ".a.part1-2x",
                             ".a",
                             ""}) {
    EXPECT_FALSE(IsTemporaryName(theirs)) << theirs;
  }
}

}  // namespace
}  // namespace groundglass
