// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/scene_folder.h"

#include "scene/advice.h"
#include "scene/tags_csv.h"
#include "scene/view_io.h"
#include "tests/support/temporary_folder.h"
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

constexpr const char* kModel = "4 1\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n4 1 2 3 4 % south wall\n";
// 20 south of the wall, looking north at its middle.
constexpr const char* kTag = "x 5 y 20 z 2\ni 5 j 0 k 2\na 1.5 v 40\n";

// A small scene that is in order: two photographs, one of them masked.
class SceneFolder : public TemporaryFolder {
 public:
  SceneFolder() {
    Write("model.osu", kModel);
    for (const std::string name : {"s2", "s10"}) {
      Write("views/" + name + ".view", kTag);
      WriteSrgb8(path() / "images" / (name + ".jpg"), Image8(30, 20, 3, 128));
    }
    WriteLabels(path() / "masks/s2.png", Image16(30, 20, 1));
    WriteLabels(path() / "faces/s10.png", Image16(30, 20, 1, 1));
  }
};

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
        Case{"views/s2.view", "", "views/s2.view: key 'x' is missing"},
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
            "option --exclude: no photograph is called 's99'; there are s2 s10");
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
  EXPECT_EQ(warnings.size(), 5u);
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

// tags.csv in place of views/.
class TableFolder : public SceneFolder {
 public:
  explicit TableFolder(const std::string& table, const std::string& model = kModel) {
    std::filesystem::remove_all(path() / "views");
    Write("model.osu", model);
    Write("tags.csv", table);
  }
};

