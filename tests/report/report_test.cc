// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report.h"

#include "report/embedded_picture.h"
#include "report/model_modes.h"
#include "report/report_data.h"
#include "report/report_text.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "scene/text.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sample_models.h"
#include "viewer/overlay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReportOf : public testing::Test {
 protected:
  ReportOf() { fs::create_directories(folder_); }

  void WriteRegistrations() {
    Registration good;
    good.name = "s1";
    good.width_px = 300;
    good.height_px = 200;
    good.verdict = Verdict::kAccepted;
    good.measured.position_in_site = {0, 11.5, 0};
    good.measured.lookat_in_site = {0, 0, 0};
    good.corrected = good.measured;
    good.corrected.position_in_site.x() = 0.25;
    good.sigmas[0] = 0.031;
    good.prior_sigmas[0] = 0.1;
    good.undetermined = {"x"};
    good.num_samples = 812;
    good.rms_px = 0.43;
    good.moved_px = 12.3;
    good.vertex_sigma_px = 0.7;
    Registration bad = good;
    bad.name = "s2";
    bad.verdict = Verdict::kRejected;
    bad.reasons = {"no fit <better> than chance & none near"};
    bad.corrected = bad.measured;
    WriteFileAtomically(folder_ / "registration.json", FormatRegistrations({good, bad}));
  }
  void WriteCoverage() {
    WriteFileAtomically(folder_ / "coverage.json",
                        R"({"covered_share": 0.62, "faces": [
          {"face": 1, "name": "south", "area": 8, "covered_area": 8, "texels": 100,
           "covered_texels": 100, "texel_size": 0.05,
           "sources": [{"photograph": "s1", "texels": 97, "footprint": 0.04},
                       {"photograph": "s3", "texels": 3, "footprint": 0.09}]},
          {"face": 2, "name": "north", "area": 8, "covered_area": 0, "texels": 100,
           "covered_texels": 0, "texel_size": 0.05, "sources": [],
           "missing": {"area": 8, "centre": [1, 2, 3], "stand_at": [12.3, -4.1, 5]}},
          {"face": 3, "name": "yard", "area": 8, "covered_area": 0, "texels": 100,
           "covered_texels": 0, "texel_size": 0.05, "sources": [],
           "missing": {"area": 8, "centre": [1, 2, 3]}},
          {"face": 4, "name": "sill", "area": 8, "covered_area": 7.8, "texels": 100,
           "covered_texels": 98, "texel_size": 0.05, "sources": [],
           "missing": {"area": 0.2, "centre": [9, 2, 3], "stand_at": [92.3, -4.1, 5]}}]})");
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_ / "hall";
};

TEST_F(ReportOf, AnEmptyFolderIsAnError) {
  try {
    MakeReport(folder_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("neither registration.json nor coverage.json"));
  }
}

TEST_F(ReportOf, TellsVerdictsReasonsAndWhatMoved) {
  WriteRegistrations();
  const std::string html = MakeReport(folder_);
  EXPECT_THAT(html, HasSubstr("<h1>hall</h1>"));
  EXPECT_THAT(html, HasSubstr("<span class=\"verdict rejected\">rejected</span>"));
  EXPECT_THAT(html, HasSubstr("no fit &lt;better&gt; than chance &amp; none near"));
  EXPECT_THAT(html, HasSubstr("0.250"));                     // x, corrected
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">2.5</td>"));  // in expected errors
  EXPECT_THAT(html, HasSubstr("no better known than before"));
  EXPECT_THAT(html,
              HasSubstr("<td class=\"n\">0.7</td>"));  // how well the model's points are known
}

