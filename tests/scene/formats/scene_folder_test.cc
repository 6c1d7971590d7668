// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/scene_folder.h"

#include "scene/advice/advice.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "tests/scene/sample_scene_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(NaturalLess, CountsAsPeopleDo) {
  std::vector<std::string> names = {"s10", "s2", "s1", "a", "s02", "s2b", "S3", "s", "s1.5"};
  std::sort(names.begin(), names.end(), NaturalLess);
  EXPECT_EQ(names,
            (std::vector<std::string>{"S3", "a", "s", "s1", "s1.5", "s02", "s2", "s2b", "s10"}));
  EXPECT_FALSE(NaturalLess("s1", "s1"));
  EXPECT_TRUE(NaturalLess("p9999999999999999999998", "p9999999999999999999999"));
}

TEST(ReadScene, FindsEverythingInNaturalOrder) {
  const SceneFolder folder;
  const Scene scene = ReadScene(folder.path());
  ASSERT_EQ(scene.photographs.size(), 2u);
  EXPECT_EQ(scene.photographs[0].name, "s2");
  EXPECT_EQ(scene.photographs[1].name, "s10");
  EXPECT_EQ(scene.photographs[0].size.width, 30);
  EXPECT_EQ(scene.photographs[0].tag.view_angle_deg, 40);
  EXPECT_EQ(scene.photographs[0].mask_file, folder / "masks/s2.png");
  EXPECT_FALSE(scene.photographs[0].faces_file);
  EXPECT_EQ(scene.photographs[1].faces_file, folder / "faces/s10.png");
  EXPECT_EQ(scene.photographs[1].view_file, folder / "views/s10.view");
  EXPECT_EQ(scene.model.faces.size(), 1u);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(ReadScene, TakesAnotherModelAndUnit) {
  const SceneFolder folder;
  SceneOptions options;
  options.model_file = folder.Write("other.osu", std::string(kModel) + "% unit: ft\n");
  options.model.unit = LengthUnit::kMetre;
  const Scene scene = ReadScene(folder.path(), options);
  EXPECT_EQ(scene.model_file, folder / "other.osu");
  EXPECT_EQ(scene.model.unit, LengthUnit::kMetre);
}

TEST(ReadScene, ThrowsTheFirstFaultOfTheWhole) {
  EXPECT_EQ(ThrownMessage([] { ReadScene("no/such/scene"); }),
            "no/such/scene: no such scene folder");
  const SceneFolder folder;
  std::filesystem::remove(folder / "model.osu");
  folder.Write("views/s2.view", "x 1");
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }), HasSubstr("no model; expected"));
  folder.Write("model.skp", "SketchUp");
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }),
              HasSubstr("model.skp is of a kind that is not read: export it as one of these"));
}

TEST(ReadScene, WhatIsNoFileUnderAPhotographsNameIsTold) {
  const SceneFolder folder;
  std::filesystem::remove(folder / "images/s2.jpg");
  const auto warnings = [&] { return CheckScene(folder.path()).scene.warnings; };
  std::filesystem::create_symlink("elsewhere/s2.jpg", folder / "images/s2.jpg");
  EXPECT_THAT(warnings(), Contains(HasSubstr("images/s2.jpg is a link that leads to no file")));
  std::filesystem::remove(folder / "images/s2.jpg");
  std::filesystem::create_directory(folder / "images/s2.jpg");
  EXPECT_THAT(warnings(), Contains(HasSubstr("images/s2.jpg is a folder")));
}

TEST(ReadScene, AFolderOrALinkToNothingInAMasksPlaceIsTold) {
  const SceneFolder folder;
  std::filesystem::create_directories(folder / "masks/s2.tif");
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
              Contains(HasSubstr("masks/s2.tif: is a folder")));
  std::filesystem::remove(folder / "masks/s2.tif");
  std::filesystem::create_symlink("nowhere", folder / "masks/s2.tif");
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
              Contains(HasSubstr("masks/s2.tif: is a link that leads to no file")));
}

TEST(ReadScene, APhotographWhoseNameHoldsALineBreakIsLeftOut) {
  const SceneFolder folder;
  std::filesystem::copy(folder / "images/s2.jpg", folder / "images/s\n3.jpg");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.scene.warnings, Contains(HasSubstr("'s?3.jpg' has a line break")));
  EXPECT_EQ(check.scene.photographs.size(), 2u);
}

TEST(ReadScene, ADamagedPictureIsToldThoughItHasNoTag) {
  const SceneFolder folder;
  const std::string whole = ReadTextFile(folder / "images/s2.jpg");
  folder.Write("images/s3.jpg", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(CheckScene(folder.path()).faults,
              testing::ElementsAre(HasSubstr("images/s3.jpg: cannot read this as an image")));
  // It spoils nothing.
  const Scene scene = ReadScene(folder.path());
  EXPECT_EQ(scene.photographs.size(), 2u);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("images/s3.jpg: cannot read this as an image")));
}

