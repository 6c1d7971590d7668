// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/image_paths.h"

#include "scene/formats/image_kind.h"
#include "scene/text.h"

#include <algorithm>
#include <map>
#include <set>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> PartsOf(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    if (!part.empty() && part != ".") parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

// Folders and stem with '_' between.
std::string JoinedName(const std::string& path) {
  std::string name;
  for (const std::string& part : PartsOf(WithoutExtension(path))) {
    name += (name.empty() ? "" : "_") + part;
  }
  return name;
}

// How many parts two paths share from the end on.
size_t NumShared(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  size_t count = 0;
  while (count < std::min(a.size(), b.size()) && a[a.size() - 1 - count] == b[b.size() - 1 - count])
    ++count;
  return count;
}

}  // namespace

std::string WithoutExtension(const std::string& path) {
  fs::path without(path);
  if (IsImageExtension(without.extension().string())) without.replace_extension();
  return without.generic_string();
}

std::vector<std::string> NamePhotographs(const std::vector<std::string>& paths) {
  const auto stem_of = [](const std::string& path) {
    const std::vector<std::string> parts = PartsOf(WithoutExtension(path));
    return parts.empty() ? std::string() : parts.back();
  };
  // Different places (paths without their extension) that have a stem in common.
  std::map<std::string, std::set<std::string>> places_of_stem;
  for (const std::string& path : paths) {
    places_of_stem[stem_of(path)].insert(JoinedName(path));
  }
  std::map<std::string, std::string> place_of_name;
  std::vector<std::string> names(paths.size());
  // Plain stems first, so that they stay what they are.
  for (const bool is_plain : {true, false}) {
    for (size_t i = 0; i < paths.size(); ++i) {
      const std::string stem = stem_of(paths[i]);
      if ((places_of_stem[stem].size() == 1) != is_plain) continue;
      const std::string place = WithoutExtension(paths[i]);
      const std::string name = is_plain ? stem : JoinedName(paths[i]);
      names[i] = name;
      for (int number = 2; place_of_name.emplace(names[i], place).first->second != place;
           ++number) {
        names[i] = name + "_" + std::to_string(number);
      }
    }
  }
  return names;
}

void ImagePathFinder::Simplify(int attempt, Parts& parts) {
  if (attempt >= 1) parts.back() = WithoutExtension(parts.back());
  if (attempt >= 2) {
    for (std::string& part : parts) part = LowerCase(part);
  }
}

ImagePathFinder::ImagePathFinder(const std::vector<std::string>& paths) {
  for (int attempt = 0; attempt < kNumAttempts; ++attempt) {
    for (size_t i = 0; i < paths.size(); ++i) {
      Parts parts = PartsOf(paths[i]);
      if (!parts.empty()) {
        Simplify(attempt, parts);
        paths_of_last_part_[attempt][parts.back()].push_back(i);
      }
      parts_of_path_[attempt].push_back(std::move(parts));
    }
  }
}

std::optional<size_t> ImagePathFinder::Find(const std::string& name) const {
  for (int attempt = 0; attempt < kNumAttempts; ++attempt) {
    Parts wanted = PartsOf(name);
    if (wanted.empty()) return std::nullopt;
    Simplify(attempt, wanted);
    const auto alike = paths_of_last_part_[attempt].find(wanted.back());
    if (alike == paths_of_last_part_[attempt].end()) continue;
    size_t most = 0;
    std::optional<size_t> best;
    for (const size_t i : alike->second) {
      const Parts& parts = parts_of_path_[attempt][i];
      if (parts == wanted) return i;
      const size_t shared = NumShared(parts, wanted);
      if (shared < most) continue;
      best = shared > most ? std::optional(i) : std::nullopt;
      most = shared;
    }
    if (best) return best;
  }
  return std::nullopt;
}

std::vector<std::string> ListFilesBelow(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator
           entry(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().string().front() == '.') {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(ignored)) {
      files.push_back(entry->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(files.begin(), files.end(), NaturalLess);
  return files;
}

std::vector<std::string> ListImagePaths(const fs::path& folder) {
  std::vector<std::string> paths = ListFilesBelow(folder);
  std::erase_if(paths, [&](const std::string& path) {
    return !IsImageExtension(fs::path(path).extension().string()) &&
           !FindImageKind(folder / path).IsImage();
  });
  return paths;
}

}  // namespace groundglass
