// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The bundled hall, spoiled in every way that people spoil scenes: what is odd is told, with what
// to do; as it is, nothing is.
#include "scene/advice/advice.h"

#include "scene/formats/scene_folder.h"
#include "scene/formats/tags_csv.h"
#include "scene/frames.h"
#include "tests/support/brick_scene.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene ReadBrick() {
  static const Scene scene = ReadScene(kBrick);
  return scene;
}

// As an OBJ in `world` that says no unit.
Scene ReadBrickAsObj() {
  Scene scene = ReadBrick();
  scene.model_file = "hall/model.obj";
  return scene;
}

void MovePoints(Scene& scene, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& moved) {
  for (Eigen::Vector3d& point : scene.model.points_in_world) point = moved(point);
}

void FlipFaces(Scene& scene) {
  for (Face& face : scene.model.faces) std::reverse(face.points.begin(), face.points.end());
}

// Positions and look-at points of every tag.
void MoveTags(Scene& scene, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& moved) {
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site = moved(photograph.tag.position_in_site);
    photograph.tag.lookat_in_site = moved(photograph.tag.lookat_in_site);
  }
}

ViewTag& TagOf(Scene& scene, const std::string& name) {
  return std::find_if(scene.photographs.begin(),
                      scene.photographs.end(),
                      [&](const Photograph& photograph) { return photograph.name == name; })
      ->tag;
}

std::vector<std::string> Oddities(const Scene& scene, const ModelOptions& options = {}) {
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene, options, false)) {
    lines.push_back(FormatAdvice(advice));
  }
  return lines;
}

TEST(FindOddities, AreNoneInGoodScenes) {
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(ReadBrick())) lines.push_back(FormatAdvice(advice));
  EXPECT_THAT(lines, IsEmpty());
  // The same far from the origin, and in metres.
  Scene scene = ReadBrickAsObj();
  scene.model.unit = LengthUnit::kMetre;
  scene.model.is_unit_assumed = false;
  const Eigen::Vector3d origin(389412.35, 5820077.82, 35.8);
  MovePoints(scene, [&](const auto& point) { return Eigen::Vector3d(0.3048 * point + origin); });
  MoveTags(scene, [&](const auto& point) {
    return Eigen::Vector3d(0.3048 * point + SiteFromWorld(origin));
  });
  EXPECT_THAT(Oddities(scene), IsEmpty());
}

TEST(FindOddities, AreNoneInRealPhotographs) {
  const char* data = std::getenv("GROUNDGLASS_DATA");
  const std::filesystem::path folder =
      (data != nullptr ? std::filesystem::path(data)
                       : std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "../shared/data") /
      "sceaux";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no " << folder;
  EXPECT_THAT(FindOddities(ReadScene(folder)), IsEmpty());
}

TEST(FindOddities, MillimetresTakenForFeet) {
  for (const double scale : {304.8, 30.48, 0.3048}) {
    Scene scene = ReadBrick();
    scene.model.is_unit_assumed = true;
    MovePoints(scene, [&](const auto& point) { return Eigen::Vector3d(scale * point); });
    MoveTags(scene, [&](const auto& point) { return Eigen::Vector3d(scale * point); });
    const std::string unit = scale > 100 ? "mm" : scale > 10 ? "cm" : "m";
    EXPECT_THAT(Oddities(scene),
                ElementsAre(AllOf(HasSubstr("only assumed"), HasSubstr("give --unit " + unit))));
    // Somebody who says the unit is believed, as long as it can be.
    scene.model.is_unit_assumed = false;
    EXPECT_THAT(Oddities(scene),
                ElementsAre(scale > 100 ? HasSubstr("too large")
                                        : HasSubstr("is stated and may be wrong")));
    scene.model.unit = *FindUnit(unit);
    EXPECT_THAT(Oddities(scene), IsEmpty());
  }
}

