// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// A job is never lost: odd photographs, broken files, runs that are stopped or changed, full disks.
#include "scene/formats/folder_lock.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "tests/cli/program.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// Every n-th pixel of the columns from `left` on.
Image8 Shrunk(const Image8& image, int n, int left, int width) {
  Image8 small(width / n, image.height / n, 3);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int i = 0; i < n * n; ++i) {
          const size_t at = static_cast<size_t>(y * n + i / n) * image.width + left + x * n + i % n;
          sum += image.values[3 * at + channel];
        }
        small.values[3 * (static_cast<size_t>(y) * small.width + x) + channel] =
            static_cast<uint8_t>(sum / (n * n));
      }
    }
  }
  return small;
}

// The brick scene's photographs at half their size, for speed.
void CopySmallBrick(const fs::path& folder, const std::vector<std::string>& names) {
  CopyBrick(folder, names);
  for (const std::string& name : names) {
    const fs::path file = folder / "images" / (name + ".jpg");
    const Image8 whole = ReadSrgb8(file);
    WriteSrgb8(file, Shrunk(whole, 2, 0, whole.width));
  }
}

ProgramRun RunJob(const fs::path& scene,
                  const fs::path& out,
                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      "run", scene.string(), "-o", out.string(), "--quiet", "--max-texture", "512"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunProgram(arguments);
}

json VerdictsOf(const fs::path& out) {
  json verdicts;
  const json registration = json::parse(ReadAll(out / "registration.json"));
  for (const json& photograph : registration.at("photographs")) {
    verdicts[photograph["name"].get<std::string>()] = photograph["verdict"];
  }
  return verdicts;
}

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(NeverLost, PhotographsOfSeveralSizesGiveStillsOfOne) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopySmallBrick(scene, {"s1", "s2", "s5"});
  // s2 was scanned half as large, of s5 the middle was cut out, which stands.
  const fs::path s2 = scene / "images/s2.jpg";
  WriteSrgb8(s2, Shrunk(ReadSrgb8(s2), 2, 0, 600));
  const fs::path s5 = scene / "images/s5.jpg";
  WriteSrgb8(s5, Shrunk(ReadSrgb8(s5), 1, 120, 360));
  ViewTag tag = ReadView(scene / "views/s5.view");
  tag.aspect = 360.0 / 400;
  tag.view_angle_deg = 2 * kDegreesPerRadian *
                       std::atan(std::tan(RadiansFromDegrees(tag.view_angle_deg) / 2) * 360 / 600);
  WriteAll(scene / "views/s5.view", FormatView(tag));
  const fs::path out = work / "out";
  const ProgramRun run = RunJob(scene, out, {"--stills", "2"});
  EXPECT_TRUE(run.status == 0 || run.status == 3) << run.err;
  EXPECT_TRUE(fs::exists(out / "model.glb"));
  EXPECT_TRUE(fs::exists(out / "report.html"));
  for (const char* still : {"renders/still_1.jpg", "renders/still_2.jpg"}) {
    const ImageSize size = ReadImageSize(out / still);
    EXPECT_EQ(size.width, 600);
    EXPECT_EQ(size.height, 400);
  }
  EXPECT_THAT(run.out, HasSubstr("(600 x 400 pixels)"));
}

