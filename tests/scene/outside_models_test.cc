// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Models as other programs write them (tests/data/models).
#include "scene/check_face.h"
#include "scene/face_number.h"
#include "scene/formats/convert.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "scene/visibility.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kModels = fs::path(GROUNDGLASS_SOURCE_DIR) / "tests/data/models";

TEST(OutsideModels, NorthingsInDoublesKeepTheirLastDigit) {
  const ModelReading reading = ReadModel(kModels / "utm_doubles.ply");
  EXPECT_THAT(reading.warnings, IsEmpty());
  EXPECT_EQ(reading.model.points_in_world.size(), 108u);
  EXPECT_EQ(reading.model.faces.size(), 70u);
  EXPECT_EQ(reading.model.points_in_world[0], Eigen::Vector3d(389412.35, 5820077.82, 35.8192));
  const TemporaryFolder folder;
  ConvertModel(kModels / "utm_doubles.ply", folder / "m.osu", {});
  EXPECT_THAT(ReadTextFile(folder / "m.osu"), HasSubstr("\n389412.35 -5820077.82 35.8192\n"));
  ConvertModel(kModels / "utm_doubles.ply", folder / "m.obj", {});
  EXPECT_EQ(ReadModel(folder / "m.obj").model.points_in_world, reading.model.points_in_world);
}

TEST(OutsideModels, RepeatedAndClosingCornersAreDroppedWithOneNote) {
  const ModelReading reading = ReadModel(kModels / "repeated_corners.obj");
  const PolygonModel brick = ReadModel(kBrick / "model.osu").model;
  ASSERT_EQ(reading.model.faces.size(), 70u);
  for (int face = 0; face < 70; ++face) {
    EXPECT_EQ(FaceNumber(reading.model, face), face + 1);
    EXPECT_NEAR(ComputeFaceArea(reading.model, face), ComputeFaceArea(brick, face), 1e-6) << face;
  }
  ASSERT_EQ(reading.warnings.size(), 1u);
  EXPECT_THAT(reading.warnings[0],
              AllOf(HasSubstr("28 faces repeat a corner or close their ring"),
                    HasSubstr("the first: face 3 (hall north wall west), line 115")));
}

TEST(OutsideModels, ABridgeCutsAWindowOutOfItsWall) {
  for (const char* name : {"holes_by_bridges.obj", "holes_by_bridges.osu"}) {
    const ModelReading reading = ReadModel(kModels / name);
    EXPECT_THAT(reading.warnings, IsEmpty()) << name;
    const PolygonModel& model = reading.model;
    ASSERT_EQ(model.faces.size(), 10u) << name;
    EXPECT_EQ(model.faces[0].name, "front wall, one hole");
    EXPECT_NEAR(ComputeFaceArea(model, 0), 38, 1e-12);
    // The wall beside the window, and through it the pane 0.3 m behind; the front looks south.
    const Visibility visibility(model);
    const Eigen::Vector3d north = Eigen::Vector3d::UnitY();
    EXPECT_EQ(visibility.FirstHit({1, -5, 2}, north)->face, 0);
    EXPECT_EQ(visibility.FirstHit({5, -5, 2}, north)->face, 5);
    EXPECT_NEAR(visibility.FirstHit({5, -5, 2}, north)->distance, 5.3, 1e-6);
    const FaceCheck check = CheckFace(model, 0);
    EXPECT_EQ(check.fault, "");
    // Written and read again it is the same.
    const TemporaryFolder folder;
    for (const char* output : {"m.osu", "m.obj", "m.glb"}) {
      ConvertModel(kModels / name, folder / output, {});
      const PolygonModel again = ReadModel(folder / output).model;
      ASSERT_EQ(again.faces.size(), 10u) << output;
      EXPECT_NEAR(ComputeFaceArea(again, 0), 38, 1e-5) << output;
    }
  }
}

