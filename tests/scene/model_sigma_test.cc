// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_sigma.h"

#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

// A triangle, 5 units from corner to corner.
std::string Osu(const std::string& comments) {
  return comments + "3 1\n0 0 0\n4 0 0\n4 -3 0\n3 1 2 3\n";
}

PolygonModel OfSize(double size, LengthUnit unit) {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0}, {0.8 * size, 0, 0}, {0.8 * size, 0.6 * size, 0}};
  model.faces = {{{0, 1, 2}, ""}};
  model.unit = unit;
  return model;
}

TEST(ModelSigma, IsThreeCentimetresForBuildings) {
  EXPECT_DOUBLE_EQ(ModelSigma(OfSize(20, LengthUnit::kMetre)), 0.03);
  EXPECT_DOUBLE_EQ(ModelSigma(OfSize(200, LengthUnit::kMetre)), 0.03);
  EXPECT_DOUBLE_EQ(ModelSigma(OfSize(60, LengthUnit::kFoot)), 0.03 / 0.3048);
  EXPECT_DOUBLE_EQ(ModelSigma(OfSize(20000, LengthUnit::kMillimetre)), 30);
}

TEST(ModelSigma, IsSmallerForMaquettes) {
  // 0.03 m (size / 15 m)^(5/4).
  EXPECT_NEAR(ModelSigma(OfSize(0.9375, LengthUnit::kMetre)), 0.03 / 32, 1e-12);
  EXPECT_NEAR(ModelSigma(OfSize(937.5, LengthUnit::kMillimetre)), 30.0 / 32, 1e-9);
  // No less than 0.3 mm.
  EXPECT_NEAR(ModelSigma(OfSize(0.3, LengthUnit::kMetre)), 0.0003, 1e-12);
  EXPECT_NEAR(ModelSigma(OfSize(300, LengthUnit::kMillimetre)), 0.3, 1e-9);
  EXPECT_NEAR(ModelSigma(OfSize(30, LengthUnit::kCentimetre)), 0.03, 1e-9);
  EXPECT_NEAR(ModelSigma(OfSize(12, LengthUnit::kInch)), 0.0118110, 1e-6);
  // What is smaller still: 0.2 %.
  EXPECT_NEAR(ModelSigma(OfSize(50, LengthUnit::kMillimetre)), 0.1, 1e-9);
  // No step where a maquette becomes a building.
  EXPECT_NEAR(ModelSigma(OfSize(14.999, LengthUnit::kMetre)), 0.03, 1e-5);
  // A hall of 40 m and its maquette at 1:100 are known to the same share.
  EXPECT_NEAR(ModelSigma(OfSize(0.4, LengthUnit::kMetre)) / 0.4,
              ModelSigma(OfSize(40, LengthUnit::kMetre)) / 40,
              0.1 * 0.03 / 40);
}

TEST(ModelSigma, IsInProportionWhereTheUnitIsAssumedAndCannotBe) {
  PolygonModel model = OfSize(30000, LengthUnit::kFoot);  // a building in millimetres
  EXPECT_DOUBLE_EQ(ModelSigma(model), 0.03 / 0.3048);
  model.is_unit_assumed = true;
  EXPECT_NEAR(ModelSigma(model), 30, 1e-9);
  model = OfSize(100, LengthUnit::kFoot);
  model.is_unit_assumed = true;
  EXPECT_DOUBLE_EQ(ModelSigma(model), 0.03 / 0.3048);
}

TEST(ModelSigma, WhatTheModelSaysCounts) {
  PolygonModel model = OfSize(20, LengthUnit::kMetre);
  EXPECT_EQ(DescribeModelSigma(model),
            "0.03 m, by default ('% sigma:' in the model or --sigma-model says another)");
  model.sigma = 0.1;
  EXPECT_EQ(ModelSigma(model), 0.1);
  EXPECT_EQ(DescribeModelSigma(model), "0.1 m");
}

TEST(SigmaComment, IsReadFromOsuInTheModelsUnit) {
  EXPECT_EQ(ParseOsu(Osu("% sigma: 0.1\n"), "a.osu").model.sigma, 0.1);
  EXPECT_EQ(ParseOsu(Osu("% Sigma: 2.5 how far its edges may lie off\n% unit: mm\n"), "a.osu")
                .model.sigma,
            2.5);
  EXPECT_EQ(ParseOsu(Osu("% sigma: 2.5 mm\n% unit: mm\n"), "a.osu").model.sigma, 2.5);
  EXPECT_FALSE(ParseOsu(Osu("% unit: m\n"), "a.osu").model.sigma.has_value());
}

TEST(SigmaComment, ThatIsNoLengthIsAnErrorWithItsLine) {
  for (const std::string bad : {"", "0", "-1", "nan", "inf", "wide", "0,1"}) {
    EXPECT_THAT(ThrownMessage([&] { ParseOsu(Osu("% a house\n% sigma: " + bad + "\n"), "a.osu"); }),
                testing::StartsWith("a.osu:2: sigma: '" + bad + "' is not a length above 0"));
  }
  EXPECT_THAT(ThrownMessage([&] { ParseOsu(Osu("% unit: m\n% sigma: 30 mm\n"), "a.osu"); }),
              testing::HasSubstr("a.osu:2: sigma is in mm, but the model is in m"));
  EXPECT_THAT(ThrownMessage([&] { ParseOsu(Osu("% unit: m\n% sigma: 0.1 %\n"), "a.osu"); }),
              testing::HasSubstr("a.osu:2: sigma: a share of nothing that is known"));
}

TEST(SigmaComment, SurvivesEveryFormatThatIsWritten) {
  PolygonModel model = OfSize(5, LengthUnit::kMetre);
  model.sigma = 0.0123;
  EXPECT_EQ(ParseOsu(FormatOsu(model), "a.osu").model.sigma, 0.0123);
  const TemporaryFolder folder;
  EXPECT_EQ(ReadModel(folder.Write("a.obj", FormatObj(model))).model.sigma, 0.0123);
  TexturedModel textured;
  textured.model = model;
  textured.faces.resize(1);
  WriteGlb(folder / "b.glb", textured);
  EXPECT_EQ(ReadModel(folder / "b.glb").model.sigma, 0.0123);
  // Another unit, the same length.
  ModelOptions in_mm;
  in_mm.unit = LengthUnit::kMillimetre;
  EXPECT_NEAR(*ReadModel(folder / "b.glb", in_mm).model.sigma, 12.3, 1e-9);
  WriteTexturedObj(folder / "c.obj", textured);
  EXPECT_EQ(ReadTexturedModel(folder / "c.obj").textured.model.sigma, 0.0123);
}

TEST(SigmaComment, OfAnObjIsCheckedToo) {
  const TemporaryFolder folder;
  const auto file = folder.Write("a.obj", "# sigma: much\nv 0 0 0\nv 4 0 0\nv 4 3 0\nf 1 2 3\n");
  EXPECT_THAT(ThrownMessage([&] { ReadModel(file); }),
              testing::HasSubstr("a.obj:1: sigma: 'much' is not a length above 0"));
}

}  // namespace
}  // namespace groundglass
