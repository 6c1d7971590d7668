// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// From a scene folder to corrected tags, a textured model, pictures and a report.
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

const std::string kTruth = std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/truth";

TEST(MainJob, CorrectsTexturesRendersAndEvaluates) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2", "s5"});
  const std::string before = Fingerprint(scene);
  const std::string out = (work / "out").string();

  // Coarse, since nothing here is about how sharp the texture is.
  const auto words = [&](const std::string& folder, const std::vector<std::string>& more) {
    std::vector<std::string> all = {
        "run", scene.string(), "-o", folder, "--max-texture", "1024", "--stills", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const ProgramRun run = RunProgram(words(out, {"--json"}));
  ASSERT_TRUE(run.status == 0 || run.status == 3) << run.err;
  const json result = json::parse(run.out);
  ASSERT_EQ(result["photographs"].size(), 3u);
  bool all_accepted = true;
  for (const json& photograph : result["photographs"]) {
    all_accepted = all_accepted && photograph["verdict"] == "accepted";
  }
  EXPECT_EQ(run.status, all_accepted ? 0 : 3);
  for (const char* file : {"views/s1.view",
                           "views/s5.view",
                           "registration.json",
                           "cameras/cameras.txt",
                           "cameras/images.txt",
                           "overlays/s1.jpg",
                           "faces/s1.png",
                           "model.glb",
                           "model.obj",
                           "coverage.json",
                           "provenance_0.png",
                           "report.html",
                           "manifest.json"}) {
    EXPECT_TRUE(fs::is_regular_file(fs::path(out) / file)) << file;
  }
  EXPECT_TRUE(json::accept(ReadAll(fs::path(out) / "coverage.json")));
  EXPECT_EQ(Fingerprint(scene), before) << "the originals were written to";

  // The same again keeps what is there; the same elsewhere gives the same bytes.
  const std::string first = Fingerprint(out);
  EXPECT_EQ(RunProgram(words(out, {"--quiet"})).status, run.status);
  EXPECT_EQ(Fingerprint(out), first);
  const std::string elsewhere = (work / "elsewhere").string();
  EXPECT_EQ(RunProgram(words(elsewhere, {"--quiet", "--threads", "1"})).status, run.status);
  for (const char* file : {"views/s1.view", "registration.json", "model.glb", "coverage.json"}) {
    EXPECT_EQ(ReadAll(fs::path(out) / file), ReadAll(fs::path(elsewhere) / file)) << file;
  }

  const fs::path picture = work / "n1.png";
  const ProgramRun render = RunProgram({"render",
                                        out + "/model.glb",
                                        "--view",
                                        kTruth + "/novel/n1.view",
                                        "-o",
                                        picture.string(),
                                        "--width",
                                        "300"});
  EXPECT_EQ(render.status, 0) << render.err;
  EXPECT_GT(fs::file_size(picture), 10000u);

  const ProgramRun evaluate = RunProgram(
      {"evaluate", out, "--truth", kTruth, "--model", (scene / "model.osu").string(), "--json"});
  ASSERT_EQ(evaluate.status, 0) << evaluate.err;
  EXPECT_TRUE(json::parse(evaluate.out).is_object());
}

TEST(MainJob, RefusesAFolderThatHoldsSomethingElse) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const fs::path out = work / "out";
  fs::create_directories(out);
  WriteAll(out / "thesis.txt", "not ours");
  for (const char* command : {"run", "register"}) {
    const ProgramRun run =
        RunProgram({command, (work / "scene").string(), "-o", out.string(), "--quiet"});
    EXPECT_EQ(run.status, 1) << command;
    EXPECT_THAT(run.err, HasSubstr(out.string())) << command;
  }
  EXPECT_EQ(Fingerprint(out), "thesis.txt\nnot ours");
}

TEST(MainJob, DryRunWritesNothing) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1", "s2"});
  const ProgramRun run =
      RunProgram({"run", (work / "scene").string(), "-o", (work / "out").string(), "--dry-run"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(run.out.empty());
  EXPECT_FALSE(fs::exists(work / "out"));
}

TEST(MainJob, APhotographOfSomethingElseIsFlaggedWithThree) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s7"});
  // s1's tag with s7's photograph: a different side of the building.
  fs::remove(scene / "images" / "s1.jpg");
  fs::copy_file(scene / "images" / "s7.jpg", scene / "images" / "s1.jpg");
  const ProgramRun run =
      RunProgram({"register", scene.string(), "-o", (work / "out").string(), "--json", "--quiet"});
  ASSERT_EQ(run.status, 3) << run.err;
  const json result = json::parse(run.out);
  EXPECT_NE(result["photographs"][0]["verdict"], "accepted");
  EXPECT_EQ(result["photographs"][1]["verdict"], "accepted");
}

TEST(MainJob, ALensFileServesRegister) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  WriteAll(work / "good.lens", "v 58 sigma_v 0.3\na 1.5 sigma_a 0.005\n");
  const ProgramRun good = RunProgram({"register",
                                      (work / "scene").string(),
                                      "-o",
                                      (work / "out").string(),
                                      "--lens",
                                      (work / "good.lens").string(),
                                      "--quiet"});
  EXPECT_TRUE(good.status == 0 || good.status == 3) << good.err;
  WriteAll(work / "bad.lens", "v 58\nfocal 35\n");
  const ProgramRun bad = RunProgram({"register",
                                     (work / "scene").string(),
                                     "-o",
                                     (work / "out2").string(),
                                     "--lens",
                                     (work / "bad.lens").string(),
                                     "--quiet"});
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.err, HasSubstr("bad.lens:2: unknown key"));
}

}  // namespace
}  // namespace groundglass
