// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/untagged.h"

#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace groundglass {
namespace {

TEST(DescribeUntagged, ExpectsATagWhereTheFolderHasThem) {
  const TemporaryFolder folder;
  const std::string in_views = "photograph without a tag; expected views/s7.view";
  EXPECT_EQ(DescribeUntagged("s7", folder.path()), in_views);
  folder.Write("tags.csv", "image,x\n");
  EXPECT_EQ(DescribeUntagged("s7", folder.path()),
            "photograph without a tag; expected a row in tags.csv for s7");
  std::filesystem::create_directory(folder / "views");
  EXPECT_EQ(DescribeUntagged("s7", folder.path()), in_views) << "views/ is what is read";
}

TEST(DescribeUntagged, ExpectsATagInAFolderThatWasGiven) {
  const TemporaryFolder folder;
  folder.Write("tags.csv", "image,x\n");
  EXPECT_EQ(DescribeUntagged("s7", folder.path(), "found/views"),
            "photograph without a tag; expected a .view file in found/views for s7");
}

}  // namespace
}  // namespace groundglass
