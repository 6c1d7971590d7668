// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/model_modes.h"

#include "report/embedded_picture.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_folder.h"
#include "scene/text.h"
#include "scene/textured_model.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// As many numbers across as the eye tells apart.
constexpr int kMostNumbersAcross = 1024;

// One number of a cell: its middle's, or where that is none, any other that it has.
uint16_t NumberOfCell(const Image16& numbers, int left, int top, int size) {
  const int right = std::min(left + size, numbers.width);
  const int bottom = std::min(top + size, numbers.height);
  uint16_t found = *numbers.At((left + right) / 2, (top + bottom) / 2);
  for (int y = top; y < bottom && found == kProvenanceNone; ++y) {
    for (int x = left; x < right && found == kProvenanceNone; ++x) found = *numbers.At(x, y);
  }
  return found;
}

// A number for each cell, since a mean of two photographs' numbers would be a third's. None gives
// way by one cell to what is beside it, or the seams between faces would be drawn as not seen.
Image16 ThinnedNumbers(const Image16& numbers) {
  const int size =
      (std::max(numbers.width, numbers.height) + kMostNumbersAcross - 1) / kMostNumbersAcross;
  Image16 cells((numbers.width + size - 1) / size, (numbers.height + size - 1) / size, 1);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      *cells.At(x, y) = NumberOfCell(numbers, x * size, y * size, size);
    }
  }
  Image16 thinned = cells;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      if (*cells.At(x, y) != kProvenanceNone) continue;
      const int left = std::max(0, x - 1);
      const int top = std::max(0, y - 1);
      *thinned.At(x, y) = NumberOfCell(cells, left, top, 3);
    }
  }
  return thinned;
}

// Red is the number's lower byte, green the upper one: what a page's script can read.
std::string NumbersAsPng(const Image16& numbers) {
  Image8 picture(numbers.width, numbers.height, 3);
  for (size_t i = 0; i < numbers.values.size(); ++i) {
    picture.values[3 * i] = static_cast<uint8_t>(numbers.values[i] & 0xff);
    picture.values[3 * i + 1] = static_cast<uint8_t>(numbers.values[i] >> 8);
  }
  return EncodeBase64(EncodeImage(picture, ".png"));
}

}  // namespace

std::string ModelModesJson(const fs::path& folder, size_t max_bytes) {
  nlohmann::json pages = nlohmann::json::array();
  size_t bytes = 0;
  for (int i = 0;; ++i) {
    const fs::path file = folder / ("provenance_" + std::to_string(i) + ".png");
    if (!fs::exists(file)) break;
    pages.push_back(NumbersAsPng(ThinnedNumbers(ReadLabels(file))));
    bytes += pages.back().get_ref<const std::string&>().size();
  }
  if (pages.empty() || bytes > max_bytes) return "";
  const nlohmann::json json = {{"names", NumberedPhotographs(folder)}, {"pages", pages}};
  // Nothing in it may end the script that holds it.
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

}  // namespace groundglass
