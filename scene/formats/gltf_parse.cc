// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_parse.h"

#include "scene/formats/gltf_accessor.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace groundglass {
namespace {

constexpr const char* kCopyAgain =
    "; copy it again from where it came from, or export it once more";

bool KeepImageBytes(tinygltf::Image* image,
                    const int,
                    std::string*,
                    std::string*,
                    int,
                    int,
                    const unsigned char* bytes,
                    int size,
                    void*) {
  image->as_is = true;
  image->image.assign(bytes, bytes + std::max(0, size));
  return true;
}

uint32_t ReadGlbNumber(std::string_view bytes, size_t at) {
  uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i) {
    number |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return number;
}

// The JSON of a GLB, its head found sound.
std::string_view JsonOfGlb(std::string_view bytes, const std::filesystem::path& file) {
  constexpr size_t kHead = 20;  // mark, version, length; length and kind of the first part
  const std::string size = std::to_string(bytes.size());
  if (bytes.size() < kHead) {
    FailGltf(file, "it is cut short after " + size + " bytes" + kCopyAgain);
  }
  const uint32_t version = ReadGlbNumber(bytes, 4);
  if (version == 1) FailGltf(file, "it is of glTF 1.0; export it as glTF 2.0");
  if (version != 2) {
    FailGltf(file,
             "its header names version " + std::to_string(version) +
                 " where 2 is expected: it is "
                 "damaged" +
                 kCopyAgain);
  }
  const uint32_t length = ReadGlbNumber(bytes, 8);
  if (length > bytes.size()) {
    FailGltf(file,
             "its header says " + std::to_string(length) + " bytes, but it has " + size +
                 ": it is cut short" + kCopyAgain);
  }
  const uint32_t json_length = ReadGlbNumber(bytes, 12);
  if (bytes.substr(16, 4) != "JSON" || json_length < 1 || json_length > bytes.size() - kHead) {
    FailGltf(file,
             "its first part is not the JSON of " + std::to_string(json_length) +
                 " bytes that its header says: it is damaged" + kCopyAgain);
  }
  return bytes.substr(kHead, json_length);
}

// A library's fault, or a plainer one where the JSON cannot be read at all.
std::string FaultOfGltf(std::string_view json, std::string fault) {
  std::string_view start = json;
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  if (TrimBlanks(start).empty() || start[start.find_first_not_of(" \t\r\n")] != '{') {
    return std::string(
               "it is no glTF, which begins with '{', and no GLB, which begins with "
               "'glTF'") +
           kCopyAgain;
  }
  try {
    [[maybe_unused]] const nlohmann::json parsed = nlohmann::json::parse(json);
  } catch (const nlohmann::json::exception& error) {
    return "its JSON is damaged or cut short (" + TellJsonFault(error.what()) + ")" + kCopyAgain;
  }
  std::replace(fault.begin(), fault.end(), '\n', ' ');
  return fault.empty() ? std::string("it is damaged") + kCopyAgain : fault;
}

}  // namespace

tinygltf::Model ParseGltf(const std::filesystem::path& file) {
  const std::string bytes = ReadTextFile(file);
  const bool is_binary = std::string_view(bytes).starts_with("glTF");  // whatever it is called
  const std::string_view json = is_binary ? JsonOfGlb(bytes, file) : std::string_view(bytes);
  tinygltf::Model gltf;
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(KeepImageBytes, nullptr);
  std::string faults;
  std::string warnings;
  bool is_read = false;
  try {
    is_read = is_binary ? parser.LoadBinaryFromFile(&gltf, &faults, &warnings, file.string())
                        : parser.LoadASCIIFromFile(&gltf, &faults, &warnings, file.string());
  } catch (const std::exception& exception) {
    faults = exception.what();
  }
  if (!is_read) FailGltf(file, FaultOfGltf(json, faults));
  return gltf;
}

}  // namespace groundglass
