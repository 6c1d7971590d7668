// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/bad_corners.h"

#include "scene/error.h"

namespace groundglass {
namespace {

Error CornerError(const std::filesystem::path& file, int line, const std::string& message) {
  return line > 0 ? Error(file, line, message) : Error(file, message);
}

}  // namespace

std::string WarnOfBadCorners(const std::filesystem::path& file,
                             const std::vector<int>& lines,
                             const PolygonModel& model,
                             const std::vector<BadCorner>& bad) {
  const BadCorner& first = bad.front();
  const int line = lines.empty() ? 0 : lines[static_cast<size_t>(first.face)];
  const std::string count = std::to_string(bad.size());
  const std::string name = DescribeFace(model, first.face);
  // Without a line the face's number is the place.
  const std::string fault = lines.empty() ? name + " " + first.text : first.text;
  if (2 * bad.size() > model.faces.size()) {
    throw CornerError(
        file,
        line,
        fault + (bad.size() == 1 ? ""
                                 : "; " + count + " of " + std::to_string(model.faces.size()) +
                                       " faces have such a corner: the file is "
                                       "damaged, or its points are missing"));
  }
  if (bad.size() == 1) {
    return CornerError(
               file, line, name + " is left out: " + (lines.empty() ? "it " : "") + first.text)
        .what();
  }
  return Error(file,
               count + " faces with a corner that is no point are left out; the first: " + name +
                   (line > 0 ? ", line " + std::to_string(line) + ":" : "") + " " + first.text)
      .what();
}

}  // namespace groundglass
