// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What is said of options: out of range, contradicting one another, mistyped; and what --json and
// --dry-run print.
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
using testing::Not;
using testing::StartsWith;

// Wrong usage ends with status 2 and one line; returns it.
std::string UsageMessage(const std::vector<std::string>& words) {
  const ProgramRun run = RunProgram(words);
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.err, StartsWith("groundglass: "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  return run.err;
}

std::vector<std::string> With(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Options, OutOfTheLibrarysRangeTheyAreNamedAsTyped) {
  const std::vector<std::string> run = {"run", "scene", "-o", "out"};
  const std::vector<std::string> render = {"render", "m.osu", "-o", "o.mp4", "--path", "orbit"};
  const std::vector<std::string> board = {"calibrate", "board", "--print", "b.png"};
  const std::vector<std::string> trials = {
      "evaluate", "scene", "--truth", "truth", "--trials", "3"};
  const std::vector<std::string> synth = {"synth", "brick", "-o", "out"};
  for (const auto& [words, message] : {
           std::pair<std::vector<std::string>, std::string>(
               With(run, {"--texel-size", "-1"}), "run: --texel-size: must be at least 0, not -1"),
           {With(run, {"--texel-size", "nan"}), "run: --texel-size: must be at least 0"},
           {With(run, {"--max-texture", "7"}),
            "run: --max-texture: must be from 64 to 32768, not 7"},
           {With(run, {"--memory", "-5"}), "run: --memory: must be at least 0, not -5"},
           {With(run, {"--sigma-roll", "0"}), "run: --sigma-roll: a standard deviation must be"},
           {With(run, {"--sigma-v", "-1"}), "run: --sigma-v: a standard deviation must be"},
           {With(run, {"--lock", "zoom"}), "run: --lock: no parameter is called 'zoom'"},
           {With(run, {"--lock", "k1", "--free", "k1"}), "run: --lock and --free: 'k1' is in both"},
           {With(run, {"--accept", "s1", "--reject", "s1"}),
            "run: --accept and --reject: photograph 's1' is in both"},
           {With(run, {"--bits", "16"}), "run: --bits: a JPEG has 8 bits"},
           {With(run, {"--frame", "site", "--up", "y"}), "run: --frame: site has z up"},
           {{"invrender", "scene", "-o", "out", "--texel-size", "-1"},
            "invrender: --texel-size: must be at least 0"},
           {{"register", "scene", "-o", "out", "--sigma-k1", "0"}, "register: --sigma-k1: "},
           {With(render, {"--orbit-height", "100"}),
            "render: --orbit-height: must be from -89 to 89, not 100"},
           {With(board, {"--columns", "1"}), "board: --columns: must be from 2 to "},
           {With(board, {"--tag-size", "0"}), "board: --tag-size: must be above 0, not 0"},
           {With(board, {"--gap", "90"}), "board: --gap: must be between a tenth of"},
           {With(board, {"--first-id", "-1"}), "board: --first-id: must be at least 0, not -1"},
           {With(board, {"--rows", "500"}),
            "board: --columns and --rows and --first-id: 3000 tags from 0 on are more than"},
           {With(trials, {"--sigma-height", "0"}), "evaluate: --sigma-height: must be above 0"},
           {With(trials, {"--blunders", "-1"}), "evaluate: --blunders: must be at least 0"},
           {With(synth, {"--size", "5x5"}), "synth: --size: a synthetic picture must be 16 to"},
           {With(synth, {"--size", "wide"}), "synth: --size: expected WIDTHxHEIGHT"},
       }) {
    EXPECT_THAT(UsageMessage(words), HasSubstr(message));
  }
}

TEST(Options, OutOfRangeInAFileIsWrongInput) {
  const TemporaryFolder work;
  WriteAll(work / "r.json", R"({"width": 5})");
  const ProgramRun run = RunProgram(
      {"synth", "brick", "-o", (work / "out").string(), "--recipe", (work / "r.json").string()});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("must be 16 to 20000 px each way, not 5x"));
}

TEST(Options, RangesAreSaidInShortNumbers) {
  const std::vector<std::string> run = {"run", "scene", "-o", "out"};
  EXPECT_THAT(UsageMessage(With(run, {"--threads", "-1"})),
              HasSubstr("--threads: must be at least 0, not -1 "));
  EXPECT_THAT(UsageMessage(With(run, {"--sigma-model", "0"})),
              HasSubstr("--sigma-model: must be above 0, not 0 "));
  EXPECT_THAT(UsageMessage(With(run, {"--sigma-model", "nan"})),
              HasSubstr("--sigma-model: must be above 0, not nan "));
  EXPECT_THAT(UsageMessage(With(run, {"--sigma-model", "thin"})),
              HasSubstr("--sigma-model: must be a number, above 0, not 'thin' "));
  EXPECT_THAT(UsageMessage(With(run, {"--stills", "101"})),
              HasSubstr("--stills: must be from 0 to 100, not 101 "));
  EXPECT_THAT(UsageMessage({"convert", "a.osu", "b.obj", "--lookat-distance", "0"}),
              HasSubstr("--lookat-distance: must be above 0, not 0 "));
  EXPECT_THAT(UsageMessage({"synth", "brick", "-o", "out", "--views", "-2"}),
              HasSubstr("--views: must be at least 0, not -2 "));
}

