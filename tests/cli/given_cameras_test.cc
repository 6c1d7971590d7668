// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kData = std::string(GROUNDGLASS_SOURCE_DIR) + "/tests/data/";

// A model, photographs, and nothing else.
std::string UntaggedBrick(const fs::path& folder, const std::vector<std::string>& names) {
  CopyBrick(folder, names);
  fs::remove_all(folder / "views");
  return folder.string();
}

TEST(Invrender, AModelPhotographsAndAColmapModelAreEnough) {
  const TemporaryFolder work;
  const std::string scene = UntaggedBrick(work / "scene", {"s1", "s3", "s7"});
  const ProgramRun run = RunProgram({"invrender",
                                     scene,
                                     "--views",
                                     kData + "colmap/opencv_small_tangential",
                                     "-o",
                                     (work / "out").string(),
                                     "--texel-size",
                                     "1",
                                     "--quiet",
                                     "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_EQ(result["photographs"], 3);
  EXPECT_GT(result["covered_share"], 0.2);
  EXPECT_TRUE(fs::exists(work / "out/model.glb"));
}

TEST(Invrender, PosesTheWrongWayRoundEndInOneLine) {
  const TemporaryFolder work;
  const std::string scene = UntaggedBrick(work / "scene", {"s1", "s3", "s7"});
  for (const auto& [model, hint] :
       {std::pair("camera_to_world", "COLMAP wants cam_from_world"),
        std::pair("quaternion_and_translation_swapped", "columns swapped?")}) {
    const ProgramRun run = RunProgram({"invrender",
                                       scene,
                                       "--views",
                                       kData + "colmap/" + model,
                                       "-o",
                                       (work / "out").string(),
                                       "--quiet"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr(hint));
    EXPECT_FALSE(fs::exists(work / "out")) << model;
  }
}

TEST(Invrender, NothingCoveredIsNoSuccess) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  WriteAll(work / "scene/views/s1.view", "x 0\ny 500\nz 5\ni 0\nj 900\nk 5\na 1.5\nv 40\n");
  const ProgramRun run = RunProgram(
      {"invrender", (work / "scene").string(), "-o", (work / "out").string(), "--quiet"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("none of the 1 photographs shows the front of a face"));
  EXPECT_FALSE(fs::exists(work / "out/model.glb"));
}

TEST(Register, TakesAColmapModelInPlaceOfTags) {
  const TemporaryFolder work;
  const std::string scene = UntaggedBrick(work / "scene", {"s1"});
  const ProgramRun run = RunProgram({"register",
                                     scene,
                                     "--views",
                                     kData + "colmap_binary",
                                     "-o",
                                     (work / "out").string(),
                                     "--quiet",
                                     "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("11 without a photograph in images/"));
  const json photograph = json::parse(run.out)["photographs"][0];
  EXPECT_EQ(photograph["verdict"], "accepted");
  // The true camera to begin with: it stays where it is.
  EXPECT_LT(photograph["moved_px"], 1.5);
  EXPECT_TRUE(fs::exists(work / "out/views/s1.view"));
  const ProgramRun dry = RunProgram({"run",
                                     scene,
                                     "--views",
                                     kData + "colmap_binary",
                                     "-o",
                                     (work / "out2").string(),
                                     "--dry-run"});
  EXPECT_EQ(dry.status, 0) << dry.err;
  EXPECT_THAT(dry.out, HasSubstr("would register 1 photographs"));
}

TEST(Convert, BinaryModelsAndEqualNamesInFolders) {
  const TemporaryFolder work;
  const std::string views = (work / "views").string();
  const ProgramRun binary = RunProgram({"convert", kData + "colmap_binary", views});
  EXPECT_EQ(binary.status, 0) << binary.err;
  EXPECT_TRUE(fs::exists(work / "views/s12.view"));
  const ProgramRun same =
      RunProgram({"convert", kData + "colmap/same_name_in_two_folders", views + "2"});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_TRUE(fs::exists(work / "views2/north_0001.view"));
  EXPECT_TRUE(fs::exists(work / "views2/east_0001.view"));
}

}  // namespace
}  // namespace groundglass
