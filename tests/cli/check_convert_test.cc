// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

const std::string kBrick = std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick";

void ReplaceIn(const fs::path& file, const std::string& old_text, const std::string& new_text) {
  std::string text = ReadAll(file);
  const size_t at = text.find(old_text);
  ASSERT_NE(at, std::string::npos) << file << " has no " << old_text;
  WriteAll(file, text.replace(at, old_text.size(), new_text));
}

TEST(Check, ASoundSceneHasNoFaults) {
  const ProgramRun run = RunProgram({"check", kBrick, "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_TRUE(result["faults"].empty());
  EXPECT_EQ(result["photographs"].size(), 12u);
  EXPECT_EQ(result["faces"], 70);
}

TEST(Check, ListsEveryFaultInOneGo) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2", "s3", "s4", "s5"});
  WriteAll(scene / "views" / "s1.view", "x 1\ny 2\nz 3\ni 4\nj 5\nk 6\na 1.5\nv 200\n");
  WriteAll(scene / "views" / "s2.view", "x 1\ny 2\nx 3\ni 4\nj 5\nk 6\na 1.5\nv 58\n");
  WriteAll(scene / "images" / "s3.jpg", "no picture");
  fs::remove(scene / "images" / "s4.jpg");
  ReplaceIn(scene / "model.osu", "\n4 ", "\n4 9999 ");
  const std::string before = Fingerprint(scene);

  const ProgramRun run = RunProgram({"check", scene.string(), "--json"});
  EXPECT_EQ(run.status, 1);
  const json result = json::parse(run.out);
  const auto faults = result["faults"].get<std::vector<std::string>>();
  EXPECT_THAT(faults, Contains(testing::AllOf(HasSubstr("s1.view:8"), HasSubstr("'v'"))));
  EXPECT_THAT(faults, Contains(testing::AllOf(HasSubstr("s2.view:3"), HasSubstr("'x'"))));
  EXPECT_THAT(faults, Contains(HasSubstr("s3.jpg")));
  EXPECT_THAT(faults, Contains(HasSubstr("model.osu:")));
  for (const std::string& fault : faults) EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
  // A tag without a photograph is told, as a fault or as a warning.
  EXPECT_THAT(run.out, HasSubstr("s4"));

  const ProgramRun for_people = RunProgram({"check", scene.string()});
  EXPECT_EQ(for_people.status, 1);
  for (const char* name : {"s1.view:8", "s2.view:3", "s3.jpg", "model.osu:", "s4"}) {
    EXPECT_THAT(for_people.out, HasSubstr(name));
  }
  EXPECT_EQ(Fingerprint(scene), before);
}

TEST(Check, DrawsTheMeasuredTags) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const ProgramRun run = RunProgram(
      {"check", (work / "scene").string(), "-o", (work / "overlays").string(), "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_GT(fs::file_size(work / "overlays" / "s1.jpg"), 10000u);
}

TEST(Convert, TellsWhatWasMendedInAModel) {
  const TemporaryFolder work;
  const std::string models = std::string(GROUNDGLASS_SOURCE_DIR) + "/tests/data/models";
  const ProgramRun run =
      RunProgram({"convert", models + "/doubled_faces.osu", (work / "m.glb").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("108 points, 70 faces"));
  EXPECT_THAT(run.err, HasSubstr("warning: "));
  EXPECT_THAT(run.err, HasSubstr("70 faces lie twice"));
  EXPECT_THAT(run.out, HasSubstr("; 70 faces left out: 71-140; 1 warning, see above"));
}

TEST(Convert, TellsAFaceThatIsLeftOutAndCountsIt) {
  const TemporaryFolder work;
  WriteAll(work / "box.obj",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 99\n");
  const ProgramRun run =
      RunProgram({"convert", (work / "box.obj").string(), (work / "box.osu").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("box.obj:9: face 4 is left out: point 99 is outside 1 to 5"));
  EXPECT_THAT(run.out, HasSubstr("3 faces, 0 texture pages"));
  EXPECT_THAT(run.out, HasSubstr("; 1 face left out: 4; 2 warnings, see above"));
  const ProgramRun as_json =
      RunProgram({"convert", (work / "box.obj").string(), (work / "box.osu").string(), "--json"});
  EXPECT_EQ(json::parse(as_json.out)["faces_left_out"], json({4}));
}

TEST(Convert, OfAFolderNamesTheModelInIt) {
  const TemporaryFolder work;
  fs::create_directories(work / "out");
  WriteAll(work / "out/model.glb", "");
  for (const char* output : {"hall.city.json", "hall.osu", "hall.glb"}) {
    const ProgramRun run =
        RunProgram({"convert", (work / "out").string(), (work / output).string()});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("give " + (work / "out/model.glb").string())) << output;
  }
  EXPECT_FALSE(fs::exists(work / "hall.osu"));
}

// A model without a unit, and one that was saved in single precision far from its origin.
TEST(Told, AnAssumedUnitAndCoordinatesOfFloats) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const std::string model = (work / "scene/model.osu").string();
  const std::string assumed = model + ": the unit, ft, is ASSUMED: neither the file nor --unit";
  const std::string view = (work / "scene/views/s1.view").string();
  const std::string views = (work / "scene/views").string();
  const std::string scene = (work / "scene").string();
  const std::string out = (work / "out").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"invrender", scene, "-o", out, "--dry-run"},
        {"invrender", scene, "-o", out, "--dry-run", "--views", views},
        {"convert", model, (work / "hall.obj").string()},
        {"render", model, "--view", view, "--dry-run", "-o", (work / "s1.png").string()}}) {
    const ProgramRun run = RunProgram(words);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("groundglass: warning: " + assumed)) << words[0];
    std::vector<std::string> with_unit = words;
    with_unit.insert(with_unit.end(), {"--unit", "ft"});
    EXPECT_THAT(RunProgram(with_unit).err, testing::Not(HasSubstr("ASSUMED"))) << words[0];
  }
  // A wall of 10 m, 5,820 km north, in steps of half a metre.
  WriteAll(work / "floats.obj",
           "# unit: m\nv 0 5820077 0\nv 10 5820077.5 0\nv 10 5820078.5 6\nv 0 5820079 6\n"
           "f 1 2 3\nf 1 3 4\n");
  for (const char* command : {"invrender", "register"}) {
    const ProgramRun run = RunProgram({command,
                                       scene,
                                       "-o",
                                       out,
                                       "--dry-run",
                                       "--views",
                                       views,
                                       "--model",
                                       (work / "floats.obj").string()});
    EXPECT_THAT(run.err, HasSubstr("lie on a raster of 0.5 m")) << command;
  }
}

