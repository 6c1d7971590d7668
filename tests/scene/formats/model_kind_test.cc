// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Models under another format's name, and of formats that are not read, are told by their content.
#include "scene/formats/model_kind.h"

#include "scene/formats/model_io.h"
#include "scene/formats/scene_folder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using namespace std::string_literals;

// A binary STL of one triangle, whose header says "solid" as some do.
std::string BinaryStl() {
  std::string bytes = "solid of nothing";
  bytes.resize(80, ' ');
  return bytes + "\1\0\0\0"s + std::string(50, '\0');
}

const std::map<std::string, std::string>& Models() {
  static const std::map<std::string, std::string> models = {
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {".obj", "# a wall\no wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {".stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid\n"},
      {".gltf", R"({"asset": {"version": "2.0"}, "nodes": []})"},
      {".osu", "% a wall\n3 1\n0 0 0\n1 0 0\n0 -1 0\n1 3 1 2 3\n"}};
  return models;
}

TEST(ModelKind, AWrongEndingIsToldWithTheRightOne) {
  const TemporaryFolder folder;
  for (const auto& [right, text] : Models()) {
    EXPECT_EQ(FindModelKind(folder.Write("m" + right, text)).ending, right);
    EXPECT_NO_THROW(CheckModelKind(folder / ("m" + right)));
    for (const char* wrong : {".ply", ".obj", ".stl", ".gltf", ".osu", ".fbx", ""}) {
      if (right == wrong) continue;
      const auto file = folder.Write("house"s + wrong, text);
      EXPECT_THAT(
          ThrownMessage([&] { ReadModel(file); }),
          AllOf(HasSubstr(file.string() + ": this is "), HasSubstr("rename it to house" + right)));
    }
  }
  EXPECT_EQ(FindModelKind(folder.Write("m.stl", BinaryStl())).ending, ".stl");
  EXPECT_EQ(FindModelKind(folder.Write("m.stl", BinaryStl() + "12")).ending, "");
  EXPECT_EQ(FindModelKind(folder.Write("m.obj", "\xEF\xBB\xBFv 0 0 0\n")).ending, ".obj");
}

TEST(ModelKind, TheTwoEndingsOfGltfAreOne) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(CheckModelKind(folder.Write("m.glb", Models().at(".gltf"))));
  EXPECT_NO_THROW(CheckModelKind(folder.Write("m.gltf", "glTF")));
}

TEST(ModelKind, WhatIsNotReadIsNamedWithWhatToDo) {
  const TemporaryFolder folder;
  const std::pair<std::string, std::string> kinds[] = {
      {"Kaydara FBX Binary  \0"s, "an FBX file"},
      {"BLENDER-v304", "a Blender file"},
      {"AC1027", "a DWG drawing"},
      {"  0\nSECTION\n  2\nHEADER\n", "a DXF drawing"},
      {"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\n", "an IFC file"},
      {"ISO-10303-21;\nHEADER;\n", "a STEP file"},
      {"<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"/>", "a COLLADA file"},
      {R"({"type": "CityJSON", "version": "2.0"})", "CityJSON"},
      {"OFF\n3 1 0\n", "an OFF file"},
      {"LASF", "a cloud of points"}};
  for (const auto& kind : kinds) {
    const std::string& bytes = kind.first;
    const std::string& what = kind.second;
    for (const char* name : {"m.obj", "m.osu", "m.model"}) {
      EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write(name, bytes)); }),
                  AllOf(HasSubstr("this is " + what), HasSubstr("; "), HasSubstr("export")));
    }
  }
  const std::string city = "<core:CityModel xmlns:core=\"c\"/>";
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("m.gml", city)); }),
              AllOf(HasSubstr("this is CityGML; make a model of it: groundglass convert "),
                    Not(HasSubstr("rename"))));
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("m.xml", city)); }),
              HasSubstr("rename it to m.gml, then make a model of it: groundglass convert "));
}

TEST(ModelKind, FilesOfCamerasAreNamedWithWhatToDo) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    return ThrownMessage([&] { ReadModel(folder.Write(name, text)); });
  };
  for (const auto& [name, text] : {std::pair("bundle.out", "# Bundle file v0.3\n1 0\n"),
                                   std::pair("a.nvm", "NVM_V3\n\n1\n"),
                                   std::pair("cameras.csv", "#name,x,y,alt,heading,pitch,roll,f\n"),
                                   std::pair("a.xml", "<BlocksExchange version=\"3.2\"/>"),
                                   std::pair("a.json", "[{\"cameras\": {}, \"shots\": {}}]")}) {
    EXPECT_THAT(message(name, text),
                HasSubstr("cameras, which is not read; export the cameras as COLMAP's"))
        << name;
  }
  EXPECT_THAT(message("images.txt", "# Image list\n# IMAGE_ID, QW, QX, QY, QZ\n"),
              HasSubstr("one file of a COLMAP model, which is not read alone; give the folder"));
  EXPECT_THAT(message("s1.view", "x 0"), HasSubstr("this is a view file, which is not read alone"));
}

