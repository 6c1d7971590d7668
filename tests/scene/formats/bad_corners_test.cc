// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/bad_corners.h"

#include "scene/face_number.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<int> NumbersOf(const PolygonModel& model) {
  std::vector<int> numbers;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    numbers.push_back(FaceNumber(model, face));
  }
  return numbers;
}

// Two walls, and a face between them with these corners.
std::string ObjWith(const std::string& corners) {
  return "v 0 0 0\nv 10 0 0\nv 10 0 5\nv 0 0 5\nv 10 8 0\nv 10 8 5\n"
         "g south\nf 1 2 3 4\ng bad\nf " +
         corners + "\ng east\nf 2 5 6 3\n";
}

TEST(Obj, AFaceWithACornerThatIsNoPointIsLeftOut) {
  const TemporaryFolder folder;
  for (const auto& [corners, fault] : {
           std::pair("1 2 99", "point 99 is outside 1 to 6"),
           std::pair("0 1 2", "point 0 is outside 1 to 6"),
           std::pair("1 2 -7", "point -7 counts back beyond the first; there are 6"),
           std::pair("1 2 -9223372036854775808",
                     "point -9223372036854775808 counts back beyond the first; there are 6"),
           std::pair("1 2x 3", "'2x' is not the number of a point; there are 6"),
           std::pair("1 99999999999999999999 3", "point 99999999999999999999 is outside 1 to 6"),
           std::pair("1 4294967297 3", "point 4294967297 is outside 1 to 6"),
       }) {
    const ModelReading reading = ReadModel(folder.Write("m.obj", ObjWith(corners)));
    EXPECT_THAT(NumbersOf(reading.model), ElementsAre(1, 3)) << corners;
    EXPECT_EQ(reading.model.faces[1].name, "east");
    EXPECT_THAT(
        reading.warnings,
        ElementsAre(AllOf(HasSubstr("m.obj:10: face 2 (bad) is left out: "), EndsWith(fault))));
  }
}

TEST(Obj, ManyBadFacesAreOneWarningAndMostAnError) {
  const TemporaryFolder folder;
  const std::string good = "f 1 2 5\nf 1 5 6\nf 4 3 6\n";
  const std::string head = ObjWith("1 2 9");
  EXPECT_THAT(ReadModel(folder.Write("m.obj", head + good + "f 7 1 2\n")).warnings,
              ElementsAre(EndsWith("m.obj: 2 faces with a corner that is no point are left out; "
                                   "the first: face 2 (bad), line 10: point 9 is outside 1 to 6")));
  EXPECT_THAT(
      ThrownMessage([&] { ReadModel(folder.Write("m.obj", head + "f 7 1 2\nf 8 1 2\n")); }),
      EndsWith("m.obj:10: point 9 is outside 1 to 6; 3 of 5 faces have such a corner: the file is "
               "damaged, or its points are missing"));
}

TEST(Obj, ABadTexturePointCostsThePictureOnly) {
  const TemporaryFolder folder;
  const std::string text = ObjWith("1/1 2/9 3/1") + "vt 0 0\n";
  const ModelReading reading = ReadModel(folder.Write("m.obj", text));
  EXPECT_EQ(reading.model.faces.size(), 3u);
  EXPECT_THAT(reading.warnings,
              testing::Contains(EndsWith("m.obj:10: face 2 (bad) is without its picture: texture "
                                         "point 9 is outside 1 to 1")));
}

std::string PlyWith(const std::string& row, const std::string& type = "int") {
  return "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
         "property float z\nelement face 3\nproperty list uchar " +
         type +
         " vertex_indices\nend_header\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n10 8 0\n10 8 5\n"
         "4 0 1 2 3\n" +
         row + "\n4 1 4 5 2\n";
}

TEST(Ply, AFaceWithACornerThatIsNoVertexIsLeftOut) {
  const TemporaryFolder folder;
  for (const auto& [row, word] : {std::pair("3 0 1 6", "6"),
                                  std::pair("3 0 1 -1", "-1"),
                                  std::pair("3 0 1.5 2", "1.5"),
                                  std::pair("3 0 one 2", "'one'"),
                                  std::pair("3 0 nan 2", "nan"),
                                  std::pair("3 0 99999999999 2", "99999999999")}) {
    const ModelReading reading = ReadModel(folder.Write("m.ply", PlyWith(row)));
    EXPECT_THAT(NumbersOf(reading.model), ElementsAre(1, 3)) << row;
    EXPECT_THAT(reading.warnings,
                ElementsAre(AllOf(HasSubstr("m.ply: face 2 is left out: it uses vertex "),
                                  HasSubstr(word),
                                  EndsWith(" (from 0), but there are 6"))));
  }
}

TEST(Ply, MostFacesBadIsAnError) {
  const TemporaryFolder folder;
  std::string text = PlyWith("3 0 1 6");
  text.replace(text.find("4 0 1 2 3"), 9, "4 0 1 2 8");
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("m.ply", text)); }),
              HasSubstr("m.ply: face 1 uses vertex 8 (from 0), but there are 6; 2 of 3 faces have "
                        "such a corner"));
}

// Faces 1, 4 and 7 of another file, in the second place one without area.
TEST(FaceNumbers, MessagesAndCommentsCallFacesAlike) {
  const TemporaryFolder folder;
  const std::string points = "\n0 0 0\n10 0 0\n10 0 5\n0 0 5\n20 0 0\n";
  const std::string numbers = "% face numbers: 1 4 7\n5 3" + points;
  const auto message = [&](const std::string& faces) {
    return ThrownMessage([&] { ReadModel(folder.Write("m.osu", numbers + faces)); });
  };
  EXPECT_THAT(message("4 1 2 3 4\n3 1 2 5 % flat\n3 2 5 3\n"),
              HasSubstr("m.osu:9: face 4 (flat) has no area"));
  EXPECT_THAT(message("4 1 2 3 4\n3 1 2 9 % flat\n3 2 5 3\n"),
              HasSubstr("m.osu:9: face 4: point number 9 is outside 1 to 5"));
  EXPECT_THAT(message("4 1 2 3 4\n3 1 2 x % flat\n3 2 5 3\n"),
              HasSubstr("m.osu:9: face 4, point number: 'x'"));
  // The same face once as OBJ, and what is written of it.
  const std::string obj =
      "# face numbers: 1 4 7\nv 0 0 0\nv 10 0 0\nv 10 0 5\nv 0 0 5\nv 20 0 0\n"
      "g wall\nf 1 2 3 4\ng flat\nf 1 2 5\ng end\nf 2 5 3\n";
  const ModelReading reading = ReadModel(folder.Write("m.obj", obj));
  EXPECT_THAT(reading.warnings, ElementsAre(HasSubstr("face 4 (flat) has no area")));
  const std::string written = FormatOsu(reading.model);
  EXPECT_THAT(written, AllOf(HasSubstr("% face 1: wall\n"), HasSubstr("% face 7: end\n")));
  const PolygonModel again = ParseOsu(written, "again.osu").model;
  EXPECT_THAT(NumbersOf(again), ElementsAre(1, 7));
  EXPECT_EQ(again.faces[1].name, "end");
  // As version 0.1.0 wrote it: the place.
  std::string old = written;
  old.replace(old.find("% face 7: end"), 13, "% face 2: end");
  EXPECT_EQ(ParseOsu(old, "old.osu").model.faces[1].name, "end");
}

}  // namespace
}  // namespace groundglass
