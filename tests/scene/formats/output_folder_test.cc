// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/output_folder.h"

#include "scene/error.h"
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

TEST(PrepareOutputFolder, AFolderThatAnotherRunWritesIntoIsRefused) {
  const TemporaryFolder folder;
  {
    const FolderLock first = PrepareOutputFolder(folder / "out");
    // The system tells two openings of a folder apart, in one process too.
    EXPECT_NE(ThrownMessage([&] {
                PrepareOutputFolder(folder / "out");
              }).find("another groundglass is at work in this folder"),
              std::string::npos);
    PrepareOutputFolder(folder / "other");
  }
  PrepareOutputFolder(folder / "out");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out")) << "the lock leaves no file";
}

TEST(Manifest, KeepsTheStages) {
  const TemporaryFolder folder;
  EXPECT_FALSE(ReadManifest(folder.path()));
  Manifest manifest;
  manifest.seed = 1988;
  manifest.options = {{"bits", "8"}};
  manifest.stages = {
      {"register", "00", true, {"registration.json", "views/s1.view"}, {{"views/s1.view", "ab"}}},
      {"texture", "01", false, {}, {}}};
  WriteManifest(folder.path(), manifest);
  const std::optional<Manifest> read = ReadManifest(folder.path());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->seed, 1988u);
  EXPECT_EQ(read->options, manifest.options);
  const std::vector<StageRecord>& stages = read->stages;
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].key, "00");
  EXPECT_TRUE(stages[0].is_complete);
  EXPECT_EQ(stages[0].files, manifest.stages[0].files);
  EXPECT_EQ(stages[0].sha256_of_files, manifest.stages[0].sha256_of_files);
  EXPECT_FALSE(stages[1].is_complete);
  folder.Write("manifest.json", "{\"program\": \"groundglass\", \"stages\": 3}");
  ASSERT_TRUE(ReadManifest(folder.path()));
  EXPECT_TRUE(ReadManifest(folder.path())->stages.empty());
  EXPECT_TRUE(IsManifestDamaged(folder.path()));
}

TEST(Manifest, OneThatIsCutShortIsStillOurs) {
  const TemporaryFolder folder;
  EXPECT_FALSE(IsManifestDamaged(folder.path()));
  WriteManifest(folder.path(), {});
  EXPECT_FALSE(IsManifestDamaged(folder.path()));
  const std::string whole = FormatManifest({});
  folder.Write("manifest.json", whole.substr(0, whole.size() - 5));
  EXPECT_TRUE(IsManifestDamaged(folder.path()));
  ASSERT_TRUE(ReadManifest(folder.path()));
  EXPECT_TRUE(ReadManifest(folder.path())->stages.empty());
  PrepareOutputFolder(folder.path());
}

// As a power cut leaves it.
TEST(Manifest, OneOfZerosIsOursBesideARegistration) {
  const TemporaryFolder folder;
  folder.Write("manifest.json", std::string(200, '\0'));
  EXPECT_THROW(PrepareOutputFolder(folder.path()), Error);
  folder.Write("registration.json", "{\"photographs\": []}");
  EXPECT_TRUE(IsManifestDamaged(folder.path()));
  PrepareOutputFolder(folder.path());
  folder.Write("manifest.json", "{\"program\": \"another\"}");
  EXPECT_THROW(PrepareOutputFolder(folder.path()), Error);
}

}  // namespace
}  // namespace groundglass
