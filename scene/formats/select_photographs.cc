// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/select_photographs.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
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
    if (!index) {
      std::string all;
      for (const PhotographName& photograph : known) {
        all += (all.empty() ? " " : ", ") + photograph.name;
      }
      throw Error(place + ": no photograph is called " + Quote(name) + NearestName(name, known) +
                  "; there are" + all);
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