TEST(Render, AModelWithoutItsPictureIsGreyAndSaysSo) {
  const TemporaryFolder work;
  const fs::path source = fs::path(GROUNDGLASS_SOURCE_DIR) / "tests/data/models/mtl with blanks";
  fs::copy_file(source / "mtl with blanks.obj", work / "wall.obj");
  fs::copy_file(source / "my building.mtl", work / "my building.mtl");
  WriteAll(work / "s1.view", "x 5\ny 12\nz 2\ni 5\nj 0\nk 2\na 1.5\nv 60\n");
  const ProgramRun run = RunProgram({"render",
                                     (work / "wall.obj").string(),
                                     "--view",
                                     (work / "s1.view").string(),
                                     "--width",
                                     "90",
                                     "-o",
                                     (work / "wall.png").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the picture 'photo of wall.jpg' is not there"));
  EXPECT_TRUE(fs::exists(work / "wall.png"));
}

TEST(Render, AViewThatShowsNothingOfTheModelIsTold) {
  const TemporaryFolder work;
  const auto render = [&](const std::string& view) {
    WriteAll(work / "n.view", view + " a 1.5 v 50\n");
    return RunProgram({"render",
                       kBrick + "/model.osu",
                       "--view",
                       (work / "n.view").string(),
                       "--width",
                       "90",
                       "-o",
                       (work / "n.png").string()});
  };
  const ProgramRun away = render("x 20 y 200 z 5 i 20 j 400 k 5");
  EXPECT_EQ(away.status, 0) << away.err;
  EXPECT_THAT(away.err, HasSubstr("n.view: shows nothing of the model"));
  EXPECT_THAT(render("x 20 y 1e8 z 5 i 20 j 0 k 5").err, HasSubstr("shows nothing of the model"));
  EXPECT_THAT(render("x 20 y 200 z 5 i 20 j 0 k 5").err, testing::Not(HasSubstr("shows nothing")));
}

TEST(Check, SaysHowTheModelWasReadAndWhereTheCamerasStand) {
  const ProgramRun run = RunProgram({"check", kBrick});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("108 points, 70 faces; "));
  EXPECT_THAT(run.out, HasSubstr("unit        ft, ASSUMED: neither the file nor --unit says it"));
  EXPECT_THAT(run.out, HasSubstr("tolerance   edges may lie "));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ns5 +137\\.3 +21\\.8 +4\\.9 +E .* face 35"));
  EXPECT_THAT(run.out, testing::EndsWith("0 faults, 0 warnings\n"));
  EXPECT_THAT(RunProgram({"check", kBrick, "--unit", "ft", "--sigma-model", "0.5"}).out,
              testing::AllOf(HasSubstr("ft, as --unit says"),
                             HasSubstr("edges may lie 0.5 ft (0.152 m) off, as --sigma-model")));
  const json result = json::parse(RunProgram({"check", kBrick, "--json"}).out);
  EXPECT_EQ(result["model"]["unit_is_assumed"], true);
  EXPECT_EQ(result["photographs"][4]["stands"], "E");
  EXPECT_TRUE(result["oddities"].empty());
}

TEST(Check, DrawsWhatCanBeDrawnInSpiteOfFaults) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1", "s2", "s3"});
  WriteAll(work / "scene" / "images" / "s2.jpg", "no picture");
  WriteAll(work / "scene" / "views" / "s3.view", "x 1");
  const ProgramRun run = RunProgram(
      {"check", (work / "scene").string(), "-o", (work / "overlays").string(), "--quiet"});
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(fs::exists(work / "overlays" / "s1.jpg"));
  EXPECT_FALSE(fs::exists(work / "overlays" / "s2.jpg"));
  EXPECT_THAT(run.out, HasSubstr("1 overlays in "));
}

