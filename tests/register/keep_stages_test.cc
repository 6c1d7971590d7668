// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/keep_stages.h"

#include "register/register.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace groundglass {
namespace {

// The lines of a CSV file, word by word; the first has the columns' names.
std::vector<std::vector<std::string>> ReadCsv(const std::filesystem::path& file) {
  std::istringstream text(ReadTextFile(file));
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string>& words = lines.emplace_back();
    std::istringstream rest(line);
    for (std::string word; std::getline(rest, word, ',');) words.push_back(word);
  }
  return lines;
}

PhotographInput HousePhotograph(const PolygonModel& model) {
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  const Image8 grey8 = PhotographModel(model, CameraFromTag(tag, 600, 400), 2, 1);
  tag.shift_x = 0.01;
  return {"s1", grey8, {}, tag, {}};
}

TEST(KeepStages, WritesWhatTheStagesHandOnAndChangesNothing) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const PhotographInput photograph = HousePhotograph(model);
  const TemporaryFolder folder;
  RegisterOptions options;
  options.keep_folder = folder / "kept";
  const PhotographAlignment kept = AlignPhotograph(photograph, edge_model, options);
  EXPECT_EQ(kept.keep_fault, "");
  EXPECT_EQ(FormatRegistrations({kept.registration}),
            FormatRegistrations({AlignPhotograph(photograph, edge_model, {}).registration}));

  const std::filesystem::path own = folder / "kept" / "s1";
  for (const char* name : {"samples_tag.csv", "samples_found.csv"}) {
    const auto samples = ReadCsv(own / name);
    ASSERT_GT(samples.size(), 100u) << name;
    for (const auto& sample : samples) EXPECT_EQ(sample.size(), samples[0].size()) << name;
  }
  // The best solution, in the axes of the notebook, is what the registration says.
  const auto solutions = ReadCsv(own / "solutions.csv");
  ASSERT_GT(solutions.size(), 2u);
  EXPECT_EQ(solutions[1].size(), solutions[0].size());
  EXPECT_EQ(solutions[1][0], "converged");
  EXPECT_EQ(std::stod(solutions[1][2]), kept.registration.score_nats);
  EXPECT_EQ(solutions[0][9], "x");
  EXPECT_NEAR(std::stod(solutions[1][9]), kept.registration.corrected.position_in_site.x(), 1e-9);
  EXPECT_EQ(solutions[0][10], "y");
  EXPECT_NEAR(std::stod(solutions[1][10]), kept.registration.corrected.position_in_site.y(), 1e-9);
  // A candidate that is taken lies where the sample's edge is seen.
  const auto matches = ReadCsv(own / "matches.csv");
  int taken = 0;
  for (size_t i = 1; i < matches.size(); ++i) {
    ASSERT_EQ(matches[i].size(), 11u);
    if (matches[i][10] != "1") continue;
    ++taken;
    EXPECT_LT(std::abs(std::stod(matches[i][6])), 2.0);
  }
  EXPECT_GE(taken, 0.8 * kept.registration.num_samples);
  const Image8 picture = ReadSrgb8(own / "stages.png");
  EXPECT_EQ(picture.width, 600);
  EXPECT_EQ(picture.height, 400);
}

TEST(KeepStages, WhereItCannotWriteThePhotographIsAlignedAllTheSame) {
  const PolygonModel model = MakeHouse();
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "no folder";
  RegisterOptions options;
  options.keep_folder = folder / "file";
  const PhotographAlignment kept =
      AlignPhotograph(HousePhotograph(model), EdgeModel(model), options);
  EXPECT_NE(kept.keep_fault, "");
  EXPECT_EQ(kept.registration.verdict, Verdict::kAccepted);
}

}  // namespace
}  // namespace groundglass
