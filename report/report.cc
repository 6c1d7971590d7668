// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report.h"

#include "report/report_html.h"
#include "report/report_sections.h"
#include "report/report_style.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/view_io.h"
#include "scene/model_sigma.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr size_t kManyPhotographs = 40;

std::optional<Json> ReadJsonIfThere(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return Json::parse(ReadTextFile(file));
  } catch (const Json::exception& error) {
    throw Error(file, std::string("is not JSON: ") + error.what());
  }
}

// A tag's numbers in words, in the order of kCameraParameterNames.
struct ParameterWords {
  const char* name;
  const char* unit;  // empty: the model's
};
constexpr std::array<ParameterWords, kNumCameraParameters> kParameterWords = {{
    {"position, east (x)", ""},
    {"position, south (y)", ""},
    {"height (z)", ""},
    {"direction (yaw)", "\u00b0"},
    {"upward tilt (pitch)", "\u00b0"},
    {"roll", "\u00b0"},
    {"angle of view (v)", "\u00b0"},
    {"aspect (a)", " "},
    {"shift, right (shift_x)", " of width"},
    {"shift, down (shift_y)", " of width"},
    {"lens distortion (k1)", " "},
}};

std::string UnitSuffix(const Scene* scene) {
  if (!scene) return " units";
  return " " + UnitName(scene->model.unit);
}

// A misfit that there may not be.
std::string PixelsOf(const std::optional<double>& px) {
  return px ? FormatRounded(*px, 0.1) : "\u2013";
}

std::string VerdictCell(Verdict verdict) {
  const std::string name(VerdictName(verdict));
  return "<span class=\"verdict " + name + "\">" + name + "</span>";
}

class Report {
 public:
  Report(const fs::path& folder, const Scene* scene, const ReportOptions& options)
      : folder_(folder), scene_(scene), options_(options) {
    if (fs::exists(folder / "registration.json")) {
      registrations_ = ReadRegistrations(folder / "registration.json");
      model_errors_ = ReadModelErrors(folder / "registration.json");
    }
    coverage_ = ReadJsonIfThere(folder / "coverage.json");
    manifest_ = ReadJsonIfThere(folder / "manifest.json");
    if (!registrations_ && !coverage_) {
      throw Error(folder, "holds neither registration.json nor coverage.json: nothing to report");
    }
    if (options_.title.empty()) {
      const fs::path named = scene ? scene->folder : folder;
      options_.title = fs::weakly_canonical(named).filename().string();
    }
    if (registrations_ && registrations_->size() > kManyPhotographs) {
      options_.picture_width_px = std::max(1, options_.picture_width_px / 2);
    }
  }

  std::string Format() {
    AddHeading();
    AddNewViews();
    if (registrations_) AddPhotographTable();
    if (coverage_) body_ += FormatCoverageSection(*coverage_, UnitSuffix(scene_));
    body_ += FormatModelErrorSection(model_errors_, UnitSuffix(scene_));
    if (registrations_) AddPhotographs();
    if (scene_) body_ += FormatWarningSection(scene_->warnings);
    AddFooter();
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           EscapeHtml(options_.title) + " \u2013 Groundglass</title>\n<style>" + kReportStyle +
           "</style>\n</head>\n<body>\n" + body_ + "</body>\n</html>\n";
  }

 private:
  size_t Count(Verdict verdict) const {
    return static_cast<size_t>(
        std::count_if(registrations_->begin(), registrations_->end(), [&](const Registration& r) {
          return r.verdict == verdict;
        }));
  }

  void AddFact(const std::string& number, const std::string& what) {
    body_ += "<div><b>" + number + "</b><span>" + what + "</span></div>\n";
  }

  void AddHeading() {
    body_ += "<h1>" + EscapeHtml(options_.title) + "</h1>\n";
    body_ +=
        "<p class=\"lead\">Where each photograph was taken from, corrected from the field notes "
        "against the building\u2019s model, and what the photographs show of the building.</p>\n";
    body_ += "<div class=\"facts\">\n";
    if (registrations_) {
      AddFact(std::to_string(registrations_->size()), "photographs");
      AddFact(std::to_string(Count(Verdict::kAccepted)), "accepted");
      AddFact(std::to_string(Count(Verdict::kReview)), "to be looked at");
      AddFact(std::to_string(Count(Verdict::kRejected)), "left as measured");
      if (Count(Verdict::kUnreadable) > 0) {
        AddFact(std::to_string(Count(Verdict::kUnreadable)), "unreadable");
      }
    }
    if (coverage_) {
      AddFact(FormatShare(coverage_->value("covered_share", 0.0)),
              "of the model\u2019s surface seen");
    }
    if (scene_ && !scene_->warnings.empty()) {
      AddFact(std::to_string(scene_->warnings.size()),
              scene_->warnings.size() == 1 ? "warning" : "warnings");
    }
    body_ += "</div>\n";
  }

