// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/keyframes.h"

#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "session/navigator.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

Camera CameraAt(double x) {
  Eye eye;
  eye.position_in_world = {x, -30, 5};
  eye.pitch_deg = -3;
  return eye.InFrame(1280, 720);
}

TEST(Keyframes, AreViewFilesInTheOrderInWhichTheyWereAdded) {
  const TemporaryFolder folder;
  {
    Keyframes keyframes(folder / "flight");
    EXPECT_TRUE(keyframes.cameras().empty());
    for (int i = 0; i < 11; ++i) keyframes.Add(CameraAt(i), 20);
  }
  EXPECT_TRUE(fs::exists(folder / "flight/11.view"));
  EXPECT_NEAR(ReadView(folder / "flight/1.view").position_in_site.y(), 30, 1e-9);
  Keyframes keyframes(folder / "flight");
  ASSERT_EQ(keyframes.cameras().size(), 11u);
  for (int i = 0; i < 11; ++i) {
    EXPECT_NEAR(keyframes.cameras()[i].PositionInWorld().x(), i, 1e-9);
  }
  EXPECT_FALSE(keyframes.RemoveLast()) << "those of an earlier session stay";
  keyframes.Add(CameraAt(50), 20);
  EXPECT_TRUE(fs::exists(folder / "flight/12.view"));
  EXPECT_TRUE(keyframes.RemoveLast());
  EXPECT_FALSE(fs::exists(folder / "flight/12.view"));
  EXPECT_EQ(keyframes.cameras().size(), 11u);
}

TEST(Keyframes, FilesOfOthersAreNeitherWrittenOverNorRemoved) {
  const TemporaryFolder folder;
  Keyframes keyframes(folder / "flight");
  keyframes.Add(CameraAt(1), 20);
  folder.Write("flight/2.view", "somebody else's");
  keyframes.Add(CameraAt(3), 20);
  EXPECT_EQ(ReadTextFile(folder / "flight/2.view"), "somebody else's");
  EXPECT_TRUE(fs::exists(folder / "flight/3.view"));
  folder.Write("flight/3.view", "changed by hand");
  EXPECT_THAT(ThrownMessage([&] { keyframes.RemoveLast(); }), testing::HasSubstr("it stays"));
  EXPECT_EQ(ReadTextFile(folder / "flight/3.view"), "changed by hand");
  // It stays in the flight, and the one before it can still be taken back.
  EXPECT_TRUE(keyframes.RemoveLast());
  EXPECT_FALSE(fs::exists(folder / "flight/1.view"));
  ASSERT_EQ(keyframes.cameras().size(), 1u);
  EXPECT_NEAR(keyframes.cameras()[0].PositionInWorld().x(), 3, 1e-9);
  EXPECT_FALSE(keyframes.RemoveLast());
}

TEST(Keyframes, ANameThatWouldComeLastIsTold) {
  const TemporaryFolder folder;
  {
    Keyframes keyframes(folder / "flight");
    keyframes.Add(CameraAt(1), 20);
  }
  fs::rename(folder / "flight/1.view", folder / "flight/end.view");
  Keyframes keyframes(folder / "flight");
  EXPECT_THAT(ThrownMessage([&] { keyframes.Add(CameraAt(2), 20); }),
              testing::HasSubstr("'end.view', which comes after 1.view"));
  EXPECT_EQ(keyframes.cameras().size(), 1u);
}

TEST(Keyframes, ThatCannotBeWrittenAreNotAdded) {
  const TemporaryFolder folder;
  folder.Write("flight", "a file where a folder should be");
  Keyframes keyframes(folder / "flight");
  EXPECT_THROW(keyframes.Add(CameraAt(0), 20), std::exception);
  EXPECT_TRUE(keyframes.cameras().empty());
}

}  // namespace
}  // namespace groundglass
