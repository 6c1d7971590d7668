// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/osu_io.h"

#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/unit_mention.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "scene/mend_faces.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace groundglass {
namespace {

// The words of "unit: m" that follow "unit:"; nothing if the comment does not start with the key.
std::optional<std::vector<TextToken>> CommentField(const TextLine& line, std::string_view key) {
  if (!line.has_comment || LowerCase(line.comment.substr(0, key.size())) != key) {
    return std::nullopt;
  }
  const std::vector<TextLine> rest = SplitLines(line.comment.substr(key.size()));
  return rest.empty() ? std::vector<TextToken>() : rest.front().tokens;
}

std::vector<double> FieldNumbers(const std::filesystem::path& name,
                                 int line,
                                 const std::vector<TextToken>& words,
                                 size_t count,
                                 const std::string& expected) {
  std::vector<double> numbers;
  for (const TextToken& word : words) {
    const std::optional<double> number = ParseNumber(word.text);
    if (!number || !std::isfinite(*number)) break;
    numbers.push_back(*number);
    if (numbers.size() == count) return numbers;
  }
  throw Error(name, line, "expected '% " + expected + "'");
}

constexpr std::string_view kSigmaKey = "sigma:";

// What the comments say of the whole model: its unit, its tolerance, and where on Earth it stands.
void ReadModelComments(const std::filesystem::path& name,
                       const std::vector<TextLine>& lines,
                       PolygonModel& model) {
  model.is_unit_assumed = true;
  for (const TextLine& line : lines) {
    if (const auto words = CommentField(line, "unit:")) {
      const std::string unit = words->empty() ? "" : LowerCase(words->front().text);
      const std::optional<LengthUnit> known = FindUnit(unit);
      if (!known) {
        throw Error(
            name, line.number, "unit " + Quote(unit) + " is not known; expected " + UnitNames());
      }
      if (!model.is_unit_assumed && model.unit != *known) {
        throw Error(name,
                    line.number,
                    "unit " + Quote(unit) + ", but a line before says " + UnitName(model.unit) +
                        "; leave the right one");
      }
      model.unit = *known;
      model.is_unit_assumed = false;
    } else if (const auto origin = CommentField(line, "origin:")) {
      const std::vector<double> numbers =
          FieldNumbers(name, line.number, *origin, 3, "origin: LATITUDE LONGITUDE HEIGHT");
      if (std::abs(numbers[0]) > 90 || std::abs(numbers[1]) > 360) {
        throw Error(name,
                    line.number,
                    "origin: latitude must lie within 90 degrees and longitude within 360");
      }
      if (!model.georeference) model.georeference.emplace();
      model.georeference->latitude_deg = numbers[0];
      model.georeference->longitude_deg = numbers[1];
      model.georeference->height_m = numbers[2];
    }
  }
  for (const TextLine& line : lines) {
    if (const auto north = CommentField(line, "north:")) {
      const std::vector<double> numbers =
          FieldNumbers(name, line.number, *north, 1, "north: DEGREES");
      // North alone places nothing on Earth.
      if (model.georeference) model.georeference->north_deg = numbers[0];
    } else if (CommentField(line, kSigmaKey)) {
      ReadSigmaComment(line.comment.substr(kSigmaKey.size()), name, line.number, model);
    }
  }
}

// "face 12: east wall" -> 12 and the name; nothing for other comments.
std::optional<std::pair<long long, std::string>> NameBeforeFace(const TextLine& line) {
  constexpr std::string_view kKey = "face ";
  if (!line.has_comment || LowerCase(line.comment.substr(0, kKey.size())) != kKey) {
    return std::nullopt;
  }
  const size_t colon = line.comment.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto number =
      ParseInteger(TrimBlanks(line.comment.substr(kKey.size(), colon - kKey.size())));
  if (!number) return std::nullopt;
  return std::pair(*number, std::string(TrimBlanks(line.comment.substr(colon + 1))));
}

// Hands out the file's words one after the other, and says what is wrong with them.
class WordReader {
 public:
  WordReader(const std::filesystem::path& name, const std::vector<TextLine>& lines) : name_(name) {
    for (const TextLine& line : lines) {
      words_.insert(words_.end(), line.tokens.begin(), line.tokens.end());
    }
  }

  size_t NumLeft() const { return words_.size() - next_; }
  // Of the word read last.
  int line() const { return next_ == 0 ? 1 : words_[next_ - 1].line; }

  long long ReadInteger(const std::string& what) {
    const TextToken& word = Next(what);
    const std::optional<long long> value = ParseInteger(word.text);
    if (!value) {
      throw Error(name_, word.line, what + ": " + Quote(word.text) + " is not a whole number");
    }
    return *value;
  }

  double ReadNumber(const std::string& what) {
    const TextToken& word = Next(what);
    const std::optional<double> value = ParseNumber(word.text);
    if (!value || !std::isfinite(*value)) {
      throw Error(name_, word.line, what + ": " + WhyNoNumber(word.text));
    }
    return *value;
  }

