// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Models as other programs write them, as far as texturing goes: windows cut out by bridges are
// open, faces that lie twice are one, and numbers stay the file's.
#include "invrender/bake.h"
#include "invrender/charts/charts.h"
#include "invrender/photos/face_mask.h"
#include "invrender/selection.h"
#include "scene/face_number.h"
#include "scene/formats/image_io.h"
#include "scene/formats/model_io.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kModels =
    std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "tests/data/models";

TEST(OutsideModels, ThePaneIsSeenThroughTheWindowAndTheWallHasAHole) {
  const TemporaryFolder folder;
  const PolygonModel model = ReadModel(kModels / "holes_by_bridges.obj").model;
  const Camera camera = LookAt({5, -8, 2.5}, {5, 0, 2.5}, 320, 240, 220);
  const Visibility visibility(model);
  const Image16 mask = MakeFaceMask(model, visibility, camera);
  EXPECT_TRUE(mask.values == visibility.FaceLabels(camera).values);
  EXPECT_EQ(*mask.At(160, 120), 6);  // the pane
  EXPECT_EQ(*mask.At(60, 120), 1);   // the wall
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(model, camera, kWaves, folder.path(), "s1")};
  const BakeResult result = BakeTextures(model, photographs);
  const FaceCoverage& wall = result.coverage.faces[0];
  EXPECT_NEAR(wall.area, 38, 1e-9);
  EXPECT_NEAR(wall.covered_area, 38, 0.8);
  // Texels in the hole are none of the wall's.
  EXPECT_NEAR(static_cast<double>(wall.num_texels) * wall.texel_size * wall.texel_size, 38, 0.3);
  EXPECT_GT(result.coverage.faces[5].covered_area, 0.8 * result.coverage.faces[5].area);
  // Nothing of the pane is printed on the wall, nor the other way round.
  for (const int face : {0, 5}) {
    for (const PlacedTexel& texel : TexelsOf(result.model, face)) {
      if (texel.source == 0 || texel.texels_from_border < 3) continue;
      const Eigen::Array3f expected = Waves(texel.point_in_world);
      ASSERT_LT((texel.radiance - expected).abs().maxCoeff(), 0.05) << face;
    }
  }
}

TEST(OutsideModels, NumbersOfFacesStayTheFilesInMasksCoverageAndChoice) {
  // Of five faces the second is a sliver and the third lies on the first.
  const TemporaryFolder folder;
  const PolygonModel model =
      ReadModel(folder.Write("m.obj",
                             "v 0 0 0\nv 10 0 0\nv 10 0 8\nv 0 0 8\nv 20 0 0\nv 20 0 8\n"
                             "g left\nf 1 2 3 4\nf 1 2 2\nf 1 2 3 4\n"
                             "v 10 9 8\ng right\nf 2 5 6 3\ng roof\nf 4 6 7\n"))
          .model;
  ASSERT_EQ(model.faces.size(), 3u);
  const Camera camera = LookAt({10, -20, 4}, {10, 0, 4}, 160, 96, 120);
  BakePhotograph photograph = PhotographPainted(model, camera, kWaves, folder.path(), "s1");
  BakeOptions options;
  Image16 numbers;
  std::mutex mutex;
  options.on_face_mask = [&](const BakePhotograph&, const Image16& mask) {
    const std::lock_guard<std::mutex> lock(mutex);
    numbers = mask;
  };
  const BakeResult result = BakeTextures(model, std::vector{photograph}, options);
  EXPECT_EQ(*numbers.At(60, 48), 1);
  EXPECT_EQ(*numbers.At(100, 48), 4);
  EXPECT_EQ(result.coverage.faces[1].number, 4);
  EXPECT_GT(result.coverage.faces[1].covered_area, 0);

  // The same picture as a hand-painted mask maps back.
  photograph.faces_file = folder / "painted.png";
  WriteLabels(*photograph.faces_file, numbers);
  const BakeResult painted = BakeTextures(model, std::vector{photograph});
  EXPECT_NEAR(painted.coverage.faces[1].covered_area,
              result.coverage.faces[1].covered_area,
              0.06 * result.coverage.faces[1].area);
  WriteLabels(*photograph.faces_file, Image16(160, 96, 1, 3));
  EXPECT_THAT(ThrownMessage([&] { BakeTextures(model, std::vector{photograph}); }),
              HasSubstr("names face 3, which is left out of the model"));

  EXPECT_THAT(FindFaces(model, {"4"}), ElementsAre(1));
  EXPECT_THAT(FindFaces(model, {"2-4"}), ElementsAre(1));
  EXPECT_THAT(FindFaces(model, {"1-5"}), ElementsAre(0, 1, 2));
  EXPECT_THAT(ThrownMessage([&] { FindFaces(model, {"3"}); }),
              HasSubstr("face 3 cannot be used, or lies twice"));
  EXPECT_THAT(ThrownMessage([&] { FindFaces(model, {"6"}); }), HasSubstr("from 1 to 5"));
}

TEST(OutsideModels, CoverageOfDoubledFacesIsThatOfTheSingleModel) {
  const TemporaryFolder folder;
  const std::string single =
      "# unit: m\nv 0 0 0\nv 10 0 0\nv 10 0 8\nv 0 0 8\nv 20 0 0\nv 20 0 8\n"
      "f 1 2 3 4\nf 2 5 6 3\n";
  const PolygonModel once = ReadModel(folder.Write("once.obj", single)).model;
  const PolygonModel twice =
      ReadModel(folder.Write("twice.obj", single + "f 4 3 2 1\nf 3 2 5 6\n")).model;
  const Camera camera = LookAt({10, -20, 4}, {10, 0, 4}, 160, 96, 120);
  const std::vector<BakePhotograph> photographs = {
      PhotographPainted(once, camera, kWaves, folder.path(), "s1")};
  const Coverage first = BakeTextures(once, photographs).coverage;
  const Coverage second = BakeTextures(twice, photographs).coverage;
  ASSERT_EQ(second.faces.size(), 2u);
  EXPECT_GT(first.CoveredShare(), 0.5);
  EXPECT_EQ(second.CoveredShare(), first.CoveredShare());
}

}  // namespace
}  // namespace groundglass