TEST(TagTable, SaysTheSameAsViewFiles) {
  const TableFolder folder(
      "Image, x,y,z,i,j,k,a,v,roll,sigma_roll,camera\n"
      "s2.jpg,5,20,2,5,0,2,1.5,40,0.5,,nikon\r\n"
      "\n"
      "\"s10\",5,20,2,5,0,2,1.5,40,,2,\n");
  const Scene scene = ReadScene(folder.path());
  ASSERT_EQ(scene.photographs.size(), 2u);
  ViewTag expected = ParseView(kTag, "");
  expected.roll_deg = 0.5;
  expected.camera = "nikon";
  EXPECT_EQ(scene.photographs[0].tag, expected);
  EXPECT_TRUE(scene.photographs[0].view_file.empty());
  expected = ParseView(kTag, "");
  expected.sigmas.roll_deg = 2;
  EXPECT_EQ(scene.photographs[1].tag, expected);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(TagTable, ReadsASpreadsheetOfTheContinent) {
  const TableFolder folder(
      "\xEF\xBB\xBFimage;x;y;z;i;j;k;a;v\r\ns2.jpg;22,2;-74,9;5,1;23,9;-11,6;20,7;1,5;54\r\n"
      "s10.jpg;78,6;-66,4;4,8;43,5;0,2;19,6;1,5;54\r\n");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  ASSERT_EQ(check.scene.photographs.size(), 2u);
  const ViewTag& tag = check.scene.photographs[0].tag;
  EXPECT_EQ(tag.position_in_site, Eigen::Vector3d(22.2, -74.9, 5.1));
  EXPECT_EQ(tag.aspect, 1.5);
}

TEST(TagTable, UnclearNumbersNameLineAndColumn) {
  const TableFolder folder(
      "image,x,y,z,i,j,k,a,v\ns2,\"1,234\",2.5,3,4,5,6,1.5,40\ns10,1,2,3,4,5,6,1.5,40\n");
  EXPECT_THAT(CheckScene(folder.path()).faults,
              Contains(HasSubstr("tags.csv:2: key 'x': '1,234' may be 1.234 or 1234; write it with "
                                 "a decimal point")));
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

TEST(TagTable, YawAndPitchAreTheThesisAngles) {
  // From +y (south) towards +x (east): 180 looks north.
  const TableFolder folder(
      "image,x,y,z,yaw,pitch,a,v\ns2,5,20,2.5,180,0,1.5,40\ns10,5,20,2.5,90,45,1.5,40\n");
  const Scene scene = ReadScene(folder.path());
  const ViewTag& north = scene.photographs[0].tag;
  // As far as the model's middle, (5, 0, 2.5).
  EXPECT_LT((north.lookat_in_site - Eigen::Vector3d(5, 0, 2.5)).norm(), 1e-12);
  const Eigen::Vector3d east =
      (scene.photographs[1].tag.lookat_in_site - scene.photographs[1].tag.position_in_site);
  EXPECT_LT((east.normalized() - Eigen::Vector3d(std::sqrt(0.5), 0, std::sqrt(0.5))).norm(), 1e-12);
}

TEST(TagTable, PlacesOnEarthBecomePlacesOnTheSite) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.georeference = Georeference{40, -83, 230, 0};
  // A second of latitude at 40 degrees is 30.8434 m, of longitude 23.7155 m (WGS 84 radii of
  // curvature 6361815.8 and 6386976.2 m, plus the height).
  const Eigen::Vector3d north = SiteFromGeodetic(model, 40 + 1 / 3600.0, -83, 230);
  EXPECT_LT((north - Eigen::Vector3d(0, -30.8440, 0)).norm(), 2e-3);
  const Eigen::Vector3d east = SiteFromGeodetic(model, 40, -83 + 1 / 3600.0, 232);
  EXPECT_LT((east - Eigen::Vector3d(23.7211, 0, 2)).norm(), 2e-3);
  // The model's north at a bearing of 90 degrees: true east lies along it.
  model.georeference->north_deg = 90;
  model.unit = LengthUnit::kFoot;
  const Eigen::Vector3d turned = SiteFromGeodetic(model, 40, -83 + 1 / 3600.0, 230);
  EXPECT_LT((turned - Eigen::Vector3d(0, -23.7211 / 0.3048, 0)).norm(), 1e-2);

  const TableFolder folder("image,lat,lon,height,i,j,k,a,v\ns2,40,-83,232,5,-1,2,1.5,40\n",
                           std::string(kModel) + "% origin: 40 -83 230\n% unit: m\n");
  EXPECT_LT(
      (ReadScene(folder.path()).photographs[0].tag.position_in_site - Eigen::Vector3d(0, 0, 2))
          .norm(),
      1e-9);
}

TEST(TagTable, FaultsNameLineAndColumn) {
  const auto faults = [](const std::string& table) {
    const TableFolder folder(table);
    return CheckScene(folder.path()).faults;
  };
  EXPECT_THAT(faults("image,x,y,z,i,j,k,a\n"),
              Contains(HasSubstr("tags.csv:1: column 'v' is missing")));
  EXPECT_THAT(faults("image,x,y,z,i,j,k,a,v,pan\n"),
              Contains(HasSubstr("tags.csv:1: unknown column 'pan'")));
  EXPECT_THAT(faults("image,x,y,z,i,j,k,a,v,v\n"),
              Contains(HasSubstr("tags.csv:1: column 'v' is repeated")));
  EXPECT_THAT(faults("image,x,y,z,i,j,k,yaw,pitch,a,v\n"),
              Contains(HasSubstr("column 'i' says the same as yaw,pitch")));
  EXPECT_THAT(faults("image,lat,lon,height,i,j,k,a,v\n"),
              Contains(HasSubstr("lat,lon,height need a model that says where it stands")));
  const std::string header = "image,x,y,z,i,j,k,a,v\n";
  EXPECT_THAT(faults(header + "s2,1,2,3\n"),
              Contains(HasSubstr("tags.csv:2: has 4 fields; the header has 9")));
  EXPECT_THAT(faults(header + "s2,1,two,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:2: key 'y': 'two' is not a number")));
  EXPECT_THAT(faults(header + "s2,1,2,3,4,5,6,1.5,240\n"),
              Contains(HasSubstr("tags.csv:2: key 'v': view angle must lie between")));
  EXPECT_THAT(faults(header + "s2,1,2,3,4,5,6,1.5,40\ns2.jpg,1,2,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:3: photograph 's2' has a row already")));
  EXPECT_THAT(faults(header + "s2,1,,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:2: key 'y' is missing")));
  EXPECT_THAT(faults(""), Contains(HasSubstr("tags.csv: no header")));
}

TEST(TagTable, ARowThatCannotBeReadCostsItsOwnPhotographOnly) {
  const std::string good = "s10,5,20,2,5,0,2,1.5,40\n";
  const std::string header = "image,x,y,z,i,j,k,a,v\n";
  for (const std::string bad : {"s2,5,twenty,2,5,0,2,1.5,40\n",
                                "s2,5,20,2,5,0,2,1.5,240\n",
                                "s2.jpg,5,20\n",
                                "s2,5,20,2,5,0,2,1.5,40\ns2,5,20,2,5,0,2,1.5,40\n"}) {
    const TableFolder folder(header + bad + good);
    const Scene scene = ReadScene(folder.path());
    ASSERT_EQ(scene.photographs.size(), 1u) << bad;
    ASSERT_EQ(scene.unreadable.size(), 1u) << bad;
    EXPECT_EQ(scene.unreadable[0].photograph.name, "s2");
    EXPECT_THAT(scene.unreadable[0].reasons, Contains(HasSubstr("tags.csv:")));
  }
  // Whose row it is nobody knows: the photograph is untagged, and both are told.
  const TableFolder folder(header + ",5,20,2,5,0,2,1.5,40\n" + good);
  const Scene scene = ReadScene(folder.path());
  EXPECT_EQ(scene.photographs.size(), 1u);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("tags.csv:2: column 'image' is empty")));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("images/s2.jpg: photograph without a tag")));
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
