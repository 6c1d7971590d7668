// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// The report's files as CMake puts them into the library (cmake/EmbedFiles.cmake): the page and a
// row of its table of faces, both Mustache templates, and the look.
extern const char kReportTemplate[];   // report.mustache
extern const char kFaceRowTemplate[];  // face_row.mustache
extern const char kReportStyle[];      // report.css

}  // namespace groundglass
