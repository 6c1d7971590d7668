// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/advice.h"
#include "scene/formats/scene_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Scene HallToDouble() {
  return ReadScene(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick");
}

std::vector<std::string> ToldOfDoubles(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene, {}, true)) lines.push_back(FormatAdvice(advice));
  return lines;
}

TEST(AdviseOnDoubles, APhotographThatIsThereTwice) {
  Scene scene = HallToDouble();
  scene.photographs.push_back(scene.photographs[0]);
  scene.photographs.back().name = "twin";
  EXPECT_THAT(ToldOfDoubles(scene), ElementsAre(HasSubstr("this is the very same picture as")));
}

TEST(AdviseOnDoubles, ATagThatWasCopiedFromAnother) {
  Scene scene = HallToDouble();
  scene.photographs[4].tag = scene.photographs[1].tag;
  EXPECT_THAT(ToldOfDoubles(scene),
              Contains(AllOf(HasSubstr("has the position and look-at point of"),
                             HasSubstr("one of the two was copied"))));
}

}  // namespace
}  // namespace groundglass
