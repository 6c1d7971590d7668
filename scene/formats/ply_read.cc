// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/bad_corners.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/ply_header.h"
#include "scene/formats/view_io.h"
#include "scene/formats/word_scanner.h"
#include "scene/text.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace groundglass {
namespace {

using Type = PlyHeader::Type;

// The numbers of the file's body one after the other, whatever way they are written.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view bytes, const PlyHeader& header, const std::filesystem::path& file)
      : file_(file),
        is_ascii_(header.format == PlyHeader::Format::kAscii),
        is_swapped_((header.format == PlyHeader::Format::kBigEndian) ==
                    (std::endian::native == std::endian::little)),
        left_(bytes.substr(header.body)),
        words_(left_, header.body_line) {}

  double Next(Type type, const std::string& what) {
    return is_ascii_ ? NextWord(what) : NextBytes(type, what);
  }

  // One that is told to be no number by NaN; what it is in place of one is then in `word`.
  double NextOrNone(Type type, const std::string& what, std::string& word) {
    if (!is_ascii_) return NextBytes(type, what);
    const std::string_view text = words_.Next();
    if (text.empty()) Fail("the file ends where " + what + " is expected");
    const auto value = ParseNumber(text);
    if (!value && word.empty()) word = text;
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  size_t NextCount(Type type, Type item_type, const std::string& what) {
    const double count = Next(type, what);
    const size_t least = is_ascii_ ? 2 : PlyTypeSize(item_type);
    const size_t left = is_ascii_ ? words_.NumBytesLeft() + 1 : left_.size();
    const size_t most = left / least;
    if (!(count >= 0) || count != std::floor(count) || count > static_cast<double>(most)) {
      Fail(what + " has " + FormatNumber(count) +
           " numbers, more than are left in the file: it may be cut short; copy it again, or "
           "export it once more");
    }
    return static_cast<size_t>(count);
  }

  [[noreturn]] void Fail(const std::string& message) const {
    if (is_ascii_) throw Error(file_, words_.line(), message);
    throw Error(file_, message);
  }

  bool HasMore() { return is_ascii_ ? !words_.Next().empty() : !left_.empty(); }

 private:
  double NextWord(const std::string& what) {
    const std::string_view word = words_.Next();
    if (word.empty()) Fail("the file ends where " + what + " is expected");
    const auto value = ParseNumber(word);
    if (!value) Fail(what + ": " + WhyNoNumber(word));
    return *value;
  }

  double NextBytes(Type type, const std::string& what) {
    const size_t size = PlyTypeSize(type);
    if (left_.size() < size) Fail("the file ends where " + what + " is expected");
    unsigned char bytes[8] = {};
    for (size_t i = 0; i < size; ++i) {
      bytes[i] = static_cast<unsigned char>(left_[is_swapped_ ? size - 1 - i : i]);
    }
    left_.remove_prefix(size);
    const auto as = [&](auto value) {
      std::memcpy(&value, bytes, sizeof(value));
      return static_cast<double>(value);
    };
    switch (type) {
      case Type::kInt8:
        return as(int8_t{});
      case Type::kUint8:
        return as(uint8_t{});
      case Type::kInt16:
        return as(int16_t{});
      case Type::kUint16:
        return as(uint16_t{});
      case Type::kInt32:
        return as(int32_t{});
      case Type::kUint32:
        return as(uint32_t{});
      case Type::kFloat:
        return as(float{});
      case Type::kDouble:
        return as(double{});
    }
    return 0;
  }

  const std::filesystem::path& file_;
  bool is_ascii_;
  bool is_swapped_;
  std::string_view left_;
  WordScanner words_;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::filesystem::path& file)
      : file_(file), header_(ParsePlyHeader(bytes, file)), numbers_(bytes, header_, file) {}

