// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/tags_table.h"

#include "scene/formats/csv.h"
#include "scene/formats/image_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "session/session.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// As a German spreadsheet saves it, with comments.
constexpr const char* kTable =
    "% hall, 1987\r\n"
    "image;x;y;z;i;j;k;a;v;roll;shift_x;shift_y;k1;sigma_position\r\n"
    "s1.png; 62,5 ;48;5;20;-4;11;1,5;54;;;;;  % paced\r\n"
    "\"s2.png\";70;-55;6;14;2;8;1,5;54;0;0;0;0;0,5\r\n";

ViewTag SecondTag() {
  ViewTag tag;
  tag.position_in_site = {70.25, -55, 6};
  tag.lookat_in_site = {14, 2, 8};
  tag.view_angle_deg = 54;
  tag.roll_deg = -0.5;
  tag.sigmas.position = 0.5;
  return tag;
}

TEST(TagsTable, ChangesTheFieldsOfOneRowAndNoOtherByte) {
  const TagsTable table("tags.csv", kTable);
  EXPECT_EQ(table.Row("s2"), "\"s2.png\";70;-55;6;14;2;8;1,5;54;0;0;0;0;0,5");
  const std::string changed = table.With("s2", table.FormatRow("s2", SecondTag(), ""));
  std::string expected = kTable;
  expected.replace(expected.find(";70;"), 4, ";70,25;");
  expected.replace(expected.find(";54;0;0"), 7, ";54;-0,5;0");
  EXPECT_EQ(changed, expected);
}

TEST(TagsTable, KeepsBlanksAndCommentsOfTheRowAndAddsTheReason) {
  const TagsTable table("tags.csv", kTable);
  ViewTag tag = SecondTag();
  const std::string row = table.FormatRow("s1", tag, "seen on the\nslide");
  EXPECT_EQ(row,
            "s1.png; 70,25 ;-55;6;14;2;8;1,5;54;-0,5;;;;0,5  % paced % taken against the verdict: "
            "seen on the slide");
  EXPECT_EQ(TagsTable::ReasonOf(row), "seen on the slide");
  const TagsTable again("tags.csv", table.With("s1", row));
  EXPECT_EQ(TagsTable::ReasonOf(again.FormatRow("s1", tag, "measured")), "measured");
  EXPECT_THAT(again.FormatRow("s1", tag, ""), HasSubstr("% paced"));
  EXPECT_EQ(TagsTable::ReasonOf(again.FormatRow("s1", tag, "")), "");
}

TEST(TagsTable, APhotographWithoutARowGetsOneAndLosesItAgain) {
  const TagsTable table("tags.csv", kTable);
  EXPECT_FALSE(table.Row("s3"));
  const std::string with = table.With("s3", table.FormatRow("s3", SecondTag(), ""));
  EXPECT_EQ(with, std::string(kTable) + "s3;70,25;-55;6;14;2;8;1,5;54;-0,5;;;;0,5\r\n");
  EXPECT_EQ(TagsTable("tags.csv", with).With("s3", std::nullopt), kTable);
}

TEST(TagsTable, SaysWhatItCannotHold) {
  const TagsTable narrow("tags.csv", "image,x,y,z,i,j,k,a,v\ns1,1,2,3,4,5,6,1.5,50\n");
  ViewTag tag = SecondTag();
  EXPECT_THAT(ThrownMessage([&] { narrow.FormatRow("s1", tag, ""); }),
              HasSubstr("has no column roll"));
  tag.roll_deg = 0;
  EXPECT_EQ(narrow.FormatRow("s1", tag, ""), "s1,70.25,-55,6,14,2,8,1.5,54");
  EXPECT_THAT(ThrownMessage([&] { TagsTable("tags.csv", "\xFF\xFEi"); }), HasSubstr("UTF-16"));
  EXPECT_THAT(ThrownMessage([&] { TagsTable("tags.csv", "image,x\nS\xFC\x64,1\n"); }),
              HasSubstr("is not UTF-8"));
  const TagsTable geodetic("tags.csv", "image,lat,lon,height,i,j,k,a,v\n");
  EXPECT_THAT(ThrownMessage([&] { geodetic.FormatRow("s1", tag, ""); }), HasSubstr("convert"));
}

TEST(TagsTable, ANameThatWouldBeTakenApartIsQuoted) {
  const std::string header = "image,x,y,z,i,j,k,a,v,roll,k1,shift_x,shift_y\n";
  for (const std::string name : {"Smith, north", "the \"hall\"", "5 % grey"}) {
    const TagsTable table("tags.csv", header);
    const std::string with = table.With(name, table.FormatRow(name, SecondTag(), ""));
    const TagsTable again("tags.csv", with);
    ASSERT_TRUE(again.Row(name)) << with;
    EXPECT_EQ(again.FormatRow(name, SecondTag(), ""), *again.Row(name));
    const TemporaryFolder folder;
    const CsvTable read(folder.Write("tags.csv", with));
    ASSERT_EQ(read.rows().size(), 1u);
    EXPECT_EQ(read.rows()[0].fields[0], name);
  }
}

