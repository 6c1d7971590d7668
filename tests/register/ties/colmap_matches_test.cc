// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/colmap_matches.h"

#include "register/ties/colmap_database.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_folder.h"
#include "tests/register/ties/colmap_file.h"
#include "tests/register/ties/wall.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Two photographs of the plaster; the left half of the second is no evidence.
struct TwoPhotographs {
  TwoPhotographs() {
    // Drawn once for all tests.
    static const Image8 left = PhotographPlaster(cameras[0], 0);
    static const Image8 right = PhotographPlaster(cameras[1], 0);
    Image8 ignore(600, 400, 1);
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 300; ++x) *ignore.At(x, y) = 255;
    }
    pictures.emplace_back(left, Image8(), 1);
    pictures.emplace_back(right, ignore, 1);
  }
  std::vector<ColmapPhotograph> Photographs() const {
    return {{&pictures[0], cameras[0]}, {&pictures[1], cameras[1]}};
  }
  std::vector<Camera> cameras = {CameraBeforeWall(14, 46, 19), CameraBeforeWall(22, 46, 21)};
  std::vector<TiePicture> pictures;
};

// A program that answers as COLMAP does, says what it was told in `calls`, and copies a database
// that the test has written to where one is wanted.
class StandIn {
 public:
  explicit StandIn(const std::string& gpu_option = "SiftExtraction.use_gpu") {
    WriteColmapFile(
        folder_ / "made.db",
        {{1, "00001.png", 6, {100, 100, 2, 0, 0, 2}}, {2, "00002.png", 6, {400, 120, 2, 0, 0, 2}}},
        {});
    program_ =
        folder_.Write("colmap",
                      "#!/bin/sh\n"
                      "cd " +
                          folder_.path().string() +
                          "\n"
                          "if [ \"$1\" = -h ]; then echo 'COLMAP 3.8 -- a stand-in'; exit 0; fi\n"
                          "if [ \"$2\" = -h ]; then echo ' --" +
                          gpu_option +
                          " arg'; exit 0; fi\n"
                          "echo \"$QT_QPA_PLATFORM $@\" >> calls\n"
                          "case $1 in\n"
                          "  feature_extractor) cp made.db \"$3\"; ls $5 $7 >> calls;;\n"
                          "  matches_importer) cat \"$5\" >> calls;;\n"
                          "esac\n"
                          "test ! -e fails || { echo 'cannot go on' >&2; exit 7; }\n");
    fs::permissions(program_, fs::perms::owner_all);
  }
  ColmapOptions Options() const {
    ColmapOptions options;
    options.program = program_;
    options.folder = folder_ / "work";
    return options;
  }
  std::string Calls() const { return TextOf(folder_ / "calls"); }
  void Forget() const { fs::remove(folder_ / "calls"); }
  void Fail() const { folder_.Write("fails", ""); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  fs::path program_;
};

TEST(MatchWithColmap, AMissingProgramIsNamedWithWhatToInstall) {
  const TwoPhotographs two;
  ColmapOptions options;
  options.program = "no-such-colmap";
  EXPECT_EQ(ThrownMessage([&] {
              MatchWithColmap(two.Photographs(), {{0, 1}}, options);
            }),
            "the program no-such-colmap was not found; install it (Debian: apt-get install "
            "colmap)");
}

TEST(MatchWithColmap, AProgramThatFailsIsNamedWithItsLastWords) {
  const TwoPhotographs two;
  const StandIn colmap;
  colmap.Fail();
  EXPECT_EQ(ThrownMessage([&] {
              MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
            }),
            colmap.Options().program + " feature_extractor failed (exit status 7): cannot go on");
  EXPECT_FALSE(fs::exists(colmap.Options().folder / "images"));
}

TEST(MatchWithColmap, TellsTheProgramWhatToDo) {
  const TwoPhotographs two;
  const StandIn colmap;
  const ColmapMatches found = MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
  EXPECT_EQ(found.version, "3.8");
  const std::string calls = colmap.Calls();
  EXPECT_THAT(calls, HasSubstr("offscreen feature_extractor --database_path"));
  EXPECT_THAT(calls, HasSubstr("--SiftExtraction.use_gpu 0"));
  EXPECT_THAT(calls, HasSubstr("00001.png\n00002.png\n"));
  EXPECT_THAT(calls, HasSubstr("00002.png.png"));  // the mask
  EXPECT_THAT(calls, Not(HasSubstr("00001.png.png")));
  EXPECT_THAT(calls, HasSubstr("offscreen matches_importer --database_path"));
  EXPECT_THAT(calls, HasSubstr("--SiftMatching.use_gpu 0 --SiftMatching.num_threads "));
  EXPECT_THAT(calls, HasSubstr("00001.png 00002.png\n"));
  // Working copies are gone, the database is kept, with the cameras as they are now.
  const fs::path work = colmap.Options().folder;
  EXPECT_FALSE(fs::exists(work / "images"));
  EXPECT_FALSE(fs::exists(work / "masks"));
  const ColmapFileCamera camera = ReadColmapFileCamera(work / "database.db", "00002.png");
  ASSERT_EQ(camera.parameters.size(), 8u);
  EXPECT_EQ(camera.parameters[0], two.cameras[1].focal_x_px);
}

TEST(MatchWithColmap, LaterReleasesHaveOtherNamesForTheSameOptions) {
  const TwoPhotographs two;
  const StandIn colmap("FeatureExtraction.use_gpu");
  MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
  EXPECT_THAT(colmap.Calls(), HasSubstr("--FeatureExtraction.use_gpu 0"));
  EXPECT_THAT(colmap.Calls(), HasSubstr("--FeatureMatching.use_gpu 0"));
}

TEST(MatchWithColmap, IsDoneAgainOnlyWhereSomethingHasChanged) {
  TwoPhotographs two;
  const StandIn colmap;
  const std::string sha256 = MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options()).sha256;
  EXPECT_EQ(sha256.size(), 64u);
  colmap.Forget();
  EXPECT_EQ(MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options()).sha256, sha256);
  EXPECT_EQ(colmap.Calls(), "");
  // Another lens: the keypoints are the same.
  two.cameras[0].focal_x_px += 1;
  MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
  EXPECT_THAT(colmap.Calls(), HasSubstr("matches_importer"));
  EXPECT_THAT(colmap.Calls(), Not(HasSubstr("feature_extractor")));
  colmap.Forget();
  // Another picture.
  Image8 grey8 = two.pictures[0].grey8();
  grey8.values[0] ^= 1;
  two.pictures[0] = TiePicture(grey8, {}, 1);
  MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
  EXPECT_THAT(colmap.Calls(), HasSubstr("feature_extractor"));
  colmap.Forget();
  // A database that somebody has spoilt.
  std::ofstream(colmap.Options().folder / "database.db") << "spoilt, and longer than a header";
  MatchWithColmap(two.Photographs(), {{0, 1}}, colmap.Options());
  EXPECT_THAT(colmap.Calls(), HasSubstr("feature_extractor"));
}

