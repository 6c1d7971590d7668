// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/output_folder.h"

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/view_io.h"

#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

namespace groundglass {
namespace {

constexpr const char* kFileName = "manifest.json";
constexpr const char* kProgram = "groundglass";

}  // namespace

std::string FormatManifest(const Manifest& manifest) {
  const nlohmann::ordered_json json = {{"program", kProgram},
                                       {"version", manifest.version},
                                       {"command", manifest.command},
                                       {"seed", manifest.seed},
                                       {"options", manifest.options},
                                       {"sha256_of_inputs", manifest.sha256_of_inputs}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string HashFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be read");
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        EVP_MD_CTX_free);
  EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
  std::array<char, 1 << 16> buffer;
  while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0) {
    EVP_DigestUpdate(context.get(), buffer.data(), static_cast<size_t>(in.gcount()));
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned length = 0;
  EVP_DigestFinal_ex(context.get(), digest.data(), &length);
  std::string text;
  for (unsigned i = 0; i < length; ++i) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

void PrepareOutputFolder(const std::filesystem::path& folder) {
  std::error_code failure;
  if (std::filesystem::exists(folder, failure)) {
    if (!std::filesystem::is_directory(folder)) {
      throw Error(folder, "is a file; the output needs a folder");
    }
    if (!std::filesystem::is_empty(folder)) {
      const std::filesystem::path file = folder / kFileName;
      const bool is_ours = std::filesystem::exists(file) && [&] {
        const auto json = nlohmann::json::parse(ReadTextFile(file), nullptr, false);
        return json.is_object() && json.value("program", "") == kProgram;
      }();
      if (!is_ours) {
        throw Error(folder,
                    "holds files that are not ours (no manifest.json of groundglass); name an "
                    "empty or new folder");
      }
    }
    return;
  }
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error(folder, "cannot be made: " + failure.message());
}

bool HasManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  const std::filesystem::path file = folder / kFileName;
  return std::filesystem::exists(file) && ReadTextFile(file) == FormatManifest(manifest);
}

void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  WriteFileAtomically(folder / kFileName, FormatManifest(manifest));
}

}  // namespace groundglass