TEST(OutsideModels, FacesThatLieTwiceAreToldAndKeptOnce) {
  const ModelReading reading = ReadModel(kModels / "doubled_faces.osu");
  ASSERT_EQ(reading.model.faces.size(), 70u);
  ASSERT_EQ(reading.warnings.size(), 1u);
  EXPECT_THAT(reading.warnings[0],
              AllOf(HasSubstr("70 faces lie twice and are kept once"), HasSubstr("face 1 ")));
  EXPECT_THAT(FindOsuFaults(ReadTextFile(kModels / "doubled_faces.osu"), "m"), IsEmpty());
  // Their numbers stay the file's, in what is written of them too.
  std::vector<int> numbers;
  for (int face = 0; face < 70; ++face) numbers.push_back(FaceNumber(reading.model, face));
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
  const TemporaryFolder folder;
  for (const char* output : {"m.osu", "m.obj", "m.glb"}) {
    ConvertModel(kModels / "doubled_faces.osu", folder / output, {});
    const PolygonModel again = ReadModel(folder / output).model;
    ASSERT_EQ(again.faces.size(), 70u) << output;
    for (int face = 0; face < 70; ++face) EXPECT_EQ(FaceNumber(again, face), numbers[face]);
  }
}

TEST(OutsideModels, LinesGoOnAfterABackslash) {
  const ModelReading reading = ReadModel(kModels / "continued_lines.obj");
  EXPECT_THAT(reading.warnings, IsEmpty());
  ASSERT_EQ(reading.model.faces.size(), 5u);
  for (const Face& face : reading.model.faces) EXPECT_EQ(face.name, "long name");
  EXPECT_THAT(reading.model.faces[4].points, ElementsAre(4, 5, 6, 7));
}

// The sum over all faces of the volume towards the origin: a closed box's, if all run the right
// way.
double SignedVolume(const PolygonModel& model) {
  double volume = 0;
  for (const Face& face : model.faces) {
    for (size_t i = 1; i + 1 < face.points.size(); ++i) {
      volume +=
          model.points_in_world[face.points[0]].dot(model.points_in_world[face.points[i]].cross(
              model.points_in_world[face.points[i + 1]])) /
          6;
    }
  }
  return volume;
}

TEST(OutsideModels, TriangleStripsAreParted) {
  const ModelReading reading = ReadModel(kModels / "tristrips.ply");
  EXPECT_THAT(reading.warnings, IsEmpty());
  EXPECT_EQ(reading.model.faces.size(), 12u);
  EXPECT_NEAR(std::abs(SignedVolume(reading.model)), 12 * 8 * 6, 1e-9);
}

TEST(OutsideModels, BytesAfterTheLastTriangleAreTold) {
  const ModelReading reading = ReadModel(kModels / "trailing_bytes.stl");
  EXPECT_EQ(reading.model.faces.size(), 12u);
  ASSERT_EQ(reading.warnings.size(), 1u);
  EXPECT_THAT(reading.warnings[0], HasSubstr("after the last triangle are not read"));
}

TEST(OutsideModels, QuantisedPositionsAreRead) {
  const ModelReading reading = ReadModel(kModels / "quantised_short.glb");
  EXPECT_EQ(reading.model.points_in_world.size(), 108u);
  EXPECT_EQ(reading.model.faces.size(), 132u);
  // The brick hall in metres, to half a step of 14.9352 m / 32767.
  const PolygonModel brick = ReadModel(kBrick / "model.osu").model;
  const Box box = ComputeBounds(reading.model);
  const Box expected = ComputeBounds(brick);
  EXPECT_LT((box.max - 0.3048 * expected.max).norm(), 0.001);
  EXPECT_LT((box.min - 0.3048 * expected.min).norm(), 0.001);
}

TEST(OutsideModels, AnUnknownExtensionThatAFileNeedsIsNamed) {
  EXPECT_THAT(ThrownMessage([] { ReadModel(kModels / "unknown_required_extension.gltf"); }),
              HasSubstr("needs the extension 'ACME_folded_space'"));
}

TEST(OutsideModels, CesiumsCentreMovesAllPoints) {
  const ModelReading reading = ReadModel(kModels / "moved_by_extension.gltf");
  ASSERT_EQ(reading.model.points_in_world.size(), 3u);
  // (-123.4, 234.5, 345678.9) with y up.
  EXPECT_EQ(reading.model.points_in_world[0], Eigen::Vector3d(-123.4, -345678.9, 234.5));
}

TEST(OutsideModels, DamagedHeadersGiveOneLine) {
  EXPECT_THAT(ThrownMessage([] { ReadModel(kModels / "crash.ply"); }), HasSubstr("crash.ply:7: "));
  EXPECT_THAT(ThrownMessage([] { ReadModel(kModels / "endless.ply"); }),
              HasSubstr("endless.ply:4: "));
}

