// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera_check.h"
#include "scene/formats/json_fault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace groundglass {
namespace {

using ::testing::HasSubstr;

// What is told of this work's fault with a JSON text.
template <typename Work>
std::string Told(const std::string& text, Work work) {
  try {
    work(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    return TellJsonFault(error.what());
  }
  return "nothing was thrown";
}

TEST(JsonFault, IsToldWithoutTheLibrarysNumbers) {
  const auto nothing = [](const nlohmann::json&) {};
  EXPECT_EQ(Told("{\n \"a\": 1,\n}", nothing),
            "line 3, column 1: unexpected '}'; expected string literal");
  EXPECT_THAT(Told("", nothing), HasSubstr("line 1, column 1: unexpected end of input"));
  EXPECT_EQ(Told("[1e999]", nothing), "1e999 is too large a number");
  EXPECT_EQ(Told("{}", [](const auto& json) { json.at("q"); }), "'q' is missing");
  EXPECT_EQ(Told("[1]", [](const auto& json) { json.at(3); }),
            "a list has no element 3 (the first is 0)");
  EXPECT_EQ(Told("[\"x\"]", [](const auto& json) { (void)json.at(0).template get<double>(); }),
            "expected a number, found a string");
  EXPECT_EQ(Told("\"x\"", [](const auto& json) { (void)json.at("q"); }),
            "expected an object or a list, found a string");
}

TEST(CameraCheck, NamesTheFirstFault) {
  Camera good;
  good.width_px = 1200;
  good.height_px = 800;
  good.focal_x_px = good.focal_y_px = 1000;
  EXPECT_EQ(FindCameraFault(good), "");
  const auto fault = [&](auto spoil) {
    Camera camera = good;
    spoil(camera);
    return FindCameraFault(camera);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fault([](Camera& c) { c.height_px = 0; }), HasSubstr("1200 x 0 pixels cannot be"));
  EXPECT_THAT(fault([](Camera& c) { c.focal_y_px = 0; }), HasSubstr("finite; here it is 0"));
  EXPECT_THAT(fault([&](Camera& c) { c.focal_x_px = nan; }), HasSubstr("here it is not a number"));
  EXPECT_THAT(fault([](Camera& c) { c.center_x_px = 2e5; }), HasSubstr("here it is at 200000, 0"));
  EXPECT_THAT(fault([&](Camera& c) { c.k2 = nan; }), HasSubstr("a term of the lens"));
  EXPECT_THAT(fault([&](Camera& c) { c.cam_from_world.translation.y() = nan; }),
              HasSubstr("place"));
  EXPECT_THAT(fault([](Camera& c) { c.cam_from_world.rotation *= -1; }), HasSubstr("no rotation"));
  const auto shares = [](Camera& c) {
    c.focal_x_px = c.focal_y_px = 0.97;
    c.center_x_px = c.center_y_px = 0.5;
  };
  EXPECT_THAT(fault(shares),
              HasSubstr("0.97 and the principal point 0.5, 0.5 are shares of the picture's sides, "
                        "it seems, and would be a view angle of nearly 180 degrees; expected "
                        "pixels: multiply them by 1200 "));
  const auto few_pixels = [&](Camera& c) {
    shares(c);
    c.width_px = 12;
    c.height_px = 8;
  };
  EXPECT_EQ(fault(few_pixels), "");
  EXPECT_THAT(FindSizeFault(12.5, 800), HasSubstr("an image of 12.5 x 800 pixels"));
}

}  // namespace
}  // namespace groundglass
