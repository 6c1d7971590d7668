// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Damaged files of other programs give sound cameras, or a model, or one line; never a crash, an
// endless loop or a picture that no memory holds.
#include "exchange/camera_exchange.h"
#include "exchange/city_gml.h"
#include "exchange/formats.h"
#include "scene/camera_check.h"
#include "scene/error.h"
#include "tests/exchange/test_camera.h"
#include "tests/fuzz/mutate.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace groundglass {
namespace {

void ExpectOneLine(const std::string& message, const std::string& start) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with(start)) << message;
}

struct ExchangeSample {
  const char* name;
  std::vector<std::string> dictionary;
  std::function<std::string()> make;                  // a sound file
  std::function<std::string(std::string)> wrap = {};  // around what is damaged
};

// Two cameras, so that one can be lost.
ExchangeScene TwoViews() {
  ExchangeScene scene = SceneOf(OffCentreCamera());
  scene.cameras.push_back({"s4", "s4.jpg", TurnedCamera(OffCentreCamera(), 1), {}});
  return scene;
}

std::string FspyJsonPart() {
  return FormatFspy(SceneOf(OffCentreCamera()), "/t")[0].bytes.substr(16);
}

// The sizes are those of what is there.
std::string WithFspyHead(const std::string& json) {
  std::string bytes = "fspy";
  for (const uint32_t word : {uint32_t{1}, static_cast<uint32_t>(json.size()), uint32_t{0}}) {
    char raw[sizeof word];
    std::memcpy(raw, &word, sizeof word);
    bytes.append(raw, sizeof word);
  }
  return bytes + json;
}

class ExchangeFuzz : public testing::TestWithParam<ExchangeSample> {};

// What was read can be written wherever a frame can hold it.
void TryToUse(const ExchangeSource& source) {
  for (const NamedCamera& named : source.cameras) {
    ASSERT_EQ(FindCameraFault(named.camera), "");
    for (const CameraNeeds& needs : {CameraNeeds{}, CameraNeeds{true, true, true}}) {
      try {
        const Camera prepared = PreparedCamera(named.camera, needs);
        ASSERT_EQ(FindSizeFault(prepared.width_px, prepared.height_px), "");
      } catch (const Error& error) {
        ExpectOneLine(error.what(), "a picture that shows all");
      }
    }
  }
}

TEST_P(ExchangeFuzz, DamagedFilesGiveSoundCamerasOrOneLine) {
  const ExchangeSample& sample = GetParam();
  const TemporaryFolder folder;
  const std::string sound = sample.make();
  std::mt19937_64 random(17);
  const int rounds = FuzzRounds() / 4;
  int num_read = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    const std::string damaged = Mutate(sound, sample.dictionary, random);
    const auto file = folder.Write(sample.name, sample.wrap ? sample.wrap(damaged) : damaged);
    try {
      const ExchangeSource source = ReadExchangeSource(file, {});
      ASSERT_FALSE(source.cameras.empty());
      for (const std::string& warning : source.warnings) ExpectOneLine(warning, file.string());
      TryToUse(source);
      ++num_read;
    } catch (const Error& error) {
      ExpectOneLine(error.what(), file.string());
    }
  }
  // The damage leaves enough files whole that both outcomes are tried.
  EXPECT_GT(num_read, rounds / 100);
  EXPECT_LT(num_read, rounds);
}

const std::vector<std::string> kXmlWords = {
    "<", "/>", "&#0;", "&#x110000;", "<![CDATA[", "-->", "\"0\"", "0 0 0 0", "1e300", "<camera>"};
const std::vector<std::string> kJsonWords = {
    "null", "[]", "{}", "1e300", "-1e-300", "\"w\"", "0.5", "[[1]]", "true", "\"\\u0000\""};

INSTANTIATE_TEST_SUITE_P(
    Formats,
    ExchangeFuzz,
    testing::Values(
        ExchangeSample{"transforms.json",
                       kJsonWords,
                       [] { return FormatNerfstudio(TwoViews(), "/t/t.json")[0].bytes; }},
        ExchangeSample{"p.fspy", kJsonWords, FspyJsonPart, WithFspyHead},
        ExchangeSample{"whole.fspy", kJsonWords, [] { return WithFspyHead(FspyJsonPart()); }},
        ExchangeSample{
            "p.mlp", kXmlWords, [] { return FormatMeshLab(TwoViews(), "/t/p.mlp")[0].bytes; }},
        ExchangeSample{
            "c.xml", kXmlWords, [] { return FormatMetashape(TwoViews(), "/t/c.xml")[0].bytes; }}),
    [](const auto& entry) {
      std::string name = entry.param.name;
      for (char& c : name) c = c == '.' ? '_' : c;
      return name;
    });

TEST(CityGmlFuzz, DamagedFilesGiveAModelOrOneLine) {
  const std::string sound =
      R"(<?xml version="1.0"?><CityModel xmlns:gml="http://www.opengis.net/gml">
<cityObjectMember><bldg:Building><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>
<gml:Polygon><gml:name>wall</gml:name><gml:exterior><gml:LinearRing><gml:posList>0 0 0 10 0 0 10 0 5 0 0 5 0 0 0</gml:posList></gml:LinearRing></gml:exterior>
<gml:interior><gml:LinearRing><gml:posList>3 0 1 3 0 4 7 0 4 7 0 1 3 0 1</gml:posList></gml:LinearRing></gml:interior></gml:Polygon>
<gml:Polygon><gml:exterior><gml:LinearRing><gml:pos>0 0 0</gml:pos><gml:pos>0 9 0</gml:pos><gml:pos>0 9 5</gml:pos></gml:LinearRing></gml:exterior></gml:Polygon>
</gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building></cityObjectMember></CityModel>
)";
  const TemporaryFolder folder;
  std::mt19937_64 random(18);
  const int rounds = FuzzRounds() / 4;
  int num_read = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    const auto file = folder.Write("m.gml", Mutate(sound, kXmlWords, random));
    try {
      const PolygonModel model = ReadCityGml(file).model;
      ASSERT_FALSE(model.faces.empty());
      for (const Face& face : model.faces) ASSERT_GE(face.points.size(), 3u);
      ++num_read;
    } catch (const Error& error) {
      ExpectOneLine(error.what(), file.string());
    }
  }
  EXPECT_GT(num_read, rounds / 50);
  EXPECT_LT(num_read, rounds);
}

}  // namespace
}  // namespace groundglass
