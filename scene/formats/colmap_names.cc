// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colmap_names.h"

#include "scene/error.h"
#include "scene/text.h"

namespace groundglass {

std::vector<std::string> TellNamesWithBlanks(const std::filesystem::path& folder,
                                             const std::vector<std::string>& image_names) {
  constexpr size_t kMost = 3;
  std::string list;
  size_t count = 0;
  for (const std::string& name : image_names) {
    if (name.find_first_of(" \t") == std::string::npos) continue;
    if (++count <= kMost) list += (list.empty() ? "" : ", ") + Quote(name);
  }
  if (count == 0) return {};
  if (count > kMost) list += " and " + std::to_string(count - kMost) + " more";
  return {Error(folder / "images.txt",
                "COLMAP itself reads names of images only up to a blank: " + list +
                    "; for COLMAP, write the binary model, which holds them (groundglass convert, "
                    "--to colmap-binary), or rename the photographs")
              .what()};
}

}  // namespace groundglass
