// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/colmap_records.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

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

ColmapCamera ReadCameraLine(FieldReader& fields, const fs::path& folder) {
  const std::string_view model = fields.ReadWord("camera model");
  const ColmapCameraKind* kind = FindColmapCameraKind(model);
  if (kind == nullptr) return UnreadColmapCamera(Quote(model), fields.place(), folder);
  const long long width = fields.ReadInteger("width");
  const long long height = fields.ReadInteger("height");
  std::vector<double> parameters;
  while (fields.NumLeft() > 0) parameters.push_back(fields.ReadNumber("camera parameter"));
  return MakeColmapCamera(*kind, width, height, parameters, fields.place(), folder);
}

void ReadCamerasTxt(const fs::path& file, ColmapRecords& records) {
  const std::string text = ReadTextFile(file);
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    FieldReader fields(file, line);
    const std::optional<long long> id = ParseInteger(line.tokens.front().text);
    if (!id) {
      records.stray_faults.push_back(fields.place() +
                                     ": camera number: " + Quote(line.tokens.front().text) +
                                     " is not a whole number; this line is left out");
      continue;
    }
    fields.ReadInteger("camera number");
    ColmapCamera camera;
    try {
      camera = ReadCameraLine(fields, file.parent_path());
    } catch (const Error& error) {
      camera.fault = error.what();
    }
    const auto [place, is_new] = records.cameras.emplace(*id, std::move(camera));
    if (!is_new) {
      place->second.fault = fields.place() + ": camera " + std::to_string(*id) + " is repeated";
    }
  }
}

constexpr const char* kPoseFields[] = {"QW", "QX", "QY", "QZ", "TX", "TY", "TZ"};
constexpr size_t kNamePlace = 9;  // of an image's name among the words of its line

// Whether a line that should hold points is an image's: points have a number where the name is.
bool IsImageLine(const TextLine& line) {
  if (line.tokens.size() <= kNamePlace || ParseNumber(line.tokens[kNamePlace].text)) return false;
  for (size_t i = 0; i < kNamePlace; ++i) {
    if (!ParseNumber(line.tokens[i].text)) return false;
  }
  return true;
}

ColmapImage ReadImageLine(const fs::path& file, const TextLine& line) {
  FieldReader fields(file, line);
  ColmapImage image;
  image.place = fields.place();
  try {
    fields.ReadInteger("image number");
    for (size_t i = 0; i < image.pose.size(); ++i) {
      image.pose[i] = fields.ReadNumber(kPoseFields[i]);
    }
    image.camera_id = fields.ReadInteger("camera number");
    image.name = fields.ReadRest("image name");
  } catch (const Error& error) {
    image.fault = error.what();
    // Whose line it is is still known where no word is missing.
    if (line.tokens.size() > kNamePlace) {
      const char* start = line.tokens[kNamePlace].text.data();
      const std::string_view last = line.tokens.back().text;
      image.name.assign(start, static_cast<size_t>(last.data() + last.size() - start));
    } else if (!ParseNumber(line.tokens.back().text)) {
      image.name = line.tokens.back().text;
    }
  }
  return image;
}

void ReadImagesTxt(const fs::path& file, ColmapRecords& records) {
  const std::string text = ReadTextFile(file);
  // Every image has two lines, the second (its points) often empty.
  bool is_points_line = false;
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (is_points_line) {
      const bool is_image = IsImageLine(line);
      if (is_image || line.tokens.size() % 3 != 0) {
        records.stray_faults.push_back(
            Error(file,
                  line.number,
                  std::string("expected the image's points (X Y POINT3D_ID ...) or an empty line") +
                      (is_image ? ", not the next image, which is read as such"
                                : "; they are not needed"))
                .what());
      }
      is_points_line = false;
      if (!is_image) continue;
    }
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    is_points_line = true;
    records.images.push_back(ReadImageLine(file, line));
  }
}

}  // namespace

ColmapRecords ReadColmapText(const fs::path& cameras_file, const fs::path& images_file) {
  ColmapRecords records;
  ReadCamerasTxt(cameras_file, records);
  ReadImagesTxt(images_file, records);
  return records;
}

}  // namespace groundglass
