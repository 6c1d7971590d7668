// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Nothing is passed over in silence: other models, names that no photograph has, files that were
// changed, pictures that cannot be made.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(Told, WhichOfSeveralModelsIsRead) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  fs::copy_file(scene / "model.osu", scene / "older.OSU");
  const auto said = [&](const char* command, const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        command, scene.string(), "-o", (work / "out").string(), "--dry-run"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = RunProgram(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.err;
  };
  for (const char* command : {"run", "register", "invrender"}) {
    EXPECT_THAT(
        said(command, {}),
        HasSubstr("the model that is read is model.osu; older.OSU beside it is not (--model "
                  "FILE chooses another)"));
    // Whoever has chosen knows.
    EXPECT_THAT(said(command, {"--model", (scene / "older.OSU").string()}),
                Not(HasSubstr("beside it")));
  }
}

// What is printed may be all that was asked for.
TEST(Told, ThatStandardOutputCannotBeWritten) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  const std::string command = std::string(GROUNDGLASS_PROGRAM) + " check " + scene.string() +
                              " --json > /dev/full 2> " + (work / "err").string();
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_THAT(ReadAll(work / "err"), HasSubstr("cannot write standard output"));
}

TEST(Told, WhichPhotographsThereAreForATableOfPairs) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2"});
  WriteAll(scene / "images/s2.jpg", "no picture");
  const auto run = [&](const std::string& pairs) {
    WriteAll(scene / "pairs.csv", "image,face\n" + pairs);
    return RunProgram({"run", scene.string(), "-o", (work / "out").string(), "--dry-run"});
  };
  EXPECT_THAT(run("s1,1\ns9,1\n").err,
              HasSubstr("pairs.csv:3: no photograph is called 's9'; there are s1, s2"));
  EXPECT_THAT(run("s01,1\n").err, HasSubstr("is it s1.jpg?"));
  // It costs itself, and not the job.
  EXPECT_EQ(run("s9,1\n").status, 0);
  WriteAll(scene / "pairs.csv", "image,face\ns9,1\ns1,999\n");
  const ProgramRun check = RunProgram({"check", scene.string()});
  EXPECT_THAT(check.out, HasSubstr("pairs.csv:2: no photograph is called 's9'"));
  EXPECT_THAT(check.out, HasSubstr("pairs.csv:3: no face is called '999'"));
  EXPECT_EQ(check.status, 1);
  std::filesystem::remove(scene / "pairs.csv");
  // One that cannot be read is there all the same.
  EXPECT_EQ(run("s1,1\ns2,1\n").status, 0);
}

TEST(Told, WhyOnePhotographGivesNoStillsAndWhatWasChanged) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  const std::vector<std::string> words = {
      "run", scene.string(), "-o", (work / "out").string(), "--max-texture", "512", "--json"};
  const ProgramRun run = RunProgram(words);
  ASSERT_TRUE(run.status == 0 || run.status == 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no pictures from new viewpoints"));
  EXPECT_THAT(json::parse(run.out)["warnings"].dump(), HasSubstr("only s1 has a camera"));
  std::vector<std::string> without = words;
  without.insert(without.end(), {"--stills", "0"});
  EXPECT_THAT(RunProgram(without).err, Not(HasSubstr("no pictures from new viewpoints")));

  // Files that are cut short or garbled are made again, and it is said.
  const fs::path out = work / "out";
  const std::string first = Fingerprint(out);
  const auto half = [](const std::string& bytes) { return bytes.substr(0, bytes.size() / 2); };
  const auto flipped = [](std::string bytes) {
    bytes[bytes.size() / 2] ^= 1;
    return bytes;
  };
  for (const auto& [file, bytes] :
       {std::pair<std::string, std::string>("model.glb", flipped(ReadAll(out / "model.glb"))),
        {"overlays/s1.jpg", half(ReadAll(out / "overlays/s1.jpg"))},
        {"views/s1.view", half(ReadAll(out / "views/s1.view"))},
        {"faces/s1.png", ""},
        {"registration.json", half(ReadAll(out / "registration.json"))},
        {"cameras/images.txt", "none"}}) {
    WriteAll(out / file, bytes);
    const ProgramRun again = RunProgram(without);
    EXPECT_EQ(again.status, run.status) << again.err;
    EXPECT_THAT(again.err, HasSubstr(file + " has changed since it was written"));
    EXPECT_EQ(Fingerprint(out), first) << file;
  }
  const ProgramRun last = RunProgram(without);
  EXPECT_THAT(last.err, Not(HasSubstr("has changed since")));

  // With nothing to do it tells what the first run told, and a dry run what is kept.
  std::vector<std::string> for_people = without;
  std::erase(for_people, "--json");
  EXPECT_THAT(RunProgram(for_people).out, HasSubstr("texture covers "));
  for_people.push_back("--dry-run");
  EXPECT_THAT(RunProgram(for_people).out,
              HasSubstr("would keep what is there already of: register, overlays, texture"));
  const std::string manifest = ReadAll(out / "manifest.json");
  WriteAll(out / "manifest.json", half(manifest));
  EXPECT_THAT(
      RunProgram(without).err,
      testing::AllOf(HasSubstr("manifest.json is damaged"), HasSubstr("everything is made again")));
}

