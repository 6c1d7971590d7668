// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/left_out.h"

#include "cli/commands.h"
#include "cli/convert_arguments.h"
#include "cli/elevation_arguments.h"
#include "cli/evaluate_arguments.h"
#include "cli/montage_arguments.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// What LeftOut says when this is done; empty if it is not thrown.
template <typename Work>
std::string WhatIsLeftOut(const Work& work) {
  try {
    work();
  } catch (const LeftOut& left_out) {
    return left_out.what();
  }
  return "";
}

// What the program without these commands says to these words.
std::string SaidTo(std::vector<std::string> words) {
  CLI::App app;
  int exit_status = 0;
  AddCalibrateCommand(app, exit_status);
  AddViewCommand(app, exit_status);
  AddWhereCommand(app, exit_status);
  AddSynthCommand(app, exit_status);
  return WhatIsLeftOut([&] { app.parse(std::vector<std::string>(words.rbegin(), words.rend())); });
}

ConvertArguments Conversion(const fs::path& input, const fs::path& output) {
  ConvertArguments arguments;
  arguments.input = input.string();
  arguments.output = output.string();
  return arguments;
}

TEST(LeftOut, NamesAnOptionAndATargetThatTheBuildFolderHas) {
  const std::string command = CommandThatBuildsEverything();
  const std::string configure = "cmake -D GROUNDGLASS_EVERY_COMMAND=ON ";
  ASSERT_THAT(command, StartsWith(configure));
  const size_t end = command.find(" && ");
  ASSERT_NE(end, std::string::npos);
  const std::string folder = command.substr(configure.size(), end - configure.size());
  EXPECT_EQ(command.substr(end), " && cmake --build " + folder + " --target groundglass");
  std::ifstream cache(fs::path(folder) / "CMakeCache.txt");
  const std::string cached{std::istreambuf_iterator<char>(cache), {}};
  EXPECT_THAT(cached, HasSubstr("\nGROUNDGLASS_EVERY_COMMAND:BOOL=ON\n"));
  EXPECT_EQ(fs::path(GROUNDGLASS_PROGRAM).parent_path().parent_path(), folder);
  EXPECT_EQ(fs::path(GROUNDGLASS_PROGRAM).filename(), "groundglass");
}

// demo.sh takes what follows "this builds it: " from the help.
TEST(LeftOut, EndsWithTheCommandInErrorsAndInTheHelp) {
  const std::string end = "; this builds it: " + CommandThatBuildsEverything();
  EXPECT_EQ(LeftOut("where").what(), "where: not in this build of groundglass" + end);
  EXPECT_THAT(LeftOut("view", "libsdl2-dev").what(),
              EndsWith("; install libsdl2-dev, then " + end.substr(2)));
  CLI::App app;
  int exit_status = 0;
  AddCalibrateCommand(app, exit_status);
  EXPECT_THAT(app.help(), HasSubstr("calibrate"));
  EXPECT_THAT(app.get_subcommand("calibrate")->help(), HasSubstr(end + "\n"));
}

TEST(LeftOut, CommandsSaySoWithWhateverWordsTheyAreCalled) {
  EXPECT_THAT(SaidTo({"calibrate"}), StartsWith("calibrate: "));
  EXPECT_THAT(SaidTo({"calibrate", "board", "b1.jpg", "-o", "my.lens"}), StartsWith("calibrate: "));
  EXPECT_THAT(SaidTo({"view", "hall", "--scene", "x"}), StartsWith("view: "));
  EXPECT_THAT(SaidTo({"where", "hall", "--point", "0,0,-4"}), StartsWith("where: "));
  EXPECT_THAT(SaidTo({"synth", "brick", "-o", "scene"}), StartsWith("synth: "));
}

TEST(LeftOut, PartsOfRenderSaySo) {
  EXPECT_THAT(WhatIsLeftOut([] { RenderElevations({}, {}, {}, "", "hall.tif", {}); }),
              StartsWith("render --elevation"));
  EXPECT_THAT(WhatIsLeftOut([] { RenderMontage({}, {}, "", {}, "hall.jpg"); }),
              StartsWith("render --over"));
}

TEST(LeftOut, PartsOfEvaluateSaySo) {
  EXPECT_THAT(WhatIsLeftOut([] { EvaluateTrials({}); }), StartsWith("evaluate --trials: "));
  EXPECT_THAT(WhatIsLeftOut([] { EvaluateScenes({}); }), StartsWith("evaluate of more than one"));
}

TEST(LeftOut, WhatConvertDoesForOtherProgramsSaysSo) {
  const TemporaryFolder work;
  ConvertArguments to_meshlab = Conversion(work / "out", work / "hall.mlp");
  to_meshlab.format = "meshlab";
  EXPECT_THAT(WhatIsLeftOut([&] { ConvertExchanged(to_meshlab); }), StartsWith("convert --to: "));
  fs::create_directories(work / "out");
  std::ofstream(work / "out" / "registration.json") << "{}";
  fs::create_directories(work / "fspy");
  std::ofstream(work / "fspy" / "s1.FSPY") << "fspy";
  for (const ConvertArguments& arguments : {Conversion(work / "out", work / "views"),
                                            Conversion(work / "fspy", work / "views"),
                                            Conversion("cameras.xml", work / "views"),
                                            Conversion("city.gml", "city.osu"),
                                            Conversion("hall.glb", "hall.city.json")}) {
    EXPECT_THAT(WhatIsLeftOut([&] { ConvertExchanged(arguments); }),
                StartsWith("convert " + arguments.input + " "));
  }
}

TEST(LeftOut, WhatConvertDoesWithModelsAndViewFilesIsThere) {
  const TemporaryFolder work;
  fs::create_directories(work / "views");
  std::ofstream(work / "views" / "s1.view") << "x 1";
  EXPECT_FALSE(ConvertExchanged(Conversion("hall.obj", "hall.osu")));
  EXPECT_FALSE(ConvertExchanged(Conversion("hall.gltf", "hall.glb")));
  EXPECT_FALSE(ConvertExchanged(Conversion(work / "views", work / "colmap")));
}

}  // namespace
}  // namespace groundglass
