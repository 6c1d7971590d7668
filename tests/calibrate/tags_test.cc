// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_tags.h"
#include "scene/frames.h"
#include "tests/calibrate/board_photographs.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// Two tags side by side, 0.5 wide and 1 apart, on a wall that faces south at y = 0 in `world`; the
// first one's top left corner stands at (3, 0, 2).
Board WallTags() {
  Board board;
  board.columns = 2;
  board.rows = 1;
  board.april_tag_size = 0.5;
  board.gap = 0.5;
  board.first_id = 7;
  return board;
}

RigidTransform BoardFromWorld() {
  RigidTransform board_from_world;
  board_from_world.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  board_from_world.translation = -(board_from_world.rotation * Eigen::Vector3d(3, 0, 2));
  return board_from_world;
}

std::vector<SurveyedTag> Survey(double sigma) {
  std::vector<SurveyedTag> tags;
  const RigidTransform world_from_board = Inverse(BoardFromWorld());
  for (int i = 0; i < 2; ++i) {
    const Eigen::Matrix<double, 2, 4> on_board = AprilTagCornersOnBoard(WallTags(), i);
    SurveyedTag tag;
    tag.id = 7 + i;
    tag.sigma = sigma;
    for (int corner = 0; corner < 4; ++corner) {
      tag.corners_in_world.col(corner) =
          world_from_board * Eigen::Vector3d(on_board(0, corner), on_board(1, corner), 0);
    }
    tags.push_back(tag);
  }
  return tags;
}

ViewTag LensTag() {
  ViewTag lens;
  lens.view_angle_deg = 50;
  lens.aspect = 1.5;
  lens.k1 = -0.05;
  lens.sigmas.view_angle_deg = 0.2;
  lens.sigmas.shift = 0.002;
  lens.sigmas.k1 = 0.005;
  return lens;
}

ViewTag Standpoint(std::mt19937_64& random) {
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  ViewTag tag = LensTag();
  tag.position_in_site = {between(1, 6), between(2.5, 5), between(1, 2.2)};
  tag.lookat_in_site = {between(3.3, 4.2), 0, between(1.5, 2)};
  tag.roll_deg = between(-3, 3);
  return tag;
}

class CalibrateTagsTest : public testing::Test {
 protected:
  static constexpr int kWidth = 480;
  static constexpr int kHeight = 320;

  Image8 Photograph(const ViewTag& tag, std::mt19937_64& random) const {
    const Camera camera = CameraFromTag(tag, kWidth, kHeight);
    return studio_.Photograph(
        camera.cam_from_world * Inverse(BoardFromWorld()), BoardStudio::Look(), random);
  }

  BoardStudio studio_{WallTags(), CameraFromTag(LensTag(), kWidth, kHeight)};
};

TEST_F(CalibrateTagsTest, TwoTagsTellTheStandpointWithinItsDeviations) {
  std::mt19937_64 random(4);
  constexpr int kTrials = 6;
  double squares = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ViewTag truth = Standpoint(random);
    const TagsResult found = CalibrateTags(Photograph(truth, random), Survey(0.005), LensTag());
    ASSERT_TRUE(found.is_found) << found.reason;
    EXPECT_THAT(found.ids, ElementsAre(7, 8));
    EXPECT_LT(found.rms_px, 0.5);
    const Eigen::Vector3d off = found.tag.position_in_site - truth.position_in_site;
    EXPECT_LT(off.head<2>().norm(), 5 * *found.tag.sigmas.position);
    EXPECT_LT(std::abs(off.z()), 4 * *found.tag.sigmas.height);
    EXPECT_LT(off.norm(), 0.1);
    EXPECT_LT(std::abs(found.tag.roll_deg - truth.roll_deg), 4 * *found.tag.sigmas.roll_deg);
    // The look-at point lies on the true axis, where it is known better than the place.
    const Camera camera = CameraFromTag(truth, kWidth, kHeight);
    const Eigen::Vector3d in_cam = camera.cam_from_world * WorldFromSite(found.tag.lookat_in_site);
    EXPECT_LT(in_cam.head<2>().norm(), 5 * *found.tag.sigmas.lookat);
    EXPECT_LT(*found.tag.sigmas.lookat, 0.05);
    squares += off.head<2>().squaredNorm() / 2 / std::pow(*found.tag.sigmas.position, 2);
  }
  EXPECT_LT(squares / kTrials, 2.5);
}

