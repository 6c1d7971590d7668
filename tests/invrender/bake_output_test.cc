// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_output.h"

#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "scene/srgb.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <set>

namespace groundglass {
namespace {

// The lengths of a GLB's box along its own axes, read as any viewer would: the accessors of all
// triangles' corners. The file's nodes may move, but neither turn nor stretch.
Eigen::Vector3d ExtentOfGlb(const std::filesystem::path& file) {
  const std::string bytes = ReadTextFile(file);
  uint32_t json_size = 0;
  std::memcpy(&json_size, bytes.data() + 12, sizeof json_size);
  const nlohmann::json json = nlohmann::json::parse(bytes.substr(20, json_size));
  for (const nlohmann::json& node : json["nodes"]) {
    for (const char* key : {"matrix", "scale", "rotation"}) EXPECT_FALSE(node.contains(key)) << key;
  }
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const nlohmann::json& mesh : json["meshes"]) {
    for (const nlohmann::json& primitive : mesh["primitives"]) {
      const nlohmann::json& accessor =
          json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], accessor["min"][i].get<double>());
        high[i] = std::max(high[i], accessor["max"][i].get<double>());
      }
    }
  }
  return high - low;
}

TEST(WriteBake, AWallOfTwentyFeetMeasuresSixMetresInTheGlbAndTwentyFeetInTheObj) {
  const TemporaryFolder folder;
  PolygonModel model;
  model.unit = LengthUnit::kFoot;
  AddWall(model, 0, 20, 0, 12);
  const Paint waves = [](int, const Eigen::Vector3d& point) { return Waves(point); };
  const std::vector<BakePhotograph> photographs = {PhotographPainted(
      model, LookAt({10, -24, 5}, {10, 0, 6}, 160, 120, 140), waves, folder.path(), "s1")};
  BakeOptions options;
  options.on_face_mask = FaceMaskWriter(folder / "out");
  WriteBake(BakeTextures(model, photographs, options), folder / "out", ".png");
  const Eigen::Vector3d extent = ExtentOfGlb(folder / "out" / "model.glb");
  EXPECT_NEAR(extent.x(), 20 * 0.3048, 1e-5);
  EXPECT_NEAR(extent.y(), 12 * 0.3048, 1e-5);  // y is up
  EXPECT_NEAR(extent.z(), 0, 1e-6);
  EXPECT_NE(ReadTextFile(folder / "out" / "model.obj").find("v 20 0 12"), std::string::npos);
  for (const char* name : {"model_0.png", "provenance_0.png", "coverage.json", "faces/s1.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  }
}

TEST(WriteBake, SixteenBitsInAreSixteenBitsOut) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 20, 0, 12);
  // So faint a ramp that 8 bits have six codes for it.
  const Paint ramp = [](int, const Eigen::Vector3d& point) -> Eigen::Array3f {
    return Eigen::Array3f::Constant(0.2f + 0.001f * static_cast<float>(point.x()));
  };
  const std::vector<BakePhotograph> photographs = {PhotographPainted(
      model, LookAt({10, -24, 5}, {10, 0, 6}, 320, 240, 280), ramp, folder.path(), "s1")};
  BakeOptions options;
  options.fill_gaps = true;
  options.match_colour = false;
  options.pages.bits = 16;
  WriteBake(BakeTextures(model, photographs, options), folder / "out", ".tif");
  // Read back as another program would: places from the OBJ, codes from the picture.
  const Image16 page = ReadSrgb16(folder / "out" / "model_0.tif");
  TexturedModel textured = ReadTexturedModel(folder / "out" / "model.obj").textured;
  textured.pages[0].provenance = Image16(page.width, page.height, 1, 1);
  long num_texels = 0;
  std::set<uint16_t> codes;
  for (const PlacedTexel& texel : TexelsOf(textured, wall)) {
    if (texel.texels_from_border < 3) continue;
    ++num_texels;
    const Eigen::Vector2d& corner = textured.faces[wall].corners_texel[0];
    const Eigen::Vector3d from_corner = texel.point_in_world - model.points_in_world[0];
    const double x = from_corner.dot(texel.right_in_world) / texel.right_in_world.squaredNorm();
    const double y = from_corner.dot(texel.down_in_world) / texel.down_in_world.squaredNorm();
    const uint16_t code =
        page.At(static_cast<int>(corner.x() + x), static_cast<int>(corner.y() + y))[1];
    codes.insert(code);
    ASSERT_NEAR(LinearFromSrgb(code / 65535.0f), 0.2 + 0.001 * texel.point_in_world.x(), 2e-5);
  }
  EXPECT_GT(num_texels, 10000);
  EXPECT_GT(codes.size(), 200u);
}

}  // namespace
}  // namespace groundglass
