// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The main job as a library call: nothing but what it returns, what it tells, and its files.
#include "pipeline/main_job.h"

#include "pipeline/register_stages.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The brick scene with two of its photographs.
Scene CopySmallScene(const fs::path& folder) {
  const fs::path brick = fs::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";
  fs::create_directories(folder / "views");
  fs::create_directories(folder / "images");
  fs::copy_file(brick / "model.osu", folder / "model.osu");
  for (const std::string name : {"s1", "s2"}) {
    fs::copy_file(brick / "views" / (name + ".view"), folder / "views" / (name + ".view"));
    fs::copy_file(brick / "images" / (name + ".jpg"), folder / "images" / (name + ".jpg"));
  }
  return ReadScene(folder);
}

// Coarse, so that it takes seconds.
MainJobOptions QuickOptions() {
  MainJobOptions options;
  options.registering.max_width_px = 600;
  options.baking.pages.max_page_texels = 512;
  options.num_stills = 1;
  return options;
}

// What a job tells while it is at work.
struct Heard {
  std::vector<std::string> begun;
  std::vector<std::string> kept;
  std::vector<std::string> lines;
  std::map<std::string, int> steps;  // of each stage, the last that was told
  size_t num_registered = 0;
  double covered_share = -1;

  JobObserver Observer() {
    JobObserver observer;
    observer.begun = [this](const std::string& stage) -> Progress {
      begun.push_back(stage);
      return [this, stage](int done, int, const std::string&) { steps[stage] = done; };
    };
    observer.kept = [this](const std::string& stage) { kept.push_back(stage); };
    observer.told = [this](const std::string& line) { lines.push_back(line); };
    observer.registered = [this](const RegisteredScene& registered) {
      num_registered = registered.registrations.size();
    };
    observer.textured = [this](double share) { covered_share = share; };
    return observer;
  }
};

// Every file below a folder and when it was written.
std::map<std::string, fs::file_time_type> TimesOf(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> times;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    times[fs::relative(entry.path(), folder).generic_string()] = entry.last_write_time();
  }
  return times;
}

// The number in the model's file of a face that no photograph shows.
int FindBareFace(const fs::path& coverage_file) {
  std::ifstream in(coverage_file);
  const nlohmann::json coverage = nlohmann::json::parse(in);
  for (const nlohmann::json& face : coverage.at("faces")) {
    if (face.at("covered_texels") == 0) return face.at("face");
  }
  return 0;
}

