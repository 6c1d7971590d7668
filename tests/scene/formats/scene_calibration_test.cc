// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// A scene's folder calibration/: what is known of cameras besides the tags.
#include "scene/formats/known_keys.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "tests/scene/sample_scene_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(KnownKeysTest, ANumberOfTheTagsOwnWins) {
  const KnownKeys known = {{"x", "1", ""},
                           {"y", "2", ""},
                           {"z", "3", ""},
                           {"v", "50", ""},
                           {"sigma_v", "1", ""},
                           {"roll", "2", ""},
                           {"k1", "0.1", ""},
                           {"sigma_k1", "0.01", ""}};
  // The position comes whole or not at all, and a standard deviation goes with its number.
  const KnownKeys taken = KeysLacking("x 5\ny 6\nz 7\nv 40\n", known);
  EXPECT_EQ(NamesOf(taken), "roll k1");
  EXPECT_EQ(taken.size(), 3u);
}

TEST(KnownKeysTest, SourcesAreKeptApart) {
  const KnownKeys lens = MergeKnownKeys({}, {{"v", "50", ""}, {"sigma_v", "1", ""}}, "lens");
  const KnownKeys lines = {{"v", "51", "90 lines"}, {"sigma_v", "0.5", ""}, {"roll", "1", ""}};
  const KnownKeys both = MergeKnownKeys(lens, lines, "lines");
  EXPECT_EQ(FormatKnownKeys(both, ""),
            "v 51   % lines: 90 lines\nsigma_v 0.5   % lines\nroll 1   % lines\n");
  // What a source says no more is gone.
  EXPECT_EQ(NamesOf(MergeKnownKeys(both, {}, "lines")), "");
  EXPECT_EQ(MergeKnownKeys(both, {{"v", "50", ""}, {"sigma_v", "2", ""}}, "lens"), both);
}

constexpr const char* kTagWithoutLens = "x 5 y 20 z 2\ni 5 j 0 k 2\n";

TEST(SceneCalibration, WithoutMetadataAMissingViewAngleStaysAFault) {
  SceneFolder folder;
  folder.Write("views/s2.view", "a 1.5\n" + std::string(kTagWithoutLens));
  const SceneCheck check = CheckScene(folder.path());
  EXPECT_THAT(check.faults,
              ElementsAre((folder.path() / "views/s2.view").string() +
                          ": key 'v' is missing, and the picture's metadata say no focal length"));
}

TEST(SceneCalibration, ItsFolderGivesWhatTagsLack) {
  SceneFolder folder;
  folder.Write("views/s2.view", "camera nikon\n" + std::string(kTagWithoutLens));
  folder.Write("calibration/s2.view", "v 44 sigma_v 1\nroll 1.5 sigma_roll 0.1\n");
  folder.Write("calibration/nikon.lens", "camera nikon\nv 41\na 1.49\n");
  // Where no tag is, a whole one of calibration/ serves.
  std::filesystem::remove(folder.path() / "views/s10.view");
  folder.Write("calibration/s10.view", kTag);
  const Scene scene = ReadScene(folder.path());
  ASSERT_EQ(scene.photographs.size(), 2u);
  // A lens that was measured goes before what was found of one photograph.
  EXPECT_EQ(scene.photographs[0].tag.view_angle_deg, 41);
  ASSERT_TRUE(scene.photographs[0].lens);
  EXPECT_EQ(scene.photographs[0].tag.roll_deg, 1.5);
  EXPECT_EQ(scene.photographs[0].tag.sigmas.roll_deg, 0.1);
  EXPECT_EQ(scene.photographs[1].name, "s10");
  EXPECT_EQ(scene.photographs[1].tag, ParseView(kTag, "s10"));
  EXPECT_EQ(scene.notes.size(), 2u);
}

// Each picture's lines told the k1 of the lens that took them all.
TEST(SceneCalibration, PhotographsOfOneLensShareWhatWasMeasuredOfIt) {
  const SceneFolder folder;
  const std::string tag = ReadTextFile(folder / "views/s2.view");
  for (const char* name : {"s10", "s11", "s12"}) {
    std::filesystem::copy(folder / "images/s2.jpg",
                          folder / ("images/" + std::string(name) + ".jpg"),
                          std::filesystem::copy_options::overwrite_existing);
    folder.Write("views/" + std::string(name) + ".view", tag);
  }
  folder.Write("views/s12.view", tag + "\nk1 -0.2 sigma_k1 0.01\n");
  folder.Write("calibration/s2.view", "k1 0.03 sigma_k1 0.01\n");
  folder.Write("calibration/s10.view", "k1 0.01 sigma_k1 0.01\n");
  folder.Write("calibration/s12.view", "k1 0.01 sigma_k1 0.01\n");
  const Scene scene = ReadScene(folder.path());
  const auto tag_of = [&](const std::string& name) {
    return std::find_if(scene.photographs.begin(),
                        scene.photographs.end(),
                        [&](const Photograph& photograph) { return photograph.name == name; })
        ->tag;
  };
  for (const char* name : {"s2", "s10", "s11"}) {
    EXPECT_NEAR(tag_of(name).k1, 0.02, 1e-12) << name;
    // They differ by twice what 0.0071 would allow: chi squared of 2 with one degree of freedom.
    EXPECT_NEAR(*tag_of(name).sigmas.k1, 0.01, 1e-12) << name;
  }
  EXPECT_EQ(tag_of("s12").k1, -0.2) << "what the tag says itself wins";
}

TEST(SceneCalibration, AViewThatLacksKeysIsCorrectedWithThem) {
  ViewTag corrected = ParseView(kTag, "s2");
  corrected.view_angle_deg = 41;
  const std::string text = FormatCorrectedView(kTagWithoutLens, corrected, {});
  EXPECT_EQ(ParseView(text, "s2"), corrected);
  EXPECT_THAT(text, HasSubstr("v 41 % (not measured)"));
}

}  // namespace
}  // namespace groundglass
