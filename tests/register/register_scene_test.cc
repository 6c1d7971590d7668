// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"
#include "register/registration_output.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace groundglass {
namespace {

std::filesystem::path BrickFolder() {
  return std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
}

// The château is kept outside the project; empty if it is not there.
std::filesystem::path ChateauFolder() {
  const char* data = std::getenv("GROUNDGLASS_DATA");
  const std::filesystem::path folder =
      (data ? std::filesystem::path(data)
            : std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / ".." / "shared" / "data") /
      "sceaux";
  return std::filesystem::exists(folder / "model.osu") ? folder : std::filesystem::path();
}

struct SceneErrors {
  std::vector<double> accepted_px;
  int num_flagged = 0;
};

SceneErrors MeasureErrors(const Scene& scene, const std::vector<Registration>& registrations) {
  SceneErrors errors;
  const std::vector<NamedCamera> truth = ReadColmapModel(scene.folder / "truth" / "cameras");
  for (const Registration& registration : registrations) {
    const auto camera = std::find_if(truth.begin(), truth.end(), [&](const NamedCamera& named) {
      return std::filesystem::path(named.name).stem() == registration.name;
    });
    if (camera == truth.end()) {
      ADD_FAILURE() << "no true camera for " << registration.name;
      continue;
    }
    if (registration.verdict != Verdict::kAccepted) {
      EXPECT_FALSE(registration.reasons.empty()) << registration.name;
      ++errors.num_flagged;
      continue;
    }
    errors.accepted_px.push_back(
        VertexErrorPx(scene.model, camera->camera, registration.CorrectedCamera()));
    EXPECT_LT(errors.accepted_px.back(), 1.0) << registration.name;
  }
  std::sort(errors.accepted_px.begin(), errors.accepted_px.end());
  return errors;
}

TEST(RegisterScene, TheBrickBuildingsSlidesAreFoundToHalfAPixel) {
  const Scene scene = ReadScene(BrickFolder());
  const SceneErrors errors = MeasureErrors(scene, RegisterScene(scene, {}, {}, {}).registrations);
  ASSERT_GE(errors.accepted_px.size(), 10u);
  EXPECT_EQ(errors.accepted_px.size() + errors.num_flagged, 12u);
  EXPECT_LT(errors.accepted_px[errors.accepted_px.size() / 2], 0.5);
}

TEST(RegisterScene, ResidualsAreThoseOfTheWholePhotograph) {
  Scene scene = ReadScene(BrickFolder());
  scene.photographs.resize(2);
  for (const Registration& registration : RegisterScene(scene, {}, {}, {}).registrations) {
    ASSERT_GT(registration.residuals.size(), 50) << registration.name;
    double squares = 0;
    for (const EdgeResidual& residual : registration.residuals) {
      squares += residual.offset_px.squaredNorm();
      EXPECT_GT(residual.image_px.minCoeff(), 0);
      EXPECT_LT(residual.image_px.x(), registration.width_px);
      EXPECT_LT(residual.image_px.y(), registration.height_px);
    }
    // Means of pieces scatter less than samples, and count alike.
    const double rms_px = std::sqrt(squares / static_cast<double>(registration.residuals.size()));
    EXPECT_GT(rms_px, 0.3 * *registration.rms_px);
    EXPECT_LT(rms_px, 2 * *registration.rms_px);
  }
}

// Slide 7 with `k 79.9` typed for 19.9: the tag looks into the sky above the hall.
TEST(RegisterScene, ATagThatLooksIntoTheSkyIsRejectedOrPutRightAndNeverAccepted) {
  Scene scene = ReadScene(BrickFolder());
  std::erase_if(scene.photographs, [](const Photograph& one) { return one.name != "s7"; });
  ASSERT_EQ(scene.photographs.size(), 1u);
  ASSERT_EQ(scene.photographs[0].tag.lookat_in_site.z(), 19.9);
  scene.photographs[0].tag.lookat_in_site.z() = 79.9;
  const Registration found = RegisterScene(scene, {}, {}, {}).registrations.at(0);
  EXPECT_EQ(found.verdict, Verdict::kReview);
  EXPECT_NE(found.reasons.at(0).find("k 19.9 (another digit)"), std::string::npos);
  RegisterOptions as_written;
  as_written.readings.num_slips = 0;
  const Registration lost = RegisterScene(scene, {}, as_written, {}).registrations.at(0);
  EXPECT_EQ(lost.verdict, Verdict::kRejected);
  EXPECT_EQ(lost.corrected, lost.measured);
  EXPECT_NE(lost.reasons.at(0).find("says next to nothing"), std::string::npos);
}

// A notebook that claims 2.4 inches and errs by 1.8 ft on every page: told, believed less, and its
// cameras are found all the same. Alone, a photograph knows nothing of the other pages.
TEST(RegisterScene, ANotebookThatClaimsTooMuchIsToldAndBelievedLess) {
  Scene scene = ReadScene(BrickFolder());
  const std::map<std::string, Eigen::Vector3d> errors = {
      {"s1", {1.4, -1.1, 0}}, {"s3", {-1.3, 1.2, 0}}, {"s7", {1.2, 1.5, 0}}, {"s8", {-1.5, -1, 0}}};
  std::erase_if(scene.photographs,
                [&](const Photograph& one) { return !errors.contains(one.name); });
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site += errors.at(photograph.name);
    photograph.tag.sigmas.position = 0.2;
    photograph.tag.sigmas.height = 0.1;
    photograph.tag.sigmas.lookat = 0.2;
  }
  const auto tells = [](const RegisteredScene& registered) {
    return std::any_of(
        registered.warnings.begin(), registered.warnings.end(), [](const std::string& warning) {
          return warning.find("claim more than they hold") != std::string::npos;
        });
  };
  const RegisteredScene registered = RegisterScene(scene, {}, {}, {});
  EXPECT_TRUE(tells(registered));
  const std::vector<NamedCamera> truth = ReadColmapModel(BrickFolder() / "truth" / "cameras");
  for (const Registration& registration : registered.registrations) {
    EXPECT_EQ(registration.verdict, Verdict::kAccepted) << registration.name;
    EXPECT_GT(registration.prior_sigmas[kPositionX], 0.3) << registration.name;
    for (const NamedCamera& camera : truth) {
      if (std::filesystem::path(camera.name).stem() != registration.name) continue;
      EXPECT_LT(VertexErrorPx(scene.model, camera.camera, registration.CorrectedCamera()), 1.5);
    }
  }
  RegisterOptions independent;
  independent.independent = true;
  EXPECT_FALSE(tells(RegisterScene(scene, {}, independent, {})));
}

