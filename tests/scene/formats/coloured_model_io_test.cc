// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/coloured_model_io.h"

#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(ReadColouredModel, PlainColoursOfMaterialsAreReadAndTheMarkOfNoPhotographIsNone) {
  const TemporaryFolder folder;
  folder.Write("wall.mtl", "newmtl red\nKd 0.8 0.2 0.1\nnewmtl no_photograph\nKd 0.5 0.5 0.5\n");
  folder.Write("wall.obj",
               "mtllib wall.mtl\nv 66 -50 0\nv 86 -50 0\nv 86 -50 15\nv 66 -50 15\n"
               "usemtl red\nf 1 2 3 4\nusemtl no_photograph\nf 1 2 3\n");
  const TexturedModel design = ReadColouredModel(folder / "wall.obj").textured;
  ASSERT_EQ(design.faces.size(), 2);
  ASSERT_EQ(design.faces[0].page, 0);
  EXPECT_EQ(design.faces[1].page, -1);
  // Kd is taken as sRGB: 0.8 and 0.2 of 255.
  EXPECT_EQ(*design.pages[0].srgb8.At(0, 0), 204);
  EXPECT_EQ(design.pages[0].srgb8.At(0, 0)[1], 51);
  EXPECT_TRUE(ReadTexturedModel(folder / "wall.obj").textured.pages.empty());

  // A glTF's factor is linear light.
  folder.Write(
      "wall.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.2,0.1,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
"min":[0,0,0],"max":[2,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAQAAAgD8AAAAA"}]})");
  const TexturedModel linear = ReadColouredModel(folder / "wall.gltf").textured;
  ASSERT_EQ(linear.pages.size(), 1);
  EXPECT_EQ(linear.faces[0].page, 0);
  EXPECT_EQ(*linear.pages[0].srgb8.At(0, 0), 188);
  EXPECT_EQ(linear.pages[0].srgb8.At(0, 0)[2], 89);
}

TEST(ReadColouredModel, AFaceWhosePictureIsMissingStaysGrey) {
  const TemporaryFolder folder;
  folder.Write("wall.mtl", "newmtl lost\nKd 1 1 1\nmap_Kd lost.jpg\n");
  folder.Write("wall.obj",
               "mtllib wall.mtl\nv 0 0 0\nv 2 0 0\nv 2 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
               "usemtl lost\nf 1/1 2/2 3/3\n");
  const TexturedModelReading reading = ReadColouredModel(folder / "wall.obj");
  ASSERT_EQ(reading.textured.faces.size(), 1);
  EXPECT_EQ(reading.textured.faces[0].page, -1);
  EXPECT_EQ(reading.warnings.size(), 1);
}

}  // namespace
}  // namespace groundglass