TEST(ModelKind, ASceneTellsItOfAnOsuTooAndOnce) {
  const TemporaryFolder folder;
  folder.Write("model.osu", Models().at(".ply"));
  folder.Write("views/s1.view", "x 0 y 0 z 0 i 1 j 0 k 0 a 1.5 v 50\n");
  const SceneCheck reading = CheckScene(folder.path());
  EXPECT_THAT(reading.faults, testing::Contains(HasSubstr("rename it to model.ply")).Times(1));
}

std::string Told(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return ThrownMessage([&] { ReadModel(folder.Write(name, text)); });
}

TEST(WithoutFaces, AnObjSaysWhatItHolds) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(Told("m.obj", points),
              HasSubstr("this model has no faces, but 3 points; a cloud of points"));
  EXPECT_THAT(Told("m.obj", points + "l 1 2\nl 2 3\n"),
              HasSubstr("no faces, but 2 lines and 3 points; export it as a mesh"));
  EXPECT_THAT(Told("m.obj", points + "cstype bspline\nsurf 0 1 0 1 1 2 3\nend\n"),
              HasSubstr("no faces, but 1 free-form curve or surface (NURBS) and 3 points; export "
                        "it as a mesh (polygons, triangulated)"));
  EXPECT_THAT(Told("m.obj", "# by hand\nv;0;0;0\nf;1;2;3\n"),
              HasSubstr("nothing in it is as in an OBJ: line 2 is 'v;0;0;0'"));
}

TEST(WithoutFaces, APlySaysWhatItHolds) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\n";
  const std::string points = "0 0 0\n1 0 0\n";
  EXPECT_THAT(Told("m.ply", head + "end_header\n" + points),
              HasSubstr("no faces, but 2 points; a cloud of points cannot be textured"));
  EXPECT_THAT(
      Told("m.ply",
           head + "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n" +
               points + "0 1\n"),
      HasSubstr("no faces, but 1 edge and 2 points; export it as a mesh"));
}

// A glTF of three corners; `mode`: what they are strung together as.
std::string ThreeCorners(int mode, const std::string& scenes) {
  return R"({"asset": {"version": "2.0"}, )" + scenes +
         R"(, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
  "mode": )" +
         std::to_string(mode) + R"(}]}], "buffers": [{"byteLength": 36, "uri":
  "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})";
}

TEST(WithoutFaces, AGltfSaysWhatItHolds) {
  const std::string one = R"("scenes": [{"nodes": [0]}])";
  EXPECT_THAT(
      Told("m.gltf", ThreeCorners(3, one)),
      HasSubstr("m.gltf: this model has no faces, but 1 set of lines; export it as a mesh"));
  EXPECT_THAT(Told("m.gltf", ThreeCorners(0, one)), HasSubstr("no faces, but 1 set of points"));
  EXPECT_THAT(
      Told("m.gltf",
           ThreeCorners(4, R"("scene": 1, "scenes": [{"name": "house", "nodes": [0]}, {}])")),
      HasSubstr("the scene that it shows (1) is empty, and its meshes are in scene 0 ('house')"));
  const TemporaryFolder folder;
  EXPECT_EQ(ReadModel(folder.Write("m.gltf", ThreeCorners(4, one))).model.faces.size(), 1u);
}

TEST(Ply, ATextureThatIsNotReadIsToldWherePicturesAreWanted) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& comment,
                            const std::string& of_vertices,
                            const std::string& more) {
    const auto file = folder.Write(
        "m.ply",
        "ply\nformat ascii 1.0\n" + comment +
            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
            of_vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
            "0 0 0" + more + "\n1 0 0" + more + "\n0 1 0" + more + "\n3 0 1 2\n");
    EXPECT_THAT(ReadModel(file).warnings, ElementsAre());
    return ReadTexturedModel(file).warnings;
  };
  EXPECT_THAT(warnings("", "", ""), ElementsAre());
  EXPECT_THAT(warnings("comment TextureFile my wall.jpg\n", "", ""),
              ElementsAre(HasSubstr("its picture 'my wall.jpg' is not read, and its faces are "
                                    "grey; export it as .glb or .obj")));
  EXPECT_THAT(warnings("", "property float s\nproperty float t\n", " 0 0"),
              ElementsAre(HasSubstr("its texture is not read")));
  EXPECT_THAT(warnings("", "property uchar red\n", " 200"),
              ElementsAre(HasSubstr("the colours of its points or faces are not read")));
}

}  // namespace
}  // namespace groundglass