TEST(RegisterScene, RealPhotographsAreFoundToThreeFifthsOfAPixel) {
  const std::filesystem::path folder = ChateauFolder();
  if (folder.empty()) GTEST_SKIP() << "the château is not here; set GROUNDGLASS_DATA to its parent";
  const Scene scene = ReadScene(folder);
  const SceneErrors errors = MeasureErrors(scene, RegisterScene(scene, {}, {}, {}).registrations);
  ASSERT_GE(errors.accepted_px.size(), 5u);
  EXPECT_LT(errors.accepted_px[errors.accepted_px.size() / 2], 0.6);
}

TEST(RegisterScene, TheNumberOfThreadsDoesNotChangeTheResult) {
  Scene scene = ReadScene(BrickFolder());
  scene.photographs.resize(2);
  std::string one;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = FormatRegistrations(RegisterScene(scene, {}, {}, {}).registrations);
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
  EXPECT_EQ(one, FormatRegistrations(RegisterScene(scene, {}, {}, {}).registrations));
}

TEST(RegisterScene, WhatCannotBeReadIsAVerdictAndNotTheEnd) {
  Scene scene = ReadScene(BrickFolder());
  scene.photographs.resize(3);
  const TemporaryFolder folder;
  scene.photographs[0].mask_file = folder / "s1.png";
  WriteLabels(*scene.photographs[0].mask_file, Image16(30, 20, 1));
  // Gone since the scene was read.
  scene.photographs[1].image_file = folder / "s2.jpg";
  UnreadablePhotograph unreadable;
  unreadable.photograph.name = "s9";
  unreadable.reasons = {(scene.folder / "images/s9.jpg").string() + ": no"};
  scene.unreadable.push_back(unreadable);
  RegisterOptions options;
  options.overrule.accept = {"s1", "s9"};  // nobody can accept what is not there
  const std::vector<Registration> found = RegisterScene(scene, {}, options, {}).registrations;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].verdict, Verdict::kUnreadable);
  EXPECT_NE(found[0].reasons.at(0).find("mask has 30 x 20 pixels, its photograph 1200 x 800"),
            std::string::npos);
  EXPECT_EQ(found[1].verdict, Verdict::kUnreadable);
  EXPECT_NE(found[1].reasons.at(0).find("s2.jpg"), std::string::npos);
  EXPECT_NE(found[2].verdict, Verdict::kUnreadable);
  EXPECT_EQ(found[3].name, "s9");
  EXPECT_EQ(found[3].verdict, Verdict::kUnreadable);
  // The same bytes wherever the scene lies.
  EXPECT_EQ(found[3].reasons, std::vector<std::string>{"images/s9.jpg: no"});
}

TEST(RegisterScene, WithoutACommonSolutionEachKeepsItsOwn) {
  Scene scene = ReadScene(BrickFolder());
  scene.photographs.resize(2);
  RegisterOptions options;
  options.independent = true;
  const RegisteredScene alone = RegisterScene(scene, {}, options, {});
  options.independent = false;
  options.joint.common_offset_sigmas = 1e200;  // its square is beyond all numbers
  const RegisteredScene together = RegisterScene(scene, {}, options, {});
  EXPECT_EQ(FormatRegistrations(together.registrations), FormatRegistrations(alone.registrations));
  ASSERT_EQ(together.warnings.size(), 1u);
  EXPECT_NE(together.warnings[0].find("could not be refined together"), std::string::npos);
  EXPECT_TRUE(alone.warnings.empty());
}

TEST(RegistrationOutput, CorrectedTagsAndColmapCamerasAgree) {
  Scene scene = ReadScene(BrickFolder());
  scene.photographs.resize(2);
  RegisteredScene registered = RegisterScene(scene, {}, {}, {});
  std::vector<Registration>& registrations = registered.registrations;
  registrations[1].verdict = Verdict::kRejected;
  registrations[1].corrected = registrations[1].measured;
  const TemporaryFolder folder;
  WriteRegistrationOutput(scene, registered, folder.path());
  const std::vector<NamedCamera> cameras = ReadColmapModel(folder / "cameras");
  ASSERT_EQ(cameras.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const Camera from_view =
        CameraFromTag(ReadView(folder / ("views/" + registrations[i].name + ".view")), 1200, 800);
    EXPECT_LT(VertexErrorPx(scene.model, cameras[i].camera, from_view), 1e-6);
  }
  // A rejected photograph's view file is the hand-written one, to the byte.
  EXPECT_EQ(ReadTextFile(folder / "views/s2.view"), ReadTextFile(scene.photographs[1].view_file));
}

}  // namespace
}  // namespace groundglass
