// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_io.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace groundglass {
namespace {

constexpr std::string_view kCameraKey = "camera";
// In place of a value that is yet to be written (FormatViewTemplate).
constexpr std::string_view kToBeFilledIn = "?";
// x y z i j k a v: without them there is no camera.
constexpr int kNumRequiredKeys = 8;

std::optional<TagKey> FindTagKey(std::string_view name) {
  const auto found = std::find(kTagKeyNames.begin(), kTagKeyNames.end(), name);
  if (found == kTagKeyNames.end()) return std::nullopt;
  return static_cast<TagKey>(found - kTagKeyNames.begin());
}

const SigmaKey* FindSigmaKey(std::string_view name) {
  const auto found = std::find_if(
      kSigmaKeys.begin(), kSigmaKeys.end(), [&](const SigmaKey& key) { return key.name == name; });
  return found == kSigmaKeys.end() ? nullptr : &*found;
}

bool IsKey(std::string_view name) {
  return FindTagKey(name) || FindSigmaKey(name) != nullptr || name == kCameraKey;
}

struct KeyValue {
  TextToken key;
  TextToken value;
};

struct ViewReading {
  ViewTag tag;
  std::vector<TextLine> lines;
  std::vector<KeyValue> pairs;
  std::vector<std::string> faults;
};

const KeyValue* FindPair(const std::vector<KeyValue>& pairs, std::string_view key) {
  const auto found = std::find_if(
      pairs.begin(), pairs.end(), [&](const KeyValue& pair) { return pair.key.text == key; });
  return found == pairs.end() ? nullptr : &*found;
}

// The number that follows a sign which stands by itself, as in `y - 74.9`; empty if none does.
std::string_view NumberAfterSign(const std::vector<TextToken>& tokens, size_t sign) {
  const std::string_view text = tokens[sign].text;
  if ((text != "-" && text != "+") || sign + 1 >= tokens.size()) return {};
  const std::string_view next = tokens[sign + 1].text;
  return !next.empty() && next[0] != '-' && next[0] != '+' && ParseNumber(next)
             ? next
             : std::string_view();
}

void StoreValue(const KeyValue& pair, double value, ViewTag& tag) {
  if (const std::optional<TagKey> key = FindTagKey(pair.key.text)) {
    SetTagValue(tag, *key, value);
  } else {
    tag.sigmas.*(FindSigmaKey(pair.key.text)->member) = value;
  }
}

// Reads everything it can; faults in the order of the file.
class PairReader {
 public:
  PairReader(const std::string& text, const std::filesystem::path& name) : name_(name) {
    reading_.lines = SplitLines(text);
    for (const TextLine& line : reading_.lines) {
      tokens_.insert(tokens_.end(), line.tokens.begin(), line.tokens.end());
    }
  }

  ViewReading Read() {
    while (next_ < tokens_.size()) {
      if (const std::optional<KeyValue> pair = NextPair()) TakeValue(*pair);
    }
    RequireValues();
    if (reading_.faults.empty()) RequireCamera();
    return std::move(reading_);
  }

 private:
  void Fail(int line, const std::string& message) {
    reading_.faults.push_back(Error(name_, line, message).what());
  }

  // Nothing, and a fault, for one that cannot be used.
  std::optional<KeyValue> NextPair() {
    const TextToken key = tokens_[next_++];
    const bool is_last = next_ == tokens_.size();
    const bool has_value = !is_last && !IsKey(tokens_[next_].text);
    if (!IsKey(key.text)) {
      Fail(key.line,
           "unknown key " + Quote(key.text) +
               "; the keys are x y z i j k a v roll shift_x shift_y k1 k2 k3 p1 p2 sigma_... "
               "camera");
      if (has_value) ++next_;
      return std::nullopt;
    }
    // A camera may be called like a key.
    if (!has_value && !(key.text == kCameraKey && !is_last)) {
      Fail(key.line, "key " + Quote(key.text) + " has no value");
      return std::nullopt;
    }
    const KeyValue pair{key, tokens_[next_]};
    if (const std::string_view number = NumberAfterSign(tokens_, next_); !number.empty()) {
      Fail(pair.value.line,
           "key " + Quote(key.text) + ": a blank stands between the sign and the number; write " +
               std::string(pair.value.text) + std::string(number));
      reading_.pairs.push_back(pair);
      next_ += 2;
      return std::nullopt;
    }
    ++next_;
    if (const KeyValue* first = FindPair(reading_.pairs, key.text)) {
      Fail(key.line,
           "key " + Quote(key.text) + " is repeated; it stands on line " +
               std::to_string(first->key.line) + " already");
      return std::nullopt;
    }
    reading_.pairs.push_back(pair);
    return pair;
  }

