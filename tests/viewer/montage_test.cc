// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/montage.h"

#include "scene/colour_page.h"
#include "scene/error.h"
#include "scene/srgb.h"
#include "scene/visibility.h"
#include "tests/viewer/montage_samples.h"
#include "tests/viewer/sample_models.h"
#include "viewer/montage_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

using testing::HasSubstr;

// A box whose faces each have a plain colour, from `low` to `high`.
void AddBox(const Eigen::Vector3d& low,
            const Eigen::Vector3d& high,
            const std::array<float, 3>& colour,
            TexturedModel& model) {
  const int page = static_cast<int>(model.pages.size());
  ColourPage colours;
  colours.Add(colour, page, 4);
  model.pages.push_back(colours.Page());
  const int first = static_cast<int>(model.model.points_in_world.size());
  for (const double z : {low.z(), high.z()}) {
    model.model.points_in_world.insert(model.model.points_in_world.end(),
                                       {{low.x(), low.y(), z},
                                        {high.x(), low.y(), z},
                                        {high.x(), high.y(), z},
                                        {low.x(), high.y(), z}});
  }
  for (const std::vector<int>& corners : {std::vector<int>{3, 2, 1, 0},
                                          {4, 5, 6, 7},
                                          {0, 1, 5, 4},
                                          {1, 2, 6, 5},
                                          {2, 3, 7, 6},
                                          {3, 0, 4, 7}}) {
    Face& face = model.model.faces.emplace_back();
    for (const int corner : corners) face.points.push_back(first + corner);
    model.faces.push_back(ColourPage().Add(colour, page, corners.size()));
  }
}

// A hall, and in `WithWing` a wing behind it and to its right, partly hidden by it.
TexturedModel Hall() {
  TexturedModel hall;
  AddBox({-6, -3, 0}, {2, 3, 5}, {0.45f, 0.2f, 0.12f}, hall);
  return hall;
}
TexturedModel WithWing() {
  TexturedModel both = Hall();
  AddBox({-1, 4, 0}, {6, 9, 6.5}, {0.6f, 0.6f, 0.5f}, both);
  return both;
}

// Off its middle, a little turned, through a lens that bends.
Camera BentCamera() {
  Camera camera = MakeCamera({5, -22, 3}, {0, 0, 2.5}, 240, 160, 210);
  camera.center_x_px += 11;
  camera.center_y_px -= 6;
  camera.focal_y_px *= 1.03;
  camera.k1 = -0.12;
  return camera;
}

// By rays, side x side of them in each pixel: the picture of a model in a light on an even ground,
// linear light, and how much of each pixel shows faces from `first_counted` on.
struct Truth {
  ImageF radiance;
  ImageF cover;
};
Truth TraceTruth(const TexturedModel& model,
                 const MontageLight& light,
                 const Camera& camera,
                 int first_counted,
                 int side) {
  const Visibility visibility(model.model);
  Truth truth = {ImageF(camera.width_px, camera.height_px, 3),
                 ImageF(camera.width_px, camera.height_px, 1)};
  const Eigen::Vector3d eye = camera.PositionInWorld();
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      for (int i = 0; i < side * side; ++i) {
        const int row = i / side;
        const Eigen::Vector2d at(x + (i % side + 0.5) / side, y + (row + 0.5) / side);
        const auto hit = visibility.FirstHit(eye, UnprojectToWorld(camera, at));
        Eigen::Vector3d seen(0.3, 0.35, 0.4);
        if (hit) {
          const uint8_t* code = model.pages[model.faces[hit->face].page].srgb8.At(0, 0);
          const std::array<float, 256>& linear = LinearOfSrgb8();
          seen =
              light.On(ComputeFacePlane(model.model, hit->face).normal_in_world)
                  .cwiseProduct(Eigen::Vector3d(linear[code[0]], linear[code[1]], linear[code[2]]));
          if (hit->face >= first_counted) *truth.cover.At(x, y) += 1.0f / (side * side);
        }
        for (int c = 0; c < 3; ++c) {
          truth.radiance.At(x, y)[c] += static_cast<float>(seen[c] / (side * side));
        }
      }
    }
  }
  return truth;
}

Image8 Srgb8Of(const ImageF& radiance) {
  Image8 srgb8(radiance.width, radiance.height, 3);
  std::transform(
      radiance.values.begin(), radiance.values.end(), srgb8.values.begin(), Srgb8FromLinear);
  return srgb8;
}

TEST(Montage, AWingStandsInThePhotographAsIfItHadBeenThere) {
  // The photograph shows the hall; the design has hall and wing. What rays see of both in the same
  // light is what the montage should be, through a lens that bends, its borders too.
  const Camera camera = BentCamera();
  const Image8 photograph = Srgb8Of(TraceTruth(Hall(), LowSun(), camera, 99, 4).radiance);
  const Truth truth = TraceTruth(WithWing(), LowSun(), camera, 6, 8);
  MontageOptions options;
  options.new_parts_only = true;
  options.grain = false;
  options.blur_px = 0;
  const Montage montage = DrawMontage({photograph, nullptr, camera}, Hall(), WithWing(), options);
  EXPECT_EQ(montage.num_faces, 6);
  EXPECT_EQ(montage.light.source, LightSource::kDesign);

  double cover_error = 0;
  double worst_code = 0;
  double sum_codes = 0;
  int num_shown = 0;
  const Image8 expected = Srgb8Of(truth.radiance);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const double cover = *truth.cover.At(x, y);
      cover_error = std::max(cover_error, std::abs(cover - *montage.cover.At(x, y)));
      if (cover == 0) continue;
      ++num_shown;
      for (int c = 0; c < 3; ++c) {
        const double off = std::abs(expected.At(x, y)[c] - montage.srgb8.At(x, y)[c]);
        sum_codes += off / 3;
        if (cover == 1) worst_code = std::max(worst_code, off);
      }
    }
  }
  ASSERT_GT(num_shown, 2000);
  EXPECT_LT(cover_error, 0.2);
  EXPECT_LT(sum_codes / num_shown, 3);
  EXPECT_LT(worst_code, 8) << "two walls of the hall and the design's word for their colour";
  // What the wing does not cover stays as it was photographed.
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      if (*montage.cover.At(x, y) > 0) continue;
      ASSERT_EQ(*montage.srgb8.At(x, y), *photograph.At(x, y));
    }
  }
}

