// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Damaged mesh files give a model or one clear line, never a crash, an endless loop or a demand for
// all of the machine's memory.
#include "scene/error.h"
#include "scene/formats/model_io.h"
#include "tests/fuzz/mutate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace groundglass {
namespace {

template <typename T>
void Append(T value, bool is_big_endian, std::string& bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (is_big_endian) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

const double kBox[8][3] = {
    {0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}, {0, 0, 6}, {12, 0, 6}, {12, 8, 6}, {0, 8, 6}};
const int kQuads[6][4] = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string BinaryPly(bool is_big_endian) {
  std::string bytes = std::string("ply\nformat binary_") + (is_big_endian ? "big" : "little") +
                      "_endian 1.0\ncomment a box\nelement vertex 8\nproperty double x\n"
                      "property double y\nproperty double z\nproperty uchar red\n"
                      "element face 6\nproperty list uchar int vertex_indices\n"
                      "property list ushort float texcoord\nelement edge 1\nproperty short a\n"
                      "end_header\n";
  for (const auto& point : kBox) {
    for (const double coordinate : point) Append(coordinate, is_big_endian, bytes);
    bytes += '\x7f';
  }
  for (const auto& quad : kQuads) {
    bytes += '\x04';
    for (const int corner : quad) Append(corner, is_big_endian, bytes);
    Append(uint16_t{2}, is_big_endian, bytes);
    Append(0.5f, is_big_endian, bytes);
    Append(0.25f, is_big_endian, bytes);
  }
  Append(int16_t{1}, is_big_endian, bytes);
  return bytes;
}

std::string AsciiPly() {
  std::string text =
      "ply\r\nformat ascii 1.0\r\nobj_info made for this\r\nelement vertex 8\r\n"
      "property float64 x\r\nproperty float64 y\r\nproperty float64 z\r\nelement face 5\r\n"
      "property uchar material\r\nproperty list uint8 int32 vertex_index\r\n"
      "element tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n";
  for (const auto& point : kBox) {
    for (const double coordinate : point) text += std::to_string(coordinate) + " ";
    text += "\r\n";
  }
  for (int i = 0; i < 5; ++i) {
    text += "1 4";
    for (const int corner : kQuads[i]) text += " " + std::to_string(corner);
    text += "\r\n";
  }
  return text + "9 3 0 7 4 -1 4 5 7 6\r\n";
}

std::string BinaryStl() {
  std::string bytes = "solid says the header, though what follows is binary";
  bytes.resize(80, ' ');
  Append(uint32_t{12}, false, bytes);
  for (const auto& quad : kQuads) {
    for (const auto& corners : {std::vector{0, 1, 2}, std::vector{0, 2, 3}}) {
      bytes.append(12, '\0');
      for (const int corner : corners) {
        for (const double c : kBox[quad[corner]]) Append(static_cast<float>(c), false, bytes);
      }
      bytes.append(2, '\0');
    }
  }
  return bytes;
}

std::string AsciiStl() {
  std::string text;
  for (const auto& quad : kQuads) {
    text += "SOLID part of a box\n facet normal 0 0 0\n  OUTER LOOP\n";
    for (const int corner : {0, 1, 2}) {
      text += "   vertex";
      for (const double c : kBox[quad[corner]]) text += " " + std::to_string(c);
      text += "\n";
    }
    text += "  endloop\n endfacet\nendsolid part of a box\n";
  }
  return text;
}

// A square hole in a square, and a face of its own.
std::string Obj() {
  return "# unit: m\nmtllib no.mtl\nv 0 0 0\nv 10 0 0\nv 10 5 0\nv 0 5 0\nv 3 1 0\nv 7 1 0\n"
         "v 7 4 0\nv 3 4 0\nvt 0 0\nvt 1 0\ng wall #1\nusemtl a\nf 1 2 3 4 1 5 8 7 6 5\n"
         "f -4/1 -3/2 \\\n-2/1 -1/2\nf 5 6 7 8\nf 1 1 2 3 1\n";
}

std::string Gltf() {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "scale": [2, 2, 2]}], "extensionsUsed": ["CESIUM_RTC"],
    "extensions": {"CESIUM_RTC": {"center": [1, 2, 3]}},
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
    "buffers": [{"byteLength": 39, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 1, "byteOffset": 1, "componentType": 5121},
        "values": {"bufferView": 0, "byteOffset": 12}}},
      {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}]})";
}

struct Sample {
  const char* name;
  std::string bytes;
  std::vector<std::string> dictionary;
};

class MeshFuzz : public testing::TestWithParam<Sample> {};

TEST_P(MeshFuzz, DamagedFilesGiveAModelOrOneLine) {
  const Sample& sample = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / (std::string("groundglass_fuzz_") + sample.name);
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  };
  write(sample.bytes);
  ASSERT_NO_THROW(ReadModel(file));
  std::mt19937_64 random(11);
  int num_read = 0;
  for (int round = 0; round < FuzzRounds(); ++round) {
    const std::string bytes = Mutate(sample.bytes, sample.dictionary, random);
    write(bytes);
    SCOPED_TRACE(round);
    try {
      const PolygonModel model = ReadModel(file).model;
      ++num_read;
      ASSERT_FALSE(model.faces.empty());
      for (const Face& face : model.faces) ASSERT_GE(face.points.size(), 3u);
      ASSERT_LE(model.points_in_world.size(), bytes.size());
    } catch (const Error& error) {
      const std::string message = error.what();
      ASSERT_EQ(message.find('\n'), std::string::npos) << message;
      ASSERT_TRUE(message.starts_with(file.string())) << message;
    }
  }
  std::filesystem::remove(file);
  // The damage leaves enough files whole that both outcomes are tried.
  EXPECT_GT(num_read, FuzzRounds() / 50);
  EXPECT_LT(num_read, FuzzRounds());
}

const std::vector<std::string> kPlyWords = {"element vertex 4000000000",
                                            "element face 99999999",
                                            "property list uchar int vertex_indices",
                                            "property list double double z",
                                            "property float x",
                                            "tristrips",
                                            "end_header",
                                            "-1",
                                            "7"};
const std::vector<std::string> kStlWords = {
    "solid", "facet", "endfacet", "vertex 0 0", "outer loop", "endsolid", "1e30"};

INSTANTIATE_TEST_SUITE_P(
    Formats,
    MeshFuzz,
    testing::Values(
        Sample{"ascii.ply", AsciiPly(), kPlyWords},
        Sample{"little.ply", BinaryPly(false), kPlyWords},
        Sample{"big.ply", BinaryPly(true), kPlyWords},
        Sample{"ascii.stl", AsciiStl(), kStlWords},
        Sample{"binary.stl", BinaryStl(), kStlWords},
        Sample{"m.obj", Obj(), {"f 1 2 3", "\\", "-1", "2/2/2", "1 5 1 5", "g", "o #"}},
        Sample{"m.gltf",
               Gltf(),
               {"\"sparse\"", "extensionsRequired", "4294967295", "[]", "{}", "5122", "null"}}),
    [](const auto& entry) {
      std::string name = entry.param.name;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

}  // namespace
}  // namespace groundglass
