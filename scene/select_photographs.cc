// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/select_photographs.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<std::string> PhotographNames(const Scene& scene) {
  std::vector<std::string> names = scene.left_out;
  for (const Photograph& photograph : scene.photographs) names.push_back(photograph.name);
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    names.push_back(unreadable.photograph.name);
  }
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

std::vector<std::string> FindPhotographNames(const Scene& scene,
                                             const std::vector<std::string>& names,
                                             const std::string& place) {
  const std::vector<std::string> there = PhotographNames(scene);
  std::vector<std::string> found = names;
  for (std::string& name : found) {
    const std::string stem = std::filesystem::path(name).stem().string();
    if (!Contains(there, name) && Contains(there, stem)) name = stem;
  }
  RequirePhotographs(scene, found, place);
  return found;
}

void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place) {
  const std::vector<std::string> there = PhotographNames(scene);
  for (const std::string& name : names) {
    if (Contains(there, name)) continue;
    std::string known;
    for (const std::string& other : there) known += " " + other;
    throw Error(place + ": no photograph is called " + Quote(name) + "; there are" + known);
  }
}

void KeepPhotographs(const std::vector<std::string>& names, Scene& scene) {
  if (names.empty()) return;
  const auto leave_out = [&](const Photograph& photograph) {
    if (Contains(names, photograph.name)) return false;
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
