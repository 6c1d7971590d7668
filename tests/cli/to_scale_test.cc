// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;

const std::string kHall =
    std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/model.osu";

TEST(ToScale, ASideIsCalledByTheDirectionThatItFaces) {
  const TemporaryFolder folder;
  const ProgramRun run = RunProgram({"render",
                                     kHall,
                                     "--elevation",
                                     "south wall",
                                     "--scale",
                                     "1:200",
                                     "-o",
                                     folder / "south.svg"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("At 1:200 a pixel of the picture is 20 mm on the building"));
  EXPECT_THAT(ReadAll(folder / "south.svg"), HasSubstr("<path id=\"OUTLINE\""));
  EXPECT_THAT(ReadAll(folder / "south.json"), HasSubstr("\"drawing\": \"south\""));
}

TEST(ToScale, AllSidesGetAFileEach) {
  const TemporaryFolder folder;
  const ProgramRun run = RunProgram(
      {"render", kHall, "--elevation", "all", "--scale", "500", "-o", folder / "hall.dxf"});
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* side : {"north", "east", "south", "west"}) {
    EXPECT_THAT(ReadAll(folder / ("hall-" + std::string(side) + ".dxf")), HasSubstr("AC1009"));
  }
}

TEST(ToScale, WhatCannotBeMeantIsNamed) {
  const TemporaryFolder folder;
  const std::string out = folder / "x.tif";
  const ProgramRun scale =
      RunProgram({"render", kHall, "--elevation", "south", "--scale", "wide", "-o", out});
  EXPECT_EQ(scale.status, 2);
  EXPECT_THAT(scale.err, HasSubstr("is not as 1:50"));
  const ProgramRun face = RunProgram({"render", kHall, "--elevation", "moat", "-o", out});
  EXPECT_EQ(face.status, 1);
  EXPECT_THAT(face.err, HasSubstr("the model's sides are: north"));
  const ProgramRun section = RunProgram({"render", kHall, "--section", "1,2,3", "-o", out});
  EXPECT_EQ(section.status, 1);
  EXPECT_THAT(section.err, HasSubstr("is neither x,y,x,y"));
  EXPECT_THAT(RunProgram({"render", kHall, "--section", "z=nan", "-o", out}).err,
              HasSubstr("is neither x,y,x,y"));
  const ProgramRun layers =
      RunProgram({"render", kHall, "--elevation", "south", "--also", "layers", "-o", out});
  EXPECT_EQ(layers.status, 1);
  EXPECT_THAT(layers.err, HasSubstr("layers are made from an output folder"));
  const std::string scene = std::filesystem::path(kHall).parent_path();
  const ProgramRun of_scene = RunProgram({"render", scene, "--elevation", "all", "-o", out});
  EXPECT_EQ(of_scene.status, 1);
  EXPECT_THAT(of_scene.err, HasSubstr("is a scene, and what is drawn is a model or the output"));
  const ProgramRun beside = RunProgram(
      {"render", kHall, "--section", "0,200,60,200", "--scale", "500", "-o", folder / "s.svg"});
  EXPECT_EQ(beside.status, 0);
  EXPECT_THAT(beside.err, HasSubstr("section: its plane does not meet the model, which reaches"));
}

// The brick hall's cameras are off-centre, so these formats get pictures of their own.
TEST(ToScale, PhotographsAreNeverWrittenOver) {
  const TemporaryFolder work;
  CopyBrick(work / "hall", {"s3"});
  WriteAll(work / "hall/views/s3.view", ReadAll(work / "hall/views/s3.view") + "\nk1 -0.1\n");
  const std::string before = Fingerprint(work / "hall");
  for (const auto& [format, out] : {std::pair("meshlab", "hall/hall.mlp"),
                                    std::pair("realitycapture", "hall/images"),
                                    std::pair("mvs-texturing", "hall/images")}) {
    const ProgramRun run = RunProgram({"convert", work / "hall/views", work / out, "--to", format});
    EXPECT_EQ(run.status, 1) << format;
    EXPECT_THAT(run.err, HasSubstr("a folder of its own")) << format;
    EXPECT_EQ(Fingerprint(work / "hall"), before) << format;
  }
  EXPECT_EQ(
      RunProgram({"convert", work / "hall/views", work / "own/hall.mlp", "--to", "meshlab"}).status,
      0);
}

TEST(ToScale, CamerasGoToAnotherProgramAndComeBackAsViews) {
  const TemporaryFolder folder;
  CopyBrick(folder / "hall", {"s3"});
  const ProgramRun there =
      RunProgram({"convert", folder / "hall/views", folder / "c.xml", "--to", "metashape"});
  EXPECT_EQ(there.status, 0) << there.err;
  const ProgramRun back = RunProgram({"convert", folder / "c.xml", folder / "views"});
  EXPECT_EQ(back.status, 0) << back.err;
  EXPECT_THAT(ReadAll(folder / "views/s3.view"),
              HasSubstr("From another program's camera of s3.jpg"));
}

}  // namespace
}  // namespace groundglass
