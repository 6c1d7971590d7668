// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Kinds of mistakes that the tags alone do not tell, or tell wrongly: the bundled hall with each.
#include "scene/advice/advice.h"
#include "scene/advice/turned_faces.h"
#include "scene/formats/image_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/frames.h"
#include "scene/text.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kHall =
    std::filesystem::path(GROUNDGLASS_SOURCE_DIR) / "datasets-synthetic" / "brick";

using Moved = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Scene Hall() {
  static const Scene scene = ReadScene(kHall);
  return scene;
}

Scene HallWithModel(const Moved& moved, bool turns_faces = false) {
  Scene scene = Hall();
  for (Eigen::Vector3d& point : scene.model.points_in_world) point = moved(point);
  if (!turns_faces) return scene;
  for (Face& face : scene.model.faces) std::reverse(face.points.begin(), face.points.end());
  return scene;
}

Scene HallWithTags(const Moved& moved_in_site) {
  Scene scene = Hall();
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site = moved_in_site(photograph.tag.position_in_site);
    photograph.tag.lookat_in_site = moved_in_site(photograph.tag.lookat_in_site);
  }
  return scene;
}

std::vector<std::string> Told(const Scene& scene,
                              bool with_pictures,
                              const ModelOptions& options = {}) {
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene, options, with_pictures)) {
    lines.push_back(FormatAdvice(advice));
  }
  return lines;
}

TEST(FindOddities, AnOsuWithYUp) {
  // In the file x, z, y of `site`; read as .osu, the second number counts south.
  const auto y_up = [](const auto& p) { return Eigen::Vector3d(p.x(), -p.z(), -p.y()); };
  EXPECT_THAT(Told(HallWithModel(y_up), true), ElementsAre(HasSubstr("; give --up y")));
  EXPECT_THAT(Told(HallWithModel(y_up, true), true),
              ElementsAre(HasSubstr("; give --up y --flip-faces")));
  // x, z, y of `world`: z counts north, which no option reads.
  const auto left_handed = [](const auto& p) { return Eigen::Vector3d(p.x(), -p.z(), p.y()); };
  for (const bool turns_faces : {false, true}) {
    EXPECT_THAT(Told(HallWithModel(left_handed, turns_faces), true),
                ElementsAre(AllOf(HasSubstr("its y axis is up and its z axis counts north"),
                                  HasSubstr("change the sign of every z, and give --up y"))));
  }
}

TEST(FindOddities, AModelMirroredAboutItsMiddle) {
  const Eigen::Vector3d middle = ComputeBounds(Hall().model).Center();
  const auto mirrored = [&](const auto& p) {
    return Eigen::Vector3d(2 * middle.x() - p.x(), p.y(), p.z());
  };
  EXPECT_THAT(Told(HallWithModel(mirrored), true),
              ElementsAre(AllOf(HasSubstr("east and west exchanged"), HasSubstr("82 - x"))));
  // With its fronts in sight nothing but the pictures tells.
  ModelOptions options;
  options.flip_faces = true;
  EXPECT_THAT(Told(HallWithModel(mirrored, true), true, options),
              ElementsAre(AllOf(HasSubstr("as the pictures' edges tell"),
                                HasSubstr("82 - x, and leave out --flip-faces"))));
}

TEST(FindOddities, AllHeightsOffByTheSame) {
  for (const double datum : {-20.0, -8.0, 8.0, 20.0}) {
    const auto lines = Told(HallWithTags([&](const auto& p) {
                              return Eigen::Vector3d(p + Eigen::Vector3d(0, 0, datum));
                            }),
                            true);
    EXPECT_THAT(lines,
                ElementsAre(AllOf(HasSubstr("they count from another zero"),
                                  HasSubstr(datum > 0 ? " less: " : " more: "))))
        << datum;
  }
  // Photographs from a height, of a model and with tags that say so: the pictures suit them.
  Scene scene = Hall();
  const double rise = 20;
  for (Eigen::Vector3d& point : scene.model.points_in_world) point.z() += rise;
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site.z() += rise;
    photograph.tag.lookat_in_site.z() += rise;
  }
  const Eigen::Vector3d low = ComputeBounds(scene.model).min - Eigen::Vector3d(100, 100, rise);
  const int first = static_cast<int>(scene.model.points_in_world.size());
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
    scene.model.points_in_world.push_back(low + corner);
  }
  scene.model.faces.push_back({{first, first + 1, first + 2}, "the street below", 0});
  EXPECT_THAT(Told(scene, true), IsEmpty());
}

