// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_io.h"

#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/formats/view_pairs.h"
#include "scene/text.h"

#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace groundglass {

std::string ReadFileBytes(const std::filesystem::path& file) {
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

std::string ReadTextFile(const std::filesystem::path& file) {
  std::string bytes = ReadFileBytes(file);
  if (bytes.starts_with("{\\rtf")) {
    throw Error(file, "this is a rich-text document (RTF); save it as plain text");
  }
  return IsUtf16(bytes) ? Utf8FromBytes(bytes).text : bytes;
}

ViewTag ParseView(const std::string& text, const std::filesystem::path& name) {
  ViewReading reading = ReadPairs(text, name);
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  return reading.tag;
}

std::string ReadViewText(const std::filesystem::path& file) {
  std::string text = ReadTextFile(file);
  if (text.find('\0') == std::string::npos && !text.starts_with("<")) return text;
  const ImageKind kind = FindImageKind(file);
  throw Error(file,
              "this is " + kind.description +
                  " and no view file; expected text: x, y, z, i, j, k, "
                  "a and v, each with its value");
}

ViewTag ReadView(const std::filesystem::path& file) { return ParseView(ReadViewText(file), file); }

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

}  // namespace groundglass
