// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/select_photographs.h"

#include "scene/error.h"
#include "scene/photograph_name.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {

void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place) {
  const std::vector<PhotographName> known = NamesOf(scene.photographs);
  for (const std::string& name : names) {
    try {
      if (FindPhotograph(name, known)) continue;
    } catch (const Error& error) {
      throw Error(place + ": " + error.what());
    }
    std::string all;
    for (const PhotographName& photograph : known) all += " " + photograph.name;
    throw Error(place + ": no photograph is called " + Quote(name) + NearestName(name, known) +
                "; there are" + all);
  }
}

std::string NameInScene(const std::string& name, const Scene& scene) {
  const std::optional<size_t> found = FindPhotograph(name, NamesOf(scene.photographs));
  return found ? scene.photographs[*found].name : name;
}

void KeepPhotographs(const std::vector<std::string>& names, Scene& scene) {
  if (names.empty()) return;
  std::vector<std::string> kept;
  for (const std::string& name : names) kept.push_back(NameInScene(name, scene));
  std::erase_if(scene.photographs, [&](const Photograph& photograph) {
    return std::find(kept.begin(), kept.end(), photograph.name) == kept.end();
  });
}

}  // namespace groundglass