TEST(NeverLost, BrokenFilesCostTheirOwnPhotographOnly) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopySmallBrick(scene, {"s1", "s2", "s3", "s5", "s7"});
  const std::string whole = ReadAll(scene / "images/s2.jpg");
  WriteAll(scene / "images/s2.jpg", whole.substr(0, whole.size() / 2));
  WriteAll(scene / "images/s3.jpg", "");
  WriteAll(scene / "views/s5.view", "x 1 y two z 3\n");
  const fs::path out = work / "out";
  const ProgramRun run = RunJob(scene, out, {"--stills", "1"});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(fs::exists(out / "model.glb"));
  const json verdicts = VerdictsOf(out);
  for (const char* name : {"s2", "s3", "s5"}) EXPECT_EQ(verdicts[name], "unreadable") << name;
  for (const char* name : {"s1", "s7"}) EXPECT_NE(verdicts[name], "unreadable") << name;
  EXPECT_EQ(NamesIn(out / "views"), (std::vector<std::string>{"s1.view", "s7.view"}));
  EXPECT_THAT(run.out, HasSubstr("unreadable"));
  EXPECT_THAT(run.out, HasSubstr("images/s2.jpg: this image is damaged"));
  EXPECT_THAT(run.out, HasSubstr("views/s5.view"));
  const std::string report = ReadAll(out / "report.html");
  EXPECT_THAT(report, HasSubstr("<b>3</b><span>unreadable"));
  EXPECT_THAT(report, HasSubstr("images/s2.jpg: this image is damaged"));
  // The texture alone does the same.
  const fs::path texture = work / "texture";
  const ProgramRun invrender = RunProgram({"invrender",
                                           scene.string(),
                                           "-o",
                                           texture.string(),
                                           "--max-texture",
                                           "256",
                                           "--quiet",
                                           "--json"});
  EXPECT_EQ(invrender.status, 3) << invrender.err;
  const std::string unreadable = json::parse(invrender.out)["unreadable"].dump();
  for (const char* name : {"s2", "s3", "s5"}) {
    EXPECT_THAT(unreadable, HasSubstr(name + std::string(" is unreadable: ")));
  }
  EXPECT_TRUE(fs::exists(texture / "model.glb"));
  // Asked for or forgiven by name, the others' faults do not matter.
  for (const char* option : {"--only", "--exclude"}) {
    const std::string names = option == std::string("--only") ? "s1" : "s2,s3.jpg,s5";
    const ProgramRun narrow =
        RunProgram({"run", scene.string(), "-o", out.string(), "--dry-run", option, names});
    EXPECT_EQ(narrow.status, 0) << narrow.err;
  }
  const ProgramRun narrow = RunProgram(
      {"register", scene.string(), "-o", (work / "narrow").string(), "--only", "s7", "--quiet"});
  EXPECT_EQ(VerdictsOf(work / "narrow").size(), 1u);
  EXPECT_THAT(narrow.out, Not(HasSubstr("unreadable")));
  // None at all is an error, with the reasons.
  const ProgramRun none =
      RunProgram({"register", scene.string(), "-o", (work / "none").string(), "--only", "s2,s3"});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.err, HasSubstr("images/s2.jpg"));
  EXPECT_THAT(none.err, HasSubstr("images/s3.jpg"));
  EXPECT_FALSE(fs::exists(work / "none"));
}

TEST(NeverLost, RunningAgainMakesWhatIsMissingAndKeepsTheRest) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopySmallBrick(scene, {"s1", "s2", "s5"});
  const fs::path out = work / "out";
  const int status = RunJob(scene, out).status;
  ASSERT_TRUE(status == 0 || status == 3);
  const std::string first = Fingerprint(out);
  const auto age = [&](const char* file) { return fs::last_write_time(out / file); };
  auto registered_at = age("registration.json");
  auto baked_at = age("model.obj");

  for (const char* missing : {"overlays/s2.jpg", "views/s1.view", "renders/still_2.jpg"}) {
    fs::remove(out / missing);
    EXPECT_EQ(RunJob(scene, out).status, status);
    EXPECT_EQ(Fingerprint(out), first) << missing << " was not made again as it was";
    EXPECT_EQ(age("model.obj"), baked_at) << missing;
  }
  for (const char* missing : {"model.glb", "faces/s5.png"}) {
    fs::remove(out / missing);
    registered_at = age("registration.json");
    EXPECT_EQ(RunJob(scene, out).status, status);
    EXPECT_EQ(Fingerprint(out), first) << missing << " was not made again as it was";
    EXPECT_EQ(age("registration.json"), registered_at) << missing;
  }

  // More or fewer stills: no more than that.
  baked_at = age("model.obj");
  EXPECT_EQ(RunJob(scene, out, {"--stills", "2"}).status, status);
  EXPECT_EQ(NamesIn(out / "renders"), (std::vector<std::string>{"still_1.jpg", "still_2.jpg"}));
  EXPECT_EQ(age("model.obj"), baked_at);
  EXPECT_EQ(age("registration.json"), registered_at);

  // Another texture: the tags stay, its pages of another kind go.
  EXPECT_EQ(RunJob(scene, out, {"--format", "png", "--only-faces", "1-20"}).status, status);
  EXPECT_EQ(age("registration.json"), registered_at);
  EXPECT_TRUE(fs::exists(out / "model_0.png"));
  EXPECT_FALSE(fs::exists(out / "model_0.jpg"));
  const json options = json::parse(ReadAll(out / "manifest.json"))["options"];
  EXPECT_EQ(options["only"], "");
  EXPECT_EQ(options["only-faces"], "1-20");
  EXPECT_EQ(options["stills"], "4");

  // Fewer photographs: nothing tells of the others; what is not ours stays.
  WriteAll(out / "renders" / "mine.mp4", "a film of my own");
  WriteAll(out / "notes.txt", "mine");
  const int narrow = RunJob(scene, out, {"--only", "s1"}).status;
  EXPECT_TRUE(narrow == 0 || narrow == 3);
  EXPECT_EQ(NamesIn(out / "views"), std::vector<std::string>{"s1.view"});
  EXPECT_EQ(NamesIn(out / "overlays"), std::vector<std::string>{"s1.jpg"});
  EXPECT_EQ(NamesIn(out / "faces"), std::vector<std::string>{"s1.png"});
  EXPECT_EQ(NamesIn(out / "renders"), std::vector<std::string>{"mine.mp4"});
  EXPECT_TRUE(fs::exists(out / "notes.txt"));

  // Nothing that could be textured: the model of before does not stay.
  EXPECT_EQ(RunJob(scene, out, {"--only", "s1", "--reject", "s1"}).status, 3);
  EXPECT_FALSE(fs::exists(out / "model.glb"));
  EXPECT_FALSE(fs::exists(out / "coverage.json"));
  EXPECT_TRUE(fs::exists(out / "report.html"));
}

