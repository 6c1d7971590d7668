// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/select_photographs.h"

#include "scene/error.h"
#include "scene/formats/untagged.h"
#include "scene/text.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Error where it is a photograph that is there, and lacks nothing but a tag.
void RefuseUntagged(const Scene& scene, const std::string& name, const std::string& place) {
  std::vector<PhotographName> untagged;
  for (const std::filesystem::path& image : scene.untagged_images) {
    untagged.push_back({image.stem().string(), image.filename().string()});
  }
  const auto matches = MatchPhotographs(std::vector<std::string>{name}, untagged);
  if (!matches[0]) return;
  const std::filesystem::path& image = scene.untagged_images[*matches[0]];
  std::string how;
  if (!HasTagTable(scene.folder)) {
    how = " (groundglass check " + scene.folder.string() +
          " --template lays one out, to be filled in)";
  }
  throw Error(place + ": " + image.filename().string() + ": " +
              DescribeUntagged(image.stem().string(), scene.folder) + how);
}

// Where a name with a comma was taken for two; empty if it was not.
std::string ExplainComma(const std::string& name, const std::vector<PhotographName>& known) {
  for (const PhotographName& photograph : known) {
    const std::string& whole = photograph.name;
    if (!whole.starts_with(name + ",")) continue;
    return " (a comma parts two names here; to be named alone, " + Quote(whole) +
           " and its tag want names without one)";
  }
  return "";
}

}  // namespace

std::vector<PhotographName> AllPhotographNames(const Scene& scene) {
  std::vector<PhotographName> known = NamesOf(scene.photographs);
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    const Photograph& photograph = unreadable.photograph;
    known.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  for (const std::string& name : scene.left_out) known.push_back({name, ""});
  std::sort(known.begin(), known.end(), [](const PhotographName& a, const PhotographName& b) {
    return NaturalLess(a.name, b.name);
  });
  return known;
}

std::vector<std::string> FindPhotographNames(const Scene& scene,
                                             const std::vector<std::string>& names,
                                             const std::string& place) {
  const std::vector<PhotographName> known = AllPhotographNames(scene);
  std::vector<std::string> found;
  for (const std::string& name : names) {
    std::optional<size_t> index;
    try {
      index = FindPhotograph(name, known);
    } catch (const Error& error) {
      throw Error(place + ": " + error.what());
    }
    if (!index) RefuseUntagged(scene, name, place);
    if (!index) {
      std::string all;
      for (const PhotographName& photograph : known) {
        all += (all.empty() ? " " : ", ") + photograph.name;
      }
      const std::string comma = ExplainComma(name, known);
      throw Error(place + ": no photograph is called " + Quote(name) +
                  (comma.empty() ? NearestName(name, known) : comma) + "; there are" + all);
    }
    found.push_back(known[*index].name);
  }
  return found;
}

void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place) {
  FindPhotographNames(scene, names, place);
}

std::string NameInScene(const std::string& name, const Scene& scene) {
  const std::vector<PhotographName> known = AllPhotographNames(scene);
  const std::optional<size_t> found = FindPhotograph(name, known);
  return found ? known[*found].name : name;
}

void KeepPhotographs(const std::vector<std::string>& names, Scene& scene) {
  if (names.empty()) return;
  std::vector<std::string> kept;
  for (const std::string& name : names) kept.push_back(NameInScene(name, scene));
  const auto leave_out = [&](const Photograph& photograph) {
    if (Contains(kept, photograph.name)) return false;
    scene.left_out.push_back(photograph.name);
    return true;
  };
  std::erase_if(scene.photographs, leave_out);
  std::erase_if(scene.unreadable, [&](const UnreadablePhotograph& unreadable) {
    return leave_out(unreadable.photograph);
  });
}

void ForgiveUnreadable(const std::vector<std::string>& names, Scene& scene) {
  std::erase_if(scene.unreadable, [&](const UnreadablePhotograph& unreadable) {
    if (!Contains(names, unreadable.photograph.name)) return false;
    scene.left_out.push_back(unreadable.photograph.name);
    return true;
  });
}

}  // namespace groundglass
