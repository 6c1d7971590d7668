// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/output_folder.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(HashFile, IsSha256) {
  const TemporaryFolder folder;
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(HashFile(folder.Write("abc.txt", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(PrepareOutputFolder, TakesNewAndEmptyFoldersAndItsOwn) {
  const TemporaryFolder folder;
  PrepareOutputFolder(folder.path());
  PrepareOutputFolder(folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  WriteManifest(folder / "a/b", {});
  PrepareOutputFolder(folder / "a/b");
}

TEST(PrepareOutputFolder, RefusesAnybodyElses) {
  const TemporaryFolder folder;
  folder.Write("letters/dear.txt", "Dear");
  EXPECT_NE(ThrownMessage([&] {
              PrepareOutputFolder(folder / "letters");
            }).find("holds files that are not ours"),
            std::string::npos);
  folder.Write("other/manifest.json", "{\"program\": \"another\"}");
  EXPECT_NE(ThrownMessage([&] { PrepareOutputFolder(folder / "other"); }).find("not ours"),
            std::string::npos);
  EXPECT_NE(
      ThrownMessage([&] { PrepareOutputFolder(folder / "letters/dear.txt"); }).find("is a file"),
      std::string::npos);
}

TEST(HasManifest, OnlyForTheSameInputsAndOptions) {
  const TemporaryFolder folder;
  Manifest manifest;
  manifest.command = "run";
  manifest.sha256_of_inputs["model.osu"] = "00";
  EXPECT_FALSE(HasManifest(folder.path(), manifest));
  WriteManifest(folder.path(), manifest);
  EXPECT_TRUE(HasManifest(folder.path(), manifest));
  manifest.sha256_of_inputs["model.osu"] = "01";
  EXPECT_FALSE(HasManifest(folder.path(), manifest));
}

}  // namespace
}  // namespace groundglass