// Every number held, so that registration is done in no time.
const std::vector<std::string> kHeld = {"--lock", "x,y,z,yaw,pitch,roll,v,a,shift,k1"};

TEST(Told, WhatRegisterWouldKeepAndWhatItCannotTrust) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const fs::path out = work / "out";
  std::vector<std::string> words = {"register", (work / "scene").string(), "-o", out.string()};
  words.insert(words.end(), kHeld.begin(), kHeld.end());
  const auto dry = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    more.push_back("--dry-run");
    return RunProgram(more).out;
  };
  EXPECT_THAT(dry({}), Not(HasSubstr("would keep")));
  const ProgramRun first = RunProgram(words);
  const std::string made = Fingerprint(out);
  EXPECT_THAT(dry({}), HasSubstr("would keep what is there already of: register, overlays"));
  EXPECT_EQ(json::parse(dry({"--json"}))["kept"], json({"register", "overlays"}));
  EXPECT_THAT(dry({"--seed", "2"}), Not(HasSubstr("would keep")));
  // What the stages hand to one another is seen only by going through them.
  const std::string stages = (work / "stages").string();
  EXPECT_EQ(json::parse(dry({"--json", "--keep", stages}))["kept"], json({"overlays"}));

  const std::string manifest = ReadAll(out / "manifest.json");
  for (const std::string& bad : {manifest.substr(0, manifest.size() / 2),
                                 std::string(R"({"program": "groundglass", "stages": 7})")}) {
    WriteAll(out / "manifest.json", bad);
    EXPECT_THAT(dry({}), Not(HasSubstr("would keep")));
    const ProgramRun again = RunProgram(words);
    EXPECT_EQ(again.status, first.status) << again.err;
    EXPECT_THAT(again.err, HasSubstr("manifest.json is damaged"));
    EXPECT_THAT(again.err, Not(HasSubstr("keeping the tags")));
    EXPECT_EQ(Fingerprint(out), made);
  }
  EXPECT_THAT(RunProgram(words).err, Not(HasSubstr("is damaged")));
  // Nobody knows whose folder it is.
  const auto expect_refused = [&](const std::string& bad) {
    WriteAll(out / "manifest.json", bad);
    const ProgramRun refused = RunProgram(words);
    EXPECT_EQ(refused.status, 1) << bad;
    EXPECT_THAT(refused.err, HasSubstr("manifest.json: is damaged or not ours"));
  };
  expect_refused(R"({"program": 5})");
  fs::remove(out / "registration.json");
  expect_refused("[1");
}

TEST(Told, InvrenderMakesEverythingAgainUnderADamagedManifest) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const fs::path out = work / "out";
  const std::vector<std::string> words = {"invrender",
                                          (work / "scene").string(),
                                          "-o",
                                          out.string(),
                                          "--max-texture",
                                          "256",
                                          "--only-faces",
                                          "3"};
  const ProgramRun first = RunProgram(words);
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string made = Fingerprint(out);
  const std::string manifest = ReadAll(out / "manifest.json");
  WriteAll(out / "manifest.json", manifest.substr(0, manifest.size() / 2));
  const ProgramRun again = RunProgram(words);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("manifest.json is damaged"));
  EXPECT_EQ(Fingerprint(out), made);
}