 private:
  const TextToken& Next(const std::string& what) {
    if (next_ == words_.size()) {
      throw Error(name_, line(), "the file ends where " + what + " is expected");
    }
    return words_[next_++];
  }

  std::filesystem::path name_;
  std::vector<TextToken> words_;
  size_t next_ = 0;
};

struct OsuReading {
  ModelReading reading;
  std::vector<std::string> faults;  // of single faces
};

// Reads a model step by step. Throws what keeps the rest from being read; collects what is wrong
// with single faces.
class OsuReader {
 public:
  OsuReader(const std::string& text, const std::filesystem::path& name)
      : name_(name), lines_(SplitLines(text)), words_(name, lines_) {}

  OsuReading Read() {
    ReadModelComments(name_, lines_, model_);
    ReadCounts();
    ReadPoints();
    ReadFaces();
    RequireEnd();
    TakeNamesAboveFaces();
    TakeNamesBesideFaces();
    LeaveOutFaultyFaces();
    const std::string unit_not_read = UnitNotRead(name_, lines_, model_);
    if (!unit_not_read.empty()) result_.reading.warnings.push_back(unit_not_read);
    return std::move(result_);
  }

 private:
  void ReadCounts() {
    num_points_ = words_.ReadInteger("the number of points");
    num_faces_ = words_.ReadInteger("the number of faces");
    if (num_points_ < 3 || num_faces_ < 1) {
      throw Error(name_, words_.line(), "a model needs at least 3 points and 1 face");
    }
    // Three words a point and four a face at least; also keeps a damaged count from asking for all
    // of the machine's memory.
    const long long words_left = static_cast<long long>(words_.NumLeft());
    if (num_points_ > words_left / 3 || num_faces_ > (words_left - 3 * num_points_) / 2) {
      throw Error(name_,
                  words_.line(),
                  "the file is too short for " + std::to_string(num_points_) + " points and " +
                      std::to_string(num_faces_) + " faces");
    }
  }

  void ReadPoints() {
    for (long long i = 0; i < num_points_; ++i) {
      const std::string point = "point " + std::to_string(i + 1);
      const double x = words_.ReadNumber(point + ", x");
      const double y = words_.ReadNumber(point + ", y");
      const double z = words_.ReadNumber(point + ", z");
      model_.points_in_world.push_back(WorldFromSite({x, y, z}));
    }
  }

  // What the faces are called, which a comment may say; known before they are read, for messages.
  PolygonModel ReadFaceNumbers() const {
    PolygonModel numbering;
    numbering.faces.resize(static_cast<size_t>(num_faces_));
    for (const TextLine& line : lines_) {
      if (CommentField(line, "face numbers:")) {
        ApplyFaceNumbers(line.comment.substr(line.comment.find(':') + 1), numbering);
      }
    }
    return numbering;
  }

  void ReadFaces() {
    const PolygonModel numbering = ReadFaceNumbers();
    for (long long i = 0; i < num_faces_; ++i) {
      ReadFace(FaceNumber(numbering, static_cast<int>(i)));
      for (int line = first_lines_.back(); line <= last_lines_.back(); ++line) {
        ++faces_on_line_[line];
      }
    }
  }

  void ReadFace(int number) {
    const std::string face_name = "face " + std::to_string(number);
    const long long corners = words_.ReadInteger(face_name + ", its number of points");
    first_lines_.push_back(words_.line());
    if (corners < 1 || corners > static_cast<long long>(words_.NumLeft())) {
      throw Error(
          name_, words_.line(), face_name + " cannot have " + std::to_string(corners) + " points");
    }
    Face& face = model_.faces.emplace_back();
    face.number = number;
    bool is_in_range = true;
    for (long long k = 0; k < corners; ++k) {
      const long long point = words_.ReadInteger(face_name + ", point number");
      if (point >= 1 && point <= num_points_) {
        face.points.push_back(static_cast<int>(point - 1));
        continue;
      }
      if (is_in_range) {
        result_.faults.push_back(Error(name_,
                                       words_.line(),
                                       face_name + ": point number " + std::to_string(point) +
                                           " is outside 1 to " + std::to_string(num_points_))
                                     .what());
      }
      is_in_range = false;
    }
    if (!is_in_range) face.points.clear();
    is_told_.push_back(is_in_range ? 0 : 1);
    last_lines_.push_back(words_.line());
  }

  void RequireEnd() {
    if (words_.NumLeft() == 0) return;
    words_.ReadInteger("a word beyond the last face");
    throw Error(name_, words_.line(), "there is more after the last face");
  }