TEST(FindOddities, AUnitThatWasStatedWrongly) {
  Scene scene = Hall();
  scene.model.is_unit_assumed = false;
  scene.model.unit = LengthUnit::kMetre;
  EXPECT_THAT(
      Told(scene, false),
      ElementsAre(AllOf(HasSubstr("is stated and may be wrong"), HasSubstr("give --unit ft"))));
  // From a drone people look down.
  for (Photograph& photograph : scene.photographs) photograph.tag.lookat_in_site.z() = 2;
  EXPECT_THAT(Told(scene, false), IsEmpty());
}

TEST(FindOddities, OneAspectThatIsTheWrongWayRound) {
  Scene scene = Hall();
  scene.photographs[4].tag.aspect = 0.667;
  EXPECT_THAT(Told(scene, true),
              ElementsAre(AllOf(HasSubstr("aspect 0.667 does not suit"), HasSubstr("write 1.5"))));
}

TEST(FindOddities, SingleFacesThatAreTurned) {
  // Each by itself; those that are seen and told, and no other.
  const auto turned = [](const std::vector<size_t>& faces) {
    Scene scene = Hall();
    for (const size_t face : faces) {
      std::vector<int>& points = scene.model.faces[face].points;
      std::reverse(points.begin(), points.end());
    }
    std::vector<std::string> names;
    for (const TurnedFace& one : FindTurnedFaces(scene)) {
      names.push_back(DescribeFace(scene.model, one.face));
    }
    return names;
  };
  EXPECT_THAT(turned({}), IsEmpty());
  // The largest one that photographs show.
  const Scene hall = Hall();
  size_t largest = 0;
  std::vector<size_t> half;
  for (size_t face = 0; face < hall.model.faces.size(); ++face) {
    const auto plane = ComputeFacePlane(hall.model, static_cast<int>(face));
    if (face % 2 == 0) half.push_back(face);
    if (std::abs(plane.normal_in_world.z()) > 0.1) continue;
    if (ComputeFaceArea(hall.model, static_cast<int>(face)) >
        ComputeFaceArea(hall.model, static_cast<int>(largest))) {
      largest = face;
    }
  }
  EXPECT_THAT(turned({largest}), ElementsAre(DescribeFace(hall.model, static_cast<int>(largest))));
  EXPECT_GE(turned(half).size(), 3u);
  for (const std::string& name : turned(half)) {
    const bool is_turned = std::any_of(half.begin(), half.end(), [&](size_t face) {
      return DescribeFace(hall.model, static_cast<int>(face)) == name;
    });
    EXPECT_TRUE(is_turned) << name;
  }
}

TEST(FindOddities, ACropWithTheWholeFramesAspect) {
  // A quarter is cut off at its sides.
  Scene scene = Hall();
  Photograph& cropped = scene.photographs[2];
  const ImageSize whole = cropped.size;
  cropped.size.width = whole.width * 3 / 4;
  const std::vector<std::string> told = Told(scene, false);
  ASSERT_EQ(told.size(), 1u);
  const double v = cropped.tag.view_angle_deg;
  const double left = 2 * std::atan(0.75 * std::tan(v * M_PI / 360)) * 180 / M_PI;
  EXPECT_THAT(told[0],
              AllOf(HasSubstr("does not suit " + std::to_string(cropped.size.width) + " x "),
                    HasSubstr("for square pixels): a crop?"),
                    HasSubstr("v " + FormatNumber(std::round(10 * left) / 10)),
                    // An eighth of the whole, of three quarters.
                    HasSubstr("shift_x too, from -0.167 (all of it on the left) to 0.167, or a "
                              "larger sigma_shift")));
  // With its own it is in order.
  cropped.tag.aspect *= 0.75;
  cropped.tag.view_angle_deg = left;
  EXPECT_THAT(Told(scene, false), IsEmpty());
}

TEST(FindOddities, PixelsThatAreOblongByDesignAreNoCrop) {
  // All of them; some of a camera's; one still of a video.
  Scene all = Hall();
  for (Photograph& photograph : all.photographs) photograph.size.width *= 9;
  for (Photograph& photograph : all.photographs) photograph.size.width /= 8;
  EXPECT_THAT(Told(all, false), IsEmpty());
  Scene some = Hall();
  for (size_t i = 0; i < 3; ++i) some.photographs[i].size = all.photographs[i].size;
  EXPECT_THAT(Told(some, false), IsEmpty());
  Scene still = Hall();
  still.photographs[2].size = {720, 480};
  still.photographs[2].tag.aspect = 4.0 / 3;
  EXPECT_THAT(Told(still, false), IsEmpty());
}