TEST(Check, WritesTemplatesAndKnowsThatTheyAreNotFilledIn) {
  const TemporaryFolder work;
  const fs::path scene = work / "scene";
  CopyBrick(scene, {"s1", "s2"});
  fs::remove_all(scene / "views");
  const ProgramRun untagged = RunProgram({"check", scene.string()});
  EXPECT_EQ(untagged.status, 1);
  for (const char* part : {"no tags",
                           "(x y z)",
                           "--template",
                           "docs/tutorial.md",
                           "run, register or invrender with --views"}) {
    EXPECT_THAT(untagged.out, HasSubstr(part));
  }
  const ProgramRun templates = RunProgram({"check", scene.string(), "--template"});
  EXPECT_EQ(templates.status, 0) << templates.err;
  EXPECT_THAT(templates.out, HasSubstr("s1.view"));
  const std::string text = ReadAll(scene / "views" / "s1.view");
  EXPECT_THAT(text, testing::AllOf(HasSubstr("\nx ?"), HasSubstr("\na 1.5 "), HasSubstr("\nv ?")));
  const ProgramRun again = RunProgram({"check", scene.string()});
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.out, HasSubstr("this template is not filled in yet"));
  // What is there is left alone; a lens that is told fills in its angle.
  WriteAll(scene / "views" / "s1.view", "x 1 % mine");
  fs::remove(scene / "views" / "s2.view");
  EXPECT_EQ(RunProgram({"check", scene.string(), "--template", "--focal-length", "35"}).status, 0);
  EXPECT_EQ(ReadAll(scene / "views" / "s1.view"), "x 1 % mine");
  EXPECT_THAT(ReadAll(scene / "views" / "s2.view"), HasSubstr("\nv 54.43 "));
}

