// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_data.h"
#include "report/report_text.h"
#include "scene/advice/turned_faces.h"
#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/text.h"

#include <Eigen/Dense>

#include <algorithm>
#include <utility>

namespace groundglass {
namespace {

using Json = nlohmann::json;
namespace mustache = kainjow::mustache;

// As many as a person does before coming back to the list.
constexpr size_t kMostStandpoints = 6;
constexpr size_t kMostNamedFaces = 4;
constexpr size_t kMostModelErrors = 3;

struct Step {
  std::string text;
  std::string link;  // a photograph's name, to its section; empty for none
};

// Where several faces could be photographed at once.
struct Standpoint {
  Eigen::Vector3d at_in_site = Eigen::Vector3d::Zero();
  double missing_area = 0;
  std::vector<std::string> faces;
};

// A face's standpoint joins another's that is nearer than this share of how far they stand from
// what they are to show.
constexpr double kSameStandpoint = 0.25;

std::vector<Standpoint> FindStandpoints(const Json& coverage) {
  std::vector<Standpoint> standpoints;
  for (const Json& face : coverage.value("faces", Json::array())) {
    const Json missing = face.value("missing", Json::object());
    const auto at = missing.value("stand_at", std::vector<double>());
    const auto centre = missing.value("centre", std::vector<double>());
    if (at.size() != 3 || centre.size() != 3) continue;
    const Eigen::Vector3d at_in_site(at[0], at[1], at[2]);
    const double distance = (at_in_site - Eigen::Vector3d(centre[0], centre[1], centre[2])).norm();
    auto standpoint =
        std::find_if(standpoints.begin(), standpoints.end(), [&](const Standpoint& known) {
          return (known.at_in_site - at_in_site).norm() < kSameStandpoint * distance;
        });
    if (standpoint == standpoints.end()) {
      standpoint = standpoints.insert(standpoints.end(), Standpoint{at_in_site, 0, {}});
    }
    standpoint->missing_area += missing.value("area", 0.0);
    const std::string name = face.value("name", "");
    standpoint->faces.push_back(name.empty() ? "face " + std::to_string(face.value("face", 0))
                                             : name);
  }
  // Slivers along edges are no reason to go there.
  std::erase_if(standpoints, [](const Standpoint& standpoint) {
    return FormatRounded(standpoint.missing_area, 10) == "0";
  });
  std::stable_sort(standpoints.begin(), standpoints.end(), [](const auto& a, const auto& b) {
    return a.missing_area > b.missing_area;
  });
  return standpoints;
}

// Higher above the model's foot than a person with a pole holds a camera, m.
constexpr double kWithinReachM = 4;

// What it takes to get up there; empty for a place that a person reaches, or if nobody knows.
std::string HowToGetThere(const Eigen::Vector3d& at_in_site, const ReportInput& input) {
  if (!input.scene || input.scene->model.points_in_world.empty()) return "";
  const PolygonModel& model = input.scene->model;
  const double height = at_in_site.z() - ComputeBounds(model).min.z();
  if (height * MetresPerUnit(model.unit) <= kWithinReachM) return "";
  return ", " + FormatRounded(height, 10) + input.unit +
         " above the model\u2019s foot (with a drone, or from a window or roof nearby)";
}

Step StandStep(const Standpoint& standpoint, const ReportInput& input) {
  const std::string& unit = input.unit;
  std::string faces;
  for (size_t i = 0; i < std::min(standpoint.faces.size(), kMostNamedFaces); ++i) {
    faces += (i == 0 ? "" : ", ") + standpoint.faces[i];
  }
  if (standpoint.faces.size() > kMostNamedFaces) {
    faces += " and " + std::to_string(standpoint.faces.size() - kMostNamedFaces) + " more";
  }
  const Eigen::Vector3d& at = standpoint.at_in_site;
  return {"Take a photograph from x " + FormatRounded(at.x(), 10) + ", y " +
              FormatRounded(at.y(), 10) + ", z " + FormatRounded(at.z(), 10) + unit +
              HowToGetThere(at, input) + ": it would show " +
              FormatRounded(standpoint.missing_area, 10) + unit + "\u00b2 that none shows yet (" +
              faces + ").",
          ""};
}

std::string FirstReason(const Registration& registration) {
  return registration.reasons.empty() ? "" : " " + registration.reasons.front();
}

void AddPhotographs(const ReportInput& input,
                    Verdict verdict,
                    const std::string& words,
                    std::vector<Step>& steps) {
  for (const Registration& registration : *input.registrations) {
    if (registration.verdict != verdict) continue;
    steps.push_back({words + FirstReason(registration), registration.name});
  }
}

// Photographs that nobody wrote a tag for: they are in no table, and so in no other part.
void AddUntagged(const ReportInput& input, std::vector<Step>& steps) {
  if (!input.scene || input.scene->untagged_images.empty()) return;
  const std::vector<std::filesystem::path>& images = input.scene->untagged_images;
  std::string names;
  for (size_t i = 0; i < std::min(images.size(), kMostNamedFaces); ++i) {
    names += (i == 0 ? "" : ", ") + images[i].filename().string();
  }
  if (images.size() > kMostNamedFaces) {
    names += " and " + std::to_string(images.size() - kMostNamedFaces) + " more";
  }
  steps.push_back({names + (images.size() == 1 ? " has" : " have") +
                       " no tag and so no part in this: write down where " +
                       std::string(images.size() == 1 ? "it was" : "they were") +
                       " taken from "
                       "(groundglass check SCENE --template makes a file to fill in).",
                   ""});
}

// Faces that take no texture since they are turned: nowhere to stand would show them.
void AddTurnedFaces(const ReportInput& input, std::vector<Step>& steps) {
  if (!input.scene) return;
  const std::vector<TurnedFace> turned = FindTurnedFaces(*input.scene);
  for (size_t i = 0; i < std::min(turned.size(), kMostNamedFaces); ++i) {
    steps.push_back({"Turn " + DescribeFace(input.scene->model, turned[i].face) +
                         " in the model: photographs see its back, and its front never, so that it "
                         "takes no texture.",
                     ""});
  }
  if (turned.size() <= kMostNamedFaces) return;
  steps.push_back({"Turn " + std::to_string(turned.size() - kMostNamedFaces) +
                       " more faces that are seen from their backs; groundglass check tells.",
                   ""});
}

// What is off as one is measured once.
void AddModelErrors(const ReportInput& input, std::vector<Step>& steps) {
  size_t num_told = 0;
  for (size_t i = 0; i < input.model_errors.size() && num_told < kMostModelErrors; ++num_told) {
    const ModelError& error = input.model_errors[i];
    size_t end = i + 1;
    while (end < input.model_errors.size() && input.model_errors[end].with_the_one_before) ++end;
    const size_t num_with_it = end - i - 1;
    steps.push_back(
        {"Measure \u201c" + error.name + "\u201d again" +
             (num_with_it > 0 ? ", and with it " + Plural(num_with_it, "more line") : "") + ": " +
             Plural(error.photographs.size(), "photograph") + " see it " +
             FormatRounded(error.offset_in_world.norm(), error.sigma) + input.unit +
             " from where the model has it.",
         ""});
    i = end;
  }
}

}  // namespace

// What can be mended at the desk comes before a walk to the building.
mustache::data NextStepsData(const ReportInput& input) {
  std::vector<Step> steps;
  if (input.registrations) {
    AddPhotographs(input, Verdict::kUnreadable, "cannot be read: mend its file.", steps);
    AddPhotographs(
        input, Verdict::kRejected, "is not used: compare its field notes with the picture.", steps);
    AddPhotographs(
        input, Verdict::kReview, "is used at lower weight: look whether the edges fit.", steps);
  }
  AddUntagged(input, steps);
  AddTurnedFaces(input, steps);
  if (input.coverage) {
    try {
      const std::vector<Standpoint> standpoints = FindStandpoints(*input.coverage);
      for (size_t i = 0; i < std::min(standpoints.size(), kMostStandpoints); ++i) {
        steps.push_back(StandStep(standpoints[i], input));
      }
    } catch (const Json::exception& error) {
      throw Error(input.folder / "coverage.json",
                  "is not as texturing writes it: " + TellJsonFault(error.what()));
    }
  }
  AddModelErrors(input, steps);
  if (steps.empty()) return false;
  mustache::list list;
  for (const Step& step : steps) {
    mustache::data entry;
    entry["text"] = step.text;
    entry["photograph"] = false;
    if (!step.link.empty()) entry["photograph"] = mustache::data("name", step.link);
    list.push_back(std::move(entry));
  }
  return {"list", list};
}

}  // namespace groundglass
