// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report_data.h"

#include "report/embedded_picture.h"
#include "report/report_text.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_kind.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
namespace mustache = kainjow::mustache;

std::vector<fs::path> FilesByName(const fs::path& folder, bool (*is_wanted)(const fs::path&)) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (is_wanted(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

// One length with its sign, to the digits that its standard deviation gives sense to.
std::string FormatOffset(double offset, double sigma) {
  return (offset < 0 ? "" : "+") + FormatRounded(offset, sigma);
}

// x, y and z in site.
std::string FormatPoint(const Eigen::Vector3d& point_in_world, double sigma) {
  const Eigen::Vector3d point_in_site = SiteFromWorld(point_in_world);
  return FormatRounded(point_in_site.x(), sigma) + " " + FormatRounded(point_in_site.y(), sigma) +
         " " + FormatRounded(point_in_site.z(), sigma);
}

}  // namespace

mustache::data CountsData(const ReportInput& input) {
  if (!input.registrations) return false;
  const auto count = [&](Verdict verdict) {
    const auto has_verdict = [&](const Registration& r) { return r.verdict == verdict; };
    return std::count_if(input.registrations->begin(), input.registrations->end(), has_verdict);
  };
  mustache::data data;
  data["all"] = std::to_string(input.registrations->size());
  data["accepted"] = std::to_string(count(Verdict::kAccepted));
  data["review"] = std::to_string(count(Verdict::kReview));
  data["rejected"] = std::to_string(count(Verdict::kRejected));
  const auto num_unreadable = count(Verdict::kUnreadable);
  data["unreadable"] = false;
  if (num_unreadable > 0) data["unreadable"] = std::to_string(num_unreadable);
  return data;
}

mustache::data WarningCountData(const ReportInput& input) {
  if (!input.scene || input.scene->warnings.empty()) return false;
  const size_t num_warnings = input.scene->warnings.size();
  mustache::data data;
  data["number"] = std::to_string(num_warnings);
  data["noun"] = num_warnings == 1 ? "warning" : "warnings";
  return data;
}

mustache::data NewViewsData(const ReportInput& input) {
  const fs::path folder = input.folder / "renders";
  const std::vector<fs::path> pictures = FilesByName(
      folder, [](const fs::path& file) { return IsImageExtension(file.extension().string()); });
  const std::vector<fs::path> films =
      FilesByName(folder, [](const fs::path& file) { return file.extension() == ".mp4"; });
  if (pictures.empty() && films.empty()) return false;
  mustache::list stills;
  for (const fs::path& picture : pictures) {
    mustache::data still =
        PictureData(ReadSrgb8(picture), input.options.picture_width_px, input.still_bytes);
    still["name"] = picture.stem().string();
    stills.push_back(std::move(still));
  }
  mustache::list links;
  for (const fs::path& film : films) {
    const std::string name = film.filename().string();
    mustache::data link;
    link["name"] = name;
    link["in_address"] = EncodeForAddress(name);
    links.push_back(std::move(link));
  }
  mustache::data data;
  data["stills"] = stills;
  data["films"] = links;
  return data;
}

mustache::data ModelErrorsData(const ReportInput& input) {
  if (input.model_errors.empty()) return false;
  mustache::list lines;
  for (const ModelError& error : input.model_errors) {
    const Eigen::Vector3d offset_in_site = SiteFromWorld(error.offset_in_world);
    mustache::data line;
    line["name"] = error.name;
    line["x"] = FormatOffset(offset_in_site.x(), error.sigma);
    line["y"] = FormatOffset(offset_in_site.y(), error.sigma);
    line["z"] = FormatOffset(offset_in_site.z(), error.sigma);
    line["sigma"] = FormatSigma(error.sigma);
    line["from"] = FormatPoint(error.start_in_world, error.sigma);
    line["to"] = FormatPoint(error.end_in_world, error.sigma);
    line["length"] = FormatRounded((error.end_in_world - error.start_in_world).norm(), error.sigma);
    line["with"] = error.with_the_one_before;
    std::string photographs;
    for (const std::string& name : error.photographs) {
      photographs += (photographs.empty() ? "" : " ") + name;
    }
    line["photographs"] = photographs;
    lines.push_back(std::move(line));
  }
  return {"lines", lines};
}

mustache::data TiesData(const ReportInput& input) {
  std::string what = input.ties.patches ? "patches of faces that are seen alike" : "";
  if (const std::optional<TieUse::Colmap>& colmap = input.ties.colmap) {
    what += (what.empty() ? "" : ", and ") + std::to_string(colmap->num_tracks) +
            " points that COLMAP " + colmap->version + " matched in " +
            std::to_string(colmap->num_pairs) + " pairs of photographs";
  }
  if (what.empty()) return false;
  return {"what", what};
}

mustache::data WarningsData(const ReportInput& input) {
  if (!input.scene || input.scene->warnings.empty()) return false;
  return {"list", TextListData(input.scene->warnings)};
}

mustache::data NotesData(const ReportInput& input) {
  if (!input.scene || input.scene->notes.empty()) return false;
  return {"list", TextListData(input.scene->notes)};
}

mustache::data MadeByData(const ReportInput& input) {
  if (!input.manifest) return false;
  mustache::data data;
  data["version"] = input.manifest->value("version", "");
  data["seed"] = false;
  if (input.manifest->contains("seed")) data["seed"] = input.manifest->at("seed").dump();
  return data;
}

}  // namespace groundglass
