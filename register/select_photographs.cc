// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/select_photographs.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {

void RequirePhotographs(const Scene& scene,
                        const std::vector<std::string>& names,
                        const std::string& place) {
  for (const std::string& name : names) {
    const bool exists = std::any_of(
        scene.photographs.begin(), scene.photographs.end(), [&](const Photograph& photograph) {
          return photograph.name == name;
        });
    if (exists) continue;
    std::string known;
    for (const Photograph& photograph : scene.photographs) known += " " + photograph.name;
    throw Error(place + ": no photograph is called " + Quote(name) + "; there are" + known);
  }
}

void KeepPhotographs(const std::vector<std::string>& names, Scene& scene) {
  if (names.empty()) return;
  std::erase_if(scene.photographs, [&](const Photograph& photograph) {
    return std::find(names.begin(), names.end(), photograph.name) == names.end();
  });
}

}  // namespace groundglass
