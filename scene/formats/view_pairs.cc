// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_pairs.h"

#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// In place of a value that is yet to be written (FormatViewTemplate).
constexpr std::string_view kToBeFilledIn = "?";

bool IsKey(std::string_view name) {
  return FindTagKey(name) || FindSigmaKey(name) != nullptr || name == kCameraKey;
}

// As comments begin elsewhere.
bool IsOtherComment(std::string_view word) {
  return word.starts_with('#') || word.starts_with("//") || word.starts_with(';');
}

// What was most likely meant by a word that is no key.
std::string HintAtKey(std::string_view word) {
  if (IsOtherComment(word)) return "a comment begins with %";
  const std::string key = LowerCase(word.substr(0, word.find_first_of(":=")));
  if (IsKey(key)) return "write '" + key + "', a blank and its value";
  return "the keys are x y z i j k a v roll shift_x shift_y k1 k2 k3 p1 p2 sigma_... camera";
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
class ViewPairReader {
 public:
  ViewPairReader(const std::string& text, const std::filesystem::path& name) : name_(name) {
    reading_.lines = SplitLines(text);
    for (const TextLine& line : reading_.lines) {
      tokens_.insert(tokens_.end(), line.tokens.begin(), line.tokens.end());
    }
  }

  ViewReading Read() {
    ReadValues();
    RequireKeys();
    if (reading_.faults.empty()) RequireCamera();
    return std::move(reading_);
  }

  ViewReading ReadSome() {
    ReadValues();
    return std::move(reading_);
  }

 private:
  void Fail(int line, const std::string& message) {
    reading_.faults.push_back(Error(name_, line, message).what());
  }

  void ReadValues() {
    while (next_ < tokens_.size()) {
      if (const std::optional<KeyValue> pair = NextPair()) TakeValue(*pair);
    }
    RequireFilledIn();
  }

  // Nothing, and a fault, for one that cannot be used.
  std::optional<KeyValue> NextPair() {
    const TextToken key = tokens_[next_++];
    const bool is_last = next_ == tokens_.size();
    const bool has_value = !is_last && !IsKey(tokens_[next_].text);
    if (!IsKey(key.text)) {
      Fail(key.line, "unknown key " + Quote(key.text) + "; " + HintAtKey(key.text));
      if (IsOtherComment(key.text)) {
        while (next_ < tokens_.size() && tokens_[next_].line == key.line) ++next_;
      } else if (has_value) {
        ++next_;
      }
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
    if ((pair.value.text == "=" || pair.value.text == ":") && next_ + 1 < tokens_.size()) {
      Fail(pair.value.line,
           "key " + Quote(key.text) + ": " + Quote(pair.value.text) + " is not needed; write " +
               std::string(key.text) + " " + std::string(tokens_[next_ + 1].text));
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
    if (!value || !std::isfinite(*value)) {
      Fail(pair.value.line, key_name + ": " + WhyNoNumber(word));
      return;
    }
    const SigmaKey* sigma = FindSigmaKey(pair.key.text);
    const std::string fault = sigma == nullptr ? "" : FindSigmaFault(*sigma, *value);
    if (fault.empty()) {
      StoreValue(pair, *value, reading_.tag);
    } else {
      Fail(pair.value.line, key_name + ": " + fault);
    }
  }

  void RequireFilledIn() {
    if (to_fill_in_.empty()) return;
    Fail(first_to_fill_in_,
         "this template is not filled in yet: write a number in place of the ? of " + to_fill_in_);
  }

  void RequireKeys() {
    if (tokens_.empty()) {
      reading_.faults.push_back(
          Error(name_,
                "this view file is empty; expected x, y, z, i, j, k, a and v, each with its value")
              .what());
      return;
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

}  // namespace

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

const KeyValue* FindPair(const std::vector<KeyValue>& pairs, std::string_view key) {
  const auto found = std::find_if(
      pairs.begin(), pairs.end(), [&](const KeyValue& pair) { return pair.key.text == key; });
  return found == pairs.end() ? nullptr : &*found;
}

ViewReading ReadPairs(const std::string& text, const std::filesystem::path& name) {
  return ViewPairReader(text, name).Read();
}

ViewReading ReadSomePairs(const std::string& text, const std::filesystem::path& name) {
  return ViewPairReader(text, name).ReadSome();
}

}  // namespace groundglass
