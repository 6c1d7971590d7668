// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kCopyAgain = "copy it again from where it came from, or export it once more";

TEST(DamagedModels, AnEmptyFileSaysSo) {
  const TemporaryFolder folder;
  for (const char* name : {"m.obj", "m.ply", "m.stl", "m.glb", "m.gltf"}) {
    EXPECT_THAT(
        ThrownMessage([&] { ReadModel(folder.Write(name, "")); }),
        AllOf(HasSubstr(std::string(name) + ": this model file is empty"), EndsWith(kCopyAgain)));
  }
}

TEST(DamagedModels, AByteOrderMarkDoesNoHarm) {
  const TemporaryFolder folder;
  const std::string mark = "\xEF\xBB\xBF";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid\n";
  for (const auto& [name, text] :
       {std::pair("m.ply", ply), std::pair("m.obj", obj), std::pair("m.stl", stl)}) {
    const ModelReading reading = ReadModel(folder.Write(name, mark + text));
    EXPECT_EQ(reading.model.faces.size(), 1u) << name;
    EXPECT_THAT(reading.warnings, IsEmpty()) << name;
  }
}

std::string Number(uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

// A GLB of one triangle, its picture in the binary part.
std::string Glb(const std::string& picture, const std::string& texture) {
  std::string binary;
  const auto add = [&](float value) {
    binary.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) add(value);
  for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 1.f}) add(value);
  binary += picture;
  while (binary.size() % 4 != 0) binary += '\0';
  std::string json = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0,
    "TEXCOORD_0": 1}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [)" + texture +
                     R"(],
    "images": [{"bufferView": 2, "mimeType": "image/webp"}],
    "buffers": [{"byteLength": )" +
                     std::to_string(binary.size()) + R"(}],
    "bufferViews": [{"buffer": 0, "byteLength": 36},
      {"buffer": 0, "byteOffset": 36, "byteLength": 24},
      {"buffer": 0, "byteOffset": 60, "byteLength": )" +
                     std::to_string(picture.size()) + R"(}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})";
  while (json.size() % 4 != 0) json += ' ';
  const size_t size = 12 + 8 + json.size() + 8 + binary.size();
  return "glTF" + Number(2) + Number(static_cast<uint32_t>(size)) +
         Number(static_cast<uint32_t>(json.size())) + "JSON" + json +
         Number(static_cast<uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
}

TEST(DamagedModels, AGlbSaysWhatIsDamagedAndWhatToDo) {
  const TemporaryFolder folder;
  const std::string sound = Glb("picture", R"({"source": 0})");
  EXPECT_EQ(ReadModel(folder.Write("m.glb", sound)).model.faces.size(), 1u);
  const auto expect = [&](const std::string& bytes, const std::string& fault) {
    EXPECT_THAT(ThrownMessage([&] { ReadModel(folder.Write("m.glb", bytes)); }),
                AllOf(HasSubstr("m.glb: cannot read this glTF model: " + fault),
                      HasSubstr(fault.find("1.0") == std::string::npos ? kCopyAgain : "2.0")));
  };
  expect(sound.substr(0, 15), "it is cut short after 15 bytes");
  expect(sound.substr(0, sound.size() - 10),
         "its header says " + std::to_string(sound.size()) + " bytes, but it has " +
             std::to_string(sound.size() - 10) + ": it is cut short");
  std::string spoilt = sound;
  spoilt[4] = 1;
  expect(spoilt, "it is of glTF 1.0");
  spoilt = sound;
  spoilt[15] = 0x7F;
  expect(spoilt, "its first part is not the JSON of ");
  spoilt = sound;
  spoilt[sound.find(':')] = ';';
  expect(spoilt, "its JSON is damaged or cut short (line 1, column ");
}

TEST(DamagedModels, AGltfThatIsNoneOrCutSaysSo) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return ThrownMessage([&] { ReadModel(folder.Write("m.gltf", text)); });
  };
  EXPECT_THAT(message("a wall"), HasSubstr("it is no glTF, which begins with '{'"));
  EXPECT_THAT(message("{\"asset\": {\"version\": \"2.0\"}, \"sce"),
              AllOf(HasSubstr("its JSON is damaged or cut short"), EndsWith(kCopyAgain)));
}

TEST(Gltf, PicturesInWebPAreRead) {
  const TemporaryFolder folder;
  {
    const auto out = OIIO::ImageOutput::create("webp");
    if (!out) GTEST_SKIP() << "OpenImageIO was built without WebP";
    OIIO::ImageSpec spec(4, 2, 3, OIIO::TypeUInt8);
    ASSERT_TRUE(out->open((folder / "a.webp").string(), spec));
    const std::vector<uint8_t> grey(24, 128);
    ASSERT_TRUE(out->write_image(OIIO::TypeUInt8, grey.data()));
    ASSERT_TRUE(out->close());
  }
  const std::string picture = ReadTextFile(folder / "a.webp");
  for (const char* texture :
       {R"({"extensions": {"EXT_texture_webp": {"source": 0}}})", R"({"source": 0})"}) {
    const TexturedModelReading reading =
        ReadTexturedModel(folder.Write("m.glb", Glb(picture, texture)));
    EXPECT_THAT(reading.warnings, IsEmpty());
    ASSERT_EQ(reading.textured.pages.size(), 1u);
    EXPECT_EQ(reading.textured.pages[0].srgb8.width, 4);
    EXPECT_NEAR(reading.textured.pages[0].srgb8.values[0], 128, 3);
  }
  // One that is not read is named.
  EXPECT_THAT(
      ReadTexturedModel(
          folder.Write("k.glb",
                       Glb(picture, R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})")))
          .warnings,
      ElementsAre(HasSubstr("pictures of the kind 'KHR_texture_basisu' are not read")));
}

}  // namespace
}  // namespace groundglass