  void TakeValue(const KeyValue& pair) {
    const std::string_view word = pair.value.text;
    if (word == kToBeFilledIn) {
      if (to_fill_in_.empty()) first_to_fill_in_ = pair.key.line;
      to_fill_in_ += (to_fill_in_.empty() ? "" : ", ") + std::string(pair.key.text);
      return;
    }
    if (pair.key.text == kCameraKey) {
      reading_.tag.camera = word;
      return;
    }
    const std::string key_name = "key " + Quote(pair.key.text);
    const std::optional<double> value = ParseNumber(word);
    if (!value) {
      Fail(pair.value.line, key_name + ": " + Quote(word) + " is not a number");
    } else if (!std::isfinite(*value)) {
      Fail(pair.value.line, key_name + ": " + Quote(word) + " is not a finite number");
    } else if (FindSigmaKey(pair.key.text) != nullptr && !(*value > 0)) {
      Fail(pair.value.line, key_name + ": a standard deviation must be above 0");
    } else {
      StoreValue(pair, *value, reading_.tag);
    }
  }

  void RequireValues() {
    if (!to_fill_in_.empty()) {
      Fail(
          first_to_fill_in_,
          "this template is not filled in yet: write a number in place of the ? of " + to_fill_in_);
    }
    for (int index = 0; index < kNumRequiredKeys; ++index) {
      if (FindPair(reading_.pairs, kTagKeyNames[index]) == nullptr) {
        reading_.faults.push_back(
            Error(name_, "key " + Quote(kTagKeyNames[index]) + " is missing").what());
      }
    }
  }

  void RequireCamera() {
    const std::optional<TagFault> fault = FindTagFault(reading_.tag);
    if (!fault) return;
    const KeyValue* pair = FindPair(reading_.pairs, fault->key);
    Fail(pair == nullptr ? 1 : pair->key.line, "key " + Quote(fault->key) + ": " + fault->message);
  }

  std::filesystem::path name_;
  std::vector<TextToken> tokens_;
  size_t next_ = 0;
  ViewReading reading_;
  // Keys whose value a template leaves open.
  std::string to_fill_in_;
  int first_to_fill_in_ = 0;
};

ViewReading ReadPairs(const std::string& text, const std::filesystem::path& name) {
  return PairReader(text, name).Read();
}

// Two significant digits: a standard deviation is never known better.
std::string FormatDeviation(double deviation) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(deviation))), 0, 12);
  const double scale = std::pow(10.0, decimals);
  return FormatNumber(std::round(deviation * scale) / scale);
}

// What the writer leaves in a comment about one corrected number. `key` is given where several
// pairs share the line: "(measured 232, now +-0.03)" or "(x measured 232, now +-0.03)".
struct Note {
  size_t begin = std::string::npos;  // in the text
  size_t end = std::string::npos;
  std::string measured;  // as written at first; empty if it was not measured at all
};

std::string FormatNote(const std::string& key, const std::string& measured, double deviation) {
  std::string note = "(" + (key.empty() ? "" : key + " ");
  note += measured.empty() ? "not measured" : "measured " + measured;
  if (deviation > 0) note += ", now +-" + FormatDeviation(deviation);
  return note + ")";
}

// The note about `key` that an earlier correction left in a comment.
std::optional<Note> FindNote(const std::string& text,
                             size_t begin,
                             size_t end,
                             const std::string& key) {
  for (const std::string& word : {std::string("measured "), std::string("not measured")}) {
    const std::string opening = "(" + (key.empty() ? "" : key + " ") + word;
    for (size_t at = text.find(opening, begin); at != std::string::npos && at < end;
         at = text.find(opening, at + 1)) {
      const size_t close = text.find(')', at);
      if (close == std::string::npos || close >= end) break;
      const size_t value_begin = at + opening.size();
      const size_t value_end = std::min(text.find(',', value_begin), close);
      const std::string value = text.substr(value_begin, value_end - value_begin);
      const bool is_measured = word == "measured ";
      if (is_measured ? ParseNumber(value).has_value() : value.empty()) {
        return Note{at, close + 1, value};
      }
    }
  }
  return std::nullopt;
}

struct Edit {
  size_t begin = 0;
  size_t end = 0;
  std::string replacement;
};

std::string ApplyEdits(std::string text, std::vector<Edit> edits) {
  std::stable_sort(
      edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
    text.replace(edit->begin, edit->end - edit->begin, edit->replacement);
  }
  return text;
}

