// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/texel_truth.h"

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/image_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace groundglass {
namespace {

// A wall of 20 x 10 ft with a texel of a hundredth of that, red growing to the right.
TexturedModel MakeWall() {
  TexturedModel wall;
  wall.model.points_in_world = {{0, 0, 0}, {20, 0, 0}, {20, 0, 10}, {0, 0, 10}};
  wall.model.faces = {{{0, 1, 2, 3}, "wall"}};
  wall.faces = {{0, {{0, 100}, {200, 100}, {200, 0}, {0, 0}}}};
  wall.pages = {{Image8(200, 100, 3, 90), Image16(200, 100, 1, 1)}};
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) wall.pages[0].srgb8.At(x, y)[0] = static_cast<uint8_t>(20 + x);
  }
  return wall;
}

std::vector<TexelSample> TrueSamples() {
  std::vector<TexelSample> samples;
  for (double x = 1; x < 20; ++x) {
    // The texel at x feet has the code 20 + 10 x; its middle lies half a texel on.
    samples.push_back({0,
                       {x, 0, 5},
                       Rgb(LinearFromSrgb(static_cast<float>((19.5 + 10 * x) / 255)),
                           LinearFromSrgb(90 / 255.0f),
                           LinearFromSrgb(90 / 255.0f))});
  }
  return samples;
}

TEST(MeasureTexels, ExactTextureHasNoErrorAndGainIsFitted) {
  const TexelErrors exact = MeasureTexels(MakeWall(), TrueSamples());
  EXPECT_EQ(exact.num_samples, 19);
  EXPECT_EQ(exact.num_covered, 19);
  EXPECT_LT(exact.rms_levels, 0.1);
  TexturedModel dimmed = MakeWall();
  for (int i = 1; i < 200 * 100 * 3; i += 3) dimmed.pages[0].srgb8.values[i] = 45;
  const TexelErrors gained = MeasureTexels(dimmed, TrueSamples());
  EXPECT_LT(gained.rms_levels, 0.1);
  EXPECT_NEAR(gained.gain[1], 2, 0.01);
}

TEST(MeasureTexels, CountsALevelAsALevelAndLeavesOutWhatIsNotCovered) {
  TexturedModel wall = MakeWall();
  // Blue is off by 6 levels up and down by halves: the gain stays near 1, two of three channels
  // are right.
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) wall.pages[0].srgb8.At(x, y)[2] = x < 100 ? 84 : 96;
  }
  std::vector<TexelSample> samples = TrueSamples();
  std::erase_if(samples, [](const TexelSample& sample) { return sample.in_world.x() == 10; });
  EXPECT_NEAR(MeasureTexels(wall, samples).rms_levels, 6 / std::sqrt(3.0), 0.1);
  EXPECT_NEAR(MeasureTexels(wall, samples).faces.at(0).rms_levels, 6 / std::sqrt(3.0), 0.1);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      *wall.pages[0].provenance.At(x, y) = x < 50 ? kProvenanceNone : kProvenanceFilled;
    }
  }
  EXPECT_EQ(MeasureTexels(wall, samples).num_covered, 9);
}

TEST(ReadTexels, ReadsBackWhatWasWrittenAndNamesTheWrongLine) {
  std::string pattern = (std::filesystem::temp_directory_path() / "texels-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const std::filesystem::path file = folder / "texels.csv";
  WriteFileAtomically(file, FormatTexels({{4, {1.5, -2.25, 30}, Rgb(0.1f, 0.2f, 0.3f)}}));
  const std::vector<TexelSample> samples = ReadTexels(file);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].face, 4);
  EXPECT_EQ(samples[0].in_world, Eigen::Vector3d(1.5, -2.25, 30));
  EXPECT_NEAR(samples[0].color[2], 0.3, 1e-6);
  WriteFileAtomically(file, std::string("face,x,y,z,red,green,blue\n1,2,3\n"));
  EXPECT_THAT([&] { ReadTexels(file); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("texels.csv:2: expected face")));
  std::filesystem::remove_all(folder);
}

TEST(SampleTexels, AreTheWallsOwnColoursUnderAnOvercastSky) {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  builder.AddPolygon({{0, 0, 0}, {20, 0, 0}, {20, 0, 10}, {0, 0, 10}},
                     Material::kEven,
                     Rgb(0.5f, 0.4f, 0.3f),
                     "a");
  builder.AddPolygon({{20, 0, 0}, {40, 0, 0}, {40, 0, 10}, {20, 0, 10}},
                     Material::kWindowBand,
                     Rgb(0.5f, 0.4f, 0.3f),
                     "glass");
  world.num_model_faces = 2;
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, {20, 0, 5}, 100);
  const Daylight light = MakeOvercast(1);
  const std::vector<TexelSample> samples =
      SampleTexels(world, world.Model(), visibility, sky_map, light, 200, 3);
  int num_on_wall = 0;
  for (const TexelSample& sample : samples) {
    if (sample.face != 0) continue;
    ++num_on_wall;
    EXPECT_EQ(sample.in_world.y(), 0);
    // A wall that stands free sees half the sky.
    EXPECT_NEAR(sample.color[0], 0.5 * IndirectIrradiance(light, 0.5f)[0], 0.06);
    EXPECT_NEAR(sample.color[1] / sample.color[0], 0.8 * light.sky[1] / light.sky[0], 1e-3);
  }
  EXPECT_GT(num_on_wall, 80);
  EXPECT_LT(static_cast<int>(samples.size()) - num_on_wall, 60);  // mullions and blinds only
}

}  // namespace
}  // namespace groundglass
