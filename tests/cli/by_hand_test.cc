// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Help by hand: photographs chosen, points given, verdicts overruled.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(ByHand, VerdictsAreOverruledAndSaySo) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2", "s7"});
  // s1's tag with s7's photograph: nobody would believe it without being told to.
  fs::remove(scene / "images" / "s1.jpg");
  fs::copy_file(scene / "images" / "s7.jpg", scene / "images" / "s1.jpg");
  const fs::path out = work / "out";
  // A list takes one word, so that the scene may follow it.
  const ProgramRun run = RunProgram({"register",
                                     "--only",
                                     "s1,s7",
                                     scene.string(),
                                     "-o",
                                     out.string(),
                                     "--accept",
                                     "s1",
                                     "--reject",
                                     "s7",
                                     "--independent",
                                     "--json",
                                     "--quiet"});
  ASSERT_EQ(run.status, 3) << run.err;
  const json photographs = json::parse(run.out)["photographs"];
  ASSERT_EQ(photographs.size(), 2u);
  EXPECT_EQ(photographs[0]["verdict"], "accepted");
  EXPECT_THAT(photographs[0]["reasons"][0].get<std::string>(), HasSubstr("accepted by a person"));
  EXPECT_EQ(photographs[1]["verdict"], "rejected");
  EXPECT_THAT(photographs[1]["reasons"][0].get<std::string>(), HasSubstr("rejected by a person"));
  // The camera that was found is used; the rejected one's tag stays as it was written.
  EXPECT_NE(ReadAll(out / "views/s1.view"), ReadAll(scene / "views/s1.view"));
  EXPECT_EQ(ReadAll(out / "views/s7.view"), ReadAll(scene / "views/s7.view"));
  const json options = json::parse(ReadAll(out / "manifest.json"))["options"];
  EXPECT_EQ(options["accept"], "s1");
  EXPECT_EQ(options["reject"], "s7");
  EXPECT_EQ(options["only"], "s1,s7");
}

TEST(ByHand, NamesThatTheSceneDoesNotHaveAreErrors) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1", "s2"});
  WriteAll(work / "a.points",
           "s1 1 2 3 4 5 2\ns1 2 3 4 5 6 2\ns1 3 4 5 6 8 2\n"
           "s9 1 2 3 4 5 2\ns9 2 3 4 5 6 2\ns9 3 4 5 6 8 2\n");
  const std::string points = (work / "a.points").string();
  for (const auto& [option, value, place] :
       {std::tuple<std::string, std::string, std::string>("--only", "s9", "option --only"),
        {"--accept", "s1,s9", "option --accept"},
        {"--reject", "s9", "option --reject"},
        {"--points", points, points}}) {
    for (const char* command : {"register", "run"}) {
      const ProgramRun run = RunProgram({command,
                                         (work / "scene").string(),
                                         "-o",
                                         (work / "out").string(),
                                         option,
                                         value,
                                         "--quiet"});
      EXPECT_EQ(run.status, 1) << option;
      EXPECT_THAT(run.err, HasSubstr(place + ": no photograph is called 's9'; there are s1, s2"));
    }
  }
  EXPECT_FALSE(fs::exists(work / "out"));
}

TEST(ByHand, APhotographWithoutATagIsNotCalledMissing) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1", "s2"});
  fs::remove(work / "scene/views/s2.view");
  WriteAll(work / "a.points", "s2 1 2 3 4 5 2\ns2 2 3 4 5 6 2\ns2 3 4 5 6 8 2\n");
  const std::string points = (work / "a.points").string();
  const ProgramRun run = RunProgram({"register",
                                     (work / "scene").string(),
                                     "-o",
                                     (work / "out").string(),
                                     "--points",
                                     points,
                                     "--quiet"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(
      run.err,
      HasSubstr(points + ": s2.jpg: photograph without a tag; expected views/s2.view (groundglass "
                         "check "));
}

TEST(ByHand, PointsJoinAndTheirFileIsInTheManifest) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  WriteAll(work / "a.points",
           "s1 1 2 30 40 5 5000\ns1 2 3 40 50 6 5000\ns1 3 4 50 60 8 5000 % anywhere\n");
  const ProgramRun run = RunProgram({"register",
                                     (work / "scene").string(),
                                     "-o",
                                     (work / "out").string(),
                                     "--points",
                                     (work / "a.points").string(),
                                     "--quiet"});
  EXPECT_TRUE(run.status == 0 || run.status == 3) << run.err;
  EXPECT_THAT(ReadAll(work / "out/manifest.json"), HasSubstr("a.points"));
}

}  // namespace
}  // namespace groundglass
