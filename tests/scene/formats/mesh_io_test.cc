// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/mesh_io.h"

#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <typename T>
std::string Bytes(std::initializer_list<T> values, bool is_swapped = false) {
  std::string bytes;
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (is_swapped) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

TEST(Ply, ReadsBothByteOrdersAnyTypesAndLineEnds) {
  const TemporaryFolder folder;
  for (const bool is_big : {false, true}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string bytes;
      for (const std::string line :
           {"PLY",
            is_big ? "Format Binary_Big_Endian 1.0" : "Format Binary_Little_Endian 1.0",
            "COMMENT unit: m",
            "element face 1",
            "property uchar material",
            "Property List Ushort Uint Vertex_Index",
            "property list uchar float texcoord",
            "Element Vertex 3",
            "property short X",
            "property uchar quality",
            "property double y",
            "property float32 z",
            "End_Header"}) {
        bytes += line + end;
      }
      bytes += "\x07" + Bytes<uint16_t>({3}, is_big) + Bytes<uint32_t>({0, 1, 2}, is_big) + "\x01" +
               Bytes<float>({0.5f}, is_big);
      const std::vector<std::pair<int16_t, double>> rows = {
          {int16_t{0}, 5820010.0}, {int16_t{-5820}, 5820077.82}, {int16_t{30}, 5823000.0}};
      for (const auto& [x, y] : rows) {
        bytes += Bytes<int16_t>({x}, is_big) + "\x0A" + Bytes<double>({y}, is_big) +
                 Bytes<float>({0.25f}, is_big);
      }
      const ModelReading reading = ReadModel(folder.Write("m.PLY", bytes));
      EXPECT_THAT(reading.warnings, IsEmpty());
      EXPECT_EQ(reading.model.unit, LengthUnit::kMetre);
      EXPECT_FALSE(reading.model.is_unit_assumed);
      ASSERT_EQ(reading.model.faces.size(), 1u);
      EXPECT_EQ(reading.model.points_in_world[1], Eigen::Vector3d(-5820, 5820077.82, 0.25));
      const ModelReading longer = ReadModel(folder.Write("m.ply", bytes + "more"));
      EXPECT_THAT(longer.warnings, ElementsAre(HasSubstr("more after the last element")));
      EXPECT_THAT(ThrownMessage(
                      [&] { ReadModel(folder.Write("m.ply", bytes.substr(0, bytes.size() - 1))); }),
                  HasSubstr("m.ply: the file ends where a vertex's z is expected"));
    }
  }
}

TEST(Ply, FaultsNameTheirLine) {
  const TemporaryFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto message = [&](const std::string& text) {
    return ThrownMessage([&] { ReadModel(folder.Write("m.ply", text)); });
  };
  EXPECT_THAT(message(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
              HasSubstr("m.ply: face 1 uses vertex 3 (from 0), but there are 3"));
  EXPECT_THAT(message(head + "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n"),
              HasSubstr("m.ply:11: a vertex's z: 'zero' is not a number"));
  EXPECT_THAT(message(head + "0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n"),
              HasSubstr("m.ply: 1 face that cannot be used is left out: face 1 uses point 3"));
  EXPECT_THAT(message(head + "0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n"), HasSubstr("m.ply:13: "));
  EXPECT_THAT(message(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n"),
              HasSubstr("m.ply: face 1 uses vertex 0.5 (from 0), but there are 3"));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n1 2 3\n"),
              HasSubstr("a cloud of points cannot be textured"));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
              HasSubstr("m.ply:4: 'real' is no type"));
  EXPECT_THAT(message("solid"), HasSubstr("m.ply:1: is no PLY file"));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement stuff 9\nend_header\n"),
              HasSubstr("this model has no points"));
}

std::string BinaryStl(const std::string& header, uint32_t count, size_t held) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes += Bytes<uint32_t>({count});
  for (size_t i = 0; i < held; ++i) {
    const float x = static_cast<float>(i);
    bytes += Bytes<float>({0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0}) + std::string(2, '\0');
  }
  return bytes;
}

