// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/registration.h"

#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::HasSubstr;

ViewTag S5() {
  return ParseView("x 232 y -104 z 4.5 i 104 j -2 k 33.1 a 1.5 v 58 k2 0.01 sigma_roll 2 camera c",
                   "s5.view");
}

TEST(ParametersFromTag, GivesTheThesisAngles) {
  const CameraParameters parameters = SiteParameters(ParametersFromTag(S5()));
  const double distance = std::sqrt(128.0 * 128 + 102.0 * 102 + 28.6 * 28.6);
  EXPECT_NEAR(parameters[kPositionY], -104, 1e-12);
  EXPECT_NEAR(parameters[kYaw], std::atan2(-128, 102) * kDegreesPerRadian, 1e-12);
  EXPECT_NEAR(parameters[kPitch], std::asin(28.6 / distance) * kDegreesPerRadian, 1e-12);
}

TEST(ParametersFromTag, AreInWorldWhereYawTurnsFromEastToNorth) {
  ViewTag tag;
  tag.position_in_site = {10, 20, 3};
  tag.lookat_in_site = {10, 10, 3};  // due north
  const CameraParameters north = ParametersFromTag(tag);
  EXPECT_EQ(north[kPositionY], -20);
  EXPECT_NEAR(north[kYaw], 90, 1e-12);
  tag.lookat_in_site = {20, 20, 3};  // due east
  EXPECT_NEAR(ParametersFromTag(tag)[kYaw], 0, 1e-12);
}

TEST(SiteCovariance, IsThatOfSiteParameters) {
  // Numbers a and b of each parameter, in `world` and in `site`: covariances go as their products.
  CameraParameters a = CameraParameters::LinSpaced(-3, 5);
  const CameraCovariance in_world = a * a.transpose();
  const CameraParameters a_in_site = SiteChange(a);
  EXPECT_EQ(SiteCovariance(in_world), a_in_site * a_in_site.transpose());
  EXPECT_EQ(SiteCovariance(SiteCovariance(in_world)), in_world);
}

TEST(TagFromParameters, IsTheInverse) {
  const ViewTag tag = S5();
  const ViewTag again = TagFromParameters(ParametersFromTag(tag), tag);
  EXPECT_LT((again.lookat_in_site - tag.lookat_in_site).norm(), 1e-12);
  ViewTag rest = again;
  rest.lookat_in_site = tag.lookat_in_site;
  EXPECT_EQ(rest, tag);
}

TEST(TagFromParameters, KeepsTheMeasuredDistance) {
  const ViewTag tag = S5();
  CameraParameters parameters = ParametersFromTag(tag);
  parameters[0] += 3;
  parameters[3] += 7;
  parameters[4] -= 4;
  const ViewTag moved = TagFromParameters(parameters, tag);
  EXPECT_NEAR((moved.lookat_in_site - moved.position_in_site).norm(),
              (tag.lookat_in_site - tag.position_in_site).norm(),
              1e-12);
  EXPECT_NEAR((ParametersFromTag(moved) - parameters).norm(), 0, 1e-12);
}

TEST(TagDeviations, AgreeWithFiniteDifferences) {
  const ViewTag tag = S5();
  const CameraParameters parameters = ParametersFromTag(tag);
  // Any covariance: the square of a full matrix.
  CameraCovariance root;
  for (int i = 0; i < root.size(); ++i) root(i) = std::sin(1.0 + i);
  const CameraCovariance covariance = root * root.transpose();
  const TagDeviations deviations = TagDeviationsFromCovariance(parameters, covariance, tag);
  for (int key = 0; key < kNumTagKeys; ++key) {
    CameraParameters gradient;
    for (int i = 0; i < kNumCameraParameters; ++i) {
      constexpr double kStep = 1e-5;
      CameraParameters up = parameters, down = parameters;
      up[i] += kStep;
      down[i] -= kStep;
      const TagKey tag_key = static_cast<TagKey>(key);
      gradient[i] = (GetTagValue(TagFromParameters(up, tag), tag_key) -
                     GetTagValue(TagFromParameters(down, tag), tag_key)) /
                    (2 * kStep);
    }
    EXPECT_NEAR(deviations[key], std::sqrt(gradient.dot(covariance * gradient)), 1e-6)
        << kTagKeyNames[key];
  }
}

