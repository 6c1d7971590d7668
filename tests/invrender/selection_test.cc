// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/selection.h"

#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

PolygonModel FiveWalls() {
  PolygonModel model;
  for (int i = 0; i < 5; ++i) AddWall(model, 4.0 * i, 4.0 * i + 3, 0, 8);
  model.faces[1].name = "porch";
  model.faces[3].name = "porch";
  model.faces[4].name = "west gable";
  return model;
}

std::vector<BakePhotograph> Named(const std::vector<std::string>& names) {
  std::vector<BakePhotograph> photographs;
  for (const std::string& name : names) {
    photographs.emplace_back();
    photographs.back().name = name;
    photographs.back().image_file = "images/" + name + ".jpg";
  }
  return photographs;
}

TEST(FindFaces, KnowsNumbersRangesAndNames) {
  const PolygonModel model = FiveWalls();
  EXPECT_THAT(FindFaces(model, {"5", "1"}), ElementsAre(0, 4));
  EXPECT_THAT(FindFaces(model, {"2-4", "3"}), ElementsAre(1, 2, 3));
  EXPECT_THAT(FindFaces(model, {"porch"}), ElementsAre(1, 3));
  EXPECT_THAT(FindFaces(model, {"west gable"}), ElementsAre(4));
  for (const std::string word : {"0", "6", "4-9", "3-2", "tower", ""}) {
    EXPECT_THAT(ThrownMessage([&] { FindFaces(model, {word}); }), HasSubstr("no face is called"))
        << word;
  }
}

TEST(FindFaces, ARangeThatRunsBackwards) {
  EXPECT_THAT(ThrownMessage([] { FindFaces(FiveWalls(), {"5-3"}); }),
              HasSubstr("runs backwards: write 3-5"));
}

TEST(ExcludePhotographs, KnowsThemByNameAndByFile) {
  std::vector<BakePhotograph> photographs = Named({"s1", "s2", "s3"});
  ExcludePhotographs({"s1", "s3.jpg"}, photographs);
  ASSERT_EQ(photographs.size(), 1u);
  EXPECT_EQ(photographs[0].name, "s2");
  EXPECT_THAT(ThrownMessage([&] { ExcludePhotographs({"s9"}, photographs); }),
              HasSubstr("no photograph to exclude is called 's9'"));
}

