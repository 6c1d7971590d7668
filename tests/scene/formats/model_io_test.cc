// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/model_io.h"

#include "scene/check_face.h"
#include "scene/frames.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Obj, RoundTripsToTheLastBit) {
  const TemporaryFolder folder;
  const PolygonModel brick = ReadModel(kBrick / "model.osu").model;
  const ModelReading again = ReadModel(folder.Write("m.obj", FormatObj(brick)));
  EXPECT_EQ(again.model.points_in_world, brick.points_in_world);
  EXPECT_EQ(again.model.unit, LengthUnit::kFoot);
  ASSERT_EQ(again.model.faces.size(), brick.faces.size());
  for (size_t i = 0; i < brick.faces.size(); ++i) {
    EXPECT_EQ(again.model.faces[i].points, brick.faces[i].points);
    EXPECT_EQ(again.model.faces[i].name, brick.faces[i].name);
  }
  EXPECT_THAT(again.warnings, IsEmpty());
}

TEST(Obj, ReadsIndicesOfEveryKindAndAxes) {
  const TemporaryFolder folder;
  const auto file = folder.Write("m.obj",
                                 "# unit: m\no wall\nv 0 0 0 1.0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                 "vt 0 0\nvn 0 0 1\ns off\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"
                                 "g roof top\nf -2//1 -3//1 -4//1\nl 1 2\n");
  const ModelReading as_world = ReadModel(file);
  ASSERT_EQ(as_world.model.faces.size(), 2u);
  EXPECT_THAT(as_world.model.faces[0].points, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(as_world.model.faces[1].points, ElementsAre(2, 1, 0));
  EXPECT_EQ(as_world.model.faces[0].name, "wall");
  EXPECT_EQ(as_world.model.faces[1].name, "roof top");
  EXPECT_EQ(as_world.model.unit, LengthUnit::kMetre);
  ModelOptions options;
  options.mesh_axes = MeshAxes::kYUp;
  options.unit = LengthUnit::kFoot;
  const ModelReading y_up = ReadModel(file, options);
  EXPECT_EQ(y_up.model.points_in_world[2], Eigen::Vector3d(1, 0, 1));
  EXPECT_EQ(y_up.model.unit, LengthUnit::kFoot);
  // Facing +z before, which is south in a file with y up.
  EXPECT_EQ(ComputeFacePlane(y_up.model, 0).normal_in_world, Eigen::Vector3d(0, -1, 0));
  options.mesh_axes = MeshAxes::kSite;
  EXPECT_EQ(ReadModel(file, options).model.points_in_world[2], Eigen::Vector3d(1, -1, 0));
}

TEST(ModelOptions, SayMoreThanAnyFile) {
  const TemporaryFolder folder;
  const auto osu = folder.Write("m.osu", "3 1\n0 0 0\n1 2 3\n4 0 0\n3 1 2 3\n");
  const auto obj = folder.Write("m.obj", "v 0 0 0\nv 1 2 3\nv 4 0 0\nf 1 2 3\n");
  EXPECT_TRUE(ReadModel(osu).model.is_unit_assumed);
  EXPECT_TRUE(ReadModel(obj).model.is_unit_assumed);
  ModelOptions options;
  options.unit = LengthUnit::kMillimetre;
  options.sigma = 2.5;
  options.flip_faces = true;
  for (const auto& file : {osu, obj}) {
    const PolygonModel model = ReadModel(file, options).model;
    EXPECT_EQ(model.unit, LengthUnit::kMillimetre);
    EXPECT_FALSE(model.is_unit_assumed);
    EXPECT_EQ(model.sigma, 2.5);
    EXPECT_THAT(model.faces[0].points, ElementsAre(2, 1, 0));
  }
  // Axes are the file's: .osu is `site` by itself, the others are `world`.
  const auto second_point = [&](const std::filesystem::path& file, MeshAxes axes) {
    options.mesh_axes = axes;
    return ReadModel(file, options).model.points_in_world[1];
  };
  for (const auto& file : {osu, obj}) {
    EXPECT_EQ(second_point(file, MeshAxes::kWorld), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(second_point(file, MeshAxes::kSite), Eigen::Vector3d(1, -2, 3));
    EXPECT_EQ(second_point(file, MeshAxes::kYUp), Eigen::Vector3d(1, -3, 2));
  }
  EXPECT_EQ(second_point(osu, MeshAxes::kZUp), Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(second_point(obj, MeshAxes::kZUp), Eigen::Vector3d(1, 2, 3));
}

TEST(Obj, BadOnesGiveOneLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return ThrownMessage([&] { ReadModel(folder.Write("m.obj", text)); });
  };
  EXPECT_THAT(message("v 0 0\n"), HasSubstr("m.obj:1: expected 3 numbers at least"));
  EXPECT_THAT(message("v 0 0 x\n"), HasSubstr("m.obj:1: 'x' is not a number"));
  EXPECT_THAT(message("v 0 0 1,5\n"),
              HasSubstr("m.obj:1: '1,5' is not a number; write 1.5, with a point"));
  EXPECT_THAT(message("v 0 0 0\nf 1 2 3\n"), HasSubstr("m.obj:2: point 2 is outside 1 to 1"));
  EXPECT_THAT(message("v 0 0 0\nf 0 1 1\n"), HasSubstr("m.obj:2: point 0 is outside 1 to 1"));
  EXPECT_THAT(message("v 0 0 0\nf a b c\n"),
              HasSubstr("m.obj:2: 'a' is not the number of a point"));
  EXPECT_THAT(message("# none\n"), HasSubstr("m.obj: this model has no faces"));
  EXPECT_THAT(message("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("face 1 has no area"));
}

TEST(Obj, TellsThatFreeFormSurfacesAreLeftOut) {
  const TemporaryFolder folder;
  const ModelReading reading =
      ReadModel(folder.Write("m.obj",
                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"
                             "cstype bezier\ndeg 2\ncurv 0 1 1 2 3\nend\n"));
  EXPECT_THAT(reading.warnings,
              ElementsAre(HasSubstr("m.obj: 1 free-form curves and surfaces are left out")));
}

TEST(Obj, LeavesSliversOutWithAWarning) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadModel(
      folder.Write("m.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 1 4\n"));
  EXPECT_EQ(reading.model.faces.size(), 1u);
  ASSERT_EQ(reading.warnings.size(), 1u);
  EXPECT_THAT(reading.warnings[0],
              HasSubstr("2 faces that cannot be used are left out; the first: face 1 has no area"));
  EXPECT_THAT(reading.warnings[0], HasSubstr("(line 5)"));
}

TEST(Ply, KeepsPolygonsAndJoinsPoints) {
  const TemporaryFolder folder;
  const ModelReading reading = ReadModel(folder.Write(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 1 0\n1 1 0\n1 2 1\n0 2 1\n4 0 1 2 3\n4 4 5 6 7\n"));
  EXPECT_EQ(reading.model.points_in_world.size(), 6u);
  ASSERT_EQ(reading.model.faces.size(), 2u);
  EXPECT_EQ(reading.model.faces[0].points.size(), 4u);
  EXPECT_EQ(reading.model.faces[1].points.size(), 4u);
  EXPECT_EQ(ComputeFacePlane(reading.model, 0).normal_in_world, Eigen::Vector3d(0, 0, 1));
}

TEST(Stl, ReadsTextAndBinary) {
  const TemporaryFolder folder;
  const ModelReading text = ReadModel(folder.Write(
      "t.stl",
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
      "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\n"
      "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n"));
  EXPECT_EQ(text.model.points_in_world.size(), 4u);
  EXPECT_EQ(text.model.faces.size(), 2u);

  std::string binary(80, ' ');
  const uint32_t count = 1;
  const float values[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0};
  binary.append(reinterpret_cast<const char*>(&count), 4);
  binary.append(reinterpret_cast<const char*>(values), sizeof(values));
  binary.append(2, '\0');
  EXPECT_EQ(ReadModel(folder.Write("b.stl", binary)).model.faces.size(), 1u);
}

TEST(ReadModel, BadMeshesGiveOneLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& bytes) {
    std::string thrown = ThrownMessage([&] { ReadModel(folder.Write(name, bytes)); });
    EXPECT_EQ(thrown.find('\n'), std::string::npos) << thrown;
    return thrown;
  };
  EXPECT_THAT(message("m.ply", "ply\nformat ascii 1.0\nelement vertex 1000000000000\n"),
              HasSubstr("m.ply:3: the file is too short for 1000000000000 elements"));
  EXPECT_THAT(message("n.ply",
                      "ply\nformat binary_little_endian 1.0\nelement vertex 900000000\nproperty "
                      "float x\nproperty float y\nproperty float z\nend_header\n0123456789"),
              HasSubstr("n.ply:3: the file is too short for 900000000 elements"));
  std::string binary(80, ' ');
  binary.append("\xff\xff\xff\x7f", 4);
  EXPECT_THAT(message("m.stl", binary), HasSubstr("m.stl: cannot read this model"));
  EXPECT_THAT(message("m.glb", "glTF rubbish"), HasSubstr("m.glb: cannot read this glTF model"));
  EXPECT_THAT(message("m.gltf", "{}"), HasSubstr("m.gltf: cannot read this glTF model"));
  EXPECT_THAT(message("m.xyz", ""), HasSubstr("this kind of model is not read; export it as .glb"));
  EXPECT_EQ(ThrownMessage([] { ReadModel("none.ply"); }), "none.ply: no such model file");
  EXPECT_EQ(ThrownMessage([] { ReadModel("none.glb"); }), "none.glb: no such model file");
}

TEST(Gltf, TriangleBeyondItsVerticesIsAnError) {
  // One triangle whose third index is 7, in a file that is otherwise sound.
  const TemporaryFolder folder;
  const std::string json = R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 39, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEH"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}]})";
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("m.gltf", json)); }),
              HasSubstr("a triangle uses a vertex that there is not"));
  std::string sound = json;
  sound.replace(sound.find("AAEH"), 4, "AAEC");
  const PolygonModel model = ReadModel(folder.Write("m.gltf", sound)).model;
  EXPECT_EQ(model.unit, LengthUnit::kMetre);
  // (0, 1, 0) in the file is straight up.
  EXPECT_EQ(model.points_in_world[2], Eigen::Vector3d(0, 0, 1));
  ModelOptions options;
  options.unit = LengthUnit::kFoot;
  EXPECT_NEAR(
      ReadModel(folder / "m.gltf", options).model.points_in_world[2].z(), 1 / 0.3048, 1e-12);
  std::string endless = sound;
  endless.replace(endless.find("{\"mesh\": 0}"), 11, "{\"mesh\": 0, \"children\": [0]}");
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("e.gltf", endless)); }),
              HasSubstr("e.gltf: "));
  std::string far = sound;
  far.replace(far.find("\"count\": 3"), 10, "\"count\": 3000000000");
  EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("f.gltf", far)); }),
              HasSubstr("an accessor reaches beyond its buffer"));
}