TEST(RegistrationFile, RoundTripsToTheLastBit) {
  Registration registration;
  registration.name = "s5";
  registration.width_px = 1500;
  registration.height_px = 1000;
  registration.verdict = Verdict::kReview;
  registration.reasons = {"a rival one \"tile\" to the left"};
  registration.measured = S5();
  registration.corrected = S5();
  registration.corrected.position_in_site.x() += 1.0 / 3;
  registration.sigmas.setLinSpaced(0.1, 0.7);
  registration.prior_sigmas.setLinSpaced(1, 2);
  for (int i = 0; i < registration.covariance.size(); ++i) {
    registration.covariance(i) = 1 / (3.0 + i);
  }
  registration.undetermined = {"shift_x"};
  registration.num_samples = 321;
  registration.rms_px = 0.1 + 0.2;
  registration.robust_sigma_px = 0.21;
  registration.residuals = {{{12.25, 7}, {-0.5, 0.03}}};
  registration.score_nats = 412.5;
  registration.margin_nats = 61;
  registration.rival = S5();
  registration.rival->lookat_in_site.z() -= 2.0 / 3;
  registration.moved_px = 16.8;
  registration.vertex_sigma_px = 0.7;
  const TemporaryFolder folder;
  const auto file =
      folder.Write("registration.json", FormatRegistrations({registration, registration}));
  const std::vector<Registration> read = ReadRegistrations(file);
  ASSERT_EQ(read.size(), 2u);
  const Registration& again = read[1];
  EXPECT_EQ(again.name, "s5");
  EXPECT_EQ(again.verdict, Verdict::kReview);
  EXPECT_EQ(again.reasons, registration.reasons);
  EXPECT_EQ(again.width_px, 1500);
  EXPECT_EQ(again.measured, registration.measured);
  EXPECT_EQ(again.corrected, registration.corrected);
  EXPECT_EQ(again.sigmas, registration.sigmas);
  EXPECT_EQ(again.prior_sigmas, registration.prior_sigmas);
  EXPECT_EQ(again.covariance, registration.covariance);
  EXPECT_EQ(again.undetermined, registration.undetermined);
  EXPECT_EQ(again.num_samples, 321);
  EXPECT_EQ(again.rms_px, registration.rms_px);
  EXPECT_EQ(again.robust_sigma_px, 0.21);
  ASSERT_EQ(again.residuals.size(), 1);
  EXPECT_EQ(again.residuals[0].image_px, Eigen::Vector2d(12.25, 7));
  EXPECT_EQ(again.residuals[0].offset_px, Eigen::Vector2d(-0.5, 0.03));
  EXPECT_EQ(again.score_nats, 412.5);
  EXPECT_EQ(again.margin_nats, 61);
  EXPECT_EQ(again.rival, registration.rival);
  EXPECT_EQ(again.moved_px, 16.8);
  EXPECT_EQ(again.vertex_sigma_px, 0.7);
}

// No rival, and nothing matched: null, not a number that looks like one.
TEST(RegistrationFile, WhatThereIsNotIsNoNumber) {
  Registration registration;
  registration.name = "s5";
  registration.width_px = registration.height_px = 100;
  registration.measured = registration.corrected = S5();
  const std::string text = FormatRegistrations({registration});
  for (const char* null :
       {"\"rms_px\": null", "\"robust_sigma_px\": null", "\"margin_nats\": null"}) {
    EXPECT_NE(text.find(null), std::string::npos) << null;
  }
  EXPECT_EQ(text.find("rival"), std::string::npos);
  const TemporaryFolder folder;
  const Registration again = ReadRegistrations(folder.Write("registration.json", text)).at(0);
  EXPECT_FALSE(again.rival.has_value());
  EXPECT_FALSE(again.rms_px.has_value());
  EXPECT_FALSE(again.robust_sigma_px.has_value());
  EXPECT_FALSE(again.margin_nats.has_value());

  // Version 0.1 called the robust spread rms_px, and wrote a million where there was no rival.
  std::string old = text;
  const auto replace = [&](const std::string& from, const std::string& to) {
    const size_t at = old.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    old.replace(at, from.size(), to);
  };
  replace("\"rms_px\": null", "\"rms_px\": 0.3");
  replace("   \"robust_sigma_px\": null,\n", "");
  replace("\"margin_nats\": null", "\"margin_nats\": 1000000.0");
  const Registration early = ReadRegistrations(folder.Write("old.json", old)).at(0);
  EXPECT_FALSE(early.rms_px.has_value());
  EXPECT_EQ(early.robust_sigma_px, 0.3);
  EXPECT_FALSE(early.margin_nats.has_value());
}

