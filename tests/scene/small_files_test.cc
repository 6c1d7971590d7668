// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.

// The smaller formats: lens files, coverage.json, and how files are written at all.
#include "scene/coverage.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/lens.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <optional>

namespace groundglass {
namespace {

using testing::HasSubstr;

TEST(WriteFileAtomically, MakesFoldersAndReplacesTheFile) {
  const TemporaryFolder folder;
  const auto file = folder / "a/b/c.txt";
  WriteFileAtomically(file, std::string("one"));
  WriteFileAtomically(file, std::string("two\0three", 9));
  EXPECT_EQ(ReadTextFile(file), std::string("two\0three", 9));
}

TEST(WriteFileAtomically, LeavesTheOldFileAndNothingElseIfTheWriterFails) {
  const TemporaryFolder folder;
  const auto file = folder.Write("c.png", "old");
  EXPECT_EQ(ThrownMessage([&] {
              WriteFileAtomically(file, [&](const std::filesystem::path& temporary) {
                EXPECT_EQ(temporary.extension(), ".png");
                EXPECT_EQ(temporary.parent_path(), file.parent_path());
                std::ofstream(temporary) << "half";
                throw Error("the disk is full");
              });
            }),
            "the disk is full");
  EXPECT_EQ(ReadTextFile(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteFileAtomically, SaysWhereItCannotWrite) {
  const TemporaryFolder folder;
  folder.Write("file", "");
  EXPECT_THAT(ThrownMessage([&] { WriteFileAtomically(folder / "file/below.txt", std::string()); }),
              HasSubstr("cannot make this folder"));
}

TEST(LensFile, RoundTripsToTheLastBit) {
  const TemporaryFolder folder;
  Lens lens;
  lens.name = "nikon";
  lens.view_angle_deg = 54.1 / 3;
  lens.sigma_view_angle_deg = 0.01;
  lens.aspect = 1.5;
  lens.shift_y = -0.001 / 7;
  lens.k1 = -0.018;
  lens.sigma_k1 = 1e-4;
  lens.k2 = 3e-3;
  lens.p2 = -4e-4;
  const Lens again = ReadLens(folder.Write("f.lens", FormatLens(lens)));
  EXPECT_EQ(again.name, "nikon");
  EXPECT_EQ(again.view_angle_deg, lens.view_angle_deg);
  EXPECT_EQ(again.sigma_view_angle_deg, 0.01);
  EXPECT_EQ(again.shift_y, lens.shift_y);
  EXPECT_EQ(again.sigma_k1, 1e-4);
  EXPECT_EQ(again.k2, 3e-3);
  EXPECT_EQ(again.k3, 0);
  EXPECT_EQ(again.p2, -4e-4);
  EXPECT_EQ(FormatLens(again), FormatLens(lens));
}

TEST(LensFile, BadOnesGiveOneLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return ThrownMessage([&] { ReadLens(folder.Write("f.lens", text)); });
  };
  EXPECT_EQ(message("v 50 a 1.5"), "nothing was thrown");
  EXPECT_THAT(message("v 50 a 1.5\nf 3"), HasSubstr("f.lens:2: unknown key 'f'"));
  EXPECT_THAT(message("v 50\n"), HasSubstr("f.lens: key 'a' is missing"));
  EXPECT_THAT(message("v 50 a 1.5\nv 51"), HasSubstr("f.lens:2: key 'v' is repeated"));
  EXPECT_THAT(message("v 50 a 1.5 k1"), HasSubstr("f.lens:1: key 'k1' has no value"));
  EXPECT_THAT(message("v 50 a 1.5 k1 x"), HasSubstr("key 'k1': 'x' is not a number"));
  EXPECT_THAT(message("v 50 a 1.5 sigma_v -1"),
              HasSubstr("key 'sigma_v': a standard deviation must not be negative"));
  EXPECT_THAT(message("v 190 a 1.5"), HasSubstr("f.lens:1: key 'v': view angle must lie"));
  EXPECT_THAT(message("v 50\na 0"), HasSubstr("f.lens:2: key 'a': aspect"));
  EXPECT_THAT(message("v 50 a 1.5\nk1 5"),
              HasSubstr("f.lens:2: key 'k1': no lens has a distortion of 5"));
}

TEST(FormatCoverage, CountsFacesFromOneAsPeopleDo) {
  Coverage coverage;
  FaceCoverage face;
  face.face = 0;
  face.name = "east wall";
  face.area = 200;
  face.covered_area = 50;
  face.num_texels = 1000;
  face.num_covered_texels = 250;
  face.texel_size = 0.05;
  face.sources = {{"s5", 250, 0.04}};
  coverage.faces.push_back(face);
  const nlohmann::json json = nlohmann::json::parse(FormatCoverage(coverage));
  EXPECT_EQ(json["covered_share"], 0.25);
  EXPECT_EQ(json["faces"][0]["face"], 1);
  EXPECT_EQ(json["faces"][0]["name"], "east wall");
  EXPECT_EQ(json["faces"][0]["sources"][0]["photograph"], "s5");
  EXPECT_EQ(json["faces"][0]["sources"][0]["texels"], 250);
}

TEST(ReadCoverage, GivesBackWhatFormatCoverageWrote) {
  const TemporaryFolder folder;
  FaceCoverage face;
  face.number = 12;
  face.name = "south wall";
  face.area = 0.1 + 0.2;
  face.covered_area = 0.07;
  face.num_texels = 40;
  face.num_covered_texels = 9;
  face.texel_size = 0.125;
  face.sources = {{"s5", 7, 0.3}, {"s2", 2, 0.4}};
  face.missing.emplace().centre_in_world = {1, 2, 3};
  face.missing->stand_in_world = Eigen::Vector3d(4, -5, 6);
  Coverage coverage;
  coverage.faces = {face, FaceCoverage()};
  coverage.faces[1].number = 13;
  const std::string text = FormatCoverage(coverage);
  const std::optional<Coverage> read = ReadCoverage(folder.Write("coverage.json", text));
  ASSERT_TRUE(read);
  EXPECT_EQ(FormatCoverage(*read), text);
  EXPECT_TRUE(read->faces[0].missing->stand_in_world == face.missing->stand_in_world);
  EXPECT_EQ(read->CoveredShare(), 0.07 / (0.1 + 0.2));
}

TEST(ReadCoverage, WhatIsNotOursGivesNothing) {
  const TemporaryFolder folder;
  EXPECT_FALSE(ReadCoverage(folder / "missing.json"));
  EXPECT_FALSE(ReadCoverage(folder.Write("a.json", "not json")));
  EXPECT_FALSE(ReadCoverage(folder.Write("b.json", "[1, 2]")));
  EXPECT_FALSE(ReadCoverage(folder.Write("c.json", "{\"faces\": [{\"face\": \"one\"}]}")));
}

}  // namespace
}  // namespace groundglass