// A tag 20 px large whose picture allows two standpoints, metres apart.
TEST_F(CalibrateTagsTest, AWrittenPlaceTellsWhichOfTwoWaysASmallTagFaces) {
  std::mt19937_64 random(6);
  const std::vector<SurveyedTag> survey = {Survey(0.005)[0]};
  int num_by_tag = 0;
  int num_by_place = 0;
  int num_by_blunder = 0;
  constexpr int kTrials = 6;
  for (int trial = 0; trial < kTrials; ++trial) {
    ViewTag truth = LensTag();
    truth.position_in_site = {3 + 0.8 * trial, 10, 1.7};
    truth.lookat_in_site = {3.3, 0, 1.75};
    const Image8 picture = Photograph(truth, random);
    const auto find = [&](const std::optional<WrittenPlace>& written) {
      return CalibrateTags(picture, survey, LensTag(), {}, written);
    };
    const TagsResult by_tag = find(std::nullopt);
    num_by_tag += by_tag.is_found;
    if (!by_tag.is_found) {
      EXPECT_THAT(by_tag.reason, HasSubstr("which of two ways it faces, and no place in views/"));
    }
    const Eigen::Vector3d written = truth.position_in_site + Eigen::Vector3d(0.1, -0.1, 0.05);
    const TagsResult by_place = find(WrittenPlace{written, 0.1});
    if (by_place.is_found) {
      ++num_by_place;
      const Eigen::Vector3d off = by_place.tag.position_in_site - truth.position_in_site;
      EXPECT_LT(off.head<2>().cwiseAbs().maxCoeff(), 4 * *by_place.tag.sigmas.position) << trial;
      EXPECT_LT(off.head<2>().norm(), 2.5) << trial;
    }
    // One that suits neither says nothing.
    num_by_blunder += find(WrittenPlace{{-60, 300, 40}, 0.1}).is_found;
  }
  EXPECT_EQ(num_by_place, kTrials);
  EXPECT_LT(num_by_tag, kTrials);
  EXPECT_EQ(num_by_blunder, num_by_tag);
}

TEST_F(CalibrateTagsTest, SmallTagsAreMeasuredAndNotTheDetectorsAlone) {
  std::mt19937_64 random(7);
  double squares = 0;
  int num_corners = 0;
  for (int trial = 0; trial < 4; ++trial) {
    ViewTag truth = LensTag();
    truth.position_in_site = {2.5 + trial, 12, 1.7};
    truth.lookat_in_site = {3.7, 0, 1.75};
    const auto corners = CalibrateTags(Photograph(truth, random), Survey(0.005), LensTag()).corners;
    const Camera camera = CameraFromTag(truth, kWidth, kHeight);
    for (const SeenTagCorner& corner : corners) {
      EXPECT_LT(corner.sigma_px, 0.4);
      squares += (corner.image_px - *Project(camera, corner.surveyed_in_world)).squaredNorm() / 2;
      ++num_corners;
    }
  }
  EXPECT_GE(num_corners, 6 * 4);
  // The detector's are off by 0.2 to 0.3.
  EXPECT_LT(std::sqrt(squares / num_corners), 0.18);
}

// A scanner's pixels are not quite square, and the lens' number for it errs by its deviation.
TEST_F(CalibrateTagsTest, AnAspectThatErrsByItsDeviationIsAllowedFor) {
  std::mt19937_64 random(8);
  ViewTag lens = LensTag();
  lens.aspect *= 1.01;
  lens.sigmas.aspect = 0.015;
  for (int trial = 0; trial < 4; ++trial) {
    const ViewTag truth = Standpoint(random);
    const TagsResult found = CalibrateTags(Photograph(truth, random), Survey(0.005), lens);
    ASSERT_TRUE(found.is_found) << found.reason;
    const Eigen::Vector3d off = found.tag.position_in_site - truth.position_in_site;
    EXPECT_LT(off.head<2>().cwiseAbs().maxCoeff(), 3 * *found.tag.sigmas.position);
    EXPECT_LT(std::abs(off.z()), 3 * *found.tag.sigmas.height);
    EXPECT_LT(std::abs(found.tag.aspect - LensTag().aspect), 2 * *lens.sigmas.aspect);
  }
}

TEST_F(CalibrateTagsTest, APhotographWithoutSurveyedTagsSaysSo) {
  const Image8 grey(200, 100, 1, 120);
  EXPECT_EQ(CalibrateTags(grey, Survey(0.01), LensTag()).reason,
            "it shows none of the surveyed tags");
}