TEST(Options, AreSuggestedWhereverTheyAreMistyped) {
  EXPECT_THAT(UsageMessage({"--vesion"}), HasSubstr("no option --vesion; did you mean --version?"));
  EXPECT_THAT(UsageMessage({"--hlp"}), HasSubstr("no option --hlp; did you mean --help?"));
  // Not that --out is missing, which comes of it.
  EXPECT_THAT(UsageMessage({"run", "scene", "--ouput", "out"}),
              HasSubstr("no option --ouput; did you mean --out?"));
  EXPECT_THAT(UsageMessage({"calibrate", "board", "--colums", "5"}),
              HasSubstr("no option --colums; did you mean --columns?"));
  EXPECT_THAT(UsageMessage({"calibrate", "--colums"}), HasSubstr("no option --colums"));
  for (const char* command :
       {"run", "check", "register", "invrender", "render", "synth", "evaluate", "convert"}) {
    EXPECT_THAT(UsageMessage({command, "--thread", "5"}), HasSubstr("did you mean --threads?"));
  }
}

TEST(Options, HelpIsAWordToo) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{}, {"run"}, {"calibrate"}, {"calibrate", "board"}}) {
    const ProgramRun help = RunProgram(With({"help"}, command));
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.out, RunProgram(With(command, {"--help"})).out);
  }
  EXPECT_THAT(UsageMessage({"help", "rn"}), HasSubstr("'rn'; did you mean run?"));
  EXPECT_THAT(UsageMessage({"hepl"}), HasSubstr("'hepl'; did you mean help?"));
}

TEST(Options, UsageErrorsAreObjectsForThoseWhoAskForJson) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"run"},
                                                {"check"},
                                                {"calibrate"},
                                                {"calibrate", "board"},
                                                {"register"},
                                                {"invrender"},
                                                {"render"},
                                                {"synth"},
                                                {"evaluate"},
                                                {"convert"},
                                                {"paint"},
                                                {"run", "scene", "-o", "out", "--memory", "-1"},
                                                {"run", "scene", "-o", "out", "--stills", "-1"},
                                                {"run", "scene", "-o", "out", "--nothing"}}) {
    const ProgramRun run = RunProgram(With(words, {"--json"}));
    EXPECT_EQ(run.status, 2);
    const json error = json::parse(run.out, nullptr, false);
    ASSERT_TRUE(error.is_object()) << run.out;
    EXPECT_EQ(error["exit"], 2);
    EXPECT_EQ("groundglass: " + error["error"].get<std::string>() + "\n", run.err);
  }
}

TEST(Options, ADryRunIsAnObjectForThoseWhoAskForJson) {
  const TemporaryFolder work;
  CopyBrick(work / "scene", {"s1"});
  const std::string scene = (work / "scene").string();
  const std::string model = (work / "scene" / "model.osu").string();
  const std::string out = (work / "out").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", scene, "-o", out},
        {"register", scene, "-o", out},
        {"invrender", scene, "-o", out},
        {"render", model, "--path", "orbit", "-o", out + ".mp4"},
        {"evaluate", scene, "--truth", scene, "--plot", out},
        {"convert", model, out + ".obj"},
        {"calibrate", "board", "--print", out + ".png"},
        {"calibrate", "board", "a.jpg", "b.jpg", "-o", out},
        {"synth", "brick", "-o", out},
        {"synth", "--list", "--pictures", out},
        {"check", scene, "-o", out}}) {
    const ProgramRun run = RunProgram(With(words, {"--dry-run", "--json", "--quiet"}));
    EXPECT_EQ(run.status, 0) << words.front() << run.err;
    EXPECT_TRUE(json::parse(run.out, nullptr, false).is_object()) << words.front() << run.out;
    const ProgramRun people = RunProgram(With(words, {"--dry-run", "--quiet"}));
    EXPECT_FALSE(people.out.empty());
  }
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(work.path())) {
    left.push_back(entry.path().filename().string());
  }
  EXPECT_EQ(left, std::vector<std::string>{"scene"}) << "a dry run wrote something";
  const json dry = json::parse(RunProgram({"run", scene, "-o", out, "--dry-run", "--json"}).out);
  EXPECT_EQ(dry["written"], false);
  EXPECT_EQ(dry["photographs"], 1);
  EXPECT_EQ(dry["out"], out);
}

TEST(Options, ListsAreObjectsForThoseWhoAskForJson) {
  const json list = json::parse(RunProgram({"synth", "--list", "--json"}).out);
  EXPECT_EQ(list["presets"][0]["name"], "wiesner");
  EXPECT_THAT(RunProgram({"synth", "--list"}).out, StartsWith("wiesner "));
  const TemporaryFolder work;
  const std::string board = (work / "board.png").string();
  EXPECT_EQ(
      json::parse(RunProgram({"calibrate", "board", "--print", board, "--json"}).out)["board"],
      board);
}

TEST(Options, WhatIsNoNumberOrNoneOfAListIsSaidPlainly) {
  for (const auto& [words, message] :
       {std::pair<std::vector<std::string>, std::string>(
            {"calibrate", "lines", "hall", "--aspect", "0"},
            "calibrate lines: --aspect: must be above 0, not 0"),
        {{"run", "hall", "-o", "out", "--texel-size", "abc"},
         "run: --texel-size: expected a number, not 'abc'"},
        {{"run", "hall", "-o", "out", "--seed", "-3"}, "run: --seed: must be at least 0, not -3"},
        {{"run", "hall", "-o", "out", "--seed", "1.5"},
         "run: --seed: expected a whole number, 0 or more, not '1.5'"},
        {{"render", "m.osu", "-o", "e.tif", "--elevation", "all", "--also", "bmp"},
         "render: --also: 'bmp' is none of tif, pdf, svg, dxf, layers"},
        {{"run", "hall", "-o", "out", "--seed"}, "run: --seed: its value is missing"}}) {
    EXPECT_THAT(UsageMessage(words), HasSubstr(message));
  }
}

}  // namespace
}  // namespace groundglass
