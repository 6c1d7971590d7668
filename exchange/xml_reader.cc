// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/xml_reader.h"

#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace groundglass {
namespace {

constexpr int kDeepest = 200;

bool IsXmlBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

void AppendUtf8(unsigned long code, std::string& text) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    text += static_cast<char>(0xf0 | ((code >> 18) & 7));
    text += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  }
}

class XmlParser {
 public:
  XmlParser(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

  XmlElement Parse() {
    SkipToElement();
    if (!Sees("<")) Fail("is no XML: it has no element");
    XmlElement root = ParseElement(1);
    SkipToElement();
    if (next_ < text_.size()) Fail("something follows the last element");
    return root;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const { throw Error(file_, line_, message); }

  bool Sees(std::string_view word) const { return text_.substr(next_).starts_with(word); }
  void Skip(size_t count) {
    for (size_t i = 0; i < count && next_ < text_.size(); ++i) {
      if (text_[next_++] == '\n') ++line_;
    }
  }
  void SkipBlanks() {
    while (next_ < text_.size() && IsXmlBlank(text_[next_])) Skip(1);
  }
  void SkipPast(std::string_view end) {
    const size_t found = text_.find(end, next_);
    if (found == std::string_view::npos) Fail("ends before " + Quote(end));
    Skip(found + end.size() - next_);
  }
  // A document type may hold a list in brackets.
  void SkipDocumentType() {
    const size_t end = text_.find('>', next_);
    const size_t bracket = text_.find('[', next_);
    if (bracket < end) SkipPast("]");
    SkipPast(">");
  }
  // True if a comment, an instruction or a document type stood here.
  bool SkipAside() {
    if (Sees("<!--")) {
      SkipPast("-->");
    } else if (Sees("<?")) {
      SkipPast("?>");
    } else if (Sees("<!DOCTYPE")) {
      SkipDocumentType();
    } else {
      return false;
    }
    return true;
  }
  void SkipToElement() {
    if (Sees("\xef\xbb\xbf")) Skip(3);
    do {
      SkipBlanks();
    } while (SkipAside());
  }

  std::string ReadName() {
    const size_t first = next_;
    while (next_ < text_.size() && !IsXmlBlank(text_[next_]) && text_[next_] != '>' &&
           text_[next_] != '/' && text_[next_] != '=' && text_[next_] != '<') {
      ++next_;
    }
    if (next_ == first) Fail("expected a name");
    std::string name(text_.substr(first, next_ - first));
    const size_t colon = name.find(':');
    return colon == std::string::npos ? name : name.substr(colon + 1);
  }

  // Up to the end mark, which is skipped.
  std::string ReadText(std::string_view raw) const {
    std::string text;
    for (size_t i = 0; i < raw.size(); ++i) {
      const size_t end = raw[i] == '&' ? raw.find(';', i) : std::string_view::npos;
      if (end == std::string_view::npos || end - i > 12) {
        text += raw[i];
        continue;
      }
      AppendEntity(raw.substr(i + 1, end - i - 1), text);
      i = end;
    }
    return text;
  }
  void AppendEntity(std::string_view name, std::string& text) const {
    if (name == "amp") {
      text += '&';
    } else if (name == "lt") {
      text += '<';
    } else if (name == "gt") {
      text += '>';
    } else if (name == "quot") {
      text += '"';
    } else if (name == "apos") {
      text += '\'';
    } else if (name.starts_with("#")) {
      const bool is_hex = name.starts_with("#x");
      const std::string digits(name.substr(is_hex ? 2 : 1));
      char* end = nullptr;
      const unsigned long code = std::strtoul(digits.c_str(), &end, is_hex ? 16 : 10);
      if (digits.empty() || *end != '\0' || code > 0x10ffff) Fail("no such character");
      AppendUtf8(code, text);
    } else {
      Fail("no such entity: " + Quote(name));
    }
  }

  void ParseAttributes(XmlElement& element) {
    while (true) {
      SkipBlanks();
      if (next_ == text_.size()) Fail("ends within <" + element.name + ">");
      if (Sees(">") || Sees("/>")) return;
      const std::string name = ReadName();
      SkipBlanks();
      if (!Sees("=")) Fail("expected = behind " + Quote(name));
      Skip(1);
      SkipBlanks();
      if (!Sees("\"") && !Sees("'")) Fail("the value of " + Quote(name) + " has no quotes");
      const char quote = text_[next_];
      Skip(1);
      const size_t end = text_.find(quote, next_);
      if (end == std::string_view::npos) Fail("the value of " + Quote(name) + " has no end");
      element.attributes[name] = ReadText(text_.substr(next_, end - next_));
      Skip(end + 1 - next_);
    }
  }

  XmlElement ParseElement(int depth) {
    if (depth > kDeepest) Fail("elements are nested too deep");
    XmlElement element;
    element.line = line_;
    Skip(1);
    element.name = ReadName();
    ParseAttributes(element);
    if (Sees("/>")) {
      Skip(2);
      return element;
    }
    Skip(1);
    ParseContent(element, depth);
    return element;
  }

  void ParseContent(XmlElement& element, int depth) {
    while (true) {
      const size_t mark = text_.find('<', next_);
      if (mark == std::string_view::npos) Fail("<" + element.name + "> has no end");
      element.text += ReadText(text_.substr(next_, mark - next_));
      Skip(mark - next_);
      if (Sees("</")) {
        Skip(2);
        const std::string name = ReadName();
        if (name != element.name) Fail("</" + name + "> ends <" + element.name + ">");
        SkipBlanks();
        if (!Sees(">")) Fail("expected > behind </" + name);
        Skip(1);
        return;
      }
      if (Sees("<![CDATA[")) {
        Skip(9);
        const size_t end = text_.find("]]>", next_);
        if (end == std::string_view::npos) Fail("CDATA has no end");
        element.text += text_.substr(next_, end - next_);
        Skip(end + 3 - next_);
      } else if (!SkipAside()) {
        element.children.push_back(ParseElement(depth + 1));
      }
    }
  }

  std::filesystem::path file_;
  std::string_view text_;
  size_t next_ = 0;
  int line_ = 1;
};

}  // namespace

const XmlElement* XmlElement::Child(std::string_view child_name) const {
  for (const XmlElement& child : children) {
    if (child.name == child_name) return &child;
  }
  return nullptr;
}

std::string XmlElement::ChildText(std::string_view child_name) const {
  const XmlElement* child = Child(child_name);
  return child ? std::string(TrimBlanks(child->text)) : std::string();
}

std::string XmlElement::Attribute(const std::string& attribute_name) const {
  const auto found = attributes.find(attribute_name);
  return found == attributes.end() ? std::string() : found->second;
}

XmlElement ReadXml(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  return XmlParser(file, text).Parse();
}

std::string XmlPlace(const std::filesystem::path& file, const XmlElement& element) {
  return file.string() + ":" + std::to_string(element.line);
}

std::vector<double> ReadXmlNumbers(const std::filesystem::path& file,
                                   const XmlElement& element,
                                   std::string_view text) {
  std::vector<double> numbers;
  size_t at = 0;
  while (true) {
    while (at < text.size() && IsXmlBlank(text[at])) ++at;
    if (at == text.size()) return numbers;
    const size_t first = at;
    while (at < text.size() && !IsXmlBlank(text[at])) ++at;
    const std::string_view word = text.substr(first, at - first);
    const std::optional<double> number = ParseNumber(word);
    if (!number || !std::isfinite(*number)) {
      throw Error(
          file, element.line, "<" + element.name + ">: " + Quote(word) + " is not a finite number");
    }
    numbers.push_back(*number);
  }
}

}  // namespace groundglass
