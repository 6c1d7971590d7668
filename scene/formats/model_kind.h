// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>

namespace groundglass {

// What kind of model a file is by its content, where that is beyond doubt: names are wrong too
// often (a PLY called .stl, a download that is a web page).
struct ModelKind {
  std::string ending;       // ".ply", ".gml": of kinds that are read; empty: not read, or not known
  std::string description;  // for a person: "a PLY", "an FBX file"; empty: not known
  std::string remedy;       // what to do with what is not read
};

// Not known too where the file cannot be opened.
ModelKind FindModelKind(const std::filesystem::path& file);

// Error that says what the file is, and what to do, if that is another kind than its ending says.
void CheckModelKind(const std::filesystem::path& file);

}  // namespace groundglass
