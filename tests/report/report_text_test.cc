// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_text.h"

#include "report/embedded_picture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

namespace groundglass {
namespace {

std::string Base64Of(std::string_view text) {
  return EncodeBase64({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

TEST(ReportText, Base64IsThatOfRfc4648) {
  EXPECT_EQ(Base64Of(""), "");
  EXPECT_EQ(Base64Of("f"), "Zg==");
  EXPECT_EQ(Base64Of("fo"), "Zm8=");
  EXPECT_EQ(Base64Of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64Of({"\xff\xfe\x00", 3}), "//4A");
}

TEST(ReportText, NumbersHaveTheDecimalsThatTheirDeviationGivesSenseTo) {
  EXPECT_EQ(FormatRounded(231.4187301, 0.0312), "231.419");
  EXPECT_EQ(FormatRounded(-2.5, 0.4), "\u22122.50");
  EXPECT_EQ(FormatRounded(1504.3, 120), "1504");
  EXPECT_EQ(FormatRounded(3.14159265), "3.142");
  EXPECT_EQ(FormatRounded(-0.0001, 0.1), "0.00");  // no minus before nothing
  EXPECT_EQ(FormatSigma(0.0312), "0.031");
}

TEST(ReportText, SharesAreNeverFalselyWhole) {
  EXPECT_EQ(FormatShare(0), "0 %");
  EXPECT_EQ(FormatShare(0.004), "< 1 %");
  EXPECT_EQ(FormatShare(0.873), "87 %");
  EXPECT_EQ(FormatShare(0.9999), "> 99 %");
  EXPECT_EQ(FormatShare(1), "100 %");
}

TEST(ReportText, AddressesOfLinksHoldNoSignOfTheirOwn) {
  EXPECT_EQ(EncodeForAddress("round_1-b.mp4"), "round_1-b.mp4");
  EXPECT_EQ(EncodeForAddress("100 %?#\u00fc.mp4"), "100%20%25%3F%23%C3%BC.mp4");
}

}  // namespace
}  // namespace groundglass
