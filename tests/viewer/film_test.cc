// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/film.h"

#include "scene/error.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sample_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

class Film : public testing::Test {
 protected:
  std::string MessageOf(int width, const FilmOptions& options) {
    try {
      WriteFilm(
          file_, 50, [&](int) { return MakePlainPage(width, 48, 200, 90, 60); }, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const TemporaryFolder folder_;
  const fs::path file_ = folder_ / "film.mp4";
};

bool HasFfmpeg() { return std::system("ffmpeg -version > /dev/null 2>&1") == 0; }

TEST_F(Film, AFullDiskIsAnErrorAndLeavesNothing) {
  if (!HasFfmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  std::string message;
  {
    const SmallDisk disk(300);
    message = MessageOf(64, {});
  }
  EXPECT_THAT(message, testing::HasSubstr("film: ffmpeg failed: "));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Film, IsWrittenTwiceWithTheSameBytes) {
  if (!HasFfmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  std::vector<std::string> bytes;
  for (int time = 0; time < 2; ++time) {
    int num_told = 0;
    WriteFilm(
        file_,
        10,
        [](int frame) { return MakePlainPage(64, 48, static_cast<uint8_t>(20 * frame), 90, 60); },
        {},
        [&](int, int, const std::string&) { ++num_told; });
    EXPECT_EQ(num_told, 10);
    std::ifstream in(file_, std::ios::binary);
    bytes.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  EXPECT_GT(bytes[0].size(), 500);
  EXPECT_EQ(bytes[0].substr(4, 4), "ftyp");
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST_F(Film, MissingFfmpegIsNamedAndLeavesNothing) {
  FilmOptions options;
  options.ffmpeg = "no-such-ffmpeg";
  EXPECT_THAT(MessageOf(64, options), testing::HasSubstr("no-such-ffmpeg was not found"));
  EXPECT_TRUE(fs::is_empty(file_.parent_path()));
}

TEST_F(Film, AnEncoderThatFailsIsQuoted) {
  FilmOptions options;
  options.ffmpeg = "false";  // takes no frames, says nothing, fails
  EXPECT_THAT(MessageOf(64, options), testing::HasSubstr("false failed: it said nothing"));
  EXPECT_TRUE(fs::is_empty(file_.parent_path()));
}

TEST_F(Film, OddSizesAreRefused) {
  EXPECT_THAT(MessageOf(63, {}), testing::HasSubstr("an even size; this one is 63 x 48"));
}

}  // namespace
}  // namespace groundglass
