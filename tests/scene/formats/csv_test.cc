// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/csv.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::string_literals;

CsvTable Table(const std::string& text) {
  const TemporaryFolder folder;
  return CsvTable(folder.Write("t.csv", text));
}

TEST(Csv, AnySpreadsheetsTableIsTheSame) {
  const auto utf16 = [](const std::string& ascii) {
    std::string bytes = "\xFF\xFE";
    for (const char c : ascii) bytes += {c, '\0'};
    return bytes;
  };
  for (const std::string& text : {"Image,x,Y\ns1,1.5,-2\n"s,
                                  "\xEF\xBB\xBFimage;x;y\r\ns1;1,5;-2\r\n"s,
                                  "image\tx\ty\rs1\t1,5\t-2\r"s,
                                  "sep=;\nimage;x;y\ns1;1.5;-2"s,
                                  "\"image\";\"x\";\"y\"\n\"s1\";\"1,5\";\"-2\"\n"s,
                                  "image,x,y\ns1,\"1,5\",-2\n"s,
                                  "image; x ;y;;;\n\n;;;;;\n s1 ; 1,5 ; \xE2\x88\x92"
                                  "2 ;;;\n;;;\n"s,
                                  "% a note\nimage,x,y % columns\ns1,1.5,-2 % a, comment\n"s,
                                  utf16("image\tx\ty\r\ns1\t1,5\t-2\r\n")}) {
    const CsvTable table = Table(text);
    ASSERT_THAT(table.header(), ElementsAre("image", "x", "y")) << text;
    ASSERT_EQ(table.rows().size(), 1u) << text;
    EXPECT_EQ(table.rows()[0].fields[0], "s1") << text;
    EXPECT_EQ(table.Number(table.rows()[0].fields[1]), 1.5) << text;
    EXPECT_EQ(table.Number(table.rows()[0].fields[2]), -2.0) << text;
    EXPECT_THAT(table.warnings(), IsEmpty());
  }
}

TEST(Csv, NumbersOfManyCountries) {
  const CsvTable comma = Table("a;b\n22,2;0,5\n");
  EXPECT_EQ(comma.Number("1.234,5"), 1234.5);
  EXPECT_EQ(comma.Number("5,123"), 5.123);
  EXPECT_EQ(comma.Number("389 412,35"), 389412.35);
  EXPECT_EQ(comma.Number("389'412,35"), 389412.35);
  EXPECT_EQ(comma.Number("-1,5e3"), -1500);
  EXPECT_EQ(comma.Number("1.5"), 1.5);
  EXPECT_EQ(comma.Number("1.234.567"), 1234567);
  EXPECT_EQ(comma.Number("two"), std::nullopt);
  EXPECT_EQ(comma.Number("1,2,3"), std::nullopt);
  EXPECT_EQ(comma.Number(""), std::nullopt);
  const CsvTable point = Table("a,b\n22.2,0.5\n");
  EXPECT_EQ(point.Number("5.123"), 5.123);
  EXPECT_EQ(point.Number("1,234.5"), 1234.5);
  EXPECT_EQ(point.Number("22,25"), 22.25);
  EXPECT_EQ(Table("a;b\n5,123;4,250\n").Number("5,123"), 5.123);
}

TEST(Csv, WhatNobodyCanTellIsNotGuessed) {
  std::string why;
  EXPECT_EQ(Table("a,b\n22.2,\"1,234\"\n").Number("1,234", &why), std::nullopt);
  EXPECT_THAT(why, HasSubstr("may be 1.234 or 1234"));
  EXPECT_EQ(Table("a;b\n22,2;1.234\n").Number("1.234"), std::nullopt);
}

TEST(Csv, QuotesHoldFieldsTogether) {
  const CsvTable table =
      Table("image,face\ns1,\"west \"\"gable\"\", left\"\ns2,\"two\nlines\"\ns3,x\n");
  EXPECT_EQ(table.rows()[0].fields[1], "west \"gable\", left");
  EXPECT_EQ(table.rows()[1].fields[1], "two lines");
  EXPECT_EQ(table.rows()[2].line, 5);
}

TEST(Csv, LatinOneIsReadAndSaid) {
  const CsvTable table = Table(
      "image;face\nS\xFC"
      "d;1\n");
  EXPECT_EQ(table.rows()[0].fields[0],
            "S\xC3\xBC"
            "d");
  EXPECT_THAT(table.warnings(), ElementsAre(HasSubstr("is not UTF-8; it is read as Windows-1252")));
}

TEST(Csv, FaultsNameTheLine) {
  EXPECT_THAT(ThrownMessage([] { Table("a,b\n1,2\n1\n"); }),
              HasSubstr("t.csv:3: has 1 fields; the header has 2"));
  EXPECT_THAT(ThrownMessage([] { Table("a,b\n1,2\n1,\"2\n3,4\n"); }),
              HasSubstr("t.csv:3: a quote here is not closed"));
  EXPECT_TRUE(Table("").header().empty());
  EXPECT_TRUE(Table("\n \n").header().empty());
}

TEST(Csv, WhatIsNoTextSaysWhatItIs) {
  const auto message = [](const std::string& bytes) {
    return ThrownMessage([&] { Table(bytes); });
  };
  EXPECT_THAT(message("PK\x03\x04\x14\0\x06\0[Content_Types].xml"s),
              HasSubstr("t.csv: this is an Excel or LibreOffice file, or another zip archive, and "
                        "no text; open it in a spreadsheet and save it as CSV"));
  EXPECT_THAT(message("\xD0\xCF\x11\xE0 old"), HasSubstr("an Excel file (.xls)"));
  EXPECT_THAT(message("%PDF-1.7\n1 0 obj"), HasSubstr("this is a PDF"));
  EXPECT_THAT(message("<html><table></table></html>"), HasSubstr("this is a web page"));
  for (const bool is_marked : {true, false}) {
    std::string utf32 = is_marked ? "\xFF\xFE\0\0"s : "";
    for (const char c : "image,x\ns1,2\n"s) utf32 += {c, '\0', '\0', '\0'};
    EXPECT_THAT(message(utf32), HasSubstr("in UTF-32; save it as UTF-8"));
  }
  EXPECT_THAT(message("\"image,x,y\"\n\"s1,1,2\"\n"),
              HasSubstr("t.csv:1: this line stands in quotes as a whole"));
}

TEST(Csv, ZerosAndControlBytesAreNotPassedOn) {
  EXPECT_THAT(ThrownMessage([] { Table("image,x\ns1,2\ns2,\0\0\0\0"s); }),
              HasSubstr("t.csv: from line 3 on it holds nothing but zeros (NUL), as after a copy"));
  EXPECT_THAT(ThrownMessage([] { Table("image,x\ns1,\0002\ns2,3"s); }),
              HasSubstr("t.csv: line 2 holds zeros (NUL), which no text has"));
  const CsvTable table = Table("image,x\n\x1B[2Js1\x07,2\n");
  EXPECT_EQ(table.rows()[0].fields[0], "[2Js1");
}

TEST(CsvField, IsQuotedWhereItMustBe) {
  EXPECT_EQ(CsvField("tower, north"), "\"tower, north\"");
  EXPECT_EQ(CsvField("the \"old\" wall"), "\"the \"\"old\"\" wall\"");
  EXPECT_EQ(CsvField("plain"), "plain");
}

}  // namespace
}  // namespace groundglass
