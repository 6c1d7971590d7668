// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The pictures of a scene's folders, and what photographs are called.
#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/open_image.h"
#include "scene/formats/scene_reader.h"
#include "scene/formats/text_encoding.h"
#include "scene/text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace groundglass {

namespace {

namespace fs = std::filesystem;

bool HasControlCharacter(const std::string& text) {
  return std::any_of(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

}  // namespace

std::string WhyNothingIsSeen(const Image8& srgb8, const std::filesystem::path& file) {
  constexpr double kTellingShare = 0.99;
  size_t num_black = 0;
  size_t num_white = 0;
  for (size_t i = 0; i + 2 < srgb8.values.size(); i += 3) {
    const auto [darkest, brightest] =
        std::minmax({srgb8.values[i], srgb8.values[i + 1], srgb8.values[i + 2]});
    num_black += brightest == 0;
    num_white += darkest == 255;
  }
  const double needed = kTellingShare * static_cast<double>(srgb8.values.size()) / 3;
  const bool is_white = static_cast<double>(num_white) >= needed;
  if (srgb8.values.empty() || (!is_white && static_cast<double>(num_black) < needed)) return "";
  std::string why = std::string("is all but ") + (is_white ? "white" : "black") +
                    ", so that nothing is to be seen in it; ";
  if (is_white && OpenImage(file).spec().format.is_floating_point()) {
    return why + "floats count from 0 to 1 here: divide them by 255, or by how far they run";
  }
  return why + "put the photograph itself there, or save it again from where it came from";
}

FilesByStem SceneReader::ListImages(const char* subfolder) {
  const fs::path folder = folder_ / subfolder;
  std::vector<std::string> paths = ListFilesBelow(folder);
  std::erase_if(paths, [&](const std::string& path) {
    if (HasControlCharacter(path)) {
      Warn(folder,
           Quote(path) +
               " has a line break, a tab or the like in its name, which no list of photographs can "
               "hold; it is left out: rename it");
      return true;
    }
    const ImageKind kind = FindImageKind(folder / path);
    if (kind.IsImage() || IsImageExtension(fs::path(path).extension().string())) return false;
    Warn(folder / path,
         "not an image that is read here, but " + kind.description + "; expected " + kImageNames +
             "; " + kind.remedy);
    return true;
  });
  const std::vector<std::string> names = NamePhotographs(paths);
  FilesByStem images;
  for (size_t i = 0; i < paths.size(); ++i) {
    const fs::path file = folder / paths[i];
    const auto [place, is_new] = images.emplace(NameInUtf8(file, names[i]), file);
    if (is_new) continue;
    // Cameras write both; the picture that is developed already is the better known one.
    const bool is_raw = FindImageKind(file).reader == "raw";
    if (is_raw != (FindImageKind(place->second).reader == "raw")) {
      const fs::path raw_file = is_raw ? file : place->second;
      if (!is_raw) place->second = file;
      Warn(
          raw_file,
          "camera raw file left out, since " + place->second.filename().string() + " is there too");
      continue;
    }
    FaultOf(place->first,
            Error(file,
                  "two images have the stem " + Quote(place->first) + "; the other is " +
                      place->second.filename().string())
                .what());
  }
  return images;
}

std::string SceneReader::NameInUtf8(const fs::path& file, const std::string& name) {
  const Utf8Text utf8 = Utf8FromBytes(name);
  if (utf8.is_guessed) {
    Warn(file, "its name is not UTF-8; it is taken as " + Quote(utf8.text) + ", rename it");
  }
  return utf8.text;
}

}  // namespace groundglass