TEST(FindOddities, SlipsOfTheDecimalPointAndTheSign) {
  const auto with = [](const std::function<void(ViewTag&)>& spoil) {
    Scene scene = Hall();
    spoil(std::find_if(scene.photographs.begin(), scene.photographs.end(), [](const auto& one) {
            return one.name == "s5";
          })->tag);
    return Told(scene, false);
  };
  EXPECT_THAT(with([](ViewTag& tag) { tag.position_in_site.x() /= 10; }),
              ElementsAre(HasSubstr("with ten times x it would")));
  EXPECT_THAT(with([](ViewTag& tag) { tag.lookat_in_site.z() *= 10; }),
              ElementsAre(HasSubstr("with a tenth of k it would")));
  EXPECT_THAT(with([](ViewTag& tag) { tag.lookat_in_site.x() *= -1; }),
              ElementsAre(HasSubstr("with the sign of i changed")));
  EXPECT_THAT(with([](ViewTag& tag) { tag.lookat_in_site.z() *= -1; }),
              ElementsAre(HasSubstr("with the sign of k changed")));
}

// The hall's model in one unit, its tags in another, as most of six or of all photographs say it.
Scene HallInUnits(double model_per_foot, double tags_per_foot, size_t num_photographs) {
  Scene scene = HallWithTags([&](const auto& p) {
    return Eigen::Vector3d((p * tags_per_foot * 100).array().round() / 100);
  });
  scene.model_file = "hall/model.obj";
  for (Eigen::Vector3d& point : scene.model.points_in_world) point *= model_per_foot;
  scene.photographs.resize(num_photographs);
  return scene;
}

TEST(FindOddities, TheUnitInSpiteOfMistypedTags) {
  struct Units {
    double model_per_foot;
    double tags_per_foot;
    const char* told;
  };
  for (const Units& units : {Units{304.8, 0.3048, "it is in mm and they in m"},
                             Units{304.8, 1, "it is in mm and they in ft"},
                             Units{1, 0.3048, "it is in ft and they in m"},
                             Units{0.3048, 1, "it is in m and they in ft"}}) {
    for (const size_t num_photographs : {6u, 12u}) {
      for (const size_t num_mistyped : {0u, 1u, 2u, 3u}) {
        if (3 * num_mistyped > num_photographs) continue;
        Scene scene = HallInUnits(units.model_per_foot, units.tags_per_foot, num_photographs);
        if (num_mistyped > 0) scene.photographs[0].tag.lookat_in_site.x() *= 4.75;
        if (num_mistyped > 1) scene.photographs[3].tag.position_in_site.y() /= 10;
        if (num_mistyped > 2) scene.photographs[4].tag.position_in_site.x() *= 10;
        EXPECT_THAT(Told(scene, true), testing::Contains(HasSubstr(units.told)))
            << num_mistyped << " of " << num_photographs;
      }
    }
  }
}

TEST(FindOddities, SlipsThatOnlyThePictureTells) {
  const auto with = [](const char* name, TagKey key, double value) {
    Scene scene = Hall();
    SetTagValue(std::find_if(scene.photographs.begin(),
                             scene.photographs.end(),
                             [&](const auto& one) { return one.name == name; })
                    ->tag,
                key,
                value);
    return Told(scene, true);
  };
  EXPECT_THAT(with("s7", TagKey::kX, 64.7), ElementsAre(HasSubstr("x 46.7 (two digits")));
  EXPECT_THAT(with("s7", TagKey::kV, 45), ElementsAre(HasSubstr("v 54 (two digits exchanged)")));
  EXPECT_THAT(with("s3", TagKey::kY, -6.64), ElementsAre(HasSubstr("ten times y")));
  EXPECT_THAT(with("s7", TagKey::kZ, 0.47), ElementsAre(HasSubstr("ten times z")));
  EXPECT_THAT(with("s5", TagKey::kX, 37.3), ElementsAre(HasSubstr("s5.view")));
}

TEST(FindOddities, TheRasterOfAModelWhoseFacesItSpoiled) {
  // A window of 0.4 m far from the origin, through floats: its corners fall together.
  const TemporaryFolder folder;
  folder.Write("model.osu",
               "% unit: m\n8 2\n389412.34375 -5820077.5 35\n389413.34375 -5820078.5 35\n"
               "389413.34375 -5820078.5 38\n389412.34375 -5820077.5 38\n"
               "389412.625 -5820079 35\n389412.625 -5820079 35\n"
               "389412.625 -5820079 36\n389412.625 -5820078 36\n"
               "4 1 2 3 4\n4 5 6 5 6\n");
  const SceneCheck check = CheckScene(folder.path());
  ASSERT_TRUE(check.scene.model.faces.empty());
  EXPECT_THAT(Told(check.scene, false),
              ElementsAre(AllOf(HasSubstr("y (north) lie on a raster of 0.5 m"),
                                HasSubstr("the faults of its faces come of it"))));
}

