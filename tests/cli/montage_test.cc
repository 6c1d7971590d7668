// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/reduce.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// The brick hall with one photograph, a quarter as wide, and a red wall south of it.
class MontageOfBrick : public testing::Test {
 protected:
  MontageOfBrick() {
    const fs::path brick = fs::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
    fs::create_directories(folder_ / "hall/views");
    fs::copy(brick / "model.osu", folder_ / "hall/model.osu");
    fs::copy(brick / "views/s6.view", folder_ / "hall/views/s6.view");
    photograph_ = ReducedInLight(ReadSrgb8(brick / "images/s6.jpg"), 300, 200);
    WriteSrgb8(folder_ / "hall/images/s6.png", photograph_);
    folder_.Write("wall.mtl", "newmtl red\nKd 0.8 0.2 0.1\nnewmtl no_photograph\nKd 0.5 0.5 0.5\n");
    folder_.Write("wall.obj",
                  "mtllib wall.mtl\nv 66 -50 0\nv 86 -50 0\nv 86 -50 15\nv 66 -50 15\n"
                  "usemtl red\nf 1 2 3 4\nusemtl no_photograph\nf 1 2 3\n");
  }

  ProgramRun Run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "render", folder_ / "hall", "--model", folder_ / "wall.obj", "-o", folder_ / "montage.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  }

  // Pixels that the file has otherwise than the photograph.
  int CountChanged() const {
    const Image8 montage = ReadSrgb8(folder_ / "montage.png");
    int count = 0;
    for (size_t i = 0; i < montage.values.size(); i += 3) {
      if (montage.values[i] != photograph_.values[i]) ++count;
    }
    return count;
  }

  TemporaryFolder folder_;
  Image8 photograph_;
};

TEST_F(MontageOfBrick, ADesignStandsInAPhotographOfAScene) {
  const ProgramRun run = Run({"--over", "s6"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("2 faces of the design over s6"));
  EXPECT_THAT(run.out, HasSubstr("faces of the building"));
  EXPECT_THAT(run.err, HasSubstr("the camera of s6 is as written"));
  EXPECT_GT(CountChanged(), 2000);
  // The photograph's own file will do, and a mask over all of it hides the design.
  WriteLabels(folder_ / "hall/masks/s6.png", Image16(300, 200, 1, 255));
  const ProgramRun masked = Run({"--over", folder_ / "hall/images/s6.png", "--json"});
  EXPECT_EQ(masked.status, 0) << masked.err;
  EXPECT_THAT(masked.out, HasSubstr("nothing of the design is seen in s6"));
  EXPECT_EQ(CountChanged(), 0);
}

TEST_F(MontageOfBrick, WhatIsMissingIsNamed) {
  EXPECT_THAT(Run({"--over", "s7"}).err, HasSubstr("there is no photograph s7"));
  EXPECT_EQ(
      RunProgram({"render", folder_ / "hall", "--over", "s6", "-o", folder_ / "m.png"}).status, 2)
      << "without --model";
  EXPECT_THAT(Run({"--over", "s6", "--exposure", "11"}).err, HasSubstr("--exposure"));
}

TEST_F(MontageOfBrick, NothingThatIsReadIsWrittenOver) {
  const std::string photograph = folder_ / "hall/images/s6.png";
  const ProgramRun over_photograph = RunProgram({"render",
                                                 folder_ / "hall",
                                                 "--model",
                                                 folder_ / "wall.obj",
                                                 "--over",
                                                 photograph,
                                                 "-o",
                                                 photograph});
  EXPECT_EQ(over_photograph.status, 1);
  EXPECT_THAT(over_photograph.err, HasSubstr("among a scene's own files"));
  EXPECT_EQ(ReadSrgb8(photograph).values, photograph_.values);
}

TEST_F(MontageOfBrick, OptionsOfOtherDrawingsAreNoneOfItsOwn) {
  EXPECT_EQ(Run({"--over", "s6", "--mode", "shaded"}).status, 2);
  EXPECT_EQ(Run({"--over", "s6", "--view", folder_ / "hall/views/s6.view"}).status, 2);
}

}  // namespace
}  // namespace groundglass