TEST(Told, WhatADryRunCannotReadAndWhichNameIsMeant) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2"});
  fs::rename(scene / "images/s2.jpg", scene / "images/Turm.jpg");
  fs::rename(scene / "views/s2.view", scene / "views/Turm.view");
  std::vector<std::string> words = {
      "run", scene.string(), "-o", (work / "out").string(), "--dry-run", "--only", "Tur"};
  EXPECT_THAT(RunProgram(words).err, HasSubstr("did you mean Turm?"));
  words.resize(words.size() - 2);
  const std::string jpeg = ReadAll(scene / "images/s1.jpg");
  WriteAll(scene / "images/s1.jpg", jpeg.substr(0, jpeg.size() / 2));
  EXPECT_THAT(
      RunProgram(words).out,
      testing::AllOf(HasSubstr("would leave out 1 that cannot be read"), HasSubstr("s1.jpg")));
}

TEST(Told, ALensThatSuitsNoPicture) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  WriteAll(work / "upright.lens", "v 42\na 0.667\n");
  const std::string scene = (work / "scene").string();
  const ProgramRun run = RunProgram(
      {"register", scene, "--lens", work / "upright.lens", "-o", work / "out", "--dry-run"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("upright.lens: a 0.667 suits no picture here (s1 is 1200 x 800"));
}

TEST(Told, WhyNoPhotographIsLeft) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2"});
  WriteAll(scene / "images/s2.jpg", "no picture");
  const ProgramRun run = RunProgram(
      {"run", scene.string(), "-o", (work / "out").string(), "--exclude", "s1", "--dry-run"});
  EXPECT_THAT(run.err, HasSubstr("since the others cannot be read:"));
  EXPECT_THAT(run.err, HasSubstr("s2.jpg: cannot read this as an image"));
}

TEST(Told, WhatCheckFoundThoughNoOverlayCanBeWritten) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  fs::create_directories(work / "out/s1.jpg/in the way");
  const ProgramRun check = RunProgram({"check", scene.string(), "-o", (work / "out").string()});
  EXPECT_EQ(check.status, 1);
  EXPECT_THAT(check.out, HasSubstr("108 points, 70 faces"));
  EXPECT_THAT(check.out, HasSubstr("overlays are not whole: "));
}

TEST(Told, AFileInPlaceOfItsFolderAndALinkToNothing) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  EXPECT_THAT(RunProgram({"check", (scene / "model.osu").string()}).out,
              HasSubstr("a file, not a scene folder"));
  fs::create_directory(scene / "masks");
  fs::create_symlink("nowhere.png", scene / "masks/s1.png");
  EXPECT_THAT(RunProgram({"check", scene.string()}).out,
              HasSubstr("s1.png: is a link that leads to no file"));
}

TEST(Told, AThumbnailInPlaceOfAPhotograph) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  fs::remove(scene / "images/s1.jpg");
  WriteAll(scene / "images/s1.ppm", "P6 3 2 255\n" + std::string(18, '\x80'));
  EXPECT_THAT(RunProgram({"check", scene.string()}).out, HasSubstr("has only 3 x 2 pixels"));
}

TEST(Told, AStandardDeviationLargerThanTheBuilding) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1"});
  EXPECT_THAT(
      RunProgram({"register",
                  scene.string(),
                  "-o",
                  (work / "out").string(),
                  "--dry-run",
                  "--sigma-position",
                  "1000"})
          .err,
      HasSubstr("--sigma-position 1000: so many metres are several times the whole building"));
}

TEST(Told, AWrongUnitBeforeTheWorkBegins) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s3", "s5", "s7", "s9"});
  const fs::path model = work / "model.osu";
  ASSERT_EQ(RunProgram({"convert",
                        (scene / "model.osu").string(),
                        model.string(),
                        "--unit",
                        "ft",
                        "--to-unit",
                        "mm"})
                .status,
            0);
  // What is told beforehand does not depend on what follows.
  std::vector<std::string> words = {"run",
                                    scene.string(),
                                    "-o",
                                    (work / "out").string(),
                                    "--model",
                                    model.string(),
                                    "--stills",
                                    "0"};
  words.insert(words.end(), kHeld.begin(), kHeld.end());
  const ProgramRun run = RunProgram(words);
  const size_t told = run.err.find("it is in mm and they in ft");
  ASSERT_NE(told, std::string::npos) << run.err;
  EXPECT_LT(told, run.err.find("registering"));
}

}  // namespace
}  // namespace groundglass