TEST(ReadScene, OnePhotographThatCannotBeReadIsSetApart) {
  const std::string damaged = [] {
    const SceneFolder folder;
    const std::string whole = ReadTextFile(folder / "images/s2.jpg");
    return whole.substr(0, whole.size() / 2);
  }();
  struct Case {
    const char* file;
    std::string bytes;
    const char* reason;
  };
  for (const Case& spoilt :
       {Case{"images/s2.jpg", damaged, "images/s2.jpg: "},
        Case{"images/s2.jpg", "", "images/s2.jpg: "},
        Case{"images/s2.jpg", "<html>not found</html>", "images/s2.jpg: "},
        Case{"images/s2.png", "second of this name", "two images have the stem 's2'"},
        Case{"views/s2.view", "x 1", "views/s2.view: key 'y' is missing"},
        Case{"views/s2.view", "", "views/s2.view: this view file is empty"},
        Case{"masks/s2.png", "no mask", "masks/s2.png: "},
        Case{"faces/s2.png", "", "faces/s2.png: "}}) {
    const SceneFolder folder;
    folder.Write(spoilt.file, spoilt.bytes);
    const Scene scene = ReadScene(folder.path());
    ASSERT_EQ(scene.photographs.size(), 1u) << spoilt.file;
    EXPECT_EQ(scene.photographs[0].name, "s10");
    ASSERT_EQ(scene.unreadable.size(), 1u) << spoilt.file;
    EXPECT_EQ(scene.unreadable[0].photograph.name, "s2");
    EXPECT_THAT(scene.unreadable[0].reasons, Contains(HasSubstr(spoilt.reason)));
    EXPECT_THAT(scene.warnings, IsEmpty()) << spoilt.file;
    // `check` tells the same.
    EXPECT_THAT(CheckScene(folder.path()).faults, Contains(HasSubstr(spoilt.reason)));
  }
}

TEST(ReadScene, FaultsOfPhotographsThatAreNotAskedForDoNotMatter) {
  const SceneFolder folder;
  folder.Write("images/s2.jpg", "");
  folder.Write("views/s2.view", "x 1");
  SceneOptions options;
  options.only = {"s10"};
  EXPECT_THAT(ReadScene(folder.path(), options).unreadable, IsEmpty());
  options = {};
  options.exclude = {"s2.jpg"};
  const Scene scene = ReadScene(folder.path(), options);
  EXPECT_THAT(scene.unreadable, IsEmpty());
  EXPECT_EQ(scene.photographs.size(), 1u);
  // Excluding a sound one says nothing of whether it is registered.
  options.exclude = {"s10"};
  EXPECT_EQ(ReadScene(folder.path(), options).photographs.size(), 1u);
  options.exclude = {"s99"};
  EXPECT_EQ(ThrownMessage([&] { ReadScene(folder.path(), options); }),
            "option --exclude: no photograph is called 's99'; there are s2, s10");
}

TEST(ReadScene, WithoutAnyPhotographThatCanBeReadTheFirstReasonsAreTold) {
  const SceneFolder folder;
  folder.Write("images/s2.jpg", "");
  folder.Write("views/s10.view", "x 1");
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path()); }),
              AllOf(HasSubstr("images/s2.jpg: "), HasSubstr("views/s10.view: key 'y'")));
  SceneOptions options;
  options.only = {"s2"};
  EXPECT_THAT(ThrownMessage([&] { ReadScene(folder.path(), options); }),
              AllOf(HasSubstr("images/s2.jpg: "), testing::Not(HasSubstr("s10"))));
}

TEST(ReadScene, AFaultyTagWithoutAPhotographIsAWarning) {
  const SceneFolder folder;
  folder.Write("views/s99.view", "x 1");
  const Scene scene = ReadScene(folder.path());
  EXPECT_EQ(scene.photographs.size(), 2u);
  EXPECT_THAT(scene.unreadable, IsEmpty());
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("views/s99.view: key 'y' is missing")));
}

TEST(CheckScene, SoundSceneHasNothingToTell) {
  const SceneFolder folder;
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.scene.warnings, IsEmpty());
}