TEST_F(CalibrateTagsTest, NoLensMakesUpForAWrongSurvey) {
  std::mt19937_64 random(5);
  const Image8 photograph = Photograph(Standpoint(random), random);
  EXPECT_TRUE(CalibrateTags(photograph, Survey(0.005), LensTag()).is_found);
  // Every view angle but the known one is then too far from it.
  TagsOptions options;
  options.most_lens_sigmas = 1e-9;
  const TagsResult found = CalibrateTags(photograph, Survey(0.005), LensTag(), options);
  EXPECT_FALSE(found.is_found);
  EXPECT_THAT(found.reason, HasSubstr("suit only a view angle of"));
}

TEST_F(CalibrateTagsTest, ATagThatWasSurveyedElsewhereIsNoticed) {
  std::mt19937_64 random(5);
  std::vector<SurveyedTag> survey = Survey(0.005);
  survey[1].corners_in_world.colwise() += Eigen::Vector3d(0.8, 0, 0.9);
  const TagsResult found = CalibrateTags(Photograph(Standpoint(random), random), survey, LensTag());
  EXPECT_FALSE(found.is_found);
  EXPECT_THAT(found.reason, HasSubstr("miss their surveyed places"));
}

class SurveyFileTest : public TemporaryFolder, public testing::Test {};

TEST_F(SurveyFileTest, MiddleAndNormalMakeAnUprightSquare) {
  // Faces south, which is +y in `site`; its left as it is looked at is west.
  const auto tags = ReadSurveyedTags(
      Write("a.csv", "id,x,y,z,nx,ny,nz,size,sigma\n3,10,0,5,0,1,0,2,0.1\n"), LengthUnit::kFoot);
  ASSERT_THAT(tags, SizeIs(1));
  Eigen::Matrix<double, 3, 4> expected;
  expected << 9, 11, 11, 9, 0, 0, 0, 0, 6, 6, 4, 4;
  EXPECT_TRUE(tags[0].corners_in_world.isApprox(expected)) << tags[0].corners_in_world;
  EXPECT_EQ(tags[0].sigma, 0.1);
  // The same by its corners; a centimetre where nobody gives a sigma.
  const auto corners = ReadSurveyedTags(
      Write("b.csv", "id,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4\n3,9,0,6,11,0,6,11,0,4,9,0,4\n"),
      LengthUnit::kMetre);
  EXPECT_TRUE(corners[0].corners_in_world.isApprox(expected));
  EXPECT_EQ(corners[0].sigma, 0.01);
}

TEST_F(SurveyFileTest, FaultsAreNamedWithTheirLine) {
  const auto message = [&](const std::string& text) {
    const auto file = Write("a.csv", text);
    return ThrownMessage([&] { ReadSurveyedTags(file, LengthUnit::kMetre); });
  };
  const std::string header = "id,x,y,z,nx,ny,nz,size\n";
  EXPECT_THAT(message("id,x,y,z\n1,2,3,4\n"), HasSubstr("a.csv:1: column 'nx' is missing"));
  EXPECT_THAT(message(header + "1,0,0,0,0,1,0,1\n1,2,0,0,0,1,0,1\n"),
              HasSubstr("a.csv:3: tag 1 stands on line 2 already"));
  // Every row that is wrong, not the first alone.
  const std::string all =
      message(header + "700,0,0,0,0,1,0,1\n1,0,0,0,0,1,0,1\n2,a,0,0,0,1,0,1\n3\n");
  EXPECT_THAT(all, HasSubstr("a.csv:2: id must be a whole number"));
  EXPECT_THAT(all, HasSubstr("a.csv:4: x: 'a' is not a number"));
  EXPECT_THAT(all, HasSubstr("a.csv:5: has 1 field"));
  EXPECT_THAT(message(""), HasSubstr("a.csv: it is empty; expected the columns id,x,y,z"));
  EXPECT_THAT(message(header), HasSubstr("a.csv: there is no tag in it; expected"));
  EXPECT_THAT(ThrownMessage([&] { ReadSurveyedTags(path() / "none.csv", LengthUnit::kMetre); }),
              HasSubstr("none.csv: no such file: the tags' survey is needed"));
  EXPECT_THAT(message(header + "700,0,0,0,0,1,0,1\n"), HasSubstr("id must be a whole number"));
  EXPECT_THAT(message(header + "1,0,0,0,0,0,1,1\n"), HasSubstr("a tag that lies flat"));
  EXPECT_THAT(message("id,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4\n3,9,0,6,11,0,6,9,0,4,11,0,4\n"),
              HasSubstr("make no square"));
}

}  // namespace
}  // namespace groundglass