TEST(FindOddities, AModelAndTagsInDifferentUnits) {
  Scene scene = ReadBrickAsObj();
  MovePoints(scene, [](const auto& point) { return Eigen::Vector3d(304.8 * point); });
  MoveTags(scene, [](const auto& point) { return Eigen::Vector3d(0.3048 * point); });
  EXPECT_THAT(Oddities(scene),
              ElementsAre(AllOf(HasSubstr("1000 times as large as the tags'"),
                                HasSubstr("--unit mm --to-unit m"))));
  scene = ReadBrickAsObj();
  MovePoints(scene, [](const auto& point) { return Eigen::Vector3d(0.3048 * point); });
  EXPECT_THAT(Oddities(scene), ElementsAre(HasSubstr("--unit m --to-unit ft")));
  // A command that can be typed as it stands, wherever one is.
  scene.folder = "my hall";
  scene.model_file = "my hall/model.obj";
  EXPECT_THAT(Oddities(scene),
              ElementsAre(HasSubstr("groundglass convert 'my hall/model.obj' 'my "
                                    "hall/model-in-ft.osu' --unit m --to-unit ft, and from then "
                                    "on give --model 'my hall/model-in-ft.osu'")));
}

TEST(FindOddities, AMirroredModel) {
  Scene scene = ReadBrickAsObj();
  MovePoints(scene, SiteFromWorld);
  EXPECT_THAT(Oddities(scene),
              ElementsAre(AllOf(HasSubstr("mirrored"), HasSubstr("--frame site"))));
  // Read so, it is in order.
  ModelOptions options;
  options.mesh_axes = MeshAxes::kSite;
  EXPECT_THAT(Oddities(ReadBrickAsObj(), options), IsEmpty());
  // About the origin it is looked at from everywhere all the same.
  const Eigen::Vector3d middle = ComputeBounds(ReadBrick().model).Center();
  scene = ReadBrickAsObj();
  MovePoints(scene, [&](const auto& point) { return SiteFromWorld(point - middle); });
  MoveTags(scene,
           [&](const auto& point) { return Eigen::Vector3d(point - SiteFromWorld(middle)); });
  // Its faces show their backs: turned about, they would do as well for all that the tags tell,
  // which look at about the same points of a building whose sides are alike.
  EXPECT_THAT(Oddities(scene),
              ElementsAre(AllOf(HasSubstr("clockwise"),
                                HasSubstr("mirrored"),
                                HasSubstr("with --flip-faces and with --frame site"))));
  // Only one of the two has its edges in the pictures.
  const auto with_pictures = [](const Scene& spoiled) {
    std::vector<std::string> lines;
    for (const Advice& advice : FindOddities(spoiled)) lines.push_back(FormatAdvice(advice));
    return lines;
  };
  EXPECT_THAT(with_pictures(scene), ElementsAre(HasSubstr("; give --frame site")));
  Scene clockwise = ReadBrickAsObj();
  MovePoints(clockwise, [&](const auto& point) { return Eigen::Vector3d(point - middle); });
  clockwise.photographs = scene.photographs;
  FlipFaces(clockwise);
  EXPECT_THAT(with_pictures(clockwise), ElementsAre(HasSubstr("; give --flip-faces")));
  // With its fronts turned back by the program that wrote it, either may be meant.
  scene = ReadBrickAsObj();
  MovePoints(scene, SiteFromWorld);
  FlipFaces(scene);
  EXPECT_THAT(Oddities(scene),
              ElementsAre(AllOf(HasSubstr("change the signs of y and j"),
                                HasSubstr("--frame site --flip-faces"))));
  // An .osu whose y counts north.
  scene = ReadBrick();
  MovePoints(scene, SiteFromWorld);
  EXPECT_THAT(Oddities(scene), ElementsAre(HasSubstr("give --frame world")));
}

TEST(FindOddities, AModelOnItsBack) {
  Scene scene = ReadBrickAsObj();
  MovePoints(scene, [](const auto& p) { return Eigen::Vector3d(p.x(), p.z(), -p.y()); });
  EXPECT_THAT(Oddities(scene), ElementsAre(AllOf(HasSubstr("on its back"), HasSubstr("--up y"))));
  // A glTF with z up.
  scene = ReadBrickAsObj();
  scene.model_file = "hall/model.glb";
  MovePoints(scene, [](const auto& p) { return Eigen::Vector3d(p.x(), -p.z(), p.y()); });
  EXPECT_THAT(Oddities(scene), ElementsAre(HasSubstr("--up z")));
}

TEST(FindOddities, FacesThatShowTheirBacks) {
  Scene scene = ReadBrick();
  FlipFaces(scene);
  EXPECT_THAT(Oddities(scene), ElementsAre(AllOf(HasSubstr("backs"), HasSubstr("--flip-faces"))));
}