TEST(CheckScene, TellsEveryFaultInOneGo) {
  const SceneFolder folder;
  folder.Write("model.osu", "4 2\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n3 1 2 9\n3 1 2 2\n");
  folder.Write("views/s2.view", "x 1 y 2 z 3 i 4 j 5 k 6 a 1.5 v 40 pan 3\n");
  folder.Write("views/s3.view", "x 1 y 2 z 3 i 4 j 5 k 6 a 1.5\n");
  folder.Write("images/s3.jpg", "not a picture");
  folder.Write("views/s4.view", kTag);
  folder.Write("images/s4.png", "not a picture either");
  const std::string whole = ReadTextFile(folder / "images/s10.jpg");
  folder.Write("images/s10.jpg", whole.substr(0, whole.size() - 4));
  WriteLabels(folder / "faces/s10.png", Image16(20, 20, 1, 1));
  const std::vector<std::string> faults = CheckScene(folder.path()).faults;
  EXPECT_THAT(faults, Contains(HasSubstr("model.osu:6: face 1: point number 9 is outside")));
  EXPECT_THAT(faults, Contains(HasSubstr("model.osu:7: face 2 has point 2 more than once")));
  EXPECT_THAT(faults, Contains(HasSubstr("views/s2.view:1: unknown key 'pan'")));
  EXPECT_THAT(faults, Contains(HasSubstr("views/s3.view: key 'v' is missing")));
  EXPECT_THAT(faults, Contains(HasSubstr("images/s3.jpg: cannot read this as an image")));
  EXPECT_THAT(faults, Contains(HasSubstr("images/s4.png: cannot read this as an image")));
  EXPECT_THAT(faults, Contains(HasSubstr("images/s10.jpg: this image is damaged")));
  EXPECT_THAT(
      faults,
      Contains(HasSubstr("faces/s10.png: mask has 20 x 20 pixels, its photograph 30 x 20")));
  EXPECT_EQ(faults.size(), 8u);
  for (const std::string& fault : faults) EXPECT_EQ(fault.find('\n'), std::string::npos);
}

TEST(CheckScene, WarnsOfWhatDoesNotMatchAndSaysWhatWasExpected) {
  const SceneFolder folder;
  WriteSrgb8(folder / "images/s7.png", Image8(30, 20, 3, 128));
  folder.Write("views/s8.view", kTag);
  folder.Write("images/Thumbs.db", "");
  folder.Write("views/notes.txt", "");
  folder.Write("images/.hidden", "");
  WriteLabels(folder / "masks/s99.png", Image16(30, 20, 1));
  WriteLabels(folder / "masks/S7.png", Image16(30, 20, 1));
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  const std::vector<std::string>& warnings = check.scene.warnings;
  EXPECT_THAT(warnings,
              Contains(EndsWith("images/s7.png: photograph without a tag; expected "
                                "views/s7.view")));
  EXPECT_THAT(warnings,
              Contains(EndsWith("views/s8.view: tag of s8 without a photograph; expected "
                                "images/s8 with .jpg, .png, .tif, .heic or another image")));
  EXPECT_THAT(warnings, Contains(HasSubstr("images/Thumbs.db: not an image that is read here")));
  EXPECT_THAT(warnings, Contains(HasSubstr("views/notes.txt: not a view file")));
  EXPECT_THAT(warnings, Contains(HasSubstr("masks/s99.png: mask without a photograph")));
  EXPECT_THAT(warnings, testing::Not(Contains(HasSubstr("masks/S7.png"))))
      << "the mask of a photograph without a tag";
  EXPECT_EQ(warnings.size(), 5u);
}

TEST(CheckScene, ACopyOfATaggedPictureNeedsNoTag) {
  const SceneFolder folder;
  // Another picture than the scene's other ones.
  WriteSrgb8(folder / "images/s2.jpg", Image8(30, 20, 3, 77));
  std::filesystem::copy_file(folder / "images/s2.jpg", folder / "images/copy.jpg");
  const Scene scene = CheckScene(folder.path()).scene;
  EXPECT_THAT(scene.warnings,
              Contains(HasSubstr("images/copy.jpg: photograph without a tag; it is the very same "
                                 "picture as s2.jpg, which has one")));
  EXPECT_EQ(scene.untagged_images.size(), 1u) << "the window shows it";
}

TEST(CheckScene, WarnsOfATurnedPictureAndACameraWithItsBackToTheModel) {
  const SceneFolder folder;
  WriteSrgb8(folder / "images/s2.jpg", Image8(20, 30, 3, 128));
  std::filesystem::remove(folder / "masks/s2.png");
  folder.Write("views/s10.view", "x 5 y -20 z 2 i 5 j -40 k 2 a 1.5 v 40");
  std::vector<std::string> warnings;
  for (const Advice& advice : FindOddities(CheckScene(folder.path()).scene)) {
    warnings.push_back(FormatAdvice(advice));
  }
  EXPECT_THAT(warnings,
              Contains(HasSubstr("views/s2.view: aspect 1.5 does not suit s2.jpg of 20 x 30")));
  EXPECT_THAT(warnings,
              Contains(HasSubstr("views/s10.view: the whole model lies behind this camera")));
}

