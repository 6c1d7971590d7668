// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine_set.h"

#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "tests/register/house.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Three slides of the bundled hall; s1 and s3 show the same walls, s12 others.
class RefineSetTest : public testing::Test {
 protected:
  RefineSetTest() {
    for (const Photograph& photograph : scene_.photographs) {
      const std::string& name = photograph.name;
      if (name != "s1" && name != "s3" && name != "s12") continue;
      alignments_.push_back(AlignPhotograph(
          {name, ReadGrey8(photograph.image_file), {}, photograph.tag, {}}, edge_model_, {}));
    }
  }

  PhotographAlignment& Of(const std::string& name) {
    for (PhotographAlignment& alignment : alignments_) {
      if (alignment.registration.name == name) return alignment;
    }
    throw std::runtime_error("no " + name);
  }

  // As if its edges had not told it from another camera.
  void PutInReview(const std::string& name) {
    Registration& registration = Of(name).registration;
    ASSERT_EQ(registration.verdict, Verdict::kAccepted);
    registration.verdict = Verdict::kReview;
    registration.reasons = {"another camera fits almost as well"};
  }

  const Scene scene_ =
      ReadScene(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick");
  const EdgeModel edge_model_{scene_.model};
  std::vector<PhotographAlignment> alignments_;
};

TEST_F(RefineSetTest, APhotographInReviewOfWhichOthersShowTheSameJoinsThem) {
  PutInReview("s3");
  PutInReview("s12");
  RefineSet(edge_model_, {}, alignments_);
  EXPECT_EQ(Of("s3").registration.verdict, Verdict::kAccepted);
  ASSERT_TRUE(Of("s3").registration.ties);
  EXPECT_GE(Of("s3").registration.ties->num_agreeing, 6);
  // Nothing that another shows is in s12.
  EXPECT_EQ(Of("s12").registration.verdict, Verdict::kReview);
  EXPECT_FALSE(Of("s12").registration.ties);
}

TEST_F(RefineSetTest, WithoutTiesItStaysAlone) {
  PutInReview("s3");
  RegisterOptions options;
  options.use_ties = false;
  RefineSet(edge_model_, options, alignments_);
  EXPECT_EQ(Of("s3").registration.verdict, Verdict::kReview);
}

// A common solution that is right for all but one photograph, as long as that one is in it.
TEST_F(RefineSetTest, APhotographThatIsPulledAwayIsReviewedAndKeepsItsOwnCamera) {
  const ViewTag alone = Of("s3").registration.corrected;
  std::vector<size_t> sizes;
  RegisterOptions options;
  options.refine_together = [&](const EdgeModel& edge_model,
                                const std::vector<AlignedPhotograph>& photographs,
                                const std::vector<int>& lenses,
                                const std::vector<TiePoint>& ties,
                                const JointOptions& joint_options) {
    JointRefinement joint = RefineTogether(edge_model, photographs, lenses, ties, joint_options);
    sizes.push_back(photographs.size());
    for (size_t i = 0; i < photographs.size(); ++i) {
      if (photographs[i].picture == Of("s3").aligned.picture) joint.photographs[i].whitened[0] += 3;
    }
    return joint;
  };
  RefineSet(edge_model_, options, alignments_);
  const Registration& pulled = Of("s3").registration;
  EXPECT_EQ(pulled.verdict, Verdict::kReview);
  EXPECT_THAT(pulled.reasons, ElementsAre(HasSubstr("do not agree on one camera")));
  EXPECT_EQ(pulled.corrected, alone);
  EXPECT_EQ(Of("s1").registration.verdict, Verdict::kAccepted);
  EXPECT_EQ(Of("s12").registration.verdict, Verdict::kAccepted);
  EXPECT_THAT(sizes, ElementsAre(3u, 2u, 2u));
}

// Of photographs that the common solution does not suit, the one that had only joined leaves first,
// and with it gone the others are as they were.
TEST_F(RefineSetTest, ThePhotographThatHadOnlyJoinedLeavesFirst) {
  PutInReview("s3");
  RegisterOptions options;
  options.refine_together = [&](const EdgeModel& edge_model,
                                const std::vector<AlignedPhotograph>& photographs,
                                const std::vector<int>& lenses,
                                const std::vector<TiePoint>& ties,
                                const JointOptions& joint_options) {
    JointRefinement joint = RefineTogether(edge_model, photographs, lenses, ties, joint_options);
    if (photographs.size() < 3) return joint;
    for (JointSolution& solution : joint.photographs) solution.whitened[0] += 3;
    return joint;
  };
  RefineSet(edge_model_, options, alignments_);
  EXPECT_EQ(Of("s1").registration.verdict, Verdict::kAccepted);
  EXPECT_EQ(Of("s12").registration.verdict, Verdict::kAccepted);
  EXPECT_EQ(Of("s3").registration.verdict, Verdict::kReview);
}

// By itself and in a set.
TEST_F(RefineSetTest, APhotographInReviewNamesTheCameraThatItMayHaveInstead) {
  for (const bool is_set : {false, true}) {
    if (is_set) RefineSet(edge_model_, {}, alignments_);
    Registration& registration = Of("s1").registration;
    ASSERT_EQ(registration.verdict, Verdict::kAccepted);
    ASSERT_TRUE(registration.margin_nats);
    ASSERT_TRUE(registration.rival);
    const Camera rival =
        CameraFromTag(*registration.rival, registration.width_px, registration.height_px);
    EXPECT_GT(VertexErrorPx(scene_.model, registration.CorrectedCamera(), rival), 2)
        << "nobody could tell the two apart";
  }
  PutInReview("s1");
  FinishVerdict({}, Of("s1"));
  EXPECT_TRUE(Of("s1").registration.rival);
  ASSERT_TRUE(Of("s3").registration.rival);
  FinishVerdict({}, Of("s3"));
  EXPECT_FALSE(Of("s3").registration.rival) << "it is accepted";
}

}  // namespace
}  // namespace groundglass
