// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/photograph_name.h"

#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/nearest_word.h"
#include "scene/text.h"

#include <algorithm>
#include <array>

namespace groundglass {
namespace {

// Without an image's extension, its folders kept. Windows' slashes count as ours.
std::string TypedWithoutExtension(const std::string& typed) {
  std::string name = typed;
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path(name);
  return (path.parent_path() / ImageStem(path)).generic_string();
}

std::string WithoutFolders(const std::string& name) {
  return std::filesystem::path(TypedWithoutExtension(name)).filename().string();
}

std::string AsTyped(const std::string& name) { return name; }
std::string Folded(const std::string& name) { return FoldedName(WithoutFolders(name)); }

// Without what people leave out or write in another way: zeros before digits, blanks, dashes.
std::string Skeleton(const std::string& name) {
  std::string skeleton;
  for (const char c : Folded(name)) {
    if (c == ' ' || c == '_' || c == '-' || c == '.') continue;
    const bool ends_in_zero = !skeleton.empty() && skeleton.back() == '0';
    const bool is_leading =
        ends_in_zero && (skeleton.size() == 1 || skeleton[skeleton.size() - 2] < '0' ||
                         skeleton[skeleton.size() - 2] > '9');
    if (is_leading && c >= '0' && c <= '9') skeleton.pop_back();
    skeleton += c;
  }
  return skeleton;
}

std::string Digits(std::string text) {
  std::erase_if(text, [](char c) { return c < '0' || c > '9'; });
  return text;
}

using Form = std::string (*)(const std::string&);
constexpr std::array<Form, 4> kForms = {AsTyped, TypedWithoutExtension, WithoutFolders, Folded};

// Those whose name or file's name has the same form as the word.
std::vector<size_t> FindInForm(Form form,
                               std::string_view word,
                               std::span<const PhotographName> names) {
  std::vector<size_t> found;
  const std::string wanted = form(std::string(word));
  if (wanted.empty()) return found;
  for (size_t i = 0; i < names.size(); ++i) {
    if (form(names[i].name) == wanted ||
        (!names[i].file_name.empty() && form(names[i].file_name) == wanted)) {
      found.push_back(i);
    }
  }
  return found;
}

// Of the first form that finds any.
std::vector<size_t> FindAll(std::string_view word, std::span<const PhotographName> names) {
  for (const Form form : kForms) {
    std::vector<size_t> found = FindInForm(form, word, names);
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace

std::optional<size_t> FindPhotograph(std::string_view word, std::span<const PhotographName> names) {
  const std::vector<size_t> found = FindAll(word, names);
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return found[0];
  std::string all;
  for (const size_t i : found) {
    const PhotographName& name = names[i];
    all += (all.empty() ? "" : ", ") + (name.file_name.empty() ? name.name : name.file_name);
  }
  throw Error(Quote(word) + " may be any of " + all + "; write the whole name");
}

std::vector<std::optional<size_t>> MatchPhotographs(std::span<const std::string> words,
                                                    std::span<const PhotographName> names) {
  std::vector<std::optional<size_t>> matches(words.size());
  std::vector<char> is_taken(names.size(), 0);
  for (const Form form : kForms) {
    std::vector<std::vector<size_t>> found(words.size());
    std::vector<int> num_words(names.size(), 0);
    for (size_t word = 0; word < words.size(); ++word) {
      if (matches[word]) continue;
      found[word] = FindInForm(form, words[word], names);
      std::erase_if(found[word], [&](size_t name) { return is_taken[name]; });
      for (const size_t name : found[word]) ++num_words[name];
    }
    for (size_t word = 0; word < words.size(); ++word) {
      if (found[word].size() != 1 || num_words[found[word][0]] != 1) continue;
      matches[word] = found[word][0];
      is_taken[found[word][0]] = 1;
    }
  }
  return matches;
}

std::string NearestName(std::string_view word, std::span<const PhotographName> names) {
  const std::vector<size_t> found = FindInForm(Skeleton, word, names);
  if (found.size() > 1) return "";
  if (found.size() == 1) {
    const PhotographName& name = names[found[0]];
    return " (is it " + (name.file_name.empty() ? name.name : name.file_name) +
           "? it differs in zeros, blanks, dashes or case only)";
  }
  // Another number is another photograph, not a slip.
  const std::string folded = Folded(std::string(word));
  std::vector<std::string> known;
  for (const PhotographName& name : names) {
    if (Digits(Folded(name.name)) == Digits(folded)) known.push_back(name.name);
  }
  const std::optional<std::string> nearest = FindNearest(WithoutFolders(std::string(word)), known);
  return nearest ? " (did you mean " + *nearest + "?)" : "";
}

}  // namespace groundglass
