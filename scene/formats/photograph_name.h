// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// What a photograph is called: its name ("s5") and its file's ("s5.jpg"; empty if there is none).
struct PhotographName {
  std::string name;
  std::string file_name;
};

template <typename Photographs>
std::vector<PhotographName> NamesOf(const Photographs& photographs) {
  std::vector<PhotographName> names;
  for (const auto& photograph : photographs) {
    names.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  return names;
}

// The one way to find a photograph by what a person or another program calls it: its name or its
// file's as they are; else without an image's extension; else without folders; else whatever upper
// and lower case and Unicode form ("ü" in one part or, as macOS has it, in two). The first of these
// that finds any decides. Nothing if none is meant; throws Error naming them if several are.
std::optional<size_t> FindPhotograph(std::string_view word, std::span<const PhotographName> names);

// The same for many words at once, where each name goes to one word only: words that match exactly
// come first. Nothing for a word that none is meant by, or several, or one that another word means
// as well.
std::vector<std::optional<size_t>> MatchPhotographs(std::span<const std::string> words,
                                                    std::span<const PhotographName> names);

// For a message about a word that nothing matches: " (is it s05? it differs in zeros, blanks or
// dashes only)", " (did you mean Turm?)"; empty if no name is so close.
std::string NearestName(std::string_view word, std::span<const PhotographName> names);

}  // namespace groundglass