TEST(FindOddities, CoordinatesSavedAsFloats) {
  const auto moved = [](double northing, bool is_single) {
    Scene scene = ReadBrickAsObj();
    scene.model.unit = LengthUnit::kMetre;
    const Eigen::Vector3d origin(389412.35, northing, 35.8);
    MovePoints(scene, [&](const auto& point) {
      const Eigen::Vector3d exact = 0.3048 * point + origin;
      return is_single ? Eigen::Vector3d(exact.cast<float>().template cast<double>()) : exact;
    });
    MoveTags(scene, [&](const auto& point) {
      return Eigen::Vector3d(0.3048 * point + SiteFromWorld(origin));
    });
    return Oddities(scene);
  };
  EXPECT_THAT(moved(5820077.82, true),
              ElementsAre(AllOf(HasSubstr("raster of 0.5 m"), HasSubstr("double precision"))));
  EXPECT_THAT(moved(5820077.82, false), IsEmpty());
}

TEST(FindOddities, TagsInAnotherOrder) {
  const auto with = [](const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& order) {
    Scene scene = ReadBrick();
    MoveTags(scene, order);
    return Oddities(scene);
  };
  EXPECT_THAT(with([](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); }),
              ElementsAre(HasSubstr("exchange x with y, and i with j")));
  EXPECT_THAT(with([](const auto& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); }),
              ElementsAre(HasSubstr("change the signs of y and j")));
  EXPECT_THAT(with([](const auto& p) { return Eigen::Vector3d(-p.y(), p.x(), p.z()); }),
              ElementsAre(HasSubstr("write y in place of x, and -x in place of y")));
  EXPECT_THAT(with([](const auto& p) { return Eigen::Vector3d(p + Eigen::Vector3d(0, 0, 1012)); }),
              ElementsAre(AllOf(HasSubstr("1012 ft"), HasSubstr("another zero"))));
  EXPECT_THAT(with([](const auto& p) { return Eigen::Vector3d(p + Eigen::Vector3d(9e5, 5e6, 0)); }),
              ElementsAre(HasSubstr("the same origin")));
}

TEST(FindOddities, OneTagThatIsWrong) {
  const auto with = [](const std::function<void(ViewTag&)>& spoil) {
    Scene scene = ReadBrick();
    spoil(TagOf(scene, "s5"));
    return Oddities(scene);
  };
  EXPECT_THAT(
      with([](ViewTag& tag) { std::swap(tag.position_in_site.x(), tag.position_in_site.y()); }),
      ElementsAre(AllOf(HasSubstr("s5.view"), HasSubstr("with x and y exchanged"))));
  EXPECT_THAT(with([](ViewTag& tag) {
                tag.position_in_site = {30, 20, 5};
              }),
              ElementsAre(AllOf(HasSubstr("s5.view"), HasSubstr("inside the model"))));
  EXPECT_THAT(with([](ViewTag& tag) { tag.position_in_site.z() = -40; }),
              ElementsAre(AllOf(HasSubstr("s5.view"), HasSubstr("below the ground, 40 ft"))));
  EXPECT_THAT(with([](ViewTag& tag) { tag.position_in_site.z() *= -1; }),
              ElementsAre(HasSubstr("without the minus")));
  EXPECT_THAT(with([](ViewTag& tag) { tag.position_in_site *= 40; }),
              ElementsAre(AllOf(HasSubstr("s5.view"), HasSubstr("of its view angle"))));
  EXPECT_THAT(with([](ViewTag& tag) {
                tag.lookat_in_site = 2 * tag.position_in_site - tag.lookat_in_site;
              }),
              ElementsAre(HasSubstr("the whole model lies behind this camera")));
}

TEST(FindOddities, OneOddRowOfATableDoesNotSilenceTheOthers) {
  // Rows of a table have no file of their own: each is told under its photograph's name.
  Scene scene = ReadBrick();
  for (Photograph& photograph : scene.photographs) photograph.view_file.clear();
  TagOf(scene, "s3").position_in_site.z() = -500;
  TagOf(scene, "s5").position_in_site.x() /= 10;
  TagOf(scene, "s7").lookat_in_site.x() *= -1;
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene)) lines.push_back(FormatAdvice(advice));
  EXPECT_THAT(lines,
              ElementsAre(HasSubstr("tags.csv: s3: the camera stands below the ground"),
                          HasSubstr("tags.csv: s5: "),
                          HasSubstr("tags.csv: s7: ")));
}