TEST(OutsideModels, NamesHoldBlanksAndMarksAndAPictureMayTakeOptions) {
  const fs::path folder = kModels / "mtl with blanks";
  const TexturedModelReading reading = ReadTexturedModel(folder / "mtl with blanks.obj");
  EXPECT_THAT(reading.warnings, IsEmpty());
  ASSERT_EQ(reading.textured.model.faces.size(), 1u);
  EXPECT_EQ(reading.textured.model.faces[0].name, "Wand #3 Süd");
  ASSERT_EQ(reading.textured.pages.size(), 1u);
  EXPECT_EQ(reading.textured.faces[0].page, 0);
  const TemporaryFolder out;
  ConvertModel(folder / "mtl with blanks.obj", out / "m.obj", {});
  EXPECT_EQ(ReadModel(out / "m.obj").model.faces[0].name, "Wand #3 Süd");
}

TEST(OutsideModels, AMissingPictureOrLibraryMakesFacesGreyAndIsTold) {
  const TemporaryFolder folder;
  fs::copy_file(kModels / "mtl with blanks/mtl with blanks.obj", folder / "wall.obj");
  const TexturedModelReading without_library = ReadTexturedModel(folder / "wall.obj");
  EXPECT_EQ(without_library.textured.faces.at(0).page, -1);
  EXPECT_THAT(without_library.warnings,
              ElementsAre(HasSubstr("the material library 'my building.mtl' is not there")));
  fs::copy_file(kModels / "mtl with blanks/my building.mtl", folder / "MY Building.MTL");
  const TexturedModelReading without_picture = ReadTexturedModel(folder / "wall.obj");
  EXPECT_EQ(without_picture.textured.faces.at(0).page, -1);
  EXPECT_THAT(without_picture.warnings,
              ElementsAre(AllOf(HasSubstr("the picture 'photo of wall.jpg' is not there"),
                                HasSubstr("its face is grey"))));
  // Nor does it say its unit, on which a model in metres depends.
  EXPECT_THAT(ConvertModel(folder / "wall.obj", folder / "out.glb", {}).warnings,
              ElementsAre(HasSubstr("its face is grey"),
                          HasSubstr("the unit, ft, is ASSUMED: neither the file nor --unit")));
  folder.Write("Photo of Wall.JPG", "no picture");
  EXPECT_THAT(ReadTexturedModel(folder / "wall.obj").warnings,
              ElementsAre(HasSubstr("its face is grey")));
  folder.Write("MY Building.MTL", "newmtl another\nmap_Kd x.png\n");
  EXPECT_THAT(ReadTexturedModel(folder / "wall.obj").warnings,
              ElementsAre(HasSubstr("no library has the material 'front wall'")));
}

TEST(OutsideModels, PicturesAreFoundAsOtherSystemsNameThem) {
  const TemporaryFolder folder;
  folder.Write("m.obj",
               "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
               "usemtl a\nf 1/1 2/2 3/3\n");
  fs::create_directories(folder / "Maps");
  WriteSrgb8(folder / "Maps/Wall.PNG", Image8(8, 4, 3));
  WriteSrgb8(folder / "brick.png", Image8(8, 4, 3));
  for (const char* line : {"map_Kd maps\\wall.png",
                           "map_Kd ./Maps/Wall.PNG",
                           "map_Kd C:\\Users\\me\\Brick.png",
                           "map_Kd \"brick.png\"",
                           "map_Kd -o 0.5 0 -s 2 2 -clamp on brick.png",
                           "Map_KD -mm 0 1 -bm 0.2 -imfchan r /home/me/brick.png"}) {
    folder.Write("m.mtl", std::string("newmtl a\r\nKd 1 1 1\r\n") + line + "\r\n");
    const TexturedModelReading reading = ReadTexturedModel(folder / "m.obj");
    EXPECT_THAT(reading.warnings, IsEmpty()) << line;
    ASSERT_EQ(reading.textured.faces[0].page, 0) << line;
    if (std::string(line).find("-s 2 2") == std::string::npos) continue;
    // (1, 0) -> (2.5, 0) of 8 x 4 texels, from the picture's bottom.
    EXPECT_EQ(reading.textured.faces[0].corners_texel[1], Eigen::Vector2d(20, 4));
  }
}

}  // namespace
}  // namespace groundglass
