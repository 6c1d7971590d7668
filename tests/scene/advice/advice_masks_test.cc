// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {
namespace {

// What is told of the hall's masks where each is all of one code but for a strip on the right.
std::vector<std::string> ToldOfMasks(uint8_t code) {
  const TemporaryFolder folder;
  Scene scene =
      ReadScene(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick");
  scene.photographs.resize(2);
  for (Photograph& photograph : scene.photographs) {
    Image8 mask(photograph.size.width, photograph.size.height, 1, code);
    for (int y = 0; y < mask.height; ++y) {
      for (int x = mask.width - 8; x < mask.width; ++x) {
        mask.At(x, y)[0] = static_cast<uint8_t>(255 - code);
      }
    }
    photograph.mask_file = folder / (photograph.name + ".png");
    WriteSrgb8(*photograph.mask_file, mask);
  }
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene)) {
    if (FormatAdvice(advice).find("mask") != std::string::npos)
      lines.push_back(FormatAdvice(advice));
  }
  return lines;
}

TEST(AdviseOnMasks, MasksThatHideTheBuildingAreTold) {
  EXPECT_THAT(ToldOfMasks(255),
              testing::ElementsAre(testing::HasSubstr(
                  "the masks of s1 and s2 hide nearly all that the tag sees of the model")));
  EXPECT_THAT(ToldOfMasks(0), testing::IsEmpty());
}

}  // namespace
}  // namespace groundglass