  MeshReading Read(MeshPages pages) {
    if (header_.unit) {
      Model().unit = *header_.unit;
    } else {
      Model().is_unit_assumed = true;
    }
    for (const PlyHeader::Element& element : header_.elements) {
      if (element.name == "vertex") {
        ReadVertices(element);
      } else if (element.name == "face" || element.name == "tristrips") {
        ReadFaces(element);
      } else {
        Skip(element);
      }
    }
    if (numbers_.HasMore()) {
      reading_.warnings.push_back(
          Error(file_, "there is more after the last element, which is not read").what());
    }
    ResolveCorners();
    if (Model().faces.empty()) {
      throw Error(file_, WhyNoFaces());
    }
    if (pages != MeshPages::kNone) TellUnreadColours();
    return std::move(reading_);
  }

 private:
  // Pictures and colours are no part of what is read here.
  void TellUnreadColours() {
    bool has_texture_points = false;
    bool has_colours = false;
    for (const PlyHeader::Element& element : header_.elements) {
      for (const PlyHeader::Property& property : element.properties) {
        const std::string& name = property.name;
        has_texture_points |= name == "texcoord" || name == "texture_u" || name == "u" ||
                              name == "s" || name == "texnumber";
        has_colours |= name == "red" || name == "diffuse_red";
      }
    }
    std::string what;
    if (!header_.pictures.empty()) {
      what = "its picture " + Quote(header_.pictures.front()) +
             (header_.pictures.size() > 1
                  ? " and " + std::to_string(header_.pictures.size() - 1) + " more are"
                  : " is");
    } else if (has_texture_points) {
      what = "its texture is";
    } else if (has_colours) {
      what = "the colours of its points or faces are";
    } else {
      return;
    }
    reading_.warnings.push_back(
        Error(
            file_,
            what +
                " not read, and its faces are grey; export it as .glb or .obj, with a texture, to "
                "have them in colour")
            .what());
  }

  // What it holds in place of faces.
  std::string WhyNoFaces() const {
    const size_t num_points = reading_.textured.model.points_in_world.size();
    if (num_points == 0) return "this model has no points";
    std::string held = std::to_string(num_points) + " points";
    bool has_edges = false;
    for (const PlyHeader::Element& element : header_.elements) {
      if (element.name != "edge" || element.count == 0) continue;
      held = std::to_string(element.count) + (element.count == 1 ? " edge and " : " edges and ") +
             held;
      has_edges = true;
    }
    return "this model has no faces, but " + held +
           (has_edges ? "; export it as a mesh, with its faces"
                      : "; a cloud of points cannot be textured: make a mesh of it first, with "
                        "CloudCompare or MeshLab");
  }

  PolygonModel& Model() { return reading_.textured.model; }

  void SkipProperty(const PlyHeader::Property& property, const std::string& what) {
    size_t count = 1;
    if (property.count_type) count = numbers_.NextCount(*property.count_type, property.type, what);
    for (size_t i = 0; i < count; ++i) numbers_.Next(property.type, what);
  }

  void Skip(const PlyHeader::Element& element) {
    if (element.properties.empty()) return;
    for (size_t i = 0; i < element.count; ++i) {
      for (const PlyHeader::Property& property : element.properties) {
        SkipProperty(property, element.name + "'s " + property.name);
      }
    }
  }

  void ReadVertices(const PlyHeader::Element& element) {
    std::vector<int> axis_of(element.properties.size(), -1);
    int num_axes = 0;
    for (size_t i = 0; i < axis_of.size(); ++i) {
      const PlyHeader::Property& property = element.properties[i];
      if (property.count_type || property.name.size() != 1) continue;
      const char name = property.name[0];
      if (name < 'x' || name > 'z') continue;
      axis_of[i] = name - 'x';
      ++num_axes;
    }
    if (num_axes != 3 || Model().points_in_world.size() > 0) {
      throw Error(file_, element.line, "expected the vertices once, with properties x, y and z");
    }
    for (size_t row = 0; row < element.count; ++row) {
      Eigen::Vector3d& point = Model().points_in_world.emplace_back();
      for (size_t i = 0; i < axis_of.size(); ++i) {
        const PlyHeader::Property& property = element.properties[i];
        if (axis_of[i] < 0) {
          SkipProperty(property, "a vertex's " + property.name);
          continue;
        }
        point[axis_of[i]] = OrNoPlace(numbers_.Next(property.type, "a vertex's " + property.name));
      }
    }
  }