TEST(FindOddities, TheSameAngleUprightAndLying) {
  Scene scene = ReadBrick();
  Photograph& upright = scene.photographs[4];
  std::swap(upright.size.width, upright.size.height);
  upright.tag.aspect = 1 / upright.tag.aspect;
  EXPECT_THAT(
      Oddities(scene),
      ElementsAre(AllOf(HasSubstr("suits as the vertical angle"), HasSubstr("write v 37.52"))));
  upright.tag.view_angle_deg = 37.52;
  EXPECT_THAT(Oddities(scene), IsEmpty());
}

// Pictures that are spoiled, in a folder of their own.
class SpoiledPictures : public TemporaryFolder {
 public:
  explicit SpoiledPictures(const std::vector<size_t>& which,
                           const std::function<Image8(const Image8&)>& spoil)
      : scene(ReadBrick()) {
    std::vector<Photograph> photographs;
    for (const size_t i : which) {
      Photograph& photograph = photographs.emplace_back(scene.photographs[i]);
      const Image8 picture = spoil(ReadSrgb8(photograph.image_file));
      photograph.image_file = path() / photograph.image_file.filename();
      photograph.size = {picture.width, picture.height};
      WriteSrgb8(photograph.image_file, picture);
    }
    scene.photographs = std::move(photographs);
  }
  std::vector<std::string> Oddities() const {
    std::vector<std::string> lines;
    for (const Advice& advice : FindOddities(scene)) lines.push_back(FormatAdvice(advice));
    return lines;
  }

  Scene scene;
};

Image8 Transposed(const Image8& picture,
                  const std::function<std::array<int, 2>(int, int)>& from,
                  int width,
                  int height) {
  Image8 result(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [u, v] = from(x, y);
      std::copy_n(picture.At(u, v), 3, result.At(x, y));
    }
  }
  return result;
}

TEST(FindOddities, PicturesUpsideDownOrMirrored) {
  const auto turned = [](const Image8& p) {
    return Transposed(
        p,
        [&](int x, int y) {
          return std::array{p.width - 1 - x, p.height - 1 - y};
        },
        p.width,
        p.height);
  };
  const auto mirrored = [](const Image8& p) {
    return Transposed(
        p,
        [&](int x, int y) {
          return std::array{p.width - 1 - x, y};
        },
        p.width,
        p.height);
  };
  EXPECT_THAT(SpoiledPictures({0, 1, 2, 3}, turned).Oddities(),
              ElementsAre(HasSubstr("turned by 180 degrees")));
  EXPECT_THAT(SpoiledPictures({0, 1, 2, 3}, mirrored).Oddities(),
              ElementsAre(HasSubstr("mirrored left to right")));
}

TEST(FindOddities, APictureThatFitsOnlyTurnedAndFarFromItsTagsPlaceIsChance) {
  // Turned and moved across by a tenth of its width: turned back, it would not lie where a right
  // tag has it.
  const auto moved = [](const Image8& p) {
    return Transposed(
        p,
        [&](int x, int y) {
          return std::array{(p.width - 1 - x + p.width / 10) % p.width, p.height - 1 - y};
        },
        p.width,
        p.height);
  };
  for (const std::string& line : SpoiledPictures({0, 1}, moved).Oddities()) {
    EXPECT_THAT(line, testing::Not(HasSubstr("turned by 180 degrees")));
  }
}

TEST(FindOddities, APictureOnItsSide) {
  const auto on_its_side = [](const Image8& p) {
    return Transposed(
        p,
        [&](int x, int y) {
          return std::array{y, p.height - 1 - x};
        },
        p.height,
        p.width);
  };
  EXPECT_THAT(SpoiledPictures({0}, on_its_side).Oddities(),
              ElementsAre(AllOf(HasSubstr("does not suit s1.jpg of 800 x 1200 pixels"),
                                HasSubstr("is the picture turned?"))));
}

TEST(FindOddities, ViewAnglesOfTheOtherSide) {
  Scene scene = ReadBrick();
  scene.photographs.resize(4);
  for (Photograph& photograph : scene.photographs) {
    const double half = std::tan(RadiansFromDegrees(photograph.tag.view_angle_deg) / 2);
    photograph.tag.view_angle_deg = 2 * DegreesFromRadians(std::atan(half / photograph.tag.aspect));
  }
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("v is the vertical view angle"));
  EXPECT_EQ(found[0].severity, Advice::Severity::kScene);
}

}  // namespace
}  // namespace groundglass