TEST(FindOddities, ThePicturesAreRightWhereLookAtPointsLieWithinTheBuilding) {
  // Without any one of them too few tags speak for the model as it is, by their look-at points
  // alone.
  for (size_t left_out = 0; left_out < Hall().photographs.size(); left_out += 4) {
    Scene scene = Hall();
    scene.photographs.erase(scene.photographs.begin() + static_cast<std::ptrdiff_t>(left_out));
    EXPECT_THAT(Told(scene, true), IsEmpty()) << left_out;
  }
}

// The orders in which people write x and y, and what is told of each.
struct Order {
  Moved in_site;
  const char* told;
};
std::vector<Order> OtherOrders() {
  return {{[](const auto& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); },
           "change the signs of y and j"},
          {[](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); },
           "exchange x with y, and i with j"},
          {[](const auto& p) { return Eigen::Vector3d(-p.y(), p.x(), p.z()); },
           "write y in place of x, and -x in place of y"},
          {[](const auto& p) { return Eigen::Vector3d(-p.x(), p.y(), p.z()); },
           "change the signs of x and i"}};
}

void MoveAll(Scene& scene, const Moved& moved_in_site) {
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site = moved_in_site(photograph.tag.position_in_site);
    photograph.tag.lookat_in_site = moved_in_site(photograph.tag.lookat_in_site);
  }
}

TEST(FindOddities, TheOrderOfTheAxesThoughLookAtPointsLieBehindTheWalls) {
  // By more than points are met that are on a wall.
  Scene deep = Hall();
  for (Photograph& photograph : deep.photographs) {
    ViewTag& tag = photograph.tag;
    tag.lookat_in_site += 0.16 * (tag.lookat_in_site - tag.position_in_site);
  }
  for (const Order& order : OtherOrders()) {
    Scene scene = deep;
    MoveAll(scene, order.in_site);
    const std::vector<std::string> told = Told(scene, true);
    ASSERT_EQ(told.size(), 1u) << order.told;
    EXPECT_THAT(told[0], HasSubstr(order.told));
    EXPECT_THAT(told[0], testing::Not(HasSubstr("either")));
  }
}

TEST(FindOddities, TheOrderOfTheAxesThoughCamerasLookAtTheModelWithAnother) {
  // About the origin, and nearly square: turned or mirrored, it is looked at all the same.
  const Eigen::Vector3d middle = ComputeBounds(Hall().model).Center();
  Scene centred = HallWithModel([&](const auto& p) { return Eigen::Vector3d(p - middle); });
  MoveAll(centred, [&](const auto& p) { return Eigen::Vector3d(p - SiteFromWorld(middle)); });
  for (const Order& order : OtherOrders()) {
    Scene scene = centred;
    MoveAll(scene, order.in_site);
    const std::vector<std::string> told = Told(scene, true);
    ASSERT_EQ(told.size(), 1u) << order.told;
    EXPECT_THAT(told[0], HasSubstr(order.told));
  }
}

TEST(FindOddities, TwoOrdersOfTheAxesThatSuitTheTagsAlikeAreBothNamed) {
  // A square house with its corner in the origin, and y counted north: turned about, x and y
  // look at it as well.
  TemporaryFolder folder;
  folder.Write("model.osu",
               "8 5\n0 -10 0\n10 -10 0\n10 0 0\n0 0 0\n0 -10 6\n10 -10 6\n10 0 6\n0 0 6\n"
               "4 2 1 5 6\n4 4 3 7 8\n4 3 2 6 7\n4 1 4 8 5\n4 8 7 6 5\n");
  const std::vector<std::string> tags = {"x 4 y -20 z 2 i 5 j 0 k 3",
                                         "x 30 y 5 z 2 i 10 j 6 k 3",
                                         "x 5 y 28 z 2 i 4 j 10 k 3",
                                         "x -22 y 4 z 2 i 0 j 5 k 3"};
  for (size_t i = 0; i < tags.size(); ++i) {
    const std::string name = "s" + std::to_string(i);
    folder.Write("views/" + name + ".view", tags[i] + " a 1.5 v 50\n");
    WriteSrgb8(folder.path() / "images" / (name + ".jpg"), Image8(30, 20, 3, 128));
  }
  for (const bool with_pictures : {false, true}) {  // which show nothing here
    EXPECT_THAT(Told(ReadScene(folder.path()), with_pictures),
                testing::Contains(AllOf(HasSubstr("either "),
                                        HasSubstr("change the signs of y and j"),
                                        HasSubstr("write y in place of x, and -x in place of y"))));
  }
}

}  // namespace
}  // namespace groundglass