TEST(Stl, BinaryFilesMayBeginWithSolidAndCountWrongly) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& bytes) {
    return ReadModel(folder.Write("m.STL", bytes));
  };
  EXPECT_EQ(read(BinaryStl("solid facet", 4, 4)).model.faces.size(), 4u);
  EXPECT_EQ(read(BinaryStl("solid", 4, 4) + "trailing").model.faces.size(), 4u);
  const ModelReading uncounted = read(BinaryStl("", 0, 5));
  EXPECT_EQ(uncounted.model.faces.size(), 5u);
  EXPECT_THAT(uncounted.warnings, ElementsAre(HasSubstr("counts no triangles; the 5")));
  EXPECT_THAT(ThrownMessage([&] { read(BinaryStl("", 9, 5)); }),
              HasSubstr("counts 9 triangles, but the file ends after 5"));
  EXPECT_THAT(ThrownMessage([&] { read("short"); }), HasSubstr("m.STL: is no STL file"));
}

TEST(Stl, TextMayHoldSeveralSolidsWithNames) {
  const TemporaryFolder folder;
  const std::string facet =
      "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0.1\nVERTEX 1 0 0\nVERTEX 1 1 0\nENDLOOP\n"
      "ENDFACET\n";
  std::string other = facet;
  other.replace(other.find("0.1"), 3, "389412.351");
  const ModelReading reading = ReadModel(folder.Write(
      "m.stl",
      "SOLID north wall\r\n" + facet + "ENDSOLID north wall\nsolid roof\n" + other + "endsolid\n"));
  ASSERT_EQ(reading.model.faces.size(), 2u);
  EXPECT_EQ(reading.model.faces[0].name, "north wall");
  EXPECT_EQ(reading.model.faces[1].name, "roof");
  EXPECT_EQ(ComputeBounds(reading.model).max.z(), 389412.351);
  EXPECT_THAT(ThrownMessage([&] {
                ReadModel(folder.Write("m.stl", "solid\nfacet normal 0 0 1\nvertex 1 2 x\n"));
              }),
              HasSubstr("m.stl:3: 'x' is not a finite number"));
  EXPECT_THAT(ThrownMessage([&] {
                ReadModel(folder.Write("m.stl", "solid\nfacet normal 0 0 1\nvertex 1 2 3\n"));
              }),
              HasSubstr("m.stl:4: the file ends amid a facet"));
}

// Programs write nan for a point that they could not compute.
TEST(Mesh, AFaceWithACornerThatIsNoNumberIsLeftOut) {
  const TemporaryFolder folder;
  std::string stl = BinaryStl("", 3, 3);
  const float nan = std::nanf("");
  std::memcpy(stl.data() + 84 + 50 + 12, &nan, sizeof(nan));  // the second triangle's first corner
  const std::vector<std::pair<std::string, std::string>> files = {
      {"m.obj",
       "v 0 0 0\nv 4 0 0\nv 4 3 0\nv nan 3 0\nv 9 inf -inf\nf 1 2 3\nf 1 3 4\nf 2 3 1 5\nf 3 2 "
       "1 2 3\n"},
      {"m.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
       "float "
       "z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n4 0 0\n4 3 "
       "0\nnan nan nan\n3 0 1 2\n3 0 2 3\n"},
      {"m.stl", stl}};
  for (const auto& [name, text] : files) {
    const ModelReading reading = ReadModel(folder.Write(name, text));
    EXPECT_FALSE(reading.left_out.empty()) << name;
    EXPECT_EQ(reading.left_out[0], 2) << name;
    EXPECT_THAT(reading.warnings, Contains(HasSubstr("whose coordinates are not finite numbers")))
        << name;
    for (const Eigen::Vector3d& point : reading.model.points_in_world) {
      EXPECT_TRUE(point.allFinite()) << name;
    }
  }
}