  void AddNewViews() {
    std::vector<fs::path> pictures;
    std::vector<fs::path> films;
    if (fs::is_directory(folder_ / "renders")) {
      for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "renders")) {
        const std::string extension = entry.path().extension().string();
        if (IsImageExtension(extension)) pictures.push_back(entry.path());
        if (extension == ".mp4") films.push_back(entry.path());
      }
    }
    if (pictures.empty() && films.empty()) return;
    const auto by_name = [](const fs::path& a, const fs::path& b) {
      return NaturalLess(a.filename().string(), b.filename().string());
    };
    std::sort(pictures.begin(), pictures.end(), by_name);
    std::sort(films.begin(), films.end(), by_name);
    body_ +=
        "<h2>New views</h2>\n<p>The textured model from viewpoints where no photograph was taken. "
        "What no photograph shows is plain grey, or filled in from its surroundings.</p>\n"
        "<div class=\"pair\">\n";
    for (const fs::path& picture : pictures) {
      const std::string name = picture.stem().string();
      body_ += "<figure>" +
               EmbeddedPicture(ShrunkPicture(ReadSrgb8(picture), 2 * options_.picture_width_px),
                               "new view " + name) +
               "<figcaption>" + EscapeHtml(name) + "</figcaption></figure>\n";
    }
    body_ += "</div>\n";
    for (const fs::path& film : films) {
      const std::string name = film.filename().string();
      body_ += "<p>Film: <a href=\"renders/" + EscapeHtml(name) + "\">" + EscapeHtml(name) +
               "</a> (beside this report)</p>\n";
    }
  }

  void AddPhotographTable() {
    body_ +=
        "<h2>Photographs</h2>\n"
        "<p><span class=\"accepted verdict\">accepted</span>: the model\u2019s edges fit the "
        "picture, within what the field notes allow. <span class=\"review verdict\">review</span>: "
        "used, at lower weight; a person should look. <span class=\"rejected verdict\">rejected"
        "</span>: no trustworthy fit; the field notes stand, and the photograph is not used.";
    if (Count(Verdict::kUnreadable) > 0) {
      body_ +=
          " <span class=\"unreadable verdict\">unreadable</span>: the picture, its mask or its "
          "field notes could not be read; mend the file and run again.";
    }
    body_ += "</p>\n";
    if (scene_) {
      body_ += "<p>The model\u2019s edges may lie off by " +
               EscapeHtml(DescribeModelSigma(scene_->model)) + ".</p>\n";
    }
    body_ +=
        "<table><thead><tr><th>Photograph</th><th>Verdict</th><th class=\"n\">Edges moved, px</th>"
        "<th class=\"n\">Misfit left, px (root mean square)</th><th class=\"n\">Misfit of most "
        "edges, px (robust)</th><th class=\"n\">Model known to, px</th><th "
        "class=\"n\">Edge points</th><th>Remarks</th></tr>"
        "</thead><tbody>\n";
    for (const Registration& registration : *registrations_) {
      std::string remarks;
      for (const std::string& reason : registration.reasons) {
        if (!remarks.empty()) remarks += "<br>";
        remarks += EscapeHtml(reason);
      }
      const bool is_corrected = HasCorrection(registration.verdict);
      body_ +=
          "<tr>" +
          TextCell("<a href=\"#" + EscapeHtml(registration.name) + "\">" +
                   EscapeHtml(registration.name) + "</a>") +
          TextCell(VerdictCell(registration.verdict)) +
          NumberCell(is_corrected ? FormatRounded(registration.moved_px, 1) : "\u2013") +
          NumberCell(PixelsOf(registration.rms_px)) +
          NumberCell(PixelsOf(registration.robust_sigma_px)) +
          NumberCell(is_corrected ? FormatRounded(registration.vertex_sigma_px, 1) : "\u2013") +
          NumberCell(std::to_string(registration.num_samples)) + TextCell(remarks) + "</tr>\n";
    }
    body_ += "</tbody></table>\n";
  }

  void AddPhotographs() {
    body_ +=
        "<h2>Each photograph</h2>\n<p>The model\u2019s edges drawn over the photograph, as the "
        "field notes place them in grey, as corrected in blue; below, what was corrected, with one "
        "standard deviation of what is left uncertain.</p>\n";
    for (const Registration& registration : *registrations_) {
      body_ += "<section class=\"photograph\" id=\"" + EscapeHtml(registration.name) +
               "\">\n<header><h3>" + EscapeHtml(registration.name) + "</h3>" +
               VerdictCell(registration.verdict) + "</header>\n";
      if (!registration.reasons.empty()) {
        body_ += "<ul>";
        for (const std::string& reason : registration.reasons) {
          body_ += "<li>" + EscapeHtml(reason) + "</li>";
        }
        body_ += "</ul>\n";
      }
      AddPictures(registration);
      AddParameters(registration);
      body_ += "</section>\n";
    }
  }

  void AddPictures(const Registration& registration) {
    if (registration.verdict == Verdict::kUnreadable) return;
    const Photograph* photograph =
        scene_ && options_.draw_edges ? FindUsablePhotograph(*scene_, registration.name) : nullptr;
    if (photograph) {
      const Image8 picture =
          ShrunkPicture(ReadSrgb8(photograph->image_file), options_.picture_width_px);
      const Camera measured =
          ResizedCamera(registration.MeasuredCamera(), picture.width, picture.height);
      const Camera corrected =
          ResizedCamera(registration.CorrectedCamera(), picture.width, picture.height);
      body_ += "<div class=\"pair\">\n";
      AddFigure(options_.draw_edges(picture, measured, false),
                registration.name + " with the edges as measured",
                "as measured");
      if (HasCorrection(registration.verdict)) {
        AddFigure(options_.draw_edges(picture, corrected, true),
                  registration.name + " with the edges as corrected",
                  "corrected");
      }
      body_ += "</div>\n";
      return;
    }
    const fs::path overlay = folder_ / "overlays" / (registration.name + ".jpg");
    if (!fs::exists(overlay)) return;
    AddFigure(ShrunkPicture(ReadSrgb8(overlay), 2 * options_.picture_width_px),
              registration.name + " with the model's edges",
              "measured in grey, corrected in blue");
  }

  void AddFigure(const Image8& picture, const std::string& description, const char* caption) {
    body_ += "<figure>" + EmbeddedPicture(picture, description) + "<figcaption>" + caption +
             "</figcaption></figure>\n";
  }

  void AddParameters(const Registration& registration) {
    if (!HasCorrection(registration.verdict)) return;
    const CameraParameters measured = SiteParameters(ParametersFromTag(registration.measured));
    const CameraParameters corrected = SiteParameters(ParametersFromTag(registration.corrected));
    body_ +=
        "<table><thead><tr><th>Number</th><th class=\"n\">Measured</th><th class=\"n\">Corrected"
        "</th><th class=\"n\">Uncertainty, \u00b1</th><th class=\"n\">Moved</th><th class=\"n\">"
        "Moved, in expected errors</th><th></th></tr></thead><tbody>\n";
    for (int i = 0; i < kNumCameraParameters; ++i) {
      const double sigma = registration.sigmas[i];
      double moved = corrected[i] - measured[i];
      if (i == kYaw) {
        moved = std::remainder(moved, 360.0);
      }
      // A number that nothing was done to says nothing.
      if (sigma <= 0 && moved == 0) continue;
      const std::string name(kCameraParameterNames[i]);
      const bool is_undetermined =
          std::find(registration.undetermined.begin(), registration.undetermined.end(), name) !=
          registration.undetermined.end();
      const std::string unit =
          *kParameterWords[i].unit ? std::string(kParameterWords[i].unit) : UnitSuffix(scene_);
      const double prior = registration.prior_sigmas[i];
      body_ += "<tr>" + TextCell(kParameterWords[i].name) +
               NumberCell(FormatRounded(measured[i], sigma) + unit) +
               NumberCell(FormatRounded(measured[i] + moved, sigma) + unit) +
               NumberCell(sigma > 0 ? FormatSigma(sigma) + unit : "\u2013") +
               NumberCell(FormatRounded(moved, sigma) + unit) +
               NumberCell(prior > 0 ? FormatRounded(std::abs(moved) / prior, 1) : "\u2013") +
               TextCell(is_undetermined ? "<span class=\"soft\">no better known than before</span>"
                                        : "") +
               "</tr>\n";
    }
    body_ += "</tbody></table>\n";
  }

  void AddFooter() {
    body_ += "<footer><p>Made by Groundglass";
    if (manifest_) {
      body_ += " " + EscapeHtml(manifest_->value("version", ""));
      if (manifest_->contains("seed")) body_ += ", seed " + manifest_->at("seed").dump();
    }
    body_ +=
        ". After Christopher Thorman\u2019s method of 1988: a photograph with a tag is a "
        "perspective "
        "rendering of its subject.</p></footer>\n";
  }

  fs::path folder_;
  const Scene* scene_;
  ReportOptions options_;
  std::optional<std::vector<Registration>> registrations_;
  std::vector<ModelError> model_errors_;
  std::optional<Json> coverage_;
  std::optional<Json> manifest_;
  std::string body_;
};

}  // namespace

void ReportOptions::Check() const {
  CheckFromTo(picture_width_px, 16, 10000, "report options: picture_width_px");
}

std::string MakeReport(const fs::path& out_folder,
                       const Scene* scene,
                       const ReportOptions& options) {
  options.Check();
  return Report(out_folder, scene, options).Format();
}

}  // namespace groundglass