  void TakeNamesAboveFaces() {
    for (const TextLine& line : lines_) {
      const auto named = NameBeforeFace(line);
      if (!named || !line.tokens.empty()) continue;
      // The face on the line below; files of version 0.1.0 called it by its place.
      const size_t below = static_cast<size_t>(
          std::upper_bound(first_lines_.begin(), first_lines_.end(), line.number) -
          first_lines_.begin());
      if (below < model_.faces.size() && named->first == static_cast<long long>(below) + 1) {
        model_.faces[below].name = named->second;
      } else if (const std::optional<int> face = FindFaceByNumber(model_, named->first)) {
        model_.faces[static_cast<size_t>(*face)].name = named->second;
      }
    }
  }

  // A comment on a line that belongs to one face alone.
  void TakeNamesBesideFaces() {
    for (size_t i = 0; i < model_.faces.size(); ++i) {
      for (const int number : {first_lines_[i], last_lines_[i]}) {
        const TextLine& line = lines_[static_cast<size_t>(number - 1)];
        if (!line.has_comment || line.comment.empty() || faces_on_line_[number] != 1) continue;
        const auto named = NameBeforeFace(line);
        model_.faces[i].name = named ? named->second : std::string(line.comment);
      }
    }
  }

  void LeaveOutFaultyFaces() {
    std::vector<FaceTexture> no_textures;
    MendedFaces mended = MendFaces(name_, first_lines_, model_, no_textures);
    for (const MendedFaces::Fault& fault : mended.faults) {
      const auto face = static_cast<size_t>(fault.face);
      if (is_told_[face]) continue;
      result_.faults.push_back(Error(name_, first_lines_[face], fault.text).what());
    }
    result_.reading.warnings = std::move(mended.warnings);
    result_.reading.left_out = KeepFaces(mended.usable, model_, no_textures);
  }

  std::filesystem::path name_;
  std::vector<TextLine> lines_;
  WordReader words_;
  OsuReading result_;
  PolygonModel& model_ = result_.reading.model;
  long long num_points_ = 0;
  long long num_faces_ = 0;
  // Of each face: where it stands, and whether its fault is known already.
  std::vector<int> first_lines_;
  std::vector<int> last_lines_;
  std::vector<char> is_told_;
  std::map<int, int> faces_on_line_;
};

// A name must stay on its line.
std::string OneLineName(std::string name) {
  for (char& c : name) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return name;
}

std::string FormatPoint(const Eigen::Vector3d& point_in_site) {
  // Adding zero turns the mirror's -0 into 0.
  return FormatNumber(point_in_site.x() + 0.0) + " " + FormatNumber(point_in_site.y() + 0.0) + " " +
         FormatNumber(point_in_site.z() + 0.0);
}

}  // namespace

ModelReading ParseOsu(const std::string& text, const std::filesystem::path& name) {
  OsuReading result = OsuReader(text, name).Read();
  if (!result.faults.empty()) throw Error(result.faults.front());
  return std::move(result.reading);
}

ModelReading ReadOsu(const std::filesystem::path& file) {
  return ParseOsu(ReadTextFile(file), file);
}

std::vector<std::string> FindOsuFaults(const std::string& text, const std::filesystem::path& name) {
  try {
    return OsuReader(text, name).Read().faults;
  } catch (const Error& error) {
    return {error.what()};
  }
}

std::string FormatOsu(const PolygonModel& model) {
  std::string text =
      "% Polygon model in the extended OSU format.\n"
      "% LEFT-handed: x east, y south, z up. Faces list point numbers, from 1, counterclockwise\n"
      "% as seen from the front.\n";
  text += std::string("% unit: ") + UnitName(model.unit) + "\n";
  if (model.sigma) text += "% sigma: " + FormatNumber(*model.sigma) + "\n";
  if (model.georeference) {
    const Georeference& place = *model.georeference;
    text += "% origin: " + FormatNumber(place.latitude_deg) + " " +
            FormatNumber(place.longitude_deg) + " " + FormatNumber(place.height_m) + "\n";
    text += "% north: " + FormatNumber(place.north_deg) + "\n";
  }
  const std::string numbers = FormatFaceNumbers(model);
  if (!numbers.empty()) text += "% face numbers: " + numbers + "\n";
  text += "\n" + std::to_string(model.points_in_world.size()) + " " +
          std::to_string(model.faces.size()) + "\n\n";
  for (const Eigen::Vector3d& point : model.points_in_world) {
    text += FormatPoint(SiteFromWorld(point)) + "\n";
  }
  text += "\n";
  for (size_t i = 0; i < model.faces.size(); ++i) {
    const Face& face = model.faces[i];
    if (!face.name.empty())
      text += "% face " + std::to_string(FaceNumber(model, static_cast<int>(i))) + ": " +
              OneLineName(face.name) + "\n";
    text += std::to_string(face.points.size());
    for (const int point : face.points) text += " " + std::to_string(point + 1);
    text += "\n";
  }
  return text;
}

}  // namespace groundglass
