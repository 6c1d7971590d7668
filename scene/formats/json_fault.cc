// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/json_fault.h"

#include "scene/text.h"

namespace groundglass {
namespace {

// The library's types: "number", "object", ...
std::string WithArticle(std::string_view type) {
  if (type == "null") return "null";
  if (type == "array") return "a list";
  return (type == "object" ? "an " : "a ") + std::string(type);
}

// What stands between two pieces of a text; empty if they are not in it.
std::string_view Between(std::string_view text, std::string_view before, std::string_view after) {
  const size_t start = text.find(before);
  if (start == std::string_view::npos) return {};
  const std::string_view rest = text.substr(start + before.size());
  const size_t end = after.empty() ? rest.size() : rest.find(after);
  return end == std::string_view::npos ? std::string_view() : rest.substr(0, end);
}

// "line 3, column 5: unexpected '}'; expected string literal"
std::string TellSyntaxFault(std::string_view what) {
  const std::string place(Between(what, "parse error at ", ": "));
  std::string_view rest = Between(what, ": ", "");
  if (rest.starts_with("syntax error")) rest = Between(rest, " - ", "");
  return place + ": " + std::string(rest);
}

}  // namespace

std::string TellJsonFault(std::string_view what) {
  if (what.starts_with("[json.exception.")) what = Between(what, "] ", "");
  std::string words(what);
  if (what.starts_with("parse error at ")) {
    words = TellSyntaxFault(what);
  } else if (what.starts_with("key '")) {
    words = Quote(Between(what, "key '", "' not found")) + " is missing";
  } else if (what.starts_with("array index ")) {
    words = "a list has no element " + std::string(Between(what, "array index ", " is")) +
            " (the first is 0)";
  } else if (what.starts_with("type must be ")) {
    words = "expected " + WithArticle(Between(what, "type must be ", ", but")) + ", found " +
            WithArticle(Between(what, "but is ", ""));
  } else if (what.starts_with("cannot use ")) {
    const size_t last = what.rfind(" with ");
    const std::string_view found = what.substr(last + 6);
    words = std::string("expected ") +
            (found == "array"    ? "an object"
             : found == "object" ? "a list"
                                 : "an object or a list") +
            ", found " + WithArticle(found);
  } else if (what.starts_with("number overflow")) {
    words = std::string(Between(what, "parsing '", "'")) + " is too large a number";
  }
  for (char& c : words) {
    if (static_cast<unsigned char>(c) < ' ' && c != '\n') c = '?';
  }
  return OneLine(words);
}

}  // namespace groundglass