TEST(CheckScene, FaultsOfTheFolderItself) {
  {
    const SceneFolder folder;
    folder.Write("model.obj", "");
    EXPECT_THAT(CheckScene(folder.path()).faults,
                Contains(HasSubstr("two models, model.obj and model.osu")));
  }
  {
    const SceneFolder folder;
    std::filesystem::remove(folder / "model.osu");
    EXPECT_THAT(CheckScene(folder.path()).faults,
                Contains(HasSubstr("no model; expected model.osu, .obj")));
  }
  {
    const SceneFolder folder;
    WriteSrgb8(folder / "images/s2.png", Image8(30, 20, 3));
    EXPECT_THAT(CheckScene(folder.path()).faults,
                Contains(AllOf(HasSubstr("two images have the stem 's2'"), HasSubstr("s2.jpg"))));
  }
  {
    const SceneFolder folder;
    std::filesystem::remove_all(folder / "views");
    EXPECT_THAT(CheckScene(folder.path()).faults,
                Contains(HasSubstr("no tags; expected a folder views/ with .view files")));
  }
  {
    const SceneFolder folder;
    std::filesystem::remove_all(folder / "images");
    EXPECT_THAT(CheckScene(folder.path()).faults, Contains(HasSubstr("no photograph has a tag")));
  }
  {
    const SceneFolder folder;
    WriteLabels(folder / "faces/s10.png", Image16(30, 20, 1, 2));
    EXPECT_THAT(CheckScene(folder.path()).faults,
                Contains(HasSubstr("faces/s10.png: names face 2, but the model has 1")));
  }
}

TEST(ReadScene, NamesMatchInAnyUnicodeFormAndCase) {
  const std::string composed = "S\xC3\xBC";
  const std::string parted = "su\xCC\x88";
  const SceneFolder folder;
  folder.Write("views/" + composed + ".view", kTag);
  WriteSrgb8(folder / ("images/" + parted + ".JPG"), Image8(30, 20, 3, 128));
  WriteLabels(folder / ("masks/" + parted + ".png"), Image16(30, 20, 1));
  std::filesystem::rename(folder / "images/s10.jpg", folder / "images/S10.jpeg");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.scene.warnings, IsEmpty());
  ASSERT_EQ(check.scene.photographs.size(), 3u);
  EXPECT_EQ(check.scene.photographs[0].name, composed);
  EXPECT_TRUE(check.scene.photographs[0].mask_file);
  EXPECT_EQ(check.scene.photographs[2].image_file, folder / "images/S10.jpeg");
}

TEST(ReadScene, ImagesAreToldByContent) {
  const SceneFolder folder;
  WriteSrgb8(folder / "a.png", Image8(30, 20, 3, 128));
  std::filesystem::rename(folder / "a.png", folder / "images/s2.jpg");  // a PNG called .jpg
  std::filesystem::rename(folder / "images/s10.jpg", folder / "images/s10");
  folder.Write("images/film.mp4",
               std::string("\0\0\0\x18"
                           "ftypmp42\0\0\0\0mp42isom",
                           24));
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_EQ(check.scene.photographs.size(), 2u);
  ASSERT_EQ(check.scene.warnings.size(), 1u);
  EXPECT_THAT(check.scene.warnings[0],
              AllOf(HasSubstr("images/film.mp4: not an image that is read here, but a film"),
                    HasSubstr("ffmpeg")));
}

TEST(ReadScene, SaysWhatIsUnusualOfAnImage) {
  const SceneFolder folder;
  const std::string whole = ReadTextFile(folder / "images/s10.jpg");
  folder.Write("images/s10.jpg", whole.substr(0, whole.size() - 2));
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.scene.warnings, Contains(HasSubstr("images/s10.jpg: lacks its end mark")));
}

TEST(CheckScene, SaysInWhatANameDiffers) {
  const SceneFolder folder;
  std::filesystem::rename(folder / "images/s10.jpg", folder / "images/s_010.jpg");
  EXPECT_THAT(CheckScene(folder.path()).scene.warnings,
              Contains(AllOf(HasSubstr("views/s10.view: tag of s10 without a photograph"),
                             HasSubstr("is it s_010.jpg? it differs in zeros"))));
}

TEST(ReadScene, ReadsTheBrickScene) {
  const Scene scene = ReadScene(std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick");
  EXPECT_EQ(scene.photographs.size(), 12u);
  EXPECT_EQ(scene.photographs[1].name, "s2");
  EXPECT_EQ(scene.photographs[11].name, "s12");
  EXPECT_EQ(scene.photographs[0].size.width, 1200);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

}  // namespace
}  // namespace groundglass