TEST_F(ReportOf, ListsWhereTheModelIsOffInSite) {
  WriteRegistrations();
  EXPECT_THAT(MakeReport(folder_), Not(HasSubstr("Where the model is off")));
  const ModelError cornice = {
      "east wall / roof", {}, {1, 0, 0}, {0, 0.25, -0.3}, 0.05, {"s1", "s2"}};
  WriteFileAtomically(
      folder_ / "registration.json",
      FormatRegistrations(ReadRegistrations(folder_ / "registration.json"), {cornice}));
  const std::string html = MakeReport(folder_);
  EXPECT_THAT(html, HasSubstr("Where the model is off"));
  EXPECT_THAT(html, HasSubstr("<td>east wall / roof</td>"));
  EXPECT_THAT(html,
              HasSubstr("<td>1.000 0.000 0.000</td><td class=\"n\">1.000</td><td>s1 s2</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">\u22120.250</td>"));  // south is positive
}

TEST_F(ReportOf, TellsWhatTiedThePhotographsTogether) {
  WriteRegistrations();
  EXPECT_THAT(MakeReport(folder_), Not(HasSubstr("refined together")));
  TieUse ties;
  ties.patches = true;
  ties.colmap = {"3.8", "abc", 5, 7, 1234};
  WriteFileAtomically(
      folder_ / "registration.json",
      FormatRegistrations(ReadRegistrations(folder_ / "registration.json"), {}, {}, ties));
  EXPECT_THAT(
      MakeReport(folder_),
      HasSubstr("by the model’s edges and by patches of faces that are seen alike, and 1234 "
                "points that COLMAP 3.8 matched in 7 pairs of photographs."));
}

TEST_F(ReportOf, PointsOutFacesThatNobodySees) {
  WriteCoverage();
  const std::string html = MakeReport(folder_);
  EXPECT_THAT(html, HasSubstr("62 %"));
  EXPECT_THAT(html, HasSubstr("2 faces are seen by less than half"));
  EXPECT_THAT(html,
              HasSubstr("<li>Take a photograph from x 12, y \u22124, z 5 units: it would show 8 "
                        "units\u00b2 that none shows yet (north).</li>"));
  EXPECT_THAT(html, Not(HasSubstr("would show 0")));        // the sill
  EXPECT_THAT(html, HasSubstr("<td>12, \u22124, 5</td>"));  // where to stand
  EXPECT_THAT(html, HasSubstr("where none is named, none was found"));
  EXPECT_THAT(html,
              HasSubstr("s1 <span class=\"soft\">97 %</span> <span class=\"soft\">and 1 more"));
}

TEST_F(ReportOf, HoldsItsPicturesAndAsksForNothingElse) {
  WriteRegistrations();
  WriteSrgb8(folder_ / "overlays" / "s1.jpg", MakePlainPage(300, 200, 120, 90, 60));
  WriteSrgb8(folder_ / "renders" / "from_the_east.png", MakePlainPage(60, 40, 9, 9, 9));
  const std::string html = MakeReport(folder_);
  EXPECT_THAT(html, HasSubstr("alt=\"new view from_the_east\" src=\"data:image/jpeg;base64,/9j/"));
  EXPECT_THAT(html, HasSubstr("alt=\"s1 with the model's edges\""));
  for (const char* elsewhere : {"http:", "https:", "src=\"/", "url(", "@import", "import("}) {
    EXPECT_THAT(html, Not(HasSubstr(elsewhere)));
  }
  // What slipped in all the same would be stopped.
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST_F(ReportOf, ShowsBeforeAndAfterWhenItHasTheScene) {
  WriteRegistrations();
  Scene scene;
  scene.folder = folder_.parent_path() / "parish hall";
  scene.model = MakeCheckeredBox().model;
  Photograph photograph;
  photograph.name = "s1";
  photograph.image_file = folder_.parent_path() / "s1.png";
  WriteSrgb8(photograph.image_file, MakePlainPage(300, 200, 120, 90, 60));
  scene.photographs = {photograph};
  ReportOptions options;
  options.find_edges = MakeEdgeFinding(scene.model);
  const std::string html = MakeReport(folder_, &scene, options);
  EXPECT_THAT(html, HasSubstr("<h1>parish hall</h1>"));
  EXPECT_THAT(html, HasSubstr("<svg class=\"as_measured\" viewBox=\"0 0 300 200\""));
  EXPECT_THAT(html, HasSubstr("<svg class=\"as_corrected\" viewBox=\"0 0 300 200\""));
  EXPECT_THAT(html, HasSubstr("aria-label=\"s1: border between"));
  EXPECT_THAT(html, HasSubstr(" ft"));
  EXPECT_THAT(html, Not(HasSubstr("ten times enlarged</option>")));
}

TEST_F(ReportOf, DrawsResidualsTenTimesEnlarged) {
  WriteRegistrations();
  std::vector<Registration> registrations = ReadRegistrations(folder_ / "registration.json");
  Registration& registration = registrations.front();
  registration.residuals = {{{registration.width_px / 2.0, 30}, {0.5, -1}}};
  WriteFileAtomically(folder_ / "registration.json", FormatRegistrations(registrations));
  Scene scene;
  scene.model = MakeCheckeredBox().model;
  scene.photographs.resize(1);
  scene.photographs[0].name = registration.name;
  scene.photographs[0].image_file = folder_.parent_path() / "s1.png";
  WriteSrgb8(scene.photographs[0].image_file,
             MakePlainPage(registration.width_px, registration.height_px, 120, 90, 60));
  ReportOptions options;
  options.find_edges = MakeEdgeFinding(scene.model);
  options.picture_width_px = registration.width_px / 2;
  const std::string html = MakeReport(folder_, &scene, options);
  // Half the size, so half the place and five times the offset.
  const std::string x = std::to_string(registration.width_px / 4);
  const std::string end = FormatNumber(registration.width_px / 4.0 + 2.5);
  EXPECT_THAT(html, HasSubstr("<path d=\"M" + x + " 15L" + end + " 10\"/>"));
  EXPECT_THAT(html, HasSubstr("ten times enlarged</option>"));
}

TEST_F(ReportOf, SaysWhatWasCorrectedInAPersonsWords) {
  Registration registration;
  registration.name = "s1";
  registration.verdict = Verdict::kAccepted;
  registration.width_px = 1200;
  registration.measured.position_in_site = {0, 20, 5};
  registration.measured.lookat_in_site = {0, 0, 5};
  registration.corrected = registration.measured;
  registration.corrected.position_in_site = {1.3, 19.5, 5.01};
  registration.corrected.lookat_in_site = {1.3, 0, 5.01};
  registration.corrected.shift_x = 0.009;
  registration.sigmas.setConstant(0.1);
  registration.sigmas[kShiftX] = 0.001;
  registration.prior_sigmas.setConstant(0.5);
  registration.prior_sigmas[kShiftX] = 0.015;
  // East and north together; the height's centimetre is a trifle.
  EXPECT_EQ(CorrectionInWords(registration, " ft"),
            "Stood 1.3 ft further east and 0.50 ft further north, slide shifted 11 px right, "
            "compared with the field notes.");
  registration.corrected = registration.measured;
  EXPECT_EQ(CorrectionInWords(registration, " ft"),
            "As the field notes have it, within what they are sure to.");
}

TEST_F(ReportOf, ThePlanEnlargesCorrectionsAndSaysHowMuch) {
  WriteRegistrations();
  const std::string html = MakeReport(folder_);
  EXPECT_THAT(html, HasSubstr("<svg class=\"plan\""));
  EXPECT_THAT(html, HasSubstr("aria-label=\"s1, accepted\""));
  EXPECT_THAT(html, HasSubstr("<ellipse "));
}

// The number behind a word.
double NumberAfter(const std::string& text, const std::string& word, size_t from = 0) {
  const size_t at = text.find(word, from);
  EXPECT_NE(at, std::string::npos) << word;
  return at == std::string::npos ? 0 : std::stod(text.substr(at + word.size()));
}

TEST_F(ReportOf, ThePlanHoldsItsEllipses) {
  WriteRegistrations();
  std::vector<Registration> registrations = ReadRegistrations(folder_ / "registration.json");
  // At the plan's southern end, and least known towards there.
  registrations[0].covariance(0, 0) = 0.01;
  registrations[0].covariance(1, 1) = 0.16;
  registrations[1].measured.position_in_site =
      registrations[1].corrected.position_in_site = {10, 0, 0};
  WriteFileAtomically(folder_ / "registration.json", FormatRegistrations(registrations));
  const std::string html = MakeReport(folder_);
  const size_t plan = html.find("class=\"plan\" viewBox=\"0 0 ");
  ASSERT_NE(plan, std::string::npos);
  double width = 0;
  double height = 0;
  ASSERT_EQ(
      std::sscanf(html.c_str() + plan, "class=\"plan\" viewBox=\"0 0 %lf %lf", &width, &height), 2);
  const size_t ellipse = html.find("<ellipse ", plan);
  const double reach = NumberAfter(html, "rx=\"", ellipse);
  EXPECT_GT(reach, 50);  // more than the plan's margin
  EXPECT_LE(NumberAfter(html, "cy=\"", ellipse) + reach, height);
  EXPECT_EQ(std::abs(NumberAfter(html, "rotate(", ellipse)), 90);
}

TEST_F(ReportOf, ThePagesNumbersAreThinnedAndCannotEndTheScriptThatHoldsThem) {
  EXPECT_EQ(ModelModesJson(folder_, 1000000), "");
  Image16 numbers(3000, 10, 1);
  for (uint16_t& number : numbers.values) number = 300;
  WriteLabels(folder_ / "provenance_0.png", numbers);
  WriteFileAtomically(folder_ / "faces/s10.png", "");
  WriteFileAtomically(folder_ / "faces/s2<!--.png", "");
  const std::string json = ModelModesJson(folder_, 1000000);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_THAT(json, HasSubstr(R"("names":["s2\u003c!--","s10"])"));
  // 1000 x 3 pixels of one colour.
  EXPECT_LT(json.size(), 3000u);
  EXPECT_EQ(ModelModesJson(folder_, 10), "");
}

TEST_F(ReportOf, WhatHasNoTagAndWhatIsOutOfReachIsSaid) {
  WriteRegistrations();
  WriteCoverage();
  Scene scene;
  scene.folder = folder_;
  scene.model = MakeWall(4, 3, MakePlainPage(8, 8, 1, 2, 3)).model;
  scene.model.unit = LengthUnit::kMetre;
  EXPECT_THAT(MakeReport(folder_, &scene),
              HasSubstr("5 m above the model\u2019s foot (with a drone"));
  scene.model.unit = LengthUnit::kFoot;  // a person with a pole reaches five feet
  scene.untagged_images = {folder_ / "images/s7.jpg", folder_ / "images/s8.jpg"};
  const std::string html = MakeReport(folder_, &scene);
  EXPECT_THAT(html, Not(HasSubstr("drone")));
  EXPECT_THAT(html, HasSubstr("s7.jpg, s8.jpg have no tag and so no part in this"));
}

TEST_F(ReportOf, WhatNeedsAPersonComesFirst) {
  WriteRegistrations();
  WriteCoverage();
  const std::string html = MakeReport(folder_);
  const size_t rejected = html.find("<li><a href=\"#s2\">s2</a> is not used");
  const size_t stand = html.find("<li>Take a photograph from");
  ASSERT_NE(rejected, std::string::npos);
  ASSERT_NE(stand, std::string::npos);
  EXPECT_LT(rejected, stand);
}

TEST_F(ReportOf, TheTexturesSharesArePhotographByPhotograph) {
  WriteCoverage();
  EXPECT_THAT(MakeReport(folder_), HasSubstr("<tr><td>s1</td><td class=\"n\">0.24 units\u00b2"));
}

TEST_F(ReportOf, ManyPhotographsStayWithinThePagesWeight) {
  std::vector<Registration> registrations;
  Image8 noise(400, 267, 3);
  uint32_t state = 1988;
  for (uint8_t& value : noise.values)
    value = static_cast<uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  for (int i = 0; i < 60; ++i) {
    Registration registration;
    registration.name = "s" + std::to_string(i);
    registration.width_px = 400;
    registration.height_px = 267;
    registration.verdict = Verdict::kAccepted;
    registrations.push_back(registration);
    WriteSrgb8(folder_ / "overlays" / (registration.name + ".jpg"), noise);
  }
  WriteFileAtomically(folder_ / "registration.json", FormatRegistrations(registrations));
  ReportOptions options;
  options.max_megabytes = 1;
  EXPECT_LT(MakeReport(folder_, nullptr, options).size(), 1000000u);
}

// What stands between > and < or between quotes must not be markup, whoever wrote it.
TEST_F(ReportOf, NamesAreTextWhateverTheyHold) {
  const std::string name = "<b>&\"x";
  const std::string safe = "&lt;b&gt;&amp;&quot;x";
  WriteRegistrations();
  std::vector<Registration> registrations = ReadRegistrations(folder_ / "registration.json");
  registrations[0].name = name;
  registrations[0].reasons = {"{{title}} <i>"};
  const ModelError cornice = {name, {}, {1, 0, 0}, {0, 0.25, -0.3}, 0.05, {"s1", "s2"}};
  WriteFileAtomically(folder_ / "registration.json", FormatRegistrations(registrations, {cornice}));
  WriteFileAtomically(folder_ / "coverage.json",
                      R"({"covered_share": 0.002, "faces": [{"face": 1, "name": "<b>&\"x",
                          "area": 8, "covered_area": 8, "covered_texels": 100, "texel_size": 0.05,
                          "sources": [{"photograph": "<b>&\"x", "texels": 100}]}]})");
  WriteFileAtomically(folder_ / "manifest.json", R"({"version": "<b>&\"x", "seed": "<b>"})");
  WriteSrgb8(folder_ / "overlays" / (name + ".jpg"), MakePlainPage(30, 20, 120, 90, 60));
  WriteSrgb8(folder_ / "renders" / (name + ".png"), MakePlainPage(60, 40, 9, 9, 9));
  WriteFileAtomically(folder_ / "renders" / (name + ".mp4"), std::string());
  Scene scene;
  scene.folder = folder_.parent_path() / name;
  scene.model = MakeCheckeredBox().model;
  scene.warnings = {"tags.csv: " + name};
  const std::string html = MakeReport(folder_, &scene);
  EXPECT_THAT(html, Not(HasSubstr(name)));
  EXPECT_THAT(html, HasSubstr("<title>" + safe + " \u2013 Groundglass</title>"));
  EXPECT_THAT(html, HasSubstr("<td><a href=\"#" + safe + "\">" + safe + "</a></td>"));
  EXPECT_THAT(html, HasSubstr("aria-label=\"" + safe + "\">\n<header><h3>" + safe + "</h3>"));
  EXPECT_THAT(html, HasSubstr("alt=\"" + safe + " with the model's edges\""));
  EXPECT_THAT(html, HasSubstr("alt=\"new view " + safe + "\""));
  EXPECT_THAT(html, HasSubstr("<a href=\"renders/%3Cb%3E%26%22x.mp4\">" + safe + ".mp4</a>"));
  EXPECT_THAT(html, HasSubstr("<td>" + safe + " <span class=\"soft\">100 %</span></td>"));
  EXPECT_THAT(html, HasSubstr("<td>" + safe + "</td><td class=\"n\">8.0</td>"));
  EXPECT_THAT(html, HasSubstr("<td>" + safe + "</td><td class=\"n\">+0.000</td>"));
  EXPECT_THAT(html, HasSubstr("<li>tags.csv: " + safe + "</li>"));
  EXPECT_THAT(html, HasSubstr("Made by Groundglass " + safe + ", seed &quot;&lt;b&gt;&quot;."));
  EXPECT_THAT(html, HasSubstr("<b>&lt; 1 %</b>"));
  // Text from a person is no template either.
  EXPECT_THAT(html, HasSubstr("<li>{{title}} &lt;i&gt;</li>"));
}

TEST_F(ReportOf, CoverageOfAnotherShapeIsNamed) {
  WriteFileAtomically(folder_ / "coverage.json", std::string(R"({"faces": [{"area": "large"}]})"));
  try {
    MakeReport(folder_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("coverage.json: is not as texturing writes it: "));
  }
}

TEST_F(ReportOf, DamagedCoverageIsNamed) {
  WriteFileAtomically(folder_ / "coverage.json", std::string("{\"faces\": ["));
  try {
    MakeReport(folder_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("coverage.json: is not JSON"));
  }
}

}  // namespace
}  // namespace groundglass