// Where a line's comment text ends: before its trailing blanks.
size_t EndOfWords(const std::string& text, const TextLine& line) {
  size_t end = line.offset + line.size;
  while (end > line.offset && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
  return end;
}

// What changes on one line: its values, and the notes of what they were.
void EditLine(const std::string& measured_text,
              const ViewReading& reading,
              const ViewTag& corrected,
              const TagDeviations& deviations,
              const TextLine& line,
              std::vector<Edit>& edits) {
  // A note belongs to the line on which its value stands.
  std::vector<const KeyValue*> pairs;
  for (const KeyValue& pair : reading.pairs) {
    if (pair.value.line == line.number) pairs.push_back(&pair);
  }
  const auto replace_value = [&](const TextToken& value, double number) {
    edits.push_back({value.offset, value.offset + value.text.size(), FormatNumber(number)});
  };
  const size_t comment_begin = line.tokens.empty()
                                   ? line.offset
                                   : line.tokens.back().offset + line.tokens.back().text.size();
  const size_t line_end = EndOfWords(measured_text, line);
  std::string new_notes;
  for (const KeyValue* pair : pairs) {
    if (const SigmaKey* sigma_key = FindSigmaKey(pair->key.text)) {
      const std::optional<double>& sigma = corrected.sigmas.*(sigma_key->member);
      if (sigma && *sigma != ParseNumber(pair->value.text)) replace_value(pair->value, *sigma);
    }
    const std::optional<TagKey> key = FindTagKey(pair->key.text);
    if (!key) continue;
    const double value = GetTagValue(corrected, *key);
    const double deviation = deviations[static_cast<int>(*key)];
    const bool is_changed = value != GetTagValue(reading.tag, *key);
    if (is_changed) replace_value(pair->value, value);
    const std::string note_key = pairs.size() > 1 ? std::string(pair->key.text) : "";
    if (const auto note = FindNote(measured_text, comment_begin, line_end, note_key)) {
      if (is_changed || deviation > 0) {
        edits.push_back({note->begin, note->end, FormatNote(note_key, note->measured, deviation)});
      }
    } else if (is_changed) {
      new_notes += " " + FormatNote(note_key, std::string(pair->value.text), deviation);
    }
  }
  if (new_notes.empty()) return;
  edits.push_back({line_end, line_end, (line.has_comment ? "" : " %") + new_notes});
}

std::string LineBreakOf(const std::string& text) {
  if (text.find("\r\n") != std::string::npos) return "\r\n";
  const bool has_only_returns =
      text.find('\n') == std::string::npos && text.find('\r') != std::string::npos;
  return has_only_returns ? "\r" : "\n";
}

// Lines for what the file has no key of.
std::string FormatNewKeys(const ViewReading& reading,
                          const ViewTag& corrected,
                          const TagDeviations& deviations,
                          const std::string& line_break) {
  std::string text;
  for (int index = kNumRequiredKeys; index < kNumTagKeys; ++index) {
    const double value = GetTagValue(corrected, static_cast<TagKey>(index));
    if (value == 0 || FindPair(reading.pairs, kTagKeyNames[index]) != nullptr) continue;
    text += std::string(kTagKeyNames[index]) + " " + FormatNumber(value) + " % " +
            FormatNote("", "", deviations[index]) + line_break;
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::optional<double>& sigma = corrected.sigmas.*(key.member);
    if (!sigma || FindPair(reading.pairs, key.name) != nullptr) continue;
    text += std::string(key.name) + " " + FormatNumber(*sigma) + line_break;
  }
  if (!corrected.camera.empty() && reading.tag.camera.empty()) {
    text += std::string(kCameraKey) + " " + corrected.camera + line_break;
  }
  return text;
}

}  // namespace

std::string ReadTextFile(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw Error(file, "this is a folder; expected a text file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot open this file");
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (in.bad() || (bytes.fail() && in.peek() != std::ifstream::traits_type::eof())) {
    throw Error(file, "cannot read this file");
  }
  return std::move(bytes).str();
}

ViewTag ParseView(const std::string& text, const std::filesystem::path& name) {
  ViewReading reading = ReadPairs(text, name);
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  return reading.tag;
}

ViewTag ReadView(const std::filesystem::path& file) { return ParseView(ReadTextFile(file), file); }

std::vector<std::string> FindViewFaults(const std::string& text,
                                        const std::filesystem::path& name) {
  return ReadPairs(text, name).faults;
}

std::string FormatView(const ViewTag& tag, const std::string& comment) {
  std::string text;
  std::istringstream comment_lines(comment);
  for (std::string line; std::getline(comment_lines, line);) text += "% " + line + "\n";
  for (int index = 0; index < kNumTagKeys; ++index) {
    const double value = GetTagValue(tag, static_cast<TagKey>(index));
    if (index >= kNumRequiredKeys && value == 0) continue;
    text += std::string(kTagKeyNames[index]) + " " + FormatNumber(value) + "\n";
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::optional<double>& sigma = tag.sigmas.*(key.member);
    if (sigma) text += std::string(key.name) + " " + FormatNumber(*sigma) + "\n";
  }
  if (!tag.camera.empty()) {
    if (tag.camera.find_first_of(" \t\r\n%") != std::string::npos) {
      throw Error("camera name " + Quote(tag.camera) + " must be one word without '%'");
    }
    text += std::string(kCameraKey) + " " + tag.camera + "\n";
  }
  return text;
}

std::string FormatCorrectedView(const std::string& measured_text,
                                const ViewTag& corrected,
                                const TagDeviations& deviations) {
  const ViewReading reading = ReadPairs(measured_text, "view");
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  std::vector<Edit> edits;
  for (const TextLine& line : reading.lines) {
    EditLine(measured_text, reading, corrected, deviations, line, edits);
  }
  std::string text = ApplyEdits(measured_text, edits);
  const std::string line_break = LineBreakOf(measured_text);
  const std::string appended = FormatNewKeys(reading, corrected, deviations, line_break);
  if (!appended.empty() && !text.empty() && text.back() != '\n' && text.back() != '\r') {
    text += line_break;
  }
  return text + appended;
}

}  // namespace groundglass
