// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/blender.h"

#include "tests/invrender/prepared_wall.h"
#include "tests/invrender/select/made_blocks.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

namespace groundglass {
namespace {

// A wall of 13 x 7 blocks, of which the left seven columns chose the first photograph and the
// others the second, both of which see all of it equally well in the middle.
class BlendedWall : public testing::Test {
 protected:
  static constexpr int kColumns = 13;
  static constexpr int kRows = 7;
  static constexpr int kSeam = 35;    // the first texel of the second photograph's blocks
  static constexpr int kMiddle = 16;  // a row far from borders

  BlendedWall() {
    for (int block = 0; block < blocks_.NumBlocks(); ++block) {
      choice_.best.push_back(block % kColumns < kSeam / kBlockTexels ? 0 : 1);
    }
    choice_.consistency.assign(blocks_.views.size(), 1);
  }
  Blender Make() const { return Make(options_); }
  Blender Make(const BlendOptions& options) const {
    return {{wall_.charts[0],
             0,
             texels_,
             wall_.photos,
             wall_.options.photos.border_margin_px,
             blocks_,
             choice_},
            options};
  }
  // Weights by k.
  static std::map<int, double> Weights(const Blender& blender, int x, int y) {
    std::vector<Contribution> contributions;
    blender.Gather(x, y, contributions);
    std::map<int, double> weights;
    for (const Contribution& contribution : contributions)
      weights[contribution.k] = contribution.weight;
    return weights;
  }

  // Texel 34's centre, at 4.3125, lies midway between the cameras.
  const PreparedWall wall_{{CameraBefore(3.3125), CameraBefore(5.3125)}, {0.2f, 0.4f}};
  const ChartTexels texels_{wall_.model, wall_.charts[0]};
  const ChartBlocks blocks_ = MakeBlocks(kColumns, kRows, 2);
  BlendOptions options_;
  ChartChoice choice_;
};

TEST_F(BlendedWall, TexelsAmidBlocksOfOneChoiceAreItsAlone) {
  const Blender blender = Make();
  EXPECT_EQ(blender.ChosenByAll(kSeam - 10, kMiddle), 0);
  EXPECT_EQ(blender.ChosenByAll(kSeam + 10, kMiddle), 1);
  EXPECT_EQ(Weights(blender, kSeam - 10, kMiddle), (std::map<int, double>{{0, 1.0}}));
  EXPECT_EQ(Weights(blender, kSeam + 10, kMiddle), (std::map<int, double>{{1, 1.0}}));
}

// Blocks' middles are five texels apart; the seam lies half way.
TEST_F(BlendedWall, WeightsChangeEvenlyAcrossASeam) {
  const Blender blender = Make();
  for (int i = 0; i < 5; ++i) {
    std::map<int, double> weights = Weights(blender, kSeam - 3 + i, kMiddle);
    EXPECT_NEAR(weights[0], 1 - 0.2 * i, 1e-9) << i;
    EXPECT_NEAR(weights[1], 0.2 * i, 1e-9) << i;
  }
  EXPECT_EQ(blender.ChosenByAll(kSeam - 1, kMiddle), -1);
}

TEST_F(BlendedWall, HardSeamsTakeTheBlocksOwn) {
  BlendOptions hard;
  hard.across_seams = false;
  const Blender blender = Make(hard);
  EXPECT_EQ(Weights(blender, kSeam - 1, kMiddle), (std::map<int, double>{{0, 1.0}}));
  EXPECT_EQ(Weights(blender, kSeam, kMiddle), (std::map<int, double>{{1, 1.0}}));
}

// Where nobody was chosen, the fourth power of quality decides.
TEST_F(BlendedWall, OthersAreAskedWhereNobodyWasChosen) {
  choice_.best.assign(choice_.best.size(), -1);
  std::map<int, double> weights = Weights(Make(), kSeam - 1, kMiddle);
  EXPECT_NEAR(weights[0], 0.5, 0.01);
  EXPECT_NEAR(weights[1], 0.5, 0.01);
  for (size_t i = 1; i < choice_.consistency.size(); i += 2) choice_.consistency[i] = 0.5f;
  weights = Weights(Make(), kSeam - 1, kMiddle);
  EXPECT_NEAR(weights[0], 16.0 / 17, 0.005);
  EXPECT_NEAR(weights[1], 1.0 / 17, 0.005);
  options_.negligible = 0.1;
  EXPECT_EQ(Weights(Make(), kSeam - 1, kMiddle), (std::map<int, double>{{0, 1.0}}));
}

// Texels of 0.8 px: of larger ones, a run is longer than what masks tell of borders' distances.
TEST_F(BlendedWall, RunsEndAtSeamsBordersAndTheChartsEnd) {
  Chart fine = wall_.charts[0];
  fine.SetTexelSize(0.04);
  const ChartTexels texels(wall_.model, fine);
  ASSERT_EQ(texels.width(), 200);
  const ChartBlocks blocks = MakeBlocks(40, 20, 2);
  ChartChoice choice;
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    choice.best.push_back(block % 40 < 20 ? 0 : 1);
  }
  choice.consistency.assign(blocks.views.size(), 1);
  const Blender blender(
      {fine, 0, texels, wall_.photos, wall_.options.photos.border_margin_px, blocks, choice},
      options_);
  std::array<SurfaceObservation, Blender::kRunTexels> run;
  std::vector<int> chosen;
  blender.ChooseRow(50, chosen);
  ASSERT_EQ(blender.GatherRun(40, 50, chosen, run), Blender::kRunTexels);
  for (int i = 1; i < Blender::kRunTexels; ++i) {
    EXPECT_NEAR(run[i].image_px.x() - run[i - 1].image_px.x(), 0.8, 1e-6) << i;
  }
  EXPECT_EQ(blender.GatherRun(96, 50, chosen, run), 0);
  EXPECT_EQ(blender.GatherRun(200 - Blender::kRunTexels + 1, 50, chosen, run), 0);
  blender.ChooseRow(0, chosen);
  EXPECT_EQ(blender.GatherRun(40, 0, chosen, run), 0);
}

TEST_F(BlendedWall, GoodTexelsHaveAWeightyPhotographBeyondTheMargin) {
  const Blender blender = Make();
  const auto is_good = [&](double weight, double border_px) {
    Contribution contribution{0, weight, true, {}};
    contribution.observation.border_px = border_px;
    return blender.IsGood({contribution});
  };
  EXPECT_TRUE(is_good(0.31, 2));
  EXPECT_FALSE(is_good(0.3, 2));
  EXPECT_FALSE(is_good(1, 1.9));
}

// A pixel's diagonal is 0.0707 units; margin and reach are three of them, 1.7 texels.
TEST_F(BlendedWall, ReachIsTheMarginInTexels) {
  const Blender blender = Make();
  SurfaceObservation observation;
  observation.px_from_unit = 20 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(blender.ReachFromBorder(observation), 3);
  observation.px_from_unit = 0.01 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(blender.ReachFromBorder(observation), 32);
  observation.px_from_unit.setZero();
  EXPECT_EQ(blender.ReachFromBorder(observation), 1);
}

}  // namespace
}  // namespace groundglass