TEST(NeverLost, ASecondRunIntoTheSameFolderIsTold) {
  const TemporaryFolder work;
  CopySmallBrick(work / "scene", {"s1"});
  const fs::path out = work / "out";
  fs::create_directories(out);
  const FolderLock first(out);
  for (const char* command : {"run", "register", "invrender"}) {
    const ProgramRun second =
        RunProgram({command, (work / "scene").string(), "-o", out.string(), "--quiet"});
    EXPECT_EQ(second.status, 1) << command;
    EXPECT_THAT(second.err, HasSubstr("another groundglass is at work in this folder")) << command;
  }
  EXPECT_TRUE(fs::is_empty(out));
}

TEST(NeverLost, AFullDiskIsAnErrorAndTheRunGoesOnOnceThereIsRoom) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopySmallBrick(scene, {"s1", "s2"});
  const fs::path out = work / "out";
  ProgramRun full;
  {
    // Room for tags and registration.json, not for the texture.
    const SmallDisk disk(40000);
    full = RunJob(scene, out, {"--stills", "1"});
  }
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, HasSubstr("cannot write this file: File too large"));
  EXPECT_TRUE(fs::exists(out / "registration.json"));
  EXPECT_FALSE(fs::exists(out / "model.glb"));
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out)) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr(".part"))) << "left behind";
    if (entry.path().extension() == ".jpg") ReadSrgb8(entry.path());  // none is cut
  }
  const ProgramRun again = RunJob(scene, out, {"--stills", "1"});
  EXPECT_TRUE(again.status == 0 || again.status == 3) << again.err;
  const fs::path elsewhere = work / "elsewhere";
  RunJob(scene, elsewhere, {"--stills", "1"});
  EXPECT_EQ(Fingerprint(out), Fingerprint(elsewhere));
}

// The same on a disk that is really full. Only root may make one, in a name space of its own.
TEST(NeverLost, OnASmallDiskPicturesAreErrorsAndLeaveNothing) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const fs::path disk = work / "disk";
  fs::create_directories(disk);
  const auto on_small_disk = [&](const std::string& command) {
    return std::system(("unshare -m sh -c 'mount -t tmpfs -o size=128k tmpfs " + disk.string() +
                        " && { " + command + "; }' >" + (work / "out").string() + " 2>&1")
                           .c_str());
  };
  if (on_small_disk("true") != 0) {
    GTEST_SKIP() << "no small disk can be mounted here: " << ReadAll(work / "out");
  }
  for (const char* file : {"a.jpg", "a.png", "a.tif", "a.exr"}) {
    const std::string command =
        std::string(GROUNDGLASS_PROGRAM) + " render " + (work / "scene/model.osu").string() +
        " --photo " + (work / "scene/images/s1.jpg").string() + " --view " +
        (work / "scene/views/s1.view").string() + " -o " + (disk / file).string() +
        "; echo status $?; ls -A " + disk.string() + " | sed s/^/left:/";
    on_small_disk(command);
    const std::string said = ReadAll(work / "out");
    EXPECT_THAT(said, HasSubstr("status 1")) << file;
    EXPECT_THAT(said, HasSubstr("No space left on device")) << file;
    EXPECT_THAT(said, Not(HasSubstr("left:"))) << file;
  }
}

}  // namespace
}  // namespace groundglass
