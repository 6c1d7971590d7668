// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/text_encoding.h"

#include "scene/text.h"

#include <utf8proc.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>

namespace groundglass {
namespace {

const utf8proc_uint8_t* Data(std::string_view text) {
  return reinterpret_cast<const utf8proc_uint8_t*>(text.data());
}

void Append(utf8proc_int32_t character, std::string& text) {
  utf8proc_uint8_t bytes[4];
  const utf8proc_ssize_t size = utf8proc_encode_char(character, bytes);
  text.append(reinterpret_cast<const char*>(bytes), static_cast<size_t>(size));
}

std::string Utf8FromUtf16(std::string_view bytes, bool is_big_endian) {
  const auto unit = [&](size_t at) {
    const auto first = static_cast<uint8_t>(bytes[at]);
    const auto second = static_cast<uint8_t>(bytes[at + 1]);
    return static_cast<uint32_t>(is_big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  for (size_t at = 0; at + 1 < bytes.size(); at += 2) {
    uint32_t character = unit(at);
    if (character >= 0xD800 && character < 0xDC00 && at + 3 < bytes.size()) {
      const uint32_t low = unit(at + 2);
      if (low >= 0xDC00 && low < 0xE000) {
        character = 0x10000 + ((character - 0xD800) << 10) + (low - 0xDC00);
        at += 2;
      }
    }
    if (character >= 0xD800 && character < 0xE000) character = 0xFFFD;
    Append(static_cast<utf8proc_int32_t>(character), text);
  }
  return text;
}

// Where Windows-1252 differs from Latin-1: 0x80 to 0x9F.
constexpr std::array<uint16_t, 32> kWindows1252 = {
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

std::string Utf8FromWindows1252(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<uint8_t>(c);
    Append(byte >= 0x80 && byte < 0xA0 ? kWindows1252[byte - 0x80] : byte, text);
  }
  return text;
}

// A byte of Windows-1252, if it has this character.
std::optional<uint8_t> Windows1252Byte(utf8proc_int32_t character) {
  if (character < 0x80 || (character >= 0xA0 && character < 0x100)) {
    return static_cast<uint8_t>(character);
  }
  const auto* const found = std::find(kWindows1252.begin(), kWindows1252.end(), character);
  if (character < 0x100 || found == kWindows1252.end()) return std::nullopt;
  return static_cast<uint8_t>(0x80 + (found - kWindows1252.begin()));
}

// The same text with letters composed in one way (macOS parts "ü" in two), and what else is asked.
std::optional<std::string> Composed(const std::string& text, int more_options) {
  utf8proc_uint8_t* composed = nullptr;
  const utf8proc_ssize_t size = utf8proc_map(
      Data(text),
      static_cast<utf8proc_ssize_t>(text.size()),
      &composed,
      static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE | more_options));
  if (size < 0) return std::nullopt;
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owner(composed, std::free);
  return std::string(reinterpret_cast<const char*>(composed), static_cast<size_t>(size));
}

// Its characters, composed, one after another. What is no UTF-8 is read as Windows-1252.
template <typename Take>
void ForEachCharacter(std::string_view bytes, const Take& take) {
  const std::string text = IsUtf8(bytes) ? std::string(bytes) : Utf8FromWindows1252(bytes);
  const std::string composed = Composed(text, 0).value_or(text);
  for (size_t at = 0; at < composed.size();) {
    utf8proc_int32_t character = 0;
    const auto left = static_cast<utf8proc_ssize_t>(composed.size() - at);
    const utf8proc_ssize_t size = utf8proc_iterate(Data(composed) + at, left, &character);
    if (size < 1) return;
    take(character);
    at += static_cast<size_t>(size);
  }
}

constexpr std::string_view kLittleEndianMark = "\xFF\xFE";
constexpr std::string_view kBigEndianMark = "\xFE\xFF";

}  // namespace

bool IsUtf8(std::string_view bytes) {
  size_t at = 0;
  while (at < bytes.size()) {
    utf8proc_int32_t character = 0;
    const auto left = static_cast<utf8proc_ssize_t>(bytes.size() - at);
    const utf8proc_ssize_t size = utf8proc_iterate(Data(bytes) + at, left, &character);
    if (size < 1) return false;
    at += static_cast<size_t>(size);
  }
  return true;
}

bool IsUtf16(std::string_view bytes) {
  if (bytes.starts_with(kBigEndianMark) || bytes.starts_with(kLittleEndianMark)) return true;
  // Without its mark: every other byte of plain letters is zero.
  if (bytes.size() < 4) return false;
  const bool is_little_endian = bytes[0] != 0 && bytes[1] == 0 && bytes[3] == 0;
  const bool is_big_endian = bytes[0] == 0 && bytes[1] != 0 && bytes[2] == 0;
  return is_little_endian || is_big_endian;
}

Utf8Text Utf8FromBytes(std::string_view bytes) {
  if (IsUtf16(bytes)) {
    const bool is_big_endian = bytes[0] == 0 || bytes.starts_with(kBigEndianMark);
    if (bytes.starts_with(kBigEndianMark) || bytes.starts_with(kLittleEndianMark)) {
      bytes.remove_prefix(2);
    }
    return {Utf8FromUtf16(bytes, is_big_endian), false};
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (IsUtf8(bytes)) return {std::string(bytes), false};
  return {Utf8FromWindows1252(bytes), true};
}

std::string FoldedName(std::string_view name) {
  const std::string text = IsUtf8(name) ? std::string(name) : Utf8FromWindows1252(name);
  return Composed(text, UTF8PROC_CASEFOLD).value_or(LowerCase(text));
}

std::string Windows1252FromUtf8(std::string_view utf8, std::set<std::string>& missing) {
  std::string text;
  ForEachCharacter(utf8, [&](utf8proc_int32_t character) {
    const std::optional<uint8_t> byte = Windows1252Byte(character);
    text += byte ? static_cast<char>(*byte) : '?';
    if (byte) return;
    std::string one;
    Append(character, one);
    missing.insert(one);
  });
  return text;
}

std::string Utf16FromUtf8(std::string_view utf8) {
  std::string bytes = "\xFE\xFF";
  const auto append = [&](uint32_t unit) {
    bytes += static_cast<char>(unit >> 8);
    bytes += static_cast<char>(unit & 0xFF);
  };
  ForEachCharacter(utf8, [&](utf8proc_int32_t character) {
    auto code = static_cast<uint32_t>(character);
    if (code < 0x10000) {
      append(code);
      return;
    }
    code -= 0x10000;
    append(0xD800 | code >> 10);
    append(0xDC00 | (code & 0x3FF));
  });
  return bytes;
}

int DisplayWidth(std::string_view utf8) {
  int width = 0;
  for (size_t at = 0; at < utf8.size();) {
    utf8proc_int32_t character = 0;
    const auto left = static_cast<utf8proc_ssize_t>(utf8.size() - at);
    const utf8proc_ssize_t size = utf8proc_iterate(Data(utf8) + at, left, &character);
    // A byte that is no letter is shown as one.
    width += size > 0 ? utf8proc_charwidth(character) : 1;
    at += size > 0 ? static_cast<size_t>(size) : 1;
  }
  return width;
}

std::string PaddedTo(int width, std::string_view utf8) {
  const int missing = std::max(0, width - DisplayWidth(utf8));
  return std::string(utf8) + std::string(static_cast<size_t>(missing), ' ');
}

}  // namespace groundglass
