// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/output_stages.h"

#include "scene/formats/view_io.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// A folder in which a stage has left two views.
class Folder : public TemporaryFolder {
 public:
  Folder() {
    OutputStages stages(path(), {});
    stages.Begin("register", "one", {"registration.json", "views/s1.view", "views/s2.view"});
    Write("registration.json", "{}");
    Write("views/s1.view", "x 1");
    Write("views/s2.view", "x 2");
    stages.Finish("register");
  }
  bool Has(const std::string& file) const { return fs::exists(path() / file); }
};

TEST(OutputStages, AStageIsCompleteWithItsKeyAndAllItsFiles) {
  const Folder folder;
  const OutputStages stages(folder.path(), {});
  EXPECT_TRUE(stages.IsComplete("register", "one"));
  EXPECT_FALSE(stages.IsComplete("register", "two"));
  EXPECT_FALSE(stages.IsComplete("texture", "one"));
  fs::remove(folder / "views/s2.view");
  EXPECT_FALSE(stages.IsComplete("register", "one"));
  EXPECT_TRUE(stages.Has("register", "one", "views/s1.view"));
  EXPECT_FALSE(stages.Has("register", "one", "views/s2.view"));
  EXPECT_FALSE(stages.Has("register", "two", "views/s1.view"));
}

TEST(OutputStages, AStageThatWasStoppedIsNotComplete) {
  const Folder folder;
  {
    OutputStages stages(folder.path(), {});
    stages.Begin("texture", "one", {"model.glb"});
    folder.Write("model.glb", "half of the stage");
  }
  const OutputStages stages(folder.path(), {});
  EXPECT_FALSE(stages.IsComplete("texture", "one"));
  EXPECT_TRUE(stages.IsFrom("texture", "one"));
  EXPECT_TRUE(stages.IsComplete("register", "one"));
}

TEST(OutputStages, AFileThatIsCutShortOrChangedIsNotKept) {
  for (const std::string text : {"x", "x 9", ""}) {
    const Folder folder;
    folder.Write("views/s2.view", text);
    OutputStages stages(folder.path(), {});
    EXPECT_FALSE(stages.IsComplete("register", "one")) << text;
    EXPECT_TRUE(stages.Has("register", "one", "views/s1.view")) << text;
    EXPECT_FALSE(stages.Has("register", "one", "views/s2.view")) << text;
    EXPECT_EQ(stages.FindChanged("register"), std::vector<std::string>{"views/s2.view"});
    stages.Begin("register", "one", {"registration.json", "views/s1.view", "views/s2.view"});
    EXPECT_TRUE(folder.Has("views/s1.view")) << text;
    EXPECT_FALSE(folder.Has("views/s2.view")) << "a stop now would leave it";
    folder.Write("views/s2.view", "x 2");
    stages.Finish("register");
    EXPECT_TRUE(stages.IsComplete("register", "one")) << text;
    EXPECT_TRUE(stages.FindChanged("register").empty());
  }
}

TEST(OutputStages, WhatAStageWritesBetweenTwoBeginningsStays) {
  const Folder folder;
  OutputStages stages(folder.path(), {});
  stages.Begin("register", "one", {"views/s1.view"});
  folder.Write("views/s1.view", "x 7");
  stages.Begin("register", "one", {"views/s1.view", "registration.json"});
  EXPECT_EQ(ReadTextFile(folder / "views/s1.view"), "x 7");
  folder.Write("registration.json", "{}");
  stages.Finish("register");
  EXPECT_TRUE(OutputStages(folder.path(), {}).IsComplete("register", "one"));
}

TEST(OutputStages, ARecordOfAnEarlierVersionIsNotComplete) {
  const Folder folder;
  folder.Write("manifest.json",
               R"({"program": "groundglass", "stages": [{"name": "register", "key": "one",
                   "is_complete": true, "files": ["registration.json"]}]})");
  const OutputStages stages(folder.path(), {});
  EXPECT_TRUE(stages.IsFrom("register", "one"));
  EXPECT_FALSE(stages.IsComplete("register", "one"));
}

TEST(OutputStages, WhatAnotherKeyLeftIsRemovedAndNothingElse) {
  const Folder folder;
  folder.Write("views/mine.txt", "somebody's own");
  folder.Write("notes.txt", "somebody's own");
  OutputStages stages(folder.path(), {});
  stages.KeepOnly("register", "one");
  EXPECT_TRUE(folder.Has("views/s2.view"));
  stages.KeepOnly("register", "two");
  stages.Write();
  EXPECT_FALSE(folder.Has("registration.json"));
  EXPECT_FALSE(folder.Has("views/s1.view"));
  EXPECT_TRUE(folder.Has("views/mine.txt"));
  EXPECT_TRUE(folder.Has("notes.txt"));
  ASSERT_TRUE(ReadManifest(folder.path()));
  EXPECT_TRUE(ReadManifest(folder.path())->stages.empty());
}

TEST(OutputStages, FoldersThatBecomeEmptyGo) {
  const Folder folder;
  OutputStages stages(folder.path(), {});
  stages.KeepOnly("register", "two");
  EXPECT_FALSE(folder.Has("views"));
}

TEST(OutputStages, ANarrowerStageRemovesWhatItNoLongerMakes) {
  const Folder folder;
  OutputStages stages(folder.path(), {});
  stages.Begin("register", "one", {"registration.json", "views/s1.view"});
  EXPECT_TRUE(folder.Has("views/s1.view")) << "made with the same key: still right";
  EXPECT_FALSE(folder.Has("views/s2.view"));
  stages.Begin("register", "two", {"registration.json", "views/s1.view"});
  EXPECT_FALSE(folder.Has("views/s1.view")) << "made with another key: no longer right";
}

TEST(OutputStages, AManifestThatNamesFilesElsewhereRemovesNone) {
  const TemporaryFolder folder;
  const fs::path letter = folder.Write("letter.txt", "Dear");
  Manifest manifest;
  manifest.stages = {{"register", "one", true, {"../letter.txt", letter.string(), ".", ""}, {}}};
  fs::create_directories(folder / "out");
  WriteManifest(folder / "out", manifest);
  OutputStages stages(folder / "out", {});
  stages.KeepOnly("register", "two");
  EXPECT_EQ(ReadTextFile(letter), "Dear");
}

}  // namespace
}  // namespace groundglass
