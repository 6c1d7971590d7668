// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/mask_flood.h"

#include "scene/formats/image_io.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

int CountReached(const Image8& flood) {
  return static_cast<int>(std::count(flood.values.begin(), flood.values.end(), 255));
}

// A picture's colour, evened out over 3 x 3 pixels.
std::array<int, 3> EvenColour(const Image8& srgb8, int x, int y) {
  std::array<int, 3> sum = {0, 0, 0};
  for (int by_y = -1; by_y <= 1; ++by_y) {
    for (int by_x = -1; by_x <= 1; ++by_x) {
      const uint8_t* pixel = srgb8.At(std::clamp(x + by_x, 0, srgb8.width - 1),
                                      std::clamp(y + by_y, 0, srgb8.height - 1));
      for (int c = 0; c < 3; ++c) sum[c] += pixel[c];
    }
  }
  for (int& channel : sum) channel = (channel + 4) / 9;
  return sum;
}

int ColourDistance(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// The same by the words of FloodOptions, pixel after pixel.
Image8 FloodPlainly(const Image8& srgb8, int start_x, int start_y, const FloodOptions& options) {
  struct Place {
    int x;
    int y;
  };
  const std::array<int, 3> start_colour = EvenColour(srgb8, start_x, start_y);
  Image8 flood(srgb8.width, srgb8.height, 1);
  std::vector<Place> front = {{start_x, start_y}};
  *flood.At(start_x, start_y) = 255;
  while (!front.empty()) {
    const Place at = front.back();
    front.pop_back();
    for (const Place by : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}}) {
      const Place next = {at.x + by.x, at.y + by.y};
      if (next.x < 0 || next.y < 0 || next.x >= srgb8.width || next.y >= srgb8.height) continue;
      if (*flood.At(next.x, next.y) != 0) continue;
      const std::array<int, 3> colour = EvenColour(srgb8, next.x, next.y);
      if (ColourDistance(colour, EvenColour(srgb8, at.x, at.y)) > options.step) continue;
      if (ColourDistance(colour, start_colour) > options.range) continue;
      *flood.At(next.x, next.y) = 255;
      front.push_back(next);
    }
  }
  return flood;
}

TEST(FindFlood, StopsAtEdgesOfThePicture) {
  Image8 picture(60, 40, 3, 90);
  for (int y = 10; y < 30; ++y) {
    // A patch whose brightness rises slowly, with a sharp border.
    for (int x = 20; x < 50; ++x) std::fill_n(picture.At(x, y), 3, static_cast<uint8_t>(150 + x));
  }
  const Image8 flood = FindFlood(picture, {35, 20});
  // The border itself is evened out, and left alone: a pixel all around.
  EXPECT_EQ(CountReached(flood), 28 * 18);
  EXPECT_EQ(*flood.At(21, 11), 255);
  EXPECT_EQ(*flood.At(10, 5), 0);
  EXPECT_TRUE(FindFlood(picture, {-5, 3}).Empty());
  EXPECT_TRUE(FindFlood(picture, {60, 3}).Empty());
}

// Small blots, so that what is reached winds its way through them.
TEST(FindFlood, IsWhatGoingFromPixelToPixelReaches) {
  std::mt19937 random(14);
  std::uniform_int_distribution<int> code(90, 150);
  std::uniform_int_distribution<int> at_x(0, 119);
  std::uniform_int_distribution<int> at_y(0, 79);
  Image8 picture(120, 80, 3);
  for (uint8_t& value : picture.values) value = static_cast<uint8_t>(code(random));
  int num_winding = 0;
  for (const FloodOptions& options :
       {FloodOptions{6, 48}, FloodOptions{9, 12}, FloodOptions{12, 20}}) {
    for (int i = 0; i < 40; ++i) {
      const int x = at_x(random);
      const int y = at_y(random);
      const Image8 flood = FindFlood(picture, {x + 0.5, y + 0.5}, options);
      const Image8 plain = FloodPlainly(picture, x, y, options);
      ASSERT_EQ(flood.values, plain.values) << x << " " << y << " step " << options.step;
      num_winding += CountReached(flood) > 200 && CountReached(flood) < 9000;
    }
  }
  EXPECT_GT(num_winding, 20) << "the picture is no test";
}

TEST(FindFlood, IsTheSameOnAPhotograph) {
  const Image8 photograph = ReadSrgb8(std::filesystem::path(GROUNDGLASS_SOURCE_DIR) /
                                      "datasets-synthetic/brick/images/s5.jpg");
  for (const auto& [x, y] : {std::pair(100, 60), std::pair(600, 420), std::pair(1100, 700)}) {
    const Image8 flood = FindFlood(photograph, {x + 0.5, y + 0.5});
    EXPECT_EQ(flood.values, FloodPlainly(photograph, x, y, {}).values) << x << " " << y;
  }
}

TEST(FloodOptions, AreChecked) {
  ExpectCheckNamesEach<FloodOptions>({{"step", [](FloodOptions& o) { o.step = -1; }},
                                      {"range", [](FloodOptions& o) { o.range = 256; }}});
}

}  // namespace
}  // namespace groundglass