// One triangle, its primitive and its node with more to them.
std::string TriangleGltf(const std::string& of_primitive, const std::string& of_node) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" +
         of_node +
         R"(}], "meshes": [{"name": "roof", "primitives": [{"attributes": {"POSITION": 0})" +
         of_primitive +
         R"(}]}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
         "type": "VEC3", "min": [0, 0, 0], "max": [4, 3, 0]}],
         "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
         "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAQAAAAAAAAAAAAACAQAAAQEAAAAAA"}],
         "skins": [{"joints": [0]}], "extensionsUsed": ["KHR_draco_mesh_compression"]})";
}

TEST(Gltf, AMeshThatComesBothWaysIsReadUnpacked) {
  const TemporaryFolder folder;
  const std::string packed =
      R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}})";
  const ModelReading reading = ReadModel(folder.Write("m.gltf", TriangleGltf(packed, "")));
  EXPECT_EQ(reading.model.faces.size(), 1u);
  EXPECT_EQ(reading.warnings.size(), 0u);
}

TEST(Gltf, WhatASkeletonMovesIsTold) {
  const TemporaryFolder folder;
  for (const auto& [more, told] : {std::pair(R"(, "skin": 0)", "'roof' hangs on a skeleton"),
                                   std::pair(R"(, "weights": [0.5])", "'roof' is morphed")}) {
    const ModelReading reading = ReadModel(folder.Write("m.gltf", TriangleGltf("", more)));
    EXPECT_THAT(reading.warnings, ElementsAre(HasSubstr(told)));
  }
}

TEST(Model, NamesOfFacesComeInUtf8) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadModel(folder.Write("m.obj",
                                                      "v 0 0 0\nv 4 0 0\nv 4 3 0\ng Stra\xDF"
                                                      "e\nf 1 2 3\n"));
  EXPECT_EQ(reading.model.faces[0].name, "Straße");
  EXPECT_THAT(reading.warnings, Contains(HasSubstr("names of faces are not UTF-8")));
}

TEST(Model, WhatIsNoneIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return ThrownMessage([&] { ReadModel(folder.Write("m.obj", text)); });
  };
  EXPECT_THAT(message("PK\x03\x04 packed"), HasSubstr("this is a zip archive and no model"));
  EXPECT_THAT(message("<!DOCTYPE html>\n<html></html>\n"), HasSubstr("this is a web page"));
}

TEST(Obj, UnitsMayBeWrittenInFull) {
  const TemporaryFolder folder;
  const std::string faces = "v 0 0 0\nv 4 0 0\nv 4 3 0\nf 1 2 3\n";
  for (const char* comment : {"# unit: metres", "# File units = meters", "# units: m"}) {
    const PolygonModel model =
        ReadModel(folder.Write("m.obj", std::string(comment) + "\n" + faces)).model;
    EXPECT_EQ(model.unit, LengthUnit::kMetre) << comment;
    EXPECT_FALSE(model.is_unit_assumed) << comment;
  }
}

// Floats of four corners and their texture points, then indices of sparse exceptions.
std::string GltfBytes() {
  return Bytes<float>({0, 0, 0, 4, 0, 0, 0, 3, 0, 4, 3, 0}) +          // 48: a strip's corners
         Bytes<float>({0, 0, 1, 0, 0, 1, 1, 1}) +                      // 32: texture points
         Bytes<uint16_t>({1, 3}) + Bytes<float>({5, 0, 0, 5, 3, 0}) +  // 4 + 24: exceptions
         Bytes<int8_t>({127, -128, 0, 64, -127, 0, 127, 127, 0, 0, 0, 127});  // 12
}

std::string GltfText(const std::string& primitive,
                     const std::string& positions,
                     const std::string& more) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_1": 1}, "mode": 5,
      "material": 0 )" +
         primitive + R"(}]}],
    "buffers": [{"byteLength": 120, "uri": "m.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 32},
      {"buffer": 0, "byteOffset": 80, "byteLength": 4},
      {"buffer": 0, "byteOffset": 84, "byteLength": 24},
      {"buffer": 0, "byteOffset": 108, "byteLength": 12}],
    "accessors": [{"count": 4, "type": "VEC3", )" +
         positions + R"(},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}],
    "textures": [{"source": 0}], "images": [{"uri": "Wall%20one.png"}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 0,
      "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.25], "scale": [2, 4],
        "rotation": 1.5707963267948966, "texCoord": 1}}}}}] )" +
         more + "}";
}