TEST(Convert, ChangesTheUnitOfLengths) {
  const TemporaryFolder work;
  WriteAll(work / "mm.osu", "% unit: mm\n3 1\n0 0 0\n1500 0 0\n0 0 2500\n3 1 2 3\n");
  const std::string out = (work / "m.osu").string();
  ASSERT_EQ(RunProgram({"convert", (work / "mm.osu").string(), out, "--to-unit", "m"}).status, 0);
  EXPECT_THAT(ReadAll(out), testing::AllOf(HasSubstr("unit: m\n"), HasSubstr("\n1.5 0 0\n")));
}

TEST(Convert, AModelSurvivesTheWayThroughObj) {
  const TemporaryFolder work;
  const std::string obj = (work / "a.obj").string();
  const std::string osu = (work / "a.osu").string();
  const std::string again = (work / "b.osu").string();
  ASSERT_EQ(RunProgram({"convert", kBrick + "/model.osu", osu}).status, 0);
  ASSERT_EQ(RunProgram({"convert", osu, obj}).status, 0);
  ASSERT_EQ(RunProgram({"convert", obj, again}).status, 0);
  const json first = json::parse(RunProgram({"check", kBrick, "--json"}).out);
  const json last = json::parse(RunProgram({"check", kBrick, "--model", again, "--json"}).out);
  EXPECT_EQ(first["points"], last["points"]);
  EXPECT_EQ(first["faces"], last["faces"]);
}

// What a command prints, and its exit status.
std::pair<int, std::string> RunOther(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  for (size_t size; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    output.append(buffer.data(), size);
  }
  return {pclose(pipe), output};
}

TEST(Convert, ColmapReadsOurCamerasAndWeReadThemBack) {
  const TemporaryFolder work;
  const std::string colmap_folder = (work / "colmap").string();
  const std::string views_folder = (work / "views").string();
  const ProgramRun there = RunProgram({"convert", kBrick + "/views", colmap_folder});
  ASSERT_EQ(there.status, 0) << there.err;
  const ProgramRun back = RunProgram({"convert", colmap_folder, views_folder});
  ASSERT_EQ(back.status, 0) << back.err;
  EXPECT_TRUE(fs::is_regular_file(fs::path(views_folder) / "s12.view"));
  // The way there and back moves no camera: the errors of both against the truth are one.
  const auto errors_of = [](const std::string& folder) {
    const ProgramRun run = RunProgram({"evaluate", folder, "--truth", kBrick + "/truth", "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
  };
  const json there_errors = errors_of(colmap_folder)["photographs"];
  const json back_errors = errors_of(views_folder)["photographs"];
  ASSERT_EQ(there_errors.size(), 12u);
  ASSERT_EQ(back_errors.size(), 12u);
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(there_errors[i]["vertex_error_px"], back_errors[i]["vertex_error_px"], 1e-6);
  }

  if (RunOther("command -v colmap").first != 0) GTEST_SKIP() << "COLMAP is not installed";
  const auto [status, report] =
      RunOther("QT_QPA_PLATFORM=offscreen colmap model_analyzer --path '" + colmap_folder + "'");
  EXPECT_EQ(status, 0) << report;
  EXPECT_THAT(report, HasSubstr("Registered images: 12"));
}

}  // namespace
}  // namespace groundglass
