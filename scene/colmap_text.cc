// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/colmap_records.h"
#include "scene/error.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <cmath>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// One line's words, read one after the other.
class FieldReader {
 public:
  FieldReader(const fs::path& file, const TextLine& line)
      : place_(file.string() + ":" + std::to_string(line.number)), line_(line) {}

  const std::string& place() const { return place_; }
  std::string_view ReadWord(const char* what) {
    if (next_ == line_.tokens.size()) Fail(std::string("expected ") + what);
    return line_.tokens[next_++].text;
  }
  double ReadNumber(const char* what) {
    const std::string_view word = ReadWord(what);
    const std::optional<double> value = ParseNumber(word);
    if (!value || !std::isfinite(*value)) {
      Fail(std::string(what) + ": " + Quote(word) + " is not a finite number");
    }
    return *value;
  }
  long long ReadInteger(const char* what) {
    const std::string_view word = ReadWord(what);
    const std::optional<long long> value = ParseInteger(word);
    if (!value) Fail(std::string(what) + ": " + Quote(word) + " is not a whole number");
    return *value;
  }
  // The rest of the line: names may hold blanks.
  std::string ReadRest(const char* what) {
    const std::string_view first = ReadWord(what);
    const std::string_view last = line_.tokens.back().text;
    next_ = line_.tokens.size();
    return std::string(first.data(), static_cast<size_t>(last.data() + last.size() - first.data()));
  }
  size_t NumLeft() const { return line_.tokens.size() - next_; }
  [[noreturn]] void Fail(const std::string& message) const { throw Error(place_ + ": " + message); }

 private:
  std::string place_;
  const TextLine& line_;
  size_t next_ = 0;
};

std::map<long long, ColmapCamera> ReadCamerasTxt(const fs::path& file) {
  std::map<long long, ColmapCamera> cameras;
  const std::string text = ReadTextFile(file);
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    FieldReader fields(file, line);
    const long long id = fields.ReadInteger("camera number");
    const std::string_view model = fields.ReadWord("camera model");
    ColmapCamera camera;
    if (const ColmapCameraKind* kind = FindColmapCameraKind(model)) {
      const long long width = fields.ReadInteger("width");
      const long long height = fields.ReadInteger("height");
      std::vector<double> parameters;
      while (fields.NumLeft() > 0) parameters.push_back(fields.ReadNumber("camera parameter"));
      camera =
          MakeColmapCamera(*kind, width, height, parameters, fields.place(), file.parent_path());
    } else {
      camera = UnreadColmapCamera(Quote(model), fields.place(), file.parent_path());
    }
    if (!cameras.emplace(id, std::move(camera)).second) {
      fields.Fail("camera " + std::to_string(id) + " is repeated");
    }
  }
  return cameras;
}

std::vector<ColmapImage> ReadImagesTxt(const fs::path& file) {
  constexpr const char* kPoseFields[] = {"QW", "QX", "QY", "QZ", "TX", "TY", "TZ"};
  const std::string text = ReadTextFile(file);
  std::vector<ColmapImage> images;
  // Every image has two lines, the second (its points) often empty.
  bool is_points_line = false;
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (is_points_line) {
      if (line.tokens.size() % 3 != 0) {
        throw Error(
            file, line.number, "expected the image's points (X Y POINT3D_ID ...) or an empty line");
      }
      is_points_line = false;
      continue;
    }
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    is_points_line = true;
    FieldReader fields(file, line);
    ColmapImage& image = images.emplace_back();
    image.place = fields.place();
    fields.ReadInteger("image number");
    for (size_t i = 0; i < image.pose.size(); ++i)
      image.pose[i] = fields.ReadNumber(kPoseFields[i]);
    image.camera_id = fields.ReadInteger("camera number");
    image.name = fields.ReadRest("image name");
  }
  return images;
}

}  // namespace

ColmapRecords ReadColmapText(const fs::path& cameras_file, const fs::path& images_file) {
  return {ReadCamerasTxt(cameras_file), ReadImagesTxt(images_file)};
}

}  // namespace groundglass