TEST(Montage, TheWholeDesignIsDrawnOverWhatItRepeats) {
  const Camera camera = BentCamera();
  const Image8 photograph = MakePlainPage(camera.width_px, camera.height_px, 90, 90, 90);
  const Truth truth = TraceTruth(WithWing(), LowSun(), camera, 0, 4);
  const Montage montage = DrawMontage({photograph, nullptr, camera}, Hall(), WithWing());
  EXPECT_EQ(montage.num_faces, 12);
  for (size_t i = 0; i < truth.cover.values.size(); ++i) {
    ASSERT_NEAR(truth.cover.values[i], montage.cover.values[i], 0.5) << "by a blur of 0.6 px";
  }
}

TEST(Montage, AMaskHidesTheDesignAsTreesDo) {
  const Camera camera = BentCamera();
  const Image8 photograph = MakePlainPage(camera.width_px, camera.height_px, 90, 90, 90);
  Image8 mask(camera.width_px, camera.height_px, 1);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < 150; ++x) *mask.At(x, y) = 255;
  }
  const Montage free = DrawMontage({photograph, nullptr, camera}, Hall(), WithWing());
  const Montage masked = DrawMontage({photograph, &mask, camera}, Hall(), WithWing());
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (x < 146) {
        ASSERT_EQ(*masked.cover.At(x, y), 0);
        ASSERT_EQ(*masked.srgb8.At(x, y), 90);
      }
      if (x > 154) {
        ASSERT_EQ(*masked.cover.At(x, y), *free.cover.At(x, y));
      }
    }
  }
}

TEST(Montage, FacesOfTheBuildingAreKnownAgainThoughCutOtherwise) {
  TexturedModel design;
  AddBox({-6, -3, 0}, {2, 3, 5}, {0.5f, 0.5f, 0.5f}, design);
  // The south wall in two halves, a hair before the building's; and one that reaches beyond it.
  design.model.points_in_world.insert(design.model.points_in_world.end(),
                                      {{-6, -3.002, 0},
                                       {-2, -3.002, 0},
                                       {-2, -3.002, 5},
                                       {-6, -3.002, 5},
                                       {-2, -3.002, 7},
                                       {-6, -3.002, 7}});
  design.model.faces.push_back({{8, 9, 10, 11}, "half"});
  design.model.faces.push_back({{8, 9, 12, 13}, "higher"});
  const std::vector<bool> is_repeated =
      FindRepeatedFaces(design.model, Visibility(Hall().model), 0.02);
  EXPECT_THAT(is_repeated, testing::ElementsAre(true, true, true, true, true, true, true, false));
}

TEST(Montage, WhatCannotBeDrawnIsNamed) {
  const Camera camera = BentCamera();
  const Image8 small = MakePlainPage(100, 80, 90, 90, 90);
  const auto message = [&](const Image8& photograph, bool new_parts_only) {
    MontageOptions options;
    options.new_parts_only = new_parts_only;
    try {
      DrawMontage({photograph, nullptr, camera}, Hall(), Hall(), options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(small, false), HasSubstr("is for a picture of 240 x 160"));
  const Image8 photograph = MakePlainPage(camera.width_px, camera.height_px, 90, 90, 90);
  EXPECT_THAT(message(photograph, true), HasSubstr("has no new parts"));
  // Labels of faces have 16 bits.
  TexturedModel many = Hall();
  const Face face = many.model.faces.front();
  many.model.faces.resize(70000, face);
  many.faces.resize(70000, many.faces.front());
  try {
    DrawMontage({photograph, nullptr, camera}, Hall(), many);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the design has 70000 faces"));
  }
}

TEST(Montage, TheDesignHasThePhotographsGrain) {
  Camera camera = MakeCamera({5, -22, 3}, {0, 0, 2.5}, 360, 240, 300);
  const Image8 photograph = GrainyPicture(5, 11);
  const Montage montage = DrawMontage({photograph, nullptr, camera}, Hall(), WithWing());
  const Montage smooth = [&] {
    MontageOptions options;
    options.grain = false;
    return DrawMontage({photograph, nullptr, camera}, Hall(), WithWing(), options);
  }();
  double sum = 0;
  int count = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 360; ++x) {
      if (*montage.cover.At(x, y) < 1) continue;
      sum += std::pow(montage.srgb8.At(x, y)[1] - smooth.srgb8.At(x, y)[1], 2);
      ++count;
    }
  }
  ASSERT_GT(count, 5000);
  EXPECT_NEAR(std::sqrt(sum / count), 5, 1);
}

}  // namespace
}  // namespace groundglass
