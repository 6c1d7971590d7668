// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/ply_header.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

std::optional<PlyHeader::Type> FindType(std::string_view word) {
  using Type = PlyHeader::Type;
  const std::string name = LowerCase(word);
  if (name == "char" || name == "int8") return Type::kInt8;
  if (name == "uchar" || name == "uint8") return Type::kUint8;
  if (name == "short" || name == "int16") return Type::kInt16;
  if (name == "ushort" || name == "uint16") return Type::kUint16;
  if (name == "int" || name == "int32") return Type::kInt32;
  if (name == "uint" || name == "uint32") return Type::kUint32;
  if (name == "float" || name == "float32") return Type::kFloat;
  if (name == "double" || name == "float64") return Type::kDouble;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::filesystem::path& file)
      : bytes_(bytes), file_(file) {
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;  // an editor's byte order mark
    // Binary data may begin with any byte, so one line end holds for the whole header.
    const size_t end = bytes.find_first_of("\r\n");
    if (end == std::string_view::npos) return;
    line_end_ = bytes.substr(end, 2) == "\r\n" ? "\r\n" : bytes.substr(end, 1);
  }

  PlyHeader Read() {
    if (LowerCase(TrimBlanks(NextLine())) != "ply") {
      Fail("is no PLY file: it does not begin with the word ply");
    }
    bool has_format = false;
    for (;;) {
      if (at_ >= bytes_.size()) Fail("the header has no end_header");
      const std::string_view line = NextLine();
      std::vector<std::string_view> words;
      for (const TextLine& split : SplitLines(line, '\0')) {
        for (const TextToken& token : split.tokens) words.push_back(token.text);
      }
      if (words.empty()) continue;
      const std::string keyword = LowerCase(words[0]);
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info") {
        ReadComment(line, words);
      } else if (keyword == "format") {
        ReadFormat(words);
        has_format = true;
      } else if (keyword == "element") {
        ReadElement(words);
      } else if (keyword == "property") {
        ReadProperty(words);
      } else {
        Fail("expected format, element, property, comment or end_header, not " + Quote(words[0]));
      }
    }
    if (!has_format) Fail("the header has no format line");
    header_.body = at_;
    header_.body_line = line_ + 1;
    CheckCounts();
    return std::move(header_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const { throw Error(file_, line_, message); }

  std::string_view NextLine() {
    ++line_;
    size_t end = line_end_.empty() ? bytes_.size() : bytes_.find(line_end_, at_);
    if (end == std::string_view::npos) end = bytes_.size();
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(bytes_.size(), end + line_end_.size());
    // A program that ends lines with \n alone may still write one \r\n.
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void ReadComment(std::string_view line, const std::vector<std::string_view>& words) {
    // As MeshLab and others write; a picture's name may have blanks.
    if (words.size() > 2 && LowerCase(words[1]) == "texturefile") {
      const size_t start = static_cast<size_t>(words[2].data() - line.data());
      header_.pictures.emplace_back(TrimBlanks(line.substr(start)));
    }
    if (words.size() < 3 || LowerCase(words[1]) != "unit:") return;
    if (const auto unit = FindUnit(words[2])) header_.unit = unit;
  }

  void ReadFormat(const std::vector<std::string_view>& words) {
    const std::string name = words.size() > 1 ? LowerCase(words[1]) : "";
    if (name == "ascii") {
      header_.format = PlyHeader::Format::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyHeader::Format::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyHeader::Format::kBigEndian;
    } else {
      Fail("expected format ascii, binary_little_endian or binary_big_endian");
    }
  }

  void ReadElement(const std::vector<std::string_view>& words) {
    const auto count = words.size() > 2 ? ParseInteger(words[2]) : std::nullopt;
    if (!count || *count < 0) Fail("expected element NAME COUNT");
    if (static_cast<unsigned long long>(*count) > bytes_.size()) TooShort(words[2]);
    PlyHeader::Element& element = header_.elements.emplace_back();
    element.name = LowerCase(words[1]);
    element.count = static_cast<size_t>(*count);
    element.line = line_;
  }

  void ReadProperty(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) Fail("a property before the first element");
    PlyHeader::Property property;
    property.line = line_;
    const bool is_list = words.size() > 1 && LowerCase(words[1]) == "list";
    if (words.size() < (is_list ? 5u : 3u)) {
      Fail("expected property TYPE NAME, or property list COUNT_TYPE TYPE NAME");
    }
    const auto type_of = [&](std::string_view word) {
      const auto type = FindType(word);
      if (!type) {
        Fail(Quote(word) +
             " is no type of a property; expected char, uchar, short, ushort, int, "
             "uint, float or double");
      }
      return *type;
    };
    if (is_list) property.count_type = type_of(words[2]);
    property.type = type_of(words[is_list ? 3 : 1]);
    property.name = LowerCase(words[is_list ? 4 : 2]);
    header_.elements.back().properties.push_back(property);
  }

  [[noreturn]] void TooShort(std::string_view count) const {
    Fail("the file is too short for " + std::string(count) + " elements");
  }

  // A damaged count must not ask for all of the machine's memory, nor for endless patience.
  void CheckCounts() {
    size_t left = bytes_.size() - at_;
    for (const PlyHeader::Element& element : header_.elements) {
      size_t least = 0;  // bytes for one
      for (const PlyHeader::Property& property : element.properties) {
        least += header_.format == PlyHeader::Format::kAscii
                     ? 2  // a digit and a blank
                     : PlyTypeSize(property.count_type.value_or(property.type));
      }
      if (least == 0) continue;
      // The last word needs no blank after it.
      if (element.count > (left + 1) / least) {
        line_ = element.line;
        TooShort(std::to_string(element.count));
      }
      left -= std::min(left, element.count * least);
    }
  }

  std::string_view bytes_;
  const std::filesystem::path& file_;
  std::string_view line_end_;
  size_t at_ = 0;
  int line_ = 0;
  PlyHeader header_;
};

}  // namespace

size_t PlyTypeSize(PlyHeader::Type type) {
  using Type = PlyHeader::Type;
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kDouble:
      return 8;
    default:
      return 4;
  }
}

PlyHeader ParsePlyHeader(std::string_view bytes, const std::filesystem::path& file) {
  return HeaderReader(bytes, file).Read();
}

}  // namespace groundglass
