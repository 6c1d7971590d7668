// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/opened_folder.h"

#include "ask/survey.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/textured_model_io.h"
#include "tests/ask/room_survey.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

PolygonModel ScaledBy(PolygonModel model, double factor) {
  for (Eigen::Vector3d& point : model.points_in_world) point *= factor;
  return model;
}

Registration Found(const std::string& name, Verdict verdict) {
  Registration registration;
  registration.name = name;
  registration.width_px = 60;
  registration.height_px = 40;
  registration.verdict = verdict;
  registration.measured.position_in_site = {0, 30, 5};
  registration.corrected = registration.measured;
  registration.corrected.position_in_site.x() = 0.5;
  registration.covariance.setIdentity();
  return registration;
}

// A scene with the photograph s1, which stands at x 0.
class FolderToOpen : public testing::Test {
 protected:
  FolderToOpen() {
    folder_.Write("hall/model.osu", FormatOsu(MakeWallSurvey().model));
    WriteSrgb8(folder_ / "hall/images/s1.png", Image8(60, 40, 3, 90));
    folder_.Write("hall/views/s1.view", "x 0 y 30 z 5 i 0 j 0 k 5 a 1.5 v 60");
  }
  void WriteRun(double model_scale) {
    WriteFileAtomically(folder_ / "out/registration.json",
                        FormatRegistrations({Found("s1", Verdict::kAccepted)}));
    TexturedModel textured;
    textured.model = ScaledBy(MakeWallSurvey().model, model_scale);
    textured.faces.resize(textured.model.faces.size());
    WriteGlb(folder_ / "out/model.glb", textured);
  }

  TemporaryFolder folder_;
};

TEST_F(FolderToOpen, ASceneWhoseModelIsCalledLikeARunsIsStillAScene) {
  fs::remove(folder_ / "hall/model.osu");
  TexturedModel textured;
  textured.model = MakeWallSurvey().model;
  textured.faces.resize(textured.model.faces.size());
  WriteGlb(folder_ / "hall/model.glb", textured);
  EXPECT_FALSE(IsOutputFolder(folder_ / "hall"));
  const OpenedFolder opened = OpenFolder(folder_ / "hall", {}, {}, true);
  EXPECT_FALSE(opened.is_output);
  EXPECT_EQ(opened.scene.photographs.size(), 1u);
}

TEST_F(FolderToOpen, ASceneHasTheCamerasAsWritten) {
  const Survey survey = ReadSurvey(folder_ / "hall", {});
  ASSERT_EQ(survey.photographs.size(), 1u);
  EXPECT_EQ(survey.photographs[0].standing, "as written");
  EXPECT_THAT(ThrownMessage([&] { ReadSurvey(folder_ / "hall", folder_ / "hall"); }),
              HasSubstr("is no output folder"));
}

TEST_F(FolderToOpen, ARunsCamerasGoWithTheScenesPhotographs) {
  WriteRun(1);
  const OpenedFolder opened = OpenFolder(folder_ / "out", folder_ / "hall", {}, true);
  EXPECT_TRUE(opened.is_output);
  EXPECT_EQ(opened.scene.photographs.size(), 1u);
  const Survey survey = SurveyOf(opened);
  ASSERT_EQ(survey.photographs.size(), 1u);
  EXPECT_EQ(survey.photographs[0].standing, "accepted");
  EXPECT_EQ(survey.photographs[0].image_file, folder_ / "hall/images/s1.png");
  EXPECT_DOUBLE_EQ(survey.photographs[0].AsCamera().PositionInWorld().x(), 0.5);
}

TEST_F(FolderToOpen, TheModelIsTheRunsWhereTheScenesIsAnother) {
  WriteRun(2);
  const OpenedFolder opened = OpenFolder(folder_ / "out", folder_ / "hall", {}, false);
  EXPECT_NEAR(ComputeBounds(opened.scene.model).Diagonal(),
              ComputeBounds(opened.textured.model).Diagonal(),
              1e-9);
  EXPECT_EQ(SurveyOf(opened).model.faces.size(), opened.textured.model.faces.size());
}

TEST_F(FolderToOpen, ARunThatRegisteredNothingHasTheTagsAsWritten) {
  WriteManifest(folder_ / "out", {});
  TexturedModel textured;
  textured.model = MakeWallSurvey().model;
  textured.faces.resize(textured.model.faces.size());
  WriteGlb(folder_ / "out/model.glb", textured);
  const OpenedFolder opened = OpenFolder(folder_ / "out", folder_ / "hall", {}, false);
  EXPECT_TRUE(opened.is_output);
  const Survey survey = SurveyOf(opened);
  ASSERT_EQ(survey.photographs.size(), 1u);
  EXPECT_EQ(survey.photographs[0].standing, "as written");
}

TEST_F(FolderToOpen, ARunWithoutAModelAsksForTheScene) {
  WriteRun(1);
  fs::remove(folder_ / "out/model.glb");
  EXPECT_THAT(ThrownMessage([&] { OpenFolder(folder_ / "out", {}, {}, false); }),
              HasSubstr("--scene"));
  EXPECT_EQ(OpenFolder(folder_ / "out", folder_ / "hall", {}, false).textured.model.faces.size(),
            MakeWallSurvey().model.faces.size());
}

TEST_F(FolderToOpen, AModelAloneHasNobodyToAsk) {
  const OpenedFolder opened = OpenFolder(folder_ / "hall/model.osu", {}, {}, true);
  EXPECT_FALSE(opened.is_output);
  EXPECT_FALSE(opened.textured.model.faces.empty());
  EXPECT_TRUE(SurveyOf(opened).photographs.empty());
}

}  // namespace
}  // namespace groundglass
