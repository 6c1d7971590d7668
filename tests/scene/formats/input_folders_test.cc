// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/input_folders.h"

#include "scene/error.h"
#include "scene/formats/output_folder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace groundglass {
namespace {

using testing::HasSubstr;

const std::string kNothing = "nothing was thrown";

TEST(InputFolders, AScenesOwnAreNoPlaceForOutput) {
  const TemporaryFolder folder;
  folder.Write("hall/images/s1.jpg", "a photograph");
  folder.Write("hall/views/s1.view", "a tag");
  folder.Write("hall/model.osu", "a model");
  for (const char* place : {"hall/images",
                            "hall/images/",
                            "hall/views",
                            "hall/images/out/deep",
                            "hall/views/../images"}) {
    EXPECT_THAT(ThrownMessage([&] { RefuseAmongInputs(folder / place); }),
                HasSubstr("lies among a scene's own files"))
        << place;
    EXPECT_THROW(PrepareOutputFolder(folder / place), Error) << place;
  }
  for (const char* place : {"hall", "hall/out", "hall/out/images", "images", "hall-out/views"}) {
    EXPECT_EQ(ThrownMessage([&] { RefuseAmongInputs(folder / place); }), kNothing) << place;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "hall/images/out"));
}

TEST(InputFolders, TagsMayBeMadeWhereThereAreNone) {
  const TemporaryFolder folder;
  folder.Write("hall/images/s1.jpg", "a photograph");
  folder.Write("hall/model.osu", "a model");
  EXPECT_EQ(ThrownMessage([&] { RefuseFilledInputs(folder / "hall/views"); }), kNothing);
  std::filesystem::create_directory(folder / "hall/views");
  EXPECT_EQ(ThrownMessage([&] { RefuseFilledInputs(folder / "hall/views"); }), kNothing);
  folder.Write("hall/views/s1.view", "written by hand");
  EXPECT_NE(ThrownMessage([&] { RefuseFilledInputs(folder / "hall/views"); }), kNothing);
  EXPECT_NE(ThrownMessage([&] { RefuseFilledInputs(folder / "hall/images/s1.jpg"); }), kNothing);
}

TEST(InputFolders, AnOutputFoldersAreNotAScenes) {
  const TemporaryFolder folder;
  folder.Write("out/images/s1.jpg", "a photograph");
  folder.Write("out/views/s1.view", "a tag");
  WriteManifest(folder / "out", {});
  EXPECT_EQ(ThrownMessage([&] { RefuseAmongInputs(folder / "out/views"); }), kNothing);
}

}  // namespace
}  // namespace groundglass