TEST(MainJob, IsOneCallThatKeepsWhatIsThereAndSurvivesAStageThatFails) {
  const TemporaryFolder work;
  const Scene scene = CopySmallScene(work / "scene");
  const fs::path out = work / "out";
  MainJobOptions options = QuickOptions();
  options.texts.emplace().registering.values["width"] = "600";

  Heard first;
  const MainJobResult result = RunMainJob(scene, out, options, first.Observer());
  ASSERT_EQ(result.registered.registrations.size(), 2u);
  EXPECT_EQ(result.registered.registrations[0].name, "s1");
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_THAT(result.selection_faults, IsEmpty());
  ASSERT_TRUE(result.covered_share.has_value());
  EXPECT_GT(*result.covered_share, 0.1);
  EXPECT_LT(*result.covered_share, 1);
  EXPECT_EQ(result.stills.width, 1200);
  EXPECT_EQ(result.stills.height, 800);
  EXPECT_THAT(
      first.begun,
      ElementsAre(kRegisterStage, kOverlayStage, kTextureStage, kStillsStage, kReportStage));
  EXPECT_THAT(first.kept, IsEmpty());
  EXPECT_THAT(first.lines, IsEmpty());
  EXPECT_EQ(first.steps[kOverlayStage], 2);
  EXPECT_EQ(first.steps[kStillsStage], 1);
  EXPECT_EQ(first.num_registered, 2u);
  EXPECT_EQ(first.covered_share, *result.covered_share);
  for (const char* file : {"views/s1.view",
                           "registration.json",
                           "cameras/cameras.txt",
                           "overlays/s2.jpg",
                           "faces/s1.png",
                           "model.glb",
                           "model.obj",
                           "coverage.json",
                           "renders/still_1.jpg",
                           "report.html",
                           "manifest.json"}) {
    EXPECT_TRUE(fs::is_regular_file(out / file)) << file;
  }

  // Once more: only the report, which tells of all the others, is made again.
  auto times = TimesOf(out);
  Heard second;
  const MainJobResult again = RunMainJob(scene, out, options, second.Observer());
  EXPECT_THAT(second.begun, ElementsAre(kReportStage));
  EXPECT_THAT(second.kept, ElementsAre(kRegisterStage, kOverlayStage, kTextureStage, kStillsStage));
  EXPECT_EQ(again.registered.registrations.size(), 2u);
  ASSERT_TRUE(again.covered_share.has_value());
  EXPECT_NEAR(*again.covered_share, *result.covered_share, 1e-3);
  EXPECT_EQ(again.stills.width, 1200);
  auto times_again = TimesOf(out);
  for (const char* always : {"report.html", "manifest.json"}) {
    times.erase(always);
    times_again.erase(always);
  }
  EXPECT_EQ(times_again, times);

  // A texture that cannot be: the tags stay, the report is there, the failure is listed.
  const std::string bare = std::to_string(FindBareFace(out / "coverage.json"));
  options.selection.only_faces = {bare};
  options.texts->texture.values["only-faces"] = bare;
  Heard third;
  const MainJobResult failed = RunMainJob(scene, out, options, third.Observer());
  ASSERT_EQ(failed.failures.size(), 1u);
  EXPECT_THAT(failed.failures[0], HasSubstr("texture: none of the 2 photographs shows"));
  EXPECT_EQ(third.lines, failed.failures);
  EXPECT_THAT(third.kept, ElementsAre(kRegisterStage, kOverlayStage));
  EXPECT_FALSE(failed.covered_share.has_value());
  EXPECT_EQ(failed.stills.width, 0);
  EXPECT_FALSE(fs::exists(out / "model.glb"));
  EXPECT_TRUE(fs::exists(out / "views/s1.view"));
  EXPECT_TRUE(fs::exists(out / "report.html"));
}

TEST(MainJob, WithoutTextsMakesEverythingAnew) {
  const TemporaryFolder work;
  const Scene scene = CopySmallScene(work / "scene");
  const fs::path out = work / "out";
  MainJobOptions options = QuickOptions();
  options.num_stills = 0;
  options.report = false;
  options.registering.independent = true;
  for (int run = 0; run < 2; ++run) {
    Heard heard;
    const MainJobResult result = RunMainJob(scene, out, options, heard.Observer());
    EXPECT_THAT(heard.begun, ElementsAre(kRegisterStage, kOverlayStage, kTextureStage)) << run;
    EXPECT_THAT(heard.kept, IsEmpty()) << run;
    EXPECT_THAT(result.failures, IsEmpty()) << run;
    EXPECT_FALSE(fs::exists(out / "report.html"));
    EXPECT_FALSE(fs::exists(out / "renders/still_1.jpg"));
  }
}

TEST(MainJob, TellsWhatIsWrongBeforeItTouchesAnything) {
  const TemporaryFolder work;
  const Scene scene = CopySmallScene(work / "scene");
  const fs::path out = work / "out";
  const auto message = [&](const MainJobOptions& options) {
    return ThrownMessage([&] { RunMainJob(scene, out, options); });
  };
  MainJobOptions options;
  options.num_stills = -1;
  EXPECT_THAT(message(options), HasSubstr("num_stills"));
  options = {};
  options.page_format = "bmp";
  EXPECT_THAT(message(options), HasSubstr("page_format must be jpg, png, tif or exr, not bmp"));
  options = {};
  options.baking.pages.bits = 16;
  EXPECT_THAT(message(options), HasSubstr("page_format must be png, tif or exr with 16 bits"));
  options = {};
  options.registering.max_width_px = 1;
  EXPECT_THAT(message(options), HasSubstr("max_width_px"));
  options = {};
  options.selection.exclude = {"s1", "s2"};
  EXPECT_THAT(message(options), HasSubstr("leaves no photograph for the texture"));
  options = {};
  options.selection.only_faces = {"no such face"};
  EXPECT_THAT(message(options), HasSubstr("no such face"));
  EXPECT_FALSE(fs::exists(out));

  work.Write("out/thesis.txt", "not ours");
  EXPECT_THAT(message({}), HasSubstr("holds files that are not ours"));
}

}  // namespace
}  // namespace groundglass
