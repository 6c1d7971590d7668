// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/photograph_name.h"

#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kComposed =
    "S\xC3\xBC"
    "d";  // ü as one letter
constexpr const char* kParted =
    "Su\xCC\x88"
    "d";  // u and its dots, as macOS stores names
constexpr const char* kLatinOne =
    "S\xFC"
    "d";

std::vector<PhotographName> Names() {
  return {{"s5", "s5.jpg"},
          {"s10", "s10.TIF"},
          {kParted, std::string(kParted) + ".jpg"},
          {"house.v2", "house.v2"}};
}

TEST(FindPhotograph, KnowsOneByAllThatItIsCalled) {
  const std::vector<PhotographName> names = Names();
  for (const std::string word : {"s5",
                                 "s5.jpg",
                                 "S5",
                                 "s5.JPG",
                                 "S5.png",
                                 "images/s5.jpg",
                                 "C:\\photos\\s5.jpg",
                                 "east/s5"}) {
    EXPECT_EQ(FindPhotograph(word, names), 0u) << word;
  }
  for (const std::string word : {kComposed,
                                 kParted,
                                 kLatinOne,
                                 "S\xC3\x9C"
                                 "D.jpeg"}) {
    EXPECT_EQ(FindPhotograph(word, names), 2u) << word;
  }
  EXPECT_EQ(FindPhotograph("house.v2", names), 3u);
  EXPECT_EQ(FindPhotograph("s6", names), std::nullopt);
  EXPECT_EQ(FindPhotograph("", names), std::nullopt);
}

TEST(FindPhotograph, ExactNamesWinAndSeveralAreAnError) {
  const std::vector<PhotographName> names = {{"s5", "s5.jpg"}, {"S5", "S5.jpg"}, {"x", "x.jpg"}};
  EXPECT_EQ(FindPhotograph("S5", names), 1u);
  const std::vector<PhotographName> folded = {{"Ab", "Ab.jpg"}, {"aB", "aB.jpg"}};
  EXPECT_THAT(ThrownMessage([&] { FindPhotograph("ab", folded); }),
              AllOf(HasSubstr("'ab' may be any of Ab.jpg, aB.jpg"), HasSubstr("whole name")));
}

TEST(MatchPhotographs, EachGoesToOneWord) {
  const std::vector<PhotographName> names = {{"s5", "s5.jpg"}, {"S6", "S6.jpg"}, {"s7", "s7.jpg"}};
  const std::vector<std::string> words = {"S5", "s5", "s6", "S7", "s7.png", "t"};
  // "S7" and "s7.png": the second differs less, and there is one s7 only.
  EXPECT_THAT(MatchPhotographs(words, names),
              ElementsAre(std::nullopt, 0u, 1u, std::nullopt, 2u, std::nullopt));
}

TEST(NearestName, SaysInWhatItDiffers) {
  const std::vector<PhotographName> names = {{"IMG_0012", "IMG_0012.jpg"}, {"s5", "s5.jpg"}};
  EXPECT_THAT(NearestName("img12", names), HasSubstr("is it IMG_0012.jpg? it differs in zeros"));
  EXPECT_THAT(NearestName("s05", names), HasSubstr("is it s5.jpg?"));
  EXPECT_EQ(NearestName("s50", names), "");
  const std::vector<PhotographName> words = {{"Turm", "Turm.jpg"}, {"Tor2", "Tor2.jpg"}};
  EXPECT_EQ(NearestName("Tur", words), " (did you mean Turm?)");
  EXPECT_EQ(NearestName("Tor3", words), "");
}

}  // namespace
}  // namespace groundglass
