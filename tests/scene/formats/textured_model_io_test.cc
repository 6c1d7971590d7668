// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/textured_model_io.h"

#include "scene/formats/model_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace groundglass {
namespace {

using testing::HasSubstr;

// A pentagon wall on page 1, a triangle on page 0 and a square without a photograph.
TexturedModel SampleModel() {
  TexturedModel textured;
  PolygonModel& model = textured.model;
  model.points_in_world = {
      {0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {5, 0, 1.0 / 3}, {0, 0, 4}, {10, 10, 0}, {0, 10, 0}};
  model.faces.push_back({{0, 1, 2, 3, 4}, "south wall"});
  model.faces.push_back({{0, 6, 5, 1}, ""});
  model.faces.push_back({{1, 5, 2}, "east wall"});
  model.georeference = Georeference{40, -83, 230, 12};
  textured.faces.resize(3);
  textured.faces[0] = {1, {{0.5, 19.5}, {31.5, 19.5}, {31.5, 2}, {16, 18}, {0.5, 2}}};
  textured.faces[2] = {0, {{1, 7}, {14.25, 7}, {1, 1}}};
  for (const auto& [width, height] : {std::pair(16, 8), std::pair(32, 20)}) {
    Image8 picture(width, height, 3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        picture.At(x, y)[0] = static_cast<uint8_t>(20 + 5 * x);
        picture.At(x, y)[1] = static_cast<uint8_t>(20 + 9 * y);
        picture.At(x, y)[2] = static_cast<uint8_t>(width);
      }
    }
    textured.pages.push_back({picture, {}});
  }
  return textured;
}

void ExpectSame(const TexturedModel& a, const TexturedModel& b, double length, double texel) {
  ASSERT_EQ(a.model.faces.size(), b.model.faces.size());
  EXPECT_EQ(a.model.unit, b.model.unit);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (size_t i = 0; i < a.faces.size(); ++i) {
    const Face& face = a.model.faces[i];
    ASSERT_EQ(face.points.size(), b.model.faces[i].points.size());
    EXPECT_EQ(face.name, b.model.faces[i].name);
    ASSERT_EQ(a.faces[i].page < 0, b.faces[i].page < 0);
    for (size_t k = 0; k < face.points.size(); ++k) {
      EXPECT_LE((a.model.points_in_world[face.points[k]] -
                 b.model.points_in_world[b.model.faces[i].points[k]])
                    .norm(),
                length);
      if (a.faces[i].page < 0) continue;
      EXPECT_LE((a.faces[i].corners_texel[k] - b.faces[i].corners_texel[k]).norm(), texel);
      // Pages may be numbered anew; their sizes tell them apart.
      EXPECT_EQ(a.pages[a.faces[i].page].srgb8.width, b.pages[b.faces[i].page].srgb8.width);
    }
  }
}

TEST(TexturedObj, RoundTrips) {
  const TemporaryFolder folder;
  TexturedModel written = SampleModel();
  WriteTexturedObj(folder / "my model.obj", written, ".png");
  const TexturedModel read = ReadTexturedModel(folder / "my model.obj").textured;
  ExpectSame(written, read, 0, 1e-12);
  EXPECT_EQ(read.model.points_in_world, written.model.points_in_world);
  EXPECT_EQ(read.pages[read.faces[0].page].srgb8.values, written.pages[1].srgb8.values);
  EXPECT_TRUE(std::filesystem::exists(folder / "my model.mtl"));
  EXPECT_TRUE(std::filesystem::exists(folder / "my model_1.png"));
  // Row 0 is the picture's top: v runs upwards from the bottom.
  EXPECT_THAT(ReadTextFile(folder / "my model.obj"), HasSubstr("vt 0.015625 0.025"));
}

TEST(Glb, GivesPolygonsTexelsUnitAndNamesBack) {
  const TemporaryFolder folder;
  const TexturedModel written = SampleModel();
  WriteGlb(folder / "model.glb", written);
  const TexturedModel read = ReadTexturedModel(folder / "model.glb").textured;
  ExpectSame(written, read, 1e-6, 1e-5);
  ASSERT_TRUE(read.model.georeference);
  EXPECT_EQ(read.model.georeference->north_deg, 12);
  double worst = 0;
  const Image8& picture = read.pages[read.faces[0].page].srgb8;
  for (size_t i = 0; i < picture.values.size(); ++i) {
    worst = std::max(worst, std::abs(double(picture.values[i]) - written.pages[1].srgb8.values[i]));
  }
  EXPECT_LE(worst, 6);  // JPEG at quality 95
  EXPECT_EQ(ReadModel(folder / "model.glb").model.faces.size(), 3u);
}

TEST(Glb, IsInMetresWithYUpAndTopLeftTextureOrigin) {
  const TemporaryFolder folder;
  WriteGlb(folder / "model.glb", SampleModel());
  const std::string bytes = ReadTextFile(folder / "model.glb");
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  const auto value = [&](size_t at, auto number) {
    std::memcpy(&number, bytes.data() + at, sizeof(number));
    return number;
  };
  EXPECT_EQ(value(4, uint32_t{}), 2u);
  EXPECT_EQ(value(8, uint32_t{}), bytes.size());
  // 10 ft east, 10 ft north, 4 ft up.
  EXPECT_THAT(bytes, HasSubstr("\"image/jpeg\""));
  const std::string json = bytes.substr(20, value(12, uint32_t{}));
  EXPECT_THAT(json, HasSubstr("\"max\":[3.0480000972747803,1.2192000150680542,0.0]"));
  EXPECT_THAT(json, HasSubstr("KHR_materials_unlit"));
}

TEST(Glb, FarFromTheOriginKeepsItsPrecision) {
  const TemporaryFolder folder;
  TexturedModel far = SampleModel();
  far.model.unit = LengthUnit::kMetre;
  for (Eigen::Vector3d& point : far.model.points_in_world) {
    point += Eigen::Vector3d(456789.125, 5123456.5, 230);
  }
  WriteGlb(folder / "far.glb", far);
  ExpectSame(far, ReadTexturedModel(folder / "far.glb").textured, 2e-6, 1e-5);
}

TEST(Glb, SameModelGivesTheSameBytes) {
  const TemporaryFolder folder;
  WriteGlb(folder / "a.glb", SampleModel());
  WriteGlb(folder / "b.glb", SampleModel());
  EXPECT_EQ(ReadTextFile(folder / "a.glb"), ReadTextFile(folder / "b.glb"));
}

TEST(Glb, DamagedFilesAreErrorsAndNoCrash) {
  const TemporaryFolder folder;
  WriteGlb(folder / "model.glb", SampleModel());
  const std::string bytes = ReadTextFile(folder / "model.glb");
  for (size_t size = 0; size < bytes.size(); size += bytes.size() / 40) {
    const auto file = folder.Write("cut.glb", bytes.substr(0, size));
    EXPECT_NE(ThrownMessage([&] { ReadTexturedModel(file); }), "nothing was thrown") << size;
  }
  // A flipped byte anywhere may or may not matter, but never crashes.
  for (size_t at = 0; at < bytes.size(); at += 61) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x15);
    const auto file = folder.Write("flipped.glb", flipped);
    ThrownMessage([&] { ReadTexturedModel(file); });
  }
}

TEST(ReadTexturedModel, PlainModelsHaveNoPages) {
  const TexturedModel brick =
      ReadTexturedModel(std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/model.osu")
          .textured;
  EXPECT_EQ(brick.faces.size(), 70u);
  EXPECT_TRUE(brick.pages.empty());
  EXPECT_EQ(brick.faces[0].page, -1);
}

}  // namespace
}  // namespace groundglass
