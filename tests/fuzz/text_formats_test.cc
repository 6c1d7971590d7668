// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Damaged text files are read or refused with one clear line; nothing crashes, nothing hangs, and
// what was read is written and read again as the same.
#include "scene/error.h"
#include "scene/formats/lens.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/view_io.h"
#include "tests/fuzz/mutate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace groundglass {
namespace {

const std::string kBrick = std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick";

// The message with which `work` refused, or nothing; it must be one line that begins with `name`.
std::optional<std::string> RefusalOf(const std::string& name, const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(name)) << message;
    return message;
  }
}

void WriteText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

TEST(Fuzz, ViewFilesAreReadOrRefusedAndSurviveRewriting) {
  const std::vector<std::string> dictionary = {
      "x", "y", "z", "i", "j", "k", "a", "v", "roll", "shift_x", "k1", "k2", "sigma_v", "camera"};
  const std::string original = ReadTextFile(kBrick + "/views/s5.view");
  std::mt19937_64 random(5);
  int num_read = 0;
  for (int round = 0; round < FuzzRounds(); ++round) {
    const std::string text = Mutate(original, dictionary, random);
    SCOPED_TRACE(text);
    ViewTag tag;
    const auto refusal = RefusalOf("s5.view", [&] { tag = ParseView(text, "s5.view"); });
    const std::vector<std::string> faults = FindViewFaults(text, "s5.view");
    ASSERT_EQ(refusal.has_value(), !faults.empty());
    if (refusal) {
      ASSERT_EQ(*refusal, faults.front());
      continue;
    }
    ++num_read;
    ASSERT_EQ(ParseView(FormatView(tag), "again"), tag);
    ViewTag corrected = tag;
    corrected.position_in_site += Eigen::Vector3d(0.123456789, -1.0 / 3, 1e-9);
    corrected.roll_deg = -0.7;
    ASSERT_EQ(ParseView(FormatCorrectedView(text, corrected, {}), "corrected"), corrected);
  }
  // The damage leaves enough files whole that both outcomes are tried.
  EXPECT_GT(num_read, FuzzRounds() / 20);
  EXPECT_LT(num_read, FuzzRounds() * 19 / 20);
}

TEST(Fuzz, OsuModelsAreReadOrRefusedAndSurviveRewriting) {
  const std::vector<std::string> dictionary = {
      "1", "3", "70", "% face 3: name", "% unit: m", "% origin: 1 2 3", "% north: x", "1000000000"};
  // Few faces keep a round short.
  const std::string original =
      "% A box with a lid.\n% unit: ft\n8 6\n"
      "0 0 0\n10 0 0\n10 8 0\n0 8 0\n0 0 6\n10 0 6\n10 8 6\n0 8 6\n"
      "4 1 2 3 4 % floor\n4 8 7 6 5 % lid\n4 1 5 6 2 % north wall\n"
      "4 2 6 7 3 % east wall\n4 3 7 8 4 % south wall\n4 4 8 5 1\n";
  std::mt19937_64 random(6);
  int num_read = 0;
  for (int round = 0; round < FuzzRounds(); ++round) {
    const std::string text = Mutate(original, dictionary, random);
    SCOPED_TRACE(text);
    ModelReading reading;
    const auto refusal = RefusalOf("box.osu", [&] { reading = ParseOsu(text, "box.osu"); });
    const std::vector<std::string> faults = FindOsuFaults(text, "box.osu");
    ASSERT_EQ(refusal.has_value(), !faults.empty());
    if (refusal) continue;
    ++num_read;
    const ModelReading again = ParseOsu(FormatOsu(reading.model), "again");
    ASSERT_EQ(FormatOsu(again.model), FormatOsu(reading.model));
  }
  EXPECT_GT(num_read, FuzzRounds() / 20);
  EXPECT_LT(num_read, FuzzRounds() * 19 / 20);
}

TEST(Fuzz, LensFilesAreReadOrRefusedAndSurviveRewriting) {
  const std::vector<std::string> dictionary = {"v", "a", "k1", "sigma_k1", "camera", "shift_y"};
  Lens lens;
  lens.name = "nikon";
  lens.view_angle_deg = 58;
  lens.aspect = 1.5;
  lens.k1 = -0.02;
  const std::string original = FormatLens(lens);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "groundglass_fuzz.lens";
  std::mt19937_64 random(7);
  int num_read = 0;
  for (int round = 0; round < FuzzRounds() / 10; ++round) {
    const std::string text = Mutate(original, dictionary, random);
    SCOPED_TRACE(text);
    WriteText(file, text);
    Lens found;
    if (RefusalOf(file.string(), [&] { found = ReadLens(file); })) continue;
    ++num_read;
    WriteText(file, FormatLens(found));
    ASSERT_EQ(FormatLens(ReadLens(file)), FormatLens(found));
  }
  std::filesystem::remove(file);
  EXPECT_GT(num_read, FuzzRounds() / 200);
}

}  // namespace
}  // namespace groundglass
