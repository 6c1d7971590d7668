// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/convert.h"

#include "scene/formats/colmap_io.h"
#include "scene/formats/view_io.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;

TEST(ConvertCameras, ViewsToColmapAndBackGiveTheSameCameras) {
  const TemporaryFolder folder;
  ConvertViewsToColmap(kBrick / "views", folder / "colmap", kBrick / "images");
  const std::vector<NamedCamera> cameras = ReadColmapModel(folder / "colmap");
  ASSERT_EQ(cameras.size(), 12u);
  EXPECT_EQ(cameras[1].name, "s2.jpg");
  ConvertColmapToViews(folder / "colmap", folder / "views", 50);
  const Camera first = CameraFromTag(ReadView(kBrick / "views/s2.view"), 1200, 800);
  const Camera again = CameraFromTag(ReadView(folder / "views/s2.view"), 1200, 800);
  EXPECT_LT((first.cam_from_world.rotation - again.cam_from_world.rotation).norm(), 1e-12);
  EXPECT_LT((first.PositionInWorld() - again.PositionInWorld()).norm(), 1e-11);
  EXPECT_NEAR(first.focal_x_px, again.focal_x_px, 1e-9);
}

TEST(ConvertModel, OsuToObjAndBackIsTheSameModel) {
  const TemporaryFolder folder;
  ConvertModel(kBrick / "model.osu", folder / "m.obj", {});
  ConvertModel(folder / "m.obj", folder / "a.osu", {});
  ConvertModel(kBrick / "model.osu", folder / "b.osu", {});
  EXPECT_EQ(ReadTextFile(folder / "a.osu"), ReadTextFile(folder / "b.osu"));
}

TEST(ConvertModel, RefusesFormatsThatItCannotWrite) {
  EXPECT_THAT(ThrownMessage([] { ConvertModel(kBrick / "model.osu", "m.ply", {}); }),
              HasSubstr("m.ply: a model is written as .osu, .obj or .glb"));
  const TemporaryFolder folder;
  EXPECT_THAT(ThrownMessage([&] { ConvertModel(folder / "no.obj", "m.ply", {}); }),
              HasSubstr("no.obj: no such model file"));
  EXPECT_THAT(ThrownMessage([&] { ConvertModel(folder.Write("a.txt", "?"), "m.ply", {}); }),
              HasSubstr("a.txt: this kind of model is not read"));
  const auto model = folder.Write("a.osu", ReadTextFile(kBrick / "model.osu"));
  EXPECT_THAT(ThrownMessage([&] { ConvertModel(model, folder.path() / "./a.osu", {}); }),
              HasSubstr("would be written over the input itself"));
}

}  // namespace
}  // namespace groundglass
