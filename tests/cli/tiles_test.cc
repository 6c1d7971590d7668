// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The texture database of 1988, written and viewed.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

const std::string kView =
    std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/truth/novel/n1.view";

TEST(Tiles, DatabaseAndRecordAreWrittenAndDrawn) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1", "s2"});
  const std::string out = (work / "out").string();
  const auto bake = [&](const std::string& option) {
    return RunProgram({"invrender",
                       (work / "scene").string(),
                       "-o",
                       out,
                       "--texel-size",
                       "0.5",
                       option,
                       "--downsample",
                       "16",
                       "--quiet"});
  };
  const auto draw = [&](const std::string& what, const fs::path& picture) {
    return RunProgram(
        {"render", what, "--view", kView, "-o", picture.string(), "--width", "300", "--quiet"});
  };
  const ProgramRun database = bake("--tiles");
  ASSERT_EQ(database.status, 0) << database.err;
  const fs::path tiles = fs::path(out) / "tiles" / "s1.tiles";
  ASSERT_TRUE(fs::is_regular_file(tiles));
  EXPECT_EQ(fs::file_size(tiles) % 96, 0u);
  EXPECT_GT(fs::file_size(tiles), 96u * 1000);
  ASSERT_EQ(draw(out + "/tiles", work / "database.png").status, 0);
  EXPECT_EQ(draw(tiles.string(), work / "one.png").status, 0);
  EXPECT_GT(fs::file_size(work / "database.png"), 10000u);

  const ProgramRun record = bake("--tile-record");
  ASSERT_EQ(record.status, 0) << record.err;
  EXPECT_FALSE(fs::exists(tiles)) << "left from the run before";
  EXPECT_LT(fs::file_size(fs::path(out) / "tiles" / "record.json"), 2000u);
  ASSERT_EQ(draw(out + "/tiles", work / "record.png").status, 0);
  EXPECT_NEAR(fs::file_size(work / "record.png"), fs::file_size(work / "database.png"), 100);

  EXPECT_EQ(RunProgram({"invrender", "scene", "-o", "out", "--tiles", "--tile-record"}).status, 2);
  EXPECT_EQ(RunProgram({"invrender", "scene", "-o", "out", "--downsample", "2"}).status, 2);
  const ProgramRun film =
      RunProgram({"render", out + "/tiles", "--path", "orbit", "-o", (work / "film.mp4").string()});
  EXPECT_EQ(film.status, 1);
  EXPECT_THAT(film.err, testing::HasSubstr("tiles are drawn from a --view"));
}

}  // namespace
}  // namespace groundglass
