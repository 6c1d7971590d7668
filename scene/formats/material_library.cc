// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/material_library.h"

#include "scene/error.h"
#include "scene/formats/continued_lines.h"
#include "scene/formats/view_io.h"
#include "scene/srgb.h"
#include "scene/text.h"

#include <algorithm>
#include <array>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// The entry of a folder with this name, whatever its case.
std::optional<fs::path> FindEntry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  const std::string lower = LowerCase(name);
  std::optional<fs::path> found;
  for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end;
       !error && entry != end;
       entry.increment(error)) {
    const std::string candidate = entry->path().filename().string();
    if (LowerCase(candidate) != lower) continue;
    // Of several, the same one on every machine.
    if (!found || candidate < found->filename().string()) found = folder / candidate;
  }
  return found;
}

std::optional<fs::path> FindBelow(const fs::path& folder, const fs::path& relative) {
  fs::path place = folder;
  for (const fs::path& part : relative) {
    if (part.empty() || part == ".") continue;
    const auto next = part == ".." ? std::optional(place / part) : FindEntry(place, part.string());
    if (!next) return std::nullopt;
    place = *next;
  }
  std::error_code error;
  return fs::is_regular_file(place, error) ? std::optional(place) : std::nullopt;
}

// "-s 1 1 1 -clamp on photo of wall.jpg": options with as many words as each takes, then a name
// with blanks.
void ReadPicture(std::string_view text, ObjMaterial& material) {
  struct Option {
    std::string_view name;
    int least;
    int most;
  };
  constexpr std::array<Option, 12> kOptions = {{{"-blendu", 1, 1},
                                                {"-blendv", 1, 1},
                                                {"-boost", 1, 1},
                                                {"-mm", 2, 2},
                                                {"-o", 1, 3},
                                                {"-s", 1, 3},
                                                {"-t", 1, 3},
                                                {"-texres", 1, 1},
                                                {"-clamp", 1, 1},
                                                {"-bm", 1, 1},
                                                {"-imfchan", 1, 1},
                                                {"-cc", 1, 1}}};
  const auto take_word = [&] {
    const size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text = TrimBlanks(text.substr(end));
    return word;
  };
  while (!text.empty() && text.front() == '-') {
    const std::string name = LowerCase(text.substr(0, text.find_first_of(" \t")));
    const auto option = std::find_if(
        kOptions.begin(), kOptions.end(), [&](const Option& known) { return known.name == name; });
    if (option == kOptions.end() && name != "-type") break;  // a file's name after all
    take_word();
    std::vector<double> numbers;
    const int least = option == kOptions.end() ? 1 : option->least;
    const int most = option == kOptions.end() ? 1 : option->most;
    for (int i = 0; i < most && !text.empty(); ++i) {
      const auto number = ParseNumber(text.substr(0, text.find_first_of(" \t")));
      if (i >= least && !number) break;
      take_word();
      numbers.push_back(number.value_or(0));
    }
    if ((name == "-s" || name == "-o") && !numbers.empty()) {
      Eigen::Vector2d& target = name == "-s" ? material.scale : material.offset;
      target.x() = numbers[0];
      if (numbers.size() > 1) target.y() = numbers[1];
    }
  }
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  material.picture = std::string(text);
}

// "0.8 0.2 0.1" in sRGB as linear light; one number is a grey. Nothing for spectra and faults.
std::optional<std::array<float, 3>> ReadColour(std::string_view text) {
  std::array<float, 3> colour = {};
  size_t count = 0;
  for (const TextLine& line : SplitLines(text, '\0')) {
    for (const TextToken& token : line.tokens) {
      const auto number = ParseNumber(token.text);
      if (!number || count == colour.size()) return std::nullopt;
      colour[count++] = LinearFromSrgb(static_cast<float>(*number));
    }
  }
  if (count == 1) colour[1] = colour[2] = colour[0];
  return count == 1 || count == colour.size() ? std::optional(colour) : std::nullopt;
}

void ReadLibrary(const fs::path& library, std::map<std::string, ObjMaterial>& materials) {
  const std::string text = ReadTextFile(library);
  ObjMaterial* material = nullptr;
  bool is_mark = false;
  for (ContinuedLines lines(text); lines.Next();) {
    const std::string keyword = LowerCase(lines.keyword());
    if (keyword == "newmtl") {
      // As in the programs that write them, the first of a name counts.
      const auto [place, is_new] = materials.try_emplace(std::string(lines.rest()));
      material = is_new ? &place->second : nullptr;
      place->second.folder = library.parent_path();
      is_mark = lines.rest() == kNoPhotographMaterial;
    } else if (keyword == "map_kd" && material != nullptr) {
      ReadPicture(lines.rest(), *material);
    } else if (keyword == "kd" && material != nullptr && !is_mark) {
      material->colour = ReadColour(lines.rest());
    }
  }
}

}  // namespace

std::optional<fs::path> FindNamedFile(const fs::path& folder, const std::string& name) {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  if (slashed.empty()) return std::nullopt;
  const fs::path path(slashed);
  std::error_code error;
  if (path.is_absolute() && fs::is_regular_file(path, error)) return path;
  // A backslash may also be part of a name.
  if (fs::is_regular_file(folder / name, error)) return folder / name;
  const bool has_drive = slashed.size() > 1 && slashed[1] == ':';
  if (!path.is_absolute() && !has_drive) {
    if (auto found = FindBelow(folder, path)) return found;
  }
  return FindBelow(folder, path.filename());
}

std::map<std::string, ObjMaterial> ReadMaterials(const fs::path& obj_file,
                                                 const std::vector<std::string>& libraries,
                                                 std::vector<std::string>& warnings) {
  std::map<std::string, ObjMaterial> materials;
  const fs::path folder = obj_file.parent_path();
  const auto read = [&](const std::string& name) {
    const auto library = FindNamedFile(folder, name);
    if (!library) return false;
    try {
      ReadLibrary(*library, materials);
    } catch (const Error& error) {
      warnings.push_back(error.what());
    }
    return true;
  };
  for (const std::string& line : libraries) {
    if (read(line)) continue;
    // Several names, or one with blanks that is not there.
    std::vector<std::string> missing;
    bool is_any = false;
    for (const TextLine& split : SplitLines(line, '\0')) {
      for (const TextToken& token : split.tokens) {
        if (split.tokens.size() > 1 && read(std::string(token.text))) {
          is_any = true;
        } else {
          missing.emplace_back(token.text);
        }
      }
    }
    if (!is_any) missing = {line};
    for (const std::string& name : missing) {
      warnings.push_back(
          Error(obj_file,
                "the material library " + Quote(name) + " is not there; its faces are grey")
              .what());
    }
  }
  return materials;
}

}  // namespace groundglass
