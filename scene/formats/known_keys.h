// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// What is known of a photograph's camera besides its tag: some of a view file's keys, with where
// each comes from. A file of them (docs/view-file.md, "Calibration files") is a view file that need
// not be whole.
struct KnownKey {
  std::string key;  // "v", "sigma_v", "camera"
  std::string value;
  std::string comment;  // its source's name, and more for a person: "lens: 26 mm ..."; or empty

  bool operator==(const KnownKey&) const = default;
};
using KnownKeys = std::vector<KnownKey>;

void AddKnown(KnownKeys& keys, std::string_view key, double value, const std::string& comment = "");

// Reads such a file. Throws Error naming file, line and key.
KnownKeys ReadKnownKeys(const std::filesystem::path& file);
std::string FormatKnownKeys(const KnownKeys& keys, const std::string& comment);

// What one source says in place of what it said before, beside what others say. Of numbers that
// several tell, those with the smallest standard deviation stay. The keys' comments begin with
// their source's name; all of `fresh` are from `source`.
KnownKeys MergeKnownKeys(const KnownKeys& before, KnownKeys fresh, const std::string& source);

// The keys that a view file's text lacks, as it may take them over: what was measured together
// (x y z; i j k; the shifts; the distortion) comes together or not at all, a number of the text's
// own wins, and a standard deviation goes with its number only.
KnownKeys KeysLacking(const std::string& view_text, const KnownKeys& known);

// The text with these keys behind it.
std::string WithKeys(std::string view_text, const KnownKeys& keys);

// "v, roll": the numbers among them, for a person.
std::string NamesOf(const KnownKeys& keys);

}  // namespace groundglass
