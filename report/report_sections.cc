// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_sections.h"

#include "report/report_html.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

using Json = nlohmann::json;

// A face of which less than this is seen is pointed out.
constexpr double kWellCovered = 0.5;

double SeenShare(const Json& face) {
  const double area = face.value("area", 0.0);
  return area > 0 ? face.value("covered_area", 0.0) / area : 0;
}

// Which photographs a face's texels come from, those with a twentieth or more by name.
std::string FormatSources(const Json& face) {
  const double texels = face.value("covered_texels", 0.0);
  std::string from;
  size_t num_left_out = 0;
  for (const Json& source : face.value("sources", Json::array())) {
    const double part = texels > 0 ? source.value("texels", 0.0) / texels : 0;
    if (part < 0.05) {
      ++num_left_out;
      continue;
    }
    if (!from.empty()) from += ", ";
    from += EscapeHtml(source.value("photograph", "")) + " <span class=\"soft\">" +
            FormatShare(part) + "</span>";
  }
  if (num_left_out > 0) {
    from += " <span class=\"soft\">and " + std::to_string(num_left_out) + " more</span>";
  }
  return from;
}

// "232, -104, 5": where to stand, in `site`.
std::string FormatStandpoint(const Json& face) {
  const Json missing = face.value("missing", Json::object());
  const auto at = missing.value("stand_at", std::vector<double>());
  std::string text;
  for (const double coordinate : at) {
    text += (text.empty() ? "" : ", ") + FormatRounded(coordinate, 10);
  }
  return text.empty() ? "\u2013" : text;
}

std::string FormatFaceRow(const Json& face, bool with_standpoint) {
  const double share = SeenShare(face);
  const int percent = static_cast<int>(std::lround(100 * std::clamp(share, 0.0, 1.0)));
  return std::string("<tr") + (share < kWellCovered ? " class=\"missing\"" : "") + ">" +
         NumberCell(std::to_string(face.value("face", 0))) +
         TextCell(EscapeHtml(face.value("name", ""))) +
         NumberCell(FormatRounded(face.value("area", 0.0), 1)) + NumberCell(FormatShare(share)) +
         TextCell("<span class=\"bar\"><i style=\"width:" + std::to_string(percent) +
                  "%\"></i></span>") +
         NumberCell(face.value("covered_texels", 0.0) > 0
                        ? FormatSigma(face.value("texel_size", 0.0))
                        : "\u2013") +
         TextCell(FormatSources(face)) + (with_standpoint ? TextCell(FormatStandpoint(face)) : "") +
         "</tr>\n";
}

std::string FormatFaceTable(const std::vector<Json>& faces,
                            const std::string& unit,
                            bool with_standpoint) {
  std::string table =
      "<table><thead><tr><th class=\"n\">Face</th><th>Name</th><th class=\"n\">Area," + unit +
      "\u00b2</th><th class=\"n\">Seen</th><th></th><th class=\"n\">Texel," + unit +
      "</th><th>From</th>" + (with_standpoint ? "<th>Stand at x, y, z," + unit + "</th>" : "") +
      "</tr></thead><tbody>\n";
  for (const Json& face : faces) table += FormatFaceRow(face, with_standpoint);
  return table + "</tbody></table>\n";
}

// One length with its sign, to the digits that its standard deviation gives sense to.
std::string FormatOffset(double offset, double sigma) {
  return (offset < 0 ? "" : "+") + FormatRounded(offset, sigma);
}

}  // namespace

std::string FormatCoverageSection(const Json& coverage, const std::string& unit) {
  const std::vector<Json> faces = coverage.value("faces", std::vector<Json>());
  std::vector<Json> missing;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(missing), [](const Json& face) {
    return SeenShare(face) < kWellCovered;
  });
  std::string section = "<h2>Coverage</h2>\n<p>How much of each of the model\u2019s " +
                        Plural(faces.size(), "face") + " the photographs show. ";
  if (missing.empty()) {
    section += "Every face is seen by half or more.</p>\n";
  } else {
    section += Plural(missing.size(), "face") + (missing.size() == 1 ? " is" : " are") +
               " seen by less than half: a photograph from the place named would show what is "
               "missing; where none is named, none was found from which nothing of the model "
               "stands before it.</p>\n" +
               FormatFaceTable(missing, unit, true);
  }
  return section + "<details><summary>All faces</summary>\n" + FormatFaceTable(faces, unit, false) +
         "</details>\n";
}

std::string FormatWarningSection(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "";
  std::string section =
      "<h2>Warnings</h2>\n<p>What was odd about the scene as it was read.</p>\n<ul>";
  for (const std::string& warning : warnings) section += "<li>" + EscapeHtml(warning) + "</li>\n";
  return section + "</ul>\n";
}

std::string FormatModelErrorSection(const std::vector<ModelError>& errors,
                                    const std::string& unit) {
  if (errors.empty()) return "";
  std::string section =
      "<h2>Where the model is off</h2>\n<p>Lines that the photographs agree to see elsewhere, by "
      "how much (x east, y south, z up," +
      unit +
      "), with one standard deviation. The cameras "
      "were found with these lines where the photographs show them; the model was left as it is."
      "</p>\n<table><thead><tr><th>Line between</th><th class=\"n\">x</th><th class=\"n\">y</th>"
      "<th class=\"n\">z</th><th class=\"n\">\u00b1</th><th class=\"n\">Photographs</th></tr>"
      "</thead><tbody>\n";
  for (const ModelError& error : errors) {
    const Eigen::Vector3d offset_in_site = SiteFromWorld(error.offset_in_world);
    section += "<tr>" + TextCell(EscapeHtml(error.name));
    for (const double offset : offset_in_site) {
      section += NumberCell(FormatOffset(offset, error.sigma));
    }
    section += NumberCell(FormatSigma(error.sigma)) +
               NumberCell(std::to_string(error.num_photographs)) + "</tr>\n";
  }
  return section + "</tbody></table>\n";
}

}  // namespace groundglass
