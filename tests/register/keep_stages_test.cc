// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/keep_stages.h"

#include "register/refine_set.h"
#include "register/register.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "tests/register/house.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

PhotographInput HousePhotographFrom(const PolygonModel& model,
                                    const std::string& name,
                                    const Eigen::Vector3d& position_in_site) {
  ViewTag tag;
  tag.position_in_site = position_in_site;
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  const Image8 grey8 = PhotographModel(model, CameraFromTag(tag, 600, 400), 2, 1);
  tag.shift_x = 0.01;
  return {name, grey8, {}, tag, {}};
}

PhotographInput HousePhotograph(const PolygonModel& model) {
  return HousePhotographFrom(model, "s1", {62, 48, 5});
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

TEST(KeepStages, WhatIsRefinedTogetherIsWrittenAndTheSame) {
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const std::vector<PhotographAlignment> alone = {
      AlignPhotograph(HousePhotograph(model), edge_model, {}),
      AlignPhotograph(HousePhotographFrom(model, "s2", {8, 62, 5}), edge_model, {})};
  const TemporaryFolder folder;
  RegisterOptions options;
  options.keep_folder = folder / "kept";
  std::vector<PhotographAlignment> kept = alone;
  std::vector<PhotographAlignment> plain = alone;
  RefineSet(edge_model, options, kept);
  RefineSet(edge_model, {}, plain);
  const auto json = nlohmann::json::parse(ReadTextFile(folder / "kept" / "joint.json"));
  for (size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(kept[i].keep_fault, "");
    const Registration& registration = kept[i].registration;
    EXPECT_EQ(FormatRegistrations({registration}), FormatRegistrations({plain[i].registration}));
    // It starts at the photograph's own camera and ends at the one that is written.
    const auto& given = json.at("given").at("photographs").at(i);
    const auto& found = json.at("found").at("photographs").at(i);
    EXPECT_EQ(given.at("name"), registration.name);
    EXPECT_EQ(given.at("tag").at("shift_x"), 0.01);
    EXPECT_EQ(found.at("matched"), registration.num_samples);
    EXPECT_NEAR(found.at("camera").at("y"), registration.corrected.position_in_site.y(), 1e-9);
    EXPECT_NEAR(found.at("sigmas").at("y"), registration.sigmas.y(), 1e-12);
    const auto samples = ReadCsv(folder / "kept" / registration.name / "joint_samples.csv");
    ASSERT_GT(samples.size(), given.at("samples").get<size_t>());
    EXPECT_EQ(samples.back().size(), samples[0].size());
  }
  EXPECT_FALSE(json.at("found").at("edges").empty());
}

}  // namespace
}  // namespace groundglass