TEST(TagsTable, ANumberStaysApartFromAComment) {
  const TagsTable table("tags.csv",
                        "image,x,y,z,i,j,k,a,v,k1,roll\ns1,1,2,3,4,5,6,1.5,54,,% paced\n");
  EXPECT_EQ(table.FormatRow("s1", SecondTag(), ""), "s1,70.25,-55,6,14,2,8,1.5,54,,-0.5 % paced");
}

TEST(TagsTable, OneNumberWithThousandsMakesNoDecimalCommas) {
  const TagsTable table(
      "tags.csv",
      "image;x;y;z;i;j;k;a;v;roll\ns1;5,123;2.5;3;4;5;6;1.5;50;\ns2;1;2;3;4;5;6;1;5;\n");
  EXPECT_EQ(table.FormatRow("s2", SecondTag(), ""), "s2;70.25;-55;6;14;2;8;1.5;54;-0.5");
  const TagsTable mixed("tags.csv", "image;x;y;z;i;j;k;a;v;roll\ns1;5,12;2.5;3;4;5;6;1.5;50;\n");
  EXPECT_THAT(ThrownMessage([&] { mixed.FormatRow("s1", SecondTag(), ""); }),
              HasSubstr("decimal points and with commas"));
}

TEST(TagsTable, DeviationsWithoutAColumnAreNamed) {
  const TagsTable table("tags.csv", kTable);
  ViewTag tag = SecondTag();
  EXPECT_EQ(table.SigmasWithoutColumn(tag), "");
  tag.sigmas.shift = 0.1;
  EXPECT_EQ(table.SigmasWithoutColumn(tag), "sigma_shift");
}

TEST(TagsTable, WritesAnglesWhereTheTableHasThem) {
  const std::string text = "image,x,y,z,yaw,pitch,a,v\ns1,1,2,3,30,-5,1.5,50\n";
  const TagsTable table("tags.csv", text);
  ViewTag tag;
  tag.position_in_site = {1, 2, 3};
  const double yaw = 30 * M_PI / 180;
  const double pitch = -5 * M_PI / 180;
  tag.lookat_in_site = tag.position_in_site + 7 * Eigen::Vector3d(std::sin(yaw) * std::cos(pitch),
                                                                  std::cos(yaw) * std::cos(pitch),
                                                                  std::sin(pitch));
  tag.view_angle_deg = 50;
  EXPECT_EQ(table.FormatRow("s1", tag, ""), *table.Row("s1"));
  tag.lookat_in_site = tag.position_in_site + Eigen::Vector3d(0, 2, 0);
  EXPECT_EQ(table.FormatRow("s1", tag, ""), "s1,1,2,3,0,0,1.5,50");
}

TEST(TagsTable, ASceneWithATableIsSavedIntoItAndUndoGivesTheFirstBytesBack) {
  const TemporaryFolder folder;
  folder.Write("model.osu", FormatOsu(MakeHouse()));
  for (const char* name : {"s1", "s2", "s3"}) {
    WriteSrgb8(folder / ("images/" + std::string(name) + ".png"), Image8(60, 40, 3, 90));
  }
  // Without a line break at its end.
  const std::string table = std::string(kTable).substr(0, std::string(kTable).size() - 2);
  folder.Write("tags.csv", table);
  Session session(ScanScene(folder.path()).scene, {});
  const auto change = [&](const char* name, double x) {
    const int photograph = *session.FindPhotograph(name);
    PhotographWork work = session.work(photograph);
    work.tag = SecondTag();
    work.tag->position_in_site.x() = x;
    session.Change(photograph, work);
    return session.Save(photograph);
  };
  ASSERT_EQ(change("s2", 71).kind, SaveResult::Kind::kSaved);
  ASSERT_EQ(change("s3", 72).kind, SaveResult::Kind::kSaved);
  EXPECT_FALSE(fs::exists(folder / "views")) << "it would take the table's place";
  const Scene scene = ReadScene(folder.path());
  ASSERT_EQ(scene.photographs.size(), 3u);
  EXPECT_DOUBLE_EQ(scene.photographs[0].tag.position_in_site.x(), 62.5);
  EXPECT_DOUBLE_EQ(scene.photographs[1].tag.position_in_site.x(), 71);
  EXPECT_DOUBLE_EQ(scene.photographs[2].tag.position_in_site.x(), 72);
  for (const char* name : {"s2", "s3"}) {
    const int photograph = *session.FindPhotograph(name);
    session.Undo(photograph);
    ASSERT_EQ(session.Save(photograph).kind, SaveResult::Kind::kSaved);
  }
  EXPECT_EQ(ReadFileBytes(folder / "tags.csv"), table);
}

}  // namespace
}  // namespace groundglass
