// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/face_number.h"

#include "scene/coverage.h"
#include "scene/formats/convert.h"
#include "scene/formats/model_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Five faces, of which the second is a sliver and the fourth lies twice.
constexpr const char* kFive =
    "# unit: m\nv 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\nv 2 0 0\nv 4 5 0\nv 0 5 0\n"
    "g south\nf 1 2 3 4\ng sliver\nf 1 5 2\ng lawn\nf 1 2 6 7\ng again\nf 4 3 2 1\n"
    "g east\nf 2 6 3\n";

std::vector<int> Numbers(const PolygonModel& model) {
  std::vector<int> numbers;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    numbers.push_back(FaceNumber(model, face));
  }
  return numbers;
}

TEST(FaceNumber, StaysTheFilesWhereFacesAreLeftOut) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadModel(folder.Write("m.obj", kFive));
  const PolygonModel& model = reading.model;
  EXPECT_THAT(Numbers(model), ElementsAre(1, 3, 5));
  EXPECT_EQ(DescribeFace(model, 2), "face 5 (east)");
  EXPECT_EQ(FindFaceByNumber(model, 3), 1);
  EXPECT_EQ(FindFaceByNumber(model, 2), std::nullopt);
  EXPECT_EQ(HighestFaceNumber(model), 5);
  EXPECT_EQ(FormatFaceNumbers(model), "1 3 5");
  for (const char* output : {"m.osu", "again.obj", "m.glb"}) {
    ConvertModel(folder / "m.obj", folder / output, {});
    EXPECT_THAT(Numbers(ReadModel(folder / output).model), ElementsAre(1, 3, 5)) << output;
  }
  EXPECT_THAT(ReadTextFile(folder / "m.osu"), HasSubstr("\n% face numbers: 1 3 5\n"));
}

TEST(FaceNumber, LabelPicturesGoThereAndBack) {
  const TemporaryFolder folder;
  const PolygonModel model = ReadModel(folder.Write("m.obj", kFive)).model;
  Image16 labels(4, 1, 1);
  labels.values = {0, 1, 2, 3};
  const Image16 numbers = NumbersFromLabels(model, labels);
  EXPECT_THAT(numbers.values, ElementsAre(0, 1, 3, 5));
  EXPECT_EQ(LabelsFromNumbers(model, numbers, "faces/s1.png").values, labels.values);
  const auto message = [&](uint16_t number) {
    return ThrownMessage([&] { LabelsFromNumbers(model, Image16(1, 1, 1, number), "s1.png"); });
  };
  EXPECT_EQ(message(2), "s1.png: names face 2, which is left out of the model");
  EXPECT_EQ(message(9), "s1.png: names face 9, but the model has 5");
  EXPECT_THAT(KnownLabelsFromNumbers(model, Image16(1, 1, 1, 2)).values, ElementsAre(65535));
}

TEST(FaceNumber, ModelsThatCountWithoutAGapSayNothing) {
  PolygonModel model = ParseOsu("3 1 0 0 0 1 0 0 0 1 0 3 1 2 3", "m").model;
  EXPECT_EQ(FormatFaceNumbers(model), "");
  EXPECT_EQ(model.faces[0].number, 1);
  // A list that does not suit the model is not believed.
  for (const char* text : {"", "1 2", "2-9999999999", "x", "3-1", "0"}) {
    ApplyFaceNumbers(text, model);
    EXPECT_EQ(FaceNumber(model, 0), 1) << text;
  }
  ApplyFaceNumbers("12", model);
  EXPECT_EQ(FaceNumber(model, 0), 12);
}

TEST(FormatCoverage, GivesTheFilesNumber) {
  Coverage coverage;
  coverage.faces.resize(2);
  coverage.faces[0].face = 0;
  coverage.faces[1].face = 1;
  coverage.faces[1].number = 5;
  EXPECT_THAT(FormatCoverage(coverage), HasSubstr("\"face\": 1,"));
  EXPECT_THAT(FormatCoverage(coverage), HasSubstr("\"face\": 5,"));
}

}  // namespace
}  // namespace groundglass
