// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tags_csv.h"

#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "tests/scene/sample_scene_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

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
  EXPECT_THAT(
      CheckScene(folder.path()).faults,
      Contains(HasSubstr("tags.csv:2: s2: key 'x': '1,234' may be 1.234 or 1234; write it with "
                         "a decimal point")));
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
  EXPECT_THAT(faults("image,x,y,z,i,j,k,a,v,v\n"),
              Contains(HasSubstr("tags.csv:1: column 'v' is repeated")));
  EXPECT_THAT(faults("image,x,y,z,i,j,k,yaw,pitch,a,v\n"),
              Contains(HasSubstr("column 'i' says the same as yaw,pitch")));
  EXPECT_THAT(faults("image,lat,lon,height,i,j,k,a,v\n"),
              Contains(HasSubstr("lat,lon,height need a model that says where it stands")));
  const std::string header = "image,x,y,z,i,j,k,a,v\n";
  EXPECT_THAT(faults(header + "s2,1,2,3\n"),
              Contains(HasSubstr("tags.csv:2: s2: has 4 fields; the header has 9")));
  EXPECT_THAT(faults(header + "s2,1,two,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:2: s2: key 'y': 'two' is not a number")));
  EXPECT_THAT(faults(header + "s2,1,2,3,4,5,6,1.5,240\n"),
              Contains(HasSubstr("tags.csv:2: s2: key 'v': view angle must lie between")));
  EXPECT_THAT(faults(header + "s2,1,2,3,4,5,6,1.5,40\ns2.jpg,1,2,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:3: s2: has a row already, on line 2")));
  EXPECT_THAT(faults(header + "s2,1,,3,4,5,6,1.5,40\n"),
              Contains(HasSubstr("tags.csv:2: s2: key 'y' is missing")));
  EXPECT_THAT(faults(""), Contains(HasSubstr("tags.csv: no header")));
}

TEST(TagTable, AColumnThatNobodyKnowsStopsNothing) {
  const TableFolder folder(
      "image,x,y,z,i,j,k,a,v,Remarks\n"
      "s2,5,20,2,5,0,2,1.5,40,from the kerb\ns10,5,20,2,5,0,2,1.5,40,3\n");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_EQ(check.scene.photographs.size(), 2u);
  EXPECT_THAT(check.scene.warnings,
              testing::ElementsAre(
                  testing::AllOf(HasSubstr("tags.csv:1: unknown column 'remarks' is not read"),
                                 HasSubstr("the columns are image x y z i j k a v roll"))));
  // One that was meant to be read.
  const TableFolder mistyped("image,x,y,z,i,j,k,a,v,sigma_postion\ns2,5,20,2,5,0,2,1.5,40,1\n");
  EXPECT_THAT(CheckScene(mistyped.path()).faults,
              Contains(HasSubstr("tags.csv:1: unknown column 'sigma_postion'; did you mean "
                                 "'sigma_position'?")));
}

TEST(TagTable, WithoutAHeaderOneFaultSaysSo) {
  for (const char* text : {"s2,5,20,2,5,0,2,1.5,40\ns10,5,20,2,5,0,2,1.5,40\n",
                           "image|x|y|z|i|j|k|a|v\ns2|5|20|2|5|0|2|1.5|40\n"}) {
    const TableFolder folder(text);
    EXPECT_THAT(
        CheckScene(folder.path()).faults,
        Contains(HasSubstr("tags.csv:1: expected the first line to name the columns, parted "
                           "by commas, semicolons or tabs")));
  }
}

TEST(TagTable, ColumnsOfOtherNamesAreToldApart) {
  const TableFolder folder(
      "Photo,E,N,H,i,j,k,a,FOV\ns2,5,20,2,5,0,2,1.5,40\ns10,5,20,2,5,0,2,1.5,40\n");
  const std::vector<std::string> faults = CheckScene(folder.path()).faults;
  EXPECT_THAT(faults, Contains(HasSubstr("unknown column 'photo'; call it 'image'")));
  EXPECT_THAT(faults, Contains(HasSubstr("unknown column 'e'; call it 'x'")));
  EXPECT_THAT(faults,
              Contains(HasSubstr("unknown column 'n'; call it 'y', with the other sign: y counts "
                                 "to the south")));
  EXPECT_THAT(faults, Contains(HasSubstr("unknown column 'h'; call it 'z'")));
  EXPECT_THAT(faults, Contains(HasSubstr("unknown column 'fov'; call it 'v', in degrees")));
  const TableFolder with_units("image,X (m),Y (m),Z [m],i,j,k,a,v (deg)\ns2,5,20,2,5,0,2,1.5,40\n");
  EXPECT_THAT(CheckScene(with_units.path()).faults,
              Contains(HasSubstr("unknown column 'z [m]'; write 'z' alone; the unit is the "
                                 "model's, which its file says (% unit: m), or --unit")));
  const TableFolder titled("Hall, surveyed 1988\nimage,x,y,z,i,j,k,a,v\n");
  EXPECT_THAT(CheckScene(titled.path()).faults,
              Contains(HasSubstr("it begins with 'hall' and 'surveyed 1988'")));
}

