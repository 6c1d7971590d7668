// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// The report's files as CMake puts them into the library (cmake/EmbedFiles.cmake): the page and a
// row of its table of faces, both Mustache templates, the look, and what moves.
extern const char kReportTemplate[];   // report.mustache
extern const char kFaceRowTemplate[];  // face_row.mustache
extern const char kReportStyle[];      // report.css
extern const char kReportScript[];     // report.js
// What turns the model, bundled from web/; empty where it could not be built.
extern const char kModelScript[];

}  // namespace groundglass
