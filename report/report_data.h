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