PolygonModel OneFace(const std::vector<Eigen::Vector3d>& points) {
  PolygonModel model;
  model.points_in_world = points;
  Face& face = model.faces.emplace_back();
  for (size_t i = 0; i < points.size(); ++i) face.points.push_back(static_cast<int>(i));
  return model;
}

TEST(CheckFace, FindsEachFault) {
  const auto fault = [](const std::vector<Eigen::Vector3d>& points) {
    return CheckFace(OneFace(points), 0).fault;
  };
  EXPECT_EQ(fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), "");
  EXPECT_EQ(fault({{0, 0, 0}, {1, 0, 0}}), "has 2 points; a face needs at least 3");
  EXPECT_EQ(fault({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            "has a repeated point: 2 and 3 are at the same place");
  EXPECT_EQ(fault({{0, 0, 0}, {1, 1, 0}, {3, 3, 0}}),
            "has no area: its points lie on a line, or its parts cancel out");
  EXPECT_EQ(fault({{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {5, 3, 0}}),
            "crosses or touches itself: its sides 2-3 and 4-1 meet");
  // A spike that runs back over the side it came along.
  EXPECT_EQ(fault({{0, 0, 0}, {4, 0, 0}, {4, 9, 0}, {4, 4, 0}, {0, 4, 0}}),
            "crosses or touches itself: its sides 2-3 and 3-4 meet");
  // A corner that touches a far side.
  EXPECT_EQ(fault({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}),
            "crosses or touches itself: its sides 1-2 and 3-4 meet");
  PolygonModel model = OneFace({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  model.faces[0].points[2] = 5;
  EXPECT_EQ(CheckFace(model, 0).fault, "uses point 6, which is outside 1 to 3");
  model.faces[0].points = {0, 1, 2, 1};
  EXPECT_EQ(CheckFace(model, 0).fault, "has point 2 more than once");
}

TEST(CheckFace, AllowsConcaveFacesWithCollinearPointsInAnyPlane) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> comb;
  for (const Eigen::Vector2d& p : std::vector<Eigen::Vector2d>{
           {0, 0}, {5, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {6, 2}, {6, 8}, {0, 8}}) {
    comb.push_back(100 * turn * Eigen::Vector3d(p.x(), p.y(), 3));
  }
  const FaceCheck check = CheckFace(OneFace(comb), 0);
  EXPECT_EQ(check.fault, "");
  EXPECT_EQ(check.warning, "");
}

TEST(CheckFace, WarnsBeyondATenthOfAPercent) {
  // One corner of a square lifted by h: the best plane leaves h / 4 at each.
  const auto warning = [](double h) {
    return CheckFace(OneFace({{0, 0, 0}, {1, 0, 0}, {1, 1, h}, {0, 1, 0}}), 0).warning;
  };
  EXPECT_EQ(warning(0.0055), "");
  EXPECT_THAT(warning(0.0058), HasSubstr("out of plane; its best plane is used"));
}

}  // namespace
}  // namespace groundglass