TEST(RestrictToPairs, NamedFacesTakeOnlyTheirPhotographs) {
  const TemporaryFolder folder;
  const PolygonModel model = FiveWalls();
  std::vector<BakePhotograph> photographs = Named({"s1", "s2"});
  WriteFileAtomically(
      folder / "pairs.csv",
      "Image,remark,face\ns1,,1\n\ns2.jpg,\"late, from the east\", porch\r\ns1,,2 % both\n");
  RestrictToPairs(folder / "pairs.csv", model, photographs);
  EXPECT_THAT(*photographs[0].faces, ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(*photographs[1].faces, ElementsAre(1, 2, 3, 4));
  RestrictToFaces(model, {0, 1}, photographs);
  EXPECT_THAT(*photographs[0].faces, ElementsAre(0, 1));
  EXPECT_THAT(*photographs[1].faces, ElementsAre(1));
}

TEST(RestrictToPairs, ALineThatNamesNothingIsLeftOutAlone) {
  const TemporaryFolder folder;
  const PolygonModel model = FiveWalls();
  std::vector<BakePhotograph> photographs = Named({"s1", "s2"});
  const std::vector<PhotographName> known = NamesOf(photographs);
  WriteFileAtomically(folder / "pairs.csv", "image,face\ns9,1\ns2,2\ns1,9\n");
  EXPECT_THAT(RestrictToPairs(folder / "pairs.csv", model, photographs, known),
              ElementsAre(AllOf(HasSubstr("pairs.csv:2: no photograph is called 's9'"),
                                HasSubstr("this line is left out")),
                          HasSubstr("pairs.csv:4: no face is called '9'")));
  EXPECT_THAT(*photographs[0].faces, ElementsAre(0, 2, 3, 4));
  EXPECT_THAT(*photographs[1].faces, ElementsAre(0, 1, 2, 3, 4));
}

TEST(RestrictToPairs, RangesHaveAnyDashAndSeveralFacesAreTold) {
  const TemporaryFolder folder;
  const PolygonModel model = FiveWalls();
  std::vector<BakePhotograph> photographs = Named({"s1", "s2"});
  WriteFileAtomically(folder / "pairs.csv",
                      "image,face\ns1,1\xE2\x80\x93"
                      "2\ns2,\"3,4\"\ns2,3 4\n");
  EXPECT_THAT(RestrictToPairs(folder / "pairs.csv", model, photographs),
              ElementsAre(AllOf(HasSubstr("pairs.csv:3: no face is called '3,4'; name one alone"),
                                HasSubstr("a range as 3-4")),
                          HasSubstr("pairs.csv:4: no face is called '3 4'; name one alone")));
  EXPECT_THAT(*photographs[0].faces, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(*photographs[1].faces, ElementsAre(2, 3, 4));
}

TEST(RestrictToPairs, WhatIsNoTableOfPairsIsAnError) {
  const TemporaryFolder folder;
  const PolygonModel model = FiveWalls();
  std::vector<BakePhotograph> photographs = Named({"s1"});
  const auto message = [&](const std::string& text) {
    WriteFileAtomically(folder / "pairs.csv", text);
    return ThrownMessage([&] { RestrictToPairs(folder / "pairs.csv", model, photographs); });
  };
  EXPECT_THAT(message("s1,1\n"), HasSubstr("pairs.csv:1: expected the first line"));
  EXPECT_THAT(message("image,face\ns1\n"),
              HasSubstr("pairs.csv:2: has 1 fields; the header has 2"));
}

TEST(UseMasks, TakesThoseThatAreThere) {
  const TemporaryFolder folder;
  std::vector<BakePhotograph> photographs = Named({"s1", "s2"});
  EXPECT_THAT(ThrownMessage([&] { UseMasks(folder.path(), photographs); }),
              HasSubstr("expected masks named after the photographs"));
  WriteSrgb8(folder / "s2.png", Image8(4, 4, 1));
  photographs[0].mask_file = "its own.png";
  UseMasks(folder.path(), photographs);
  EXPECT_EQ(photographs[0].mask_file, "its own.png");
  EXPECT_EQ(photographs[1].mask_file, folder / "s2.png");
}

TEST(FillGaps, PaintsWhatNobodySawAndSaysSo) {
  const TemporaryFolder folder;
  PolygonModel model;
  AddWall(model, 0, 20, 0, 12);
  AddFace(model, {{0, 4, 0}, {0, 4, 12}, {20, 4, 12}, {20, 4, 0}});  // seen by nobody
  const Paint paint = [](int, const Eigen::Vector3d&) { return Eigen::Array3f(0.3f, 0.2f, 0.1f); };
  const Camera camera = LookAt({10, -24, 6}, {10, 0, 6}, 320, 240, 280);
  BakePhotograph photograph = PhotographPainted(model, camera, paint, folder.path(), "s1");
  Image8 mask(320, 240, 1);
  for (int y = 100; y < 140; ++y) {
    for (int x = 140; x < 180; ++x) *mask.At(x, y) = 255;
  }
  photograph.mask_file = folder / "mask.png";
  WriteSrgb8(*photograph.mask_file, mask);
  const BakeResult open = BakeTextures(model, std::vector{photograph});
  BakeOptions options;
  options.fill_gaps = true;
  const BakeResult filled = BakeTextures(model, std::vector{photograph}, options);
  long num_filled = 0;
  for (const PlacedTexel& texel : TexelsOf(filled.model, 0)) {
    ASSERT_NE(texel.source, kProvenanceNone);
    num_filled += texel.source == kProvenanceFilled ? 1 : 0;
    ASSERT_NEAR(texel.radiance[0], 0.3, 0.03) << texel.point_in_world.transpose();
  }
  EXPECT_GT(num_filled, 1000);
  // What was painted over does not count as covered, and nothing comes from nothing.
  EXPECT_EQ(filled.coverage.CoveredShare(), open.coverage.CoveredShare());
  EXPECT_EQ(filled.model.faces[1].page, -1);
}

}  // namespace
}  // namespace groundglass
