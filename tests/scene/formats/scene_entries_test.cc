// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "tests/scene/sample_scene_folder.h"
#include "tests/support/as_nobody.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SceneEntries, LinksThatLeadToNothingAreTold) {
  for (const char* name : {"masks", "faces", "pairs.csv", "calibration"}) {
    const SceneFolder folder;
    fs::remove_all(folder / name);
    fs::create_symlink("/no/such/place", folder / name);
    EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
                Contains(HasSubstr(std::string(name) + ": is a link that leads to nothing")));
  }
  for (const char* name : {"images", "views"}) {
    const SceneFolder folder;
    fs::remove_all(folder / name);
    fs::create_symlink("/no/such/place", folder / name);
    EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }),
                HasSubstr(std::string(name) + ": is a link that leads to nothing"));
  }
  const SceneFolder folder;
  fs::remove(folder / "model.osu");
  fs::create_symlink("elsewhere.osu", folder / "model.osu");
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }),
              HasSubstr("model.osu is a link that leads to nothing"));
}

TEST(SceneEntries, FoldersThatNobodyMayOpenAreTold) {
  const SceneFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  for (const char* name : {"masks", "views"}) {
    fs::permissions(folder / name, fs::perms::none);
    {
      const AsNobody nobody;
      const SceneCheck check = CheckScene(folder.path());
      std::vector<std::string> told = check.scene.warnings;
      told.insert(told.end(), check.faults.begin(), check.faults.end());
      EXPECT_THAT(told, Contains(HasSubstr(std::string(name) + ": cannot be opened")));
    }
    fs::permissions(folder / name, fs::perms::all);
  }
}

TEST(SceneEntries, NamesThatNearlyFitAreTold) {
  struct Case {
    const char* expected;
    const char* given;
  };
  for (const Case& name : {Case{"masks", "mask"}, Case{"masks", "Masks"}, Case{"faces", "FACES"}}) {
    const SceneFolder folder;
    fs::create_directories(folder / name.expected);
    fs::rename(folder / name.expected, folder / name.given);
    EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
                ElementsAre(AllOf(HasSubstr(std::string("but ") + name.given + " is"),
                                  EndsWith(std::string("rename it to ") + name.expected))));
  }
  for (const Case& name : {Case{"images", "Photos"}, Case{"views", "Views"}}) {
    const SceneFolder folder;
    fs::rename(folder / name.expected, folder / name.given);
    EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }),
                HasSubstr(std::string("but ") + name.given + " is"));
  }
  const SceneFolder folder;
  fs::remove_all(folder / "views");
  folder.Write("tags.xlsx", "PK");
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
              Contains(HasSubstr("but tags.xlsx is, which is not read; save it as tags.csv")));
}

TEST(SceneEntries, APictureThatShowsNothingIsTold) {
  const auto warnings = [](const char* name, const Image8& picture) {
    const SceneFolder folder;
    fs::remove(folder / "images/s2.jpg");
    WriteSrgb8(folder / "images" / name, picture);
    return CheckScene(folder.path()).scene.warnings;
  };
  EXPECT_THAT(warnings("s2.png", Image8(30, 20, 3, 255)),
              ElementsAre(HasSubstr("s2.png: is all but white, so that nothing is to be seen")));
  EXPECT_THAT(warnings("s2.png", Image8(30, 20, 3, 0)),
              ElementsAre(HasSubstr("s2.png: is all but black, so that nothing is to be seen")));
  EXPECT_THAT(warnings("s2.png", Image8(30, 20, 3, 254)), IsEmpty());
  Image8 signed_picture(30, 20, 3, 255);
  for (int x = 0; x < 30; ++x) signed_picture.At(x, 19)[0] = 0;
  EXPECT_THAT(warnings("s2.png", signed_picture), IsEmpty());
  // Floats from 0 to 255, as a script in Python leaves them.
  const SceneFolder folder;
  fs::remove(folder / "images/s2.jpg");
  WriteRadiance(folder / "images/s2.exr", ImageF(30, 20, 3, 80));
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
              ElementsAre(HasSubstr("floats count from 0 to 1 here: divide them")));
}

TEST(SceneEntries, APictureCalledAViewFileIsOneFault) {
  const SceneFolder folder;
  fs::copy_file(
      folder / "images/s2.jpg", folder / "views/s2.view", fs::copy_options::overwrite_existing);
  EXPECT_THAT(CheckScene(folder.path()).faults,
              ElementsAre(HasSubstr("views/s2.view: this is a JPEG and no view file; expected")));
  EXPECT_EQ(ReadScene(folder.path()).photographs.size(), 1u);
}

TEST(SceneEntries, WhatStandsBesideWhatIsReadIsNobodysBusiness) {
  const SceneFolder folder;
  fs::create_directories(folder / "mask");
  fs::create_directories(folder / "photos/old");
  fs::create_directories(folder / "notes");
  fs::create_directories(folder / "images/more");
  fs::create_symlink(folder / "images/s2.jpg", folder / "linked.jpg");
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings, IsEmpty());
}

TEST(SceneEntries, WhatIsNoFileAmongFilesIsTold) {
  const SceneFolder folder;
  fs::create_symlink("s9.jpg", folder / "images/s9.jpg");  // to itself
  fs::create_directories(folder / "images/s8.jpg");
  ASSERT_EQ(mkfifo((folder / "images/s7.jpg").c_str(), 0600), 0);
  fs::create_directories(folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "images/north");
  fs::create_symlink("nowhere", folder / "views/s9.view");
  folder.Write("views/old/s2.view", kTag);
  const std::vector<std::string> warnings = CheckScene(folder.path()).scene.warnings;
  EXPECT_THAT(warnings, Contains(HasSubstr("images/s9.jpg: is a link that leads to no file")));
  EXPECT_THAT(warnings, Contains(HasSubstr("images/s8.jpg: is a folder")));
  EXPECT_THAT(warnings, Contains(HasSubstr("images/s7.jpg: is no plain file")));
  EXPECT_THAT(warnings, Contains(HasSubstr("images/north: is a link to a folder")));
  EXPECT_THAT(warnings, Contains(HasSubstr("views/s9.view: is a link that leads to no file")));
  EXPECT_THAT(warnings, Contains(HasSubstr("views/old: is a folder, and the view files in it")));
}

}  // namespace
}  // namespace groundglass
