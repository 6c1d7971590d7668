// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report.h"

#include "report/report_data.h"
#include "report/report_input.h"
#include "report/report_page.h"
#include "scene/check_option.h"

#include <kainjow/mustache.hpp>

#include <cassert>

namespace groundglass {
namespace {

namespace mustache = kainjow::mustache;

// Data by the names that report.mustache uses.
mustache::data PageData(const ReportInput& input) {
  mustache::data page;
  page["title"] = input.options.title;
  page["style"] = kReportStyle;
  page["script"] = kReportScript;
  page["plan"] = PlanData(input);
  page["next_steps"] = NextStepsData(input);
  page["model"] = ModelData(input);
  page["provenance"] = ProvenanceData(input);
  page["unit"] = input.unit;
  page["face_row"] =
      mustache::data(mustache::partial([] { return std::string(kFaceRowTemplate); }));
  page["counts"] = CountsData(input);
  page["warning_count"] = WarningCountData(input);
  page["new_views"] = NewViewsData(input);
  page["photograph_table"] = PhotographTableData(input);
  page["coverage"] = CoverageData(input);
  page["ties"] = TiesData(input);
  page["model_errors"] = ModelErrorsData(input);
  page["photographs"] = PhotographsData(input);
  page["warnings"] = WarningsData(input);
  page["notes"] = NotesData(input);
  page["made_by"] = MadeByData(input);
  return page;
}

}  // namespace

void ReportOptions::Check() const {
  CheckFromTo(picture_width_px, 16, 10000, "report options: picture_width_px");
  CheckFromTo(max_megabytes, 1, 1000, "report options: max_megabytes");
}

std::string MakeReport(const std::filesystem::path& out_folder,
                       const Scene* scene,
                       const ReportOptions& options) {
  options.Check();
  const mustache::data page = PageData(ReadReportInput(out_folder, scene, options));
  mustache::mustache report(kReportTemplate);
  assert(report.is_valid());
  return report.render(page);
}

}  // namespace groundglass