const char* const kFloats = R"("bufferView": 0, "componentType": 5126)";

TEST(Gltf, StripsTexturesWithTransformAndMissingPictures) {
  const TemporaryFolder folder;
  folder.Write("m.bin", GltfBytes());
  WriteSrgb8(folder / "Wall one.png", Image8(10, 20, 3));
  const auto file = folder.Write("m.gltf", GltfText("", kFloats, ""));
  const TexturedModelReading reading = ReadTexturedModel(file);
  EXPECT_THAT(reading.warnings, IsEmpty());
  const TexturedModel& textured = reading.textured;
  ASSERT_EQ(textured.model.faces.size(), 2u);
  // Both triangles of the strip face the viewer: +z of the file, south in world.
  for (const int face : {0, 1}) {
    EXPECT_EQ(ComputeFacePlane(textured.model, face).normal_in_world, Eigen::Vector3d(0, -1, 0));
  }
  // (1, 0): scaled to (2, 0), turned counterclockwise where v runs down to (0, -2), moved.
  ASSERT_EQ(textured.faces[0].page, 0);
  EXPECT_LT((textured.faces[0].corners_texel[1] - Eigen::Vector2d(0.5 * 10, -1.75 * 20)).norm(),
            1e-9);
  std::filesystem::remove(folder / "Wall one.png");
  const TexturedModelReading grey = ReadTexturedModel(file);
  EXPECT_EQ(grey.textured.faces[0].page, -1);
  EXPECT_THAT(grey.warnings,
              ElementsAre(AllOf(HasSubstr("Wall%20one.png"), HasSubstr("its 2 faces are grey"))));
}

TEST(Gltf, SparseAndNormalisedPositions) {
  const TemporaryFolder folder;
  folder.Write("m.bin", GltfBytes());
  const auto corners = [&](const std::string& positions) {
    const PolygonModel model = ReadModel(folder.Write("m.gltf", GltfText("", positions, ""))).model;
    return ComputeBounds(model);
  };
  const std::string sparse =
      R"("componentType": 5126, "sparse": {"count": 2,
         "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})";
  EXPECT_EQ(corners(R"("bufferView": 0, )" + sparse).max, Eigen::Vector3d(5, 0, 3));
  // Without bytes of its own all else is zero: one triangle of two is a sliver.
  EXPECT_EQ(corners(sparse).max, Eigen::Vector3d(5, 0, 3));
  EXPECT_EQ(ReadModel(folder / "m.gltf").model.faces.size(), 1u);
  const Box box = corners(R"("bufferView": 4, "componentType": 5120, "normalized": true)");
  EXPECT_EQ(box.min, Eigen::Vector3d(0, -1, -1));
  EXPECT_EQ(box.max, Eigen::Vector3d(1, 0, 1));
  EXPECT_EQ(corners(R"("bufferView": 4, "componentType": 5120)").min,
            Eigen::Vector3d(0, -127, -128));
}

TEST(Gltf, CompressionIsNamedWithItsRemedy) {
  const TemporaryFolder folder;
  folder.Write("m.bin", GltfBytes());
  const auto message = [&](const std::string& required) {
    const std::string more = ", \"extensionsRequired\": [\"" + required + "\"]";
    return ThrownMessage([&] { ReadModel(folder.Write("m.gltf", GltfText("", kFloats, more))); });
  };
  EXPECT_THAT(message("KHR_draco_mesh_compression"),
              AllOf(HasSubstr("compressed by Draco"), HasSubstr("gltf-transform copy")));
  EXPECT_THAT(message("EXT_meshopt_compression"), HasSubstr("compressed by meshoptimizer"));
  EXPECT_THAT(message("EXT_mesh_gpu_instancing"), HasSubstr("'EXT_mesh_gpu_instancing'"));
  EXPECT_EQ(message("KHR_materials_unlit"), "nothing was thrown");
}

}  // namespace
}  // namespace groundglass
