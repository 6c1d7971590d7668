// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "report/report_input.h"

#include <kainjow/mustache.hpp>

namespace groundglass {

// What fills in the sections of report.mustache, one function for each, by the names that the
// template uses. `false` leaves a section out.

// Of the heading: how many photographs have which verdict.
kainjow::mustache::data CountsData(const ReportInput& input);
// The stations from above: as written, as corrected, with error ellipses.
kainjow::mustache::data PlanData(const ReportInput& input);
// What a person could do next, most useful first; false if nothing is left.
kainjow::mustache::data NextStepsData(const ReportInput& input);
// How much of what is seen each photograph shows. Error if coverage.json does not hold it.
kainjow::mustache::data ProvenanceData(const ReportInput& input);
// The textured model to be turned in the page, small enough for it; false if there is none.
kainjow::mustache::data ModelData(const ReportInput& input);
// What was corrected, in a sentence: "Stood 1.3 ft further east, looked 0.4° higher, compared with
// the field notes." Empty where nothing was. unit: as ReportInput has it.
std::string CorrectionInWords(const Registration& registration, const std::string& unit);
// Of the heading: number and noun.
kainjow::mustache::data WarningCountData(const ReportInput& input);
// Stills and films of renders/.
kainjow::mustache::data NewViewsData(const ReportInput& input);
// One row for each photograph.
kainjow::mustache::data PhotographTableData(const ReportInput& input);
// How much of each face the photographs show. Error if coverage.json does not hold it.
kainjow::mustache::data CoverageData(const ReportInput& input);
// What tied the photographs together, in a sentence; false if nothing did.
kainjow::mustache::data TiesData(const ReportInput& input);
// Where the model is off.
kainjow::mustache::data ModelErrorsData(const ReportInput& input);
// Each photograph with its pictures and numbers.
kainjow::mustache::data PhotographsData(const ReportInput& input);
// What was odd about the scene.
kainjow::mustache::data WarningsData(const ReportInput& input);
kainjow::mustache::data NotesData(const ReportInput& input);
// Of the footer: version and seed.
kainjow::mustache::data MadeByData(const ReportInput& input);

}  // namespace groundglass