  // The list that holds the corners, whatever it is called.
  static int FindCornerList(const PlyHeader::Element& element) {
    int found = -1;
    int num_lists = 0;
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyHeader::Property& property = element.properties[i];
      if (!property.count_type) continue;
      if (property.name.find("vert") != std::string::npos ||
          property.name.find("ind") != std::string::npos) {
        return static_cast<int>(i);
      }
      ++num_lists;
      found = static_cast<int>(i);
    }
    return num_lists == 1 ? found : -1;
  }

  void ReadFaces(const PlyHeader::Element& element) {
    const int corner_list = FindCornerList(element);
    if (corner_list < 0) {
      if (element.count == 0) return;
      throw Error(file_, element.line, "expected the corners, as property list ... vertex_indices");
    }
    std::vector<double> corners;
    for (size_t row = 0; row < element.count; ++row) {
      const std::string what = element.name == "face" ? "a face" : "a strip";
      for (size_t i = 0; i < element.properties.size(); ++i) {
        const PlyHeader::Property& property = element.properties[i];
        if (static_cast<int>(i) != corner_list) {
          SkipProperty(property, what + "'s " + property.name);
          continue;
        }
        corners.resize(numbers_.NextCount(*property.count_type, property.type, what));
        no_number_.clear();
        for (double& corner : corners) {
          corner = numbers_.NextOrNone(property.type, what + "'s corner", no_number_);
        }
      }
      if (element.name == "face") {
        AddFace(corners);
      } else {
        AddStrips(corners);
      }
    }
  }

  // Corners that can be no vertex become -1; ResolveCorners tells them.
  void AddFace(const std::vector<double>& corners) {
    Face& face = Model().faces.emplace_back();
    face.number = static_cast<int>(Model().faces.size());
    for (const double corner : corners) {
      const bool is_index = corner >= 0 && corner < 2147483647.0 && corner == std::floor(corner);
      face.points.push_back(is_index ? static_cast<int>(corner) : -1);
      if (is_index) continue;
      const std::string word =
          std::isnan(corner) && !no_number_.empty() ? Quote(no_number_) : FormatNumber(corner);
      no_index_.try_emplace(face.number - 1, word);
    }
  }

  // Strips one after the other, parted by -1. Every second triangle runs the other way.
  void AddStrips(const std::vector<double>& corners) {
    size_t in_strip = 0;  // corners so far
    for (size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] < 0) {
        in_strip = 0;
        continue;
      }
      if (++in_strip < 3) continue;
      const double a = corners[i - 2];
      const double b = corners[i - 1];
      const double c = corners[i];
      if (a == b || b == c || a == c) continue;  // only turns the strip around a corner
      if (in_strip % 2 == 1) {
        AddFace({a, b, c});
      } else {
        AddFace({b, a, c});
      }
    }
  }

  // Faces may stand before the vertices.
  void ResolveCorners() {
    const int num_points = static_cast<int>(Model().points_in_world.size());
    std::vector<BadCorner> bad;
    for (int place = 0; place < static_cast<int>(Model().faces.size()); ++place) {
      for (const int point : Model().faces[place].points) {
        if (point >= 0 && point < num_points) continue;
        bad.push_back({place,
                       "uses vertex " + (point < 0 ? no_index_.at(place) : std::to_string(point)) +
                           " (from 0), but there are " + std::to_string(num_points)});
        break;
      }
    }
    if (bad.empty()) return;
    reading_.warnings.push_back(WarnOfBadCorners(file_, {}, Model(), bad));
    for (const BadCorner& corner : bad) reading_.left_out.push_back(corner.face + 1);
    DropFaces(bad, Model().faces);
  }

  const std::filesystem::path& file_;
  PlyHeader header_;
  PlyNumbers numbers_;
  std::string no_number_;                // a word among the face's corners that is no number
  std::map<int, std::string> no_index_;  // of faces, by place, the first corner that is none
  MeshReading reading_;
};

}  // namespace

MeshReading ReadPly(const std::filesystem::path& file, MeshPages pages) {
  const std::string bytes = ReadFileBytes(file);
  MeshReading reading = PlyReader(bytes, file).Read(pages);
  JoinIdenticalPoints(reading.textured.model);
  return reading;
}

}  // namespace groundglass