TEST(MatchWithColmap, WithoutPairsNothingIsRun) {
  const TwoPhotographs two;
  const StandIn colmap;
  EXPECT_TRUE(MatchWithColmap(two.Photographs(), {}, colmap.Options()).matches.pairs.empty());
  EXPECT_EQ(colmap.Calls(), "");
}

// The real program, on two small photographs: two to three seconds.
TEST(MatchWithColmap, FindsThePlasterWhereBothPhotographsShowIt) {
  const TwoPhotographs two;
  const TemporaryFolder folder;
  ColmapOptions options;
  options.folder = folder / "colmap";
  try {
    FindColmapVersion(options);
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  const ColmapMatches found = MatchWithColmap(two.Photographs(), {{0, 1}}, options);
  ASSERT_EQ(found.matches.keypoints.size(), 2u);
  // Next to nothing where the mask is: keypoints just outside reach into it.
  for (const Keypoint& keypoint : found.matches.keypoints[1]) {
    EXPECT_GT(keypoint.image_px.x(), 299);
  }
  ASSERT_EQ(found.matches.pairs.size(), 1u);
  const auto& matches = found.matches.pairs[0].matches;
  EXPECT_GT(matches.size(), 30u);
  std::vector<double> errors_px;
  for (const auto& [first, second] : matches) {
    const Eigen::Vector2d image_px = found.matches.keypoints[0][first].image_px;
    const Eigen::Vector3d position = two.cameras[0].PositionInWorld();
    const Eigen::Vector3d ray = UnprojectToWorld(two.cameras[0], image_px);
    const auto expected_px = Project(two.cameras[1], position - position.y() / ray.y() * ray);
    ASSERT_TRUE(expected_px);
    errors_px.push_back((*expected_px - found.matches.keypoints[1][second].image_px).norm());
  }
  std::sort(errors_px.begin(), errors_px.end());
  EXPECT_LT(errors_px[errors_px.size() / 2], 0.5);
  // COLMAP would not find the very same ones again; they are kept.
  EXPECT_EQ(MatchWithColmap(two.Photographs(), {{0, 1}}, options).sha256, found.sha256);
}

}  // namespace
}  // namespace groundglass
