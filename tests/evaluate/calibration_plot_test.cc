// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/calibration_plot.h"

#include "scene/error.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace groundglass {
namespace {

Trial MakeTrial(std::optional<double> confidence) {
  Trial trial;
  trial.confidence = confidence;
  return trial;
}

TEST(CalibrationCurve, CountsWhatIsJudged) {
  const CalibrationCurve curve = CalibrationCurveOf(
      "hall", {MakeTrial(0.2), MakeTrial(std::nullopt), MakeTrial(0.6), MakeTrial(0.99)});
  EXPECT_EQ(curve.confidences.size(), 3u);
  EXPECT_EQ(curve.ShareInside(0.1), 0);
  EXPECT_NEAR(curve.ShareInside(0.6), 2.0 / 3, 1e-12);
  EXPECT_EQ(curve.ShareInside(1), 1);
  EXPECT_EQ(CalibrationCurve().ShareInside(0.5), 0);
}

TEST(CalibrationCurve, ComesBackFromTheTrialsAsPrinted) {
  const TemporaryFolder folder;
  const std::vector<Trial> trials = {MakeTrial(0.25), MakeTrial(std::nullopt), MakeTrial(0.5)};
  std::ofstream(folder / "hall.json") << FormatTrialsJson(trials, {});
  EXPECT_THAT(ReadCalibrationCurve("hall", folder / "hall.json").confidences,
              testing::ElementsAre(0.25, 0.5));
  std::ofstream(folder / "other.json") << "{\"trials\": [{}]}";
  EXPECT_THAT([&] { ReadCalibrationCurve("other", folder / "other.json"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("evaluate --trials --json")));
}

TEST(FormatCalibrationPlot, DrawsStepsWhereTheTruthsAre) {
  // A panel 420 high and wide from 64, 44: half the truths lie inside the 25 % ellipsoid, all
  // inside the 50 % one.
  const std::string svg = FormatCalibrationPlot({{"hall & yard", {0.5, 0.25}}, {"block", {0.97}}});
  EXPECT_THAT(svg, testing::HasSubstr("M64.0 464.0H169.0V254.0H274.0V44.0H484.0"));
  EXPECT_THAT(svg, testing::HasSubstr("hall &amp; yard: 100 % of 2 inside 95 %"));
  EXPECT_THAT(svg, testing::HasSubstr("block: 0 % of 1 inside 95 %"));
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(FormatCalibrationPlot, HasAPictureForNothingToo) {
  EXPECT_THAT(FormatCalibrationPlot({{"empty", {}}}), testing::HasSubstr("</svg>"));
}

}  // namespace
}  // namespace groundglass