TEST(TagTable, AColumnBesideOneOfItsMeaningIsARemark) {
  const TableFolder folder("image,name,x,y,z,i,j,k,a,v,n\ns2,gate,5,20,2,5,0,2,1.5,40,7\n");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.scene.warnings, Contains(HasSubstr("unknown column 'name' is not read")));
}

TEST(TagTable, AColumnThatMightBeMeantStopsNothingWhereAllIsThere) {
  const TableFolder folder(
      "image,x,y,z,i,j,k,a,v,heading,tilt,label\n"
      "s2,5,20,2,5,0,2,1.5,40,45,3,porch\ns10,5,20,2,5,0,2,1.5,40,45,3,porch\n");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_EQ(check.scene.photographs.size(), 2u);
  EXPECT_THAT(check.scene.warnings,
              Contains(HasSubstr("tags.csv:1: unknown column 'heading' is not read; if it is what "
                                 "is meant, call it 'yaw'")));
}

TEST(TagTable, ALineOfUnitsIsLeftOut) {
  const TableFolder folder(
      "image,x,y,z,i,j,k,a,v\n,ft,ft,ft,ft,ft,ft,,deg\n"
      "s2,5,20,2,5,0,2,1.5,40\ns10,5,20,2,5,0,2,1.5,40\n");
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_EQ(check.scene.photographs.size(), 2u);
  EXPECT_THAT(check.scene.warnings,
              testing::ElementsAre(
                  HasSubstr("tags.csv:2: left out: it names no photograph and gives no number")));
}

TEST(TagTable, FaultsComeInTheOrderOfLinesWithTheirPhotographs) {
  const TableFolder folder(
      "image;x;y;z;i;j;k;a;v\n"
      "s2;ca. 3,2;20,5;2,5;5;0;2;2/3;40\n"
      "s10;5,5;9,7 m;2,5;5;0;;;40\n"
      "a1;5,5;20;2,5;5;zwei;2;1,5;40\n"
      "Sum;3;;;;;;;\n");
  const SceneCheck check = CheckScene(folder.path());
  ASSERT_EQ(check.faults.size(), 4u);
  EXPECT_THAT(check.faults[0],
              HasSubstr("tags.csv:2: s2: key 'a': '2/3' is not a number; write 0,6667"));
  EXPECT_THAT(check.faults[1],
              HasSubstr("tags.csv:2: s2: key 'x': 'ca. 3,2' is not a number; write 3,2 alone, "
                        "without 'ca.'"));
  EXPECT_THAT(check.faults[2],
              HasSubstr("tags.csv:3: s10: key 'y': '9,7 m' is not a number; write 9,7 alone, "
                        "if the model is in m too, or else what that is in its unit"));
  EXPECT_THAT(check.faults[3], HasSubstr("tags.csv:4: a1: key 'j': 'zwei' is not a number"));
  const auto of_the_sum = std::count_if(
      check.scene.warnings.begin(), check.scene.warnings.end(), [](const std::string& line) {
        return line.find("'Sum'") != std::string::npos;
      });
  EXPECT_EQ(of_the_sum, 1);
}

TEST(TagTable, ALineWithoutANumberIsNoTag) {
  const std::string good = "s10;5;20;2;5;0;2;1,5;40;\n";
  for (const std::string header :
       {"image;x;y;z;i;j;k;a;v;remarks\n", "image;x;y;z;yaw;pitch;roll;a;v;remarks\n"}) {
    const TableFolder folder(header + good + "Sum;;;;;;;;;7 slides\n");
    const SceneCheck check = CheckScene(folder.path());
    EXPECT_THAT(check.faults, IsEmpty()) << header;
    EXPECT_THAT(check.scene.warnings,
                Contains(HasSubstr("tags.csv:3: left out: there is no photograph 'Sum'")));
    EXPECT_THAT(check.scene.warnings, testing::Not(Contains(HasSubstr("tag of Sum"))));
  }
  // A photograph's own empty line is no camera at the origin.
  const TableFolder folder("image;x;y;z;i;j;k;a;v;remarks\n" + good + "s2;;;;;;;;;later\n");
  EXPECT_THAT(CheckScene(folder.path()).faults,
              Contains(HasSubstr("tags.csv:3: s2: the line gives no number; expected x, y")));
}

TEST(TagTable, WhatALineLacksIsToldWithItsNumber) {
  const TableFolder folder("image,x,y,z,i,j,k,a,v\ns10,5,20,2,5,0,2,1.5,40\ns2,5,20,2,5,,2,1.5,\n");
  EXPECT_THAT(CheckScene(folder.path()).faults,
              Contains(HasSubstr("tags.csv:3: s2: key 'j' is missing")));
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

}  // namespace
}  // namespace groundglass
