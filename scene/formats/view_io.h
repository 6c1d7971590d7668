// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/view_tag.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// Reads a .view file (docs/view-file.md). Throws Error naming file, line and key.
ViewTag ReadView(const std::filesystem::path& file);
// The same for text already in memory; `name` stands for the file in messages.
ViewTag ParseView(const std::string& text, const std::filesystem::path& name);
// Every fault of the text, one line each, as ParseView would throw the first; empty if valid.
std::vector<std::string> FindViewFaults(const std::string& text, const std::filesystem::path& name);

// A fresh view file: one "key value" pair a line, defaults left out.
std::string FormatView(const ViewTag& tag, const std::string& comment = "");

// The hand-written file with its numbers replaced in place: comments, order and spacing survive,
// new keys are appended one to a line, and each changed pair's comment gains
// "(measured 232, now +-0.03)". Parsing the result gives `corrected` to the last bit.
// deviations: one standard deviation of each corrected number, 0 where unknown. A file that was
// corrected before keeps its first measured value. Sigmas and the camera's name are of the
// measurement: where `corrected` has none, the text's stay. The text need not have every key.
std::string FormatCorrectedView(const std::string& measured_text,
                                const ViewTag& corrected,
                                const TagDeviations& deviations);

// Reads a whole file; Error if it cannot be opened.
std::string ReadFileBytes(const std::filesystem::path& file);
// The same for text: UTF-16, as Windows' Notepad saves "Unicode", becomes UTF-8; any other bytes
// stay as they are.
std::string ReadTextFile(const std::filesystem::path& file);

}  // namespace groundglass