TEST(RegistrationFile, ARivalThatIsNoCameraIsTold) {
  Registration registration;
  registration.name = "s5";
  registration.width_px = registration.height_px = 100;
  registration.measured = registration.corrected = S5();
  registration.rival = S5();
  registration.rival->view_angle_deg = 200;
  const TemporaryFolder folder;
  const auto file = folder.Write("registration.json", FormatRegistrations({registration}));
  try {
    ReadRegistrations(file);
    FAIL() << "a view angle of 200 degrees was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("photograph 's5': key 'v'"), std::string::npos)
        << error.what();
  }
}

TEST(RegistrationFile, KeepsWhereTheModelIsOff) {
  const ModelError error = {
      "east wall / roof", {1, 2, 3}, {4, 2, 3}, {0, 0.25, -0.3}, 0.05, {"s1", "s5"}, true};
  const TemporaryFolder folder;
  const auto file = folder.Write("registration.json", FormatRegistrations({}, {error}));
  const std::vector<ModelError> read = ReadModelErrors(file);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, error.name);
  EXPECT_EQ(read[0].start_in_world, error.start_in_world);
  EXPECT_EQ(read[0].end_in_world, error.end_in_world);
  EXPECT_EQ(read[0].offset_in_world, error.offset_in_world);
  EXPECT_EQ(read[0].sigma, error.sigma);
  EXPECT_EQ(read[0].photographs, error.photographs);
  EXPECT_TRUE(read[0].with_the_one_before);
  // People read `site`, where y counts southwards.
  EXPECT_NE(ReadTextFile(file).find("-0.25"), std::string::npos);
}

TEST(RegistrationFile, AnUnreadablePhotographHasNameAndReasons) {
  Registration registration;
  registration.name = "s2";
  registration.verdict = Verdict::kUnreadable;
  registration.reasons = {"images/s2.jpg: this image is damaged"};
  const TemporaryFolder folder;
  const auto file =
      folder.Write("registration.json", FormatRegistrations({registration}, {}, {"a warning"}));
  const std::vector<Registration> read = ReadRegistrations(file);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "s2");
  EXPECT_EQ(read[0].verdict, Verdict::kUnreadable);
  EXPECT_EQ(read[0].reasons, registration.reasons);
  EXPECT_EQ(ReadRegistrationWarnings(file), std::vector<std::string>{"a warning"});
}

TEST(RegistrationFile, WhatTiedThePhotographsComesBack) {
  TieUse ties;
  ties.patches = true;
  ties.colmap = {"3.8", "abc", 5, 7, 1234};
  const TemporaryFolder folder;
  const auto file = folder.Write("registration.json", FormatRegistrations({}, {}, {}, ties));
  const TieUse read = ReadTieUse(file);
  EXPECT_TRUE(read.patches);
  ASSERT_TRUE(read.colmap);
  EXPECT_EQ(read.colmap->version, "3.8");
  EXPECT_EQ(read.colmap->sha256, "abc");
  EXPECT_EQ(read.colmap->num_photographs, 5);
  EXPECT_EQ(read.colmap->num_pairs, 7);
  EXPECT_EQ(read.colmap->num_tracks, 1234);
  // Files of before say nothing of it.
  const auto before = folder.Write("before.json", R"({"photographs": []})");
  EXPECT_FALSE(ReadTieUse(before).patches);
  EXPECT_FALSE(ReadTieUse(before).colmap);
}

TEST(RegistrationFile, BadOnesGiveOneLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    std::string thrown = ThrownMessage([&] { ReadRegistrations(folder.Write("r.json", text)); });
    EXPECT_EQ(thrown.find('\n'), std::string::npos);
    return thrown;
  };
  EXPECT_THAT(message("{"), HasSubstr("r.json: not a registration file"));
  EXPECT_THAT(message("[]"), HasSubstr("r.json: not a registration file"));
  EXPECT_THAT(message("{\"photographs\": [{\"name\": \"s5\"}]}"), HasSubstr("verdict"));
  EXPECT_THAT(message("{\"photographs\": [{\"name\": \"s5\", \"verdict\": \"fine\"}]}"),
              HasSubstr("verdict 'fine' is not accepted, review, rejected or unreadable"));
}

}  // namespace
}  // namespace groundglass
