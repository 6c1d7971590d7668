// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/hypotheses.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

// The house from the south-east, its photograph, and what the search is given of them. The slide
// lies this far off in its mount, as shares of the frame, and turned.
struct SlideOffRegister {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  ViewTag tag;
  Camera truth;
  EdgeEvidence evidence{Image8(kPhotoWidth, kPhotoHeight, 1), {}};
  CameraPrior prior;
  std::vector<EdgeSample> samples;

  SlideOffRegister(double shift_x, double shift_y, double roll_deg) {
    tag.position_in_site = {62, 48, 5};
    tag.lookat_in_site = {20, -4, 11};
    tag.aspect = 1.5;
    tag.view_angle_deg = 54;
    ViewTag true_tag = tag;
    true_tag.shift_x = shift_x;
    true_tag.shift_y = shift_y;
    true_tag.roll_deg = roll_deg;
    truth = CameraFromTag(true_tag, kPhotoWidth, kPhotoHeight);
    evidence = EdgeEvidence(PhotographModel(model, truth, 2, 1), {});
    prior = MakeCameraPrior(tag, kPhotoWidth, kPhotoHeight, model.unit, {}, {});
    samples = SampleVisibleEdges(
        edge_model, prior.CameraAt(CameraParameters::Zero()), 0.02 * kPhotoWidth, 10);
  }

  std::vector<Hypothesis> Find(const HypothesisOptions& options = {}) const {
    return FindHypotheses(samples, prior, evidence, options);
  }
  double ErrorPx(const Hypothesis& hypothesis) const {
    return VertexErrorPx(model, truth, prior.CameraAt(hypothesis.whitened));
  }
};

TEST(FindHypotheses, TheOneNearestTheTruthIsAmongThem) {
  const SlideOffRegister slide(0.025, -0.018, 1.2);
  const std::vector<Hypothesis> hypotheses = slide.Find();
  ASSERT_GT(hypotheses.size(), 1u);
  // The tag itself is the last.
  EXPECT_EQ(hypotheses.back().whitened, CameraParameters::Zero());
  EXPECT_GT(slide.ErrorPx(hypotheses.back()), 15);
  const auto nearest = std::ranges::min_element(
      hypotheses, {}, [&](const Hypothesis& one) { return slide.ErrorPx(one); });
  // Two cells of the search: refinement looks farther than that.
  EXPECT_LT(slide.ErrorPx(*nearest), 2.0 * kPhotoWidth / HypothesisOptions().width_cells);
}

TEST(FindHypotheses, TheBestComeFirstAndTheTagLast) {
  const SlideOffRegister slide(0.025, -0.018, 1.2);
  const std::vector<Hypothesis> hypotheses = slide.Find();
  EXPECT_TRUE(std::is_sorted(
      hypotheses.begin(), hypotheses.end() - 1, [](const Hypothesis& a, const Hypothesis& b) {
        return a.score > b.score;
      }));
  EXPECT_GT(hypotheses.front().score, hypotheses.back().score);
}

TEST(FindHypotheses, NoTwoAreTheSame) {
  // Also where the tag is right, and so a peak of the score itself.
  for (const double shift : {0.0, 0.02}) {
    const SlideOffRegister slide(shift, 0, 0);
    const std::vector<Hypothesis> hypotheses = slide.Find();
    for (size_t i = 0; i < hypotheses.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        EXPECT_GT((hypotheses[i].whitened - hypotheses[j].whitened).norm(), 1e-3)
            << shift << ": " << j << " and " << i;
      }
    }
  }
}

TEST(FindHypotheses, GivesAtMostAsManyAsAreAskedForAndTheSameEachTime) {
  const SlideOffRegister slide(0.025, -0.018, 1.2);
  HypothesisOptions options;
  options.max_starts = 3;
  const std::vector<Hypothesis> once = slide.Find(options);
  EXPECT_LE(once.size(), 4u);
  const std::vector<Hypothesis> again = slide.Find(options);
  ASSERT_EQ(once.size(), again.size());
  for (size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].whitened, again[i].whitened);
    EXPECT_EQ(once[i].score, again[i].score);
  }
}

// Three sigmas of a shift of 0.015 are 27 px here: what lies far beyond is not looked for.
TEST(FindHypotheses, LooksNoFartherThanThePriorAllows) {
  const SlideOffRegister slide(0.2, 0, 0);
  for (const Hypothesis& hypothesis : slide.Find()) {
    EXPECT_GT(slide.ErrorPx(hypothesis), 20);
    EXPECT_LT(hypothesis.whitened.norm(), 6);
  }
}

// Such a grid has more points than any memory holds before its steps have grown.
TEST(FindHypotheses, AWidePriorIsSearchedWithFewPointsToo) {
  SlideOffRegister slide(0.025, -0.018, 1.2);
  PriorOptions prior;
  prior.position_m = 1000;
  slide.prior = MakeCameraPrior(slide.tag, kPhotoWidth, kPhotoHeight, slide.model.unit, {}, prior);
  EXPECT_LE(slide.Find().size(), static_cast<size_t>(HypothesisOptions().max_starts) + 1);
}

TEST(PriorNonlinearity, GrowsWithTheSquareOfThePrior) {
  const SlideOffRegister slide(0, 0, 0);
  CameraPrior twice = slide.prior;
  twice.root *= 2;
  const double once_px = PriorNonlinearity(slide.samples, slide.prior);
  EXPECT_GT(once_px, 0);
  EXPECT_NEAR(PriorNonlinearity(slide.samples, twice) / once_px, 4, 0.4);
}

}  // namespace
}  // namespace groundglass
