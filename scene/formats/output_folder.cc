// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/output_folder.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/input_folders.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <optional>

namespace groundglass {
namespace {

constexpr const char* kFileName = "manifest.json";
constexpr const char* kProgram = "groundglass";

// SHA-256 of what is added, piece by piece.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void Add(const char* bytes, size_t size) { EVP_DigestUpdate(context_.get(), bytes, size); }
  std::string Finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned length = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &length);
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
      constexpr const char* kDigits = "0123456789abcdef";
      text += kDigits[digest[i] >> 4];
      text += kDigits[digest[i] & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

Manifest ManifestFromJson(const nlohmann::json& json) {
  Manifest manifest;
  using Texts = std::map<std::string, std::string>;
  manifest.version = json.value("version", std::string());
  manifest.command = json.value("command", std::string());
  manifest.seed = json.value("seed", uint64_t{0});
  manifest.options = json.value("options", Texts());
  manifest.sha256_of_inputs = json.value("sha256_of_inputs", Texts());
  for (const auto& stage : json.at("stages")) {
    manifest.stages.push_back(
        {stage.at("name").get<std::string>(),
         stage.at("key").get<std::string>(),
         stage.at("is_complete").get<bool>(),
         stage.at("files").get<std::vector<std::string>>(),
         // Earlier versions did not write them down.
         stage.value("sha256_of_files", std::map<std::string, std::string>())});
  }
  return manifest;
}

struct ManifestText {
  bool is_ours = false;
  bool is_damaged = false;           // no JSON, so that it does not say whose it is
  std::optional<Manifest> manifest;  // nothing if it cannot be understood
};

ManifestText ParseManifest(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  // One that is cut short or garbled further on still begins as we write it.
  if (json.is_discarded()) {
    return {text.find("\"program\": \"" + std::string(kProgram)) < 100, true, std::nullopt};
  }
  if (!json.is_object() || !json.contains("program") || json["program"] != kProgram) return {};
  try {
    return {true, false, ManifestFromJson(json)};
  } catch (const nlohmann::json::exception&) {
    // Written by hand, or by an earlier version: nothing of it can be kept.
    return {true, false, std::nullopt};
  }
}

// A power cut may leave a manifest of zeros; what registration wrote beside it tells whose it was.
bool HasRegistration(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "registration.json";
  if (!std::filesystem::exists(file)) return false;
  const auto json = nlohmann::json::parse(ReadTextFile(file), nullptr, false);
  return json.is_object() && json.contains("photographs");
}

}  // namespace

std::string FormatManifest(const Manifest& manifest) {
  nlohmann::ordered_json json = {{"program", kProgram},
                                 {"version", manifest.version},
                                 {"command", manifest.command},
                                 {"seed", manifest.seed},
                                 {"options", manifest.options},
                                 {"sha256_of_inputs", manifest.sha256_of_inputs},
                                 {"stages", nlohmann::ordered_json::array()}};
  for (const StageRecord& stage : manifest.stages) {
    json["stages"].push_back({{"name", stage.name},
                              {"key", stage.key},
                              {"is_complete", stage.is_complete},
                              {"files", stage.files},
                              {"sha256_of_files", stage.sha256_of_files}});
  }
  // File names may be of any bytes.
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string HashFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be read");
  Sha256 sha;
  std::array<char, 1 << 16> buffer;
  while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0) {
    sha.Add(buffer.data(), static_cast<size_t>(in.gcount()));
  }
  return sha.Finish();
}

std::string HashText(const std::string& text) {
  Sha256 sha;
  sha.Add(text.data(), text.size());
  return sha.Finish();
}

FolderLock PrepareOutputFolder(const std::filesystem::path& folder) {
  RefuseAmongInputs(folder);
  std::error_code failure;
  if (std::filesystem::exists(folder, failure) && !std::filesystem::is_directory(folder)) {
    throw Error(folder, "is a file; the output needs a folder");
  }
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error(folder, "cannot be made: " + failure.message());
  FolderLock lock(folder);
  if (std::filesystem::is_empty(folder)) return lock;
  if (!ReadManifest(folder)) {
    if (IsManifestDamaged(folder)) {
      throw Error(folder / kFileName,
                  "is damaged or not ours, so that nobody knows whose the files beside it "
                  "are; name an empty or new folder, or remove that one if it is groundglass's");
    }
    throw Error(folder,
                "holds files that are not ours (no manifest.json of groundglass); name an "
                "empty or new folder");
  }
  // What a run that was killed was writing.
  std::vector<std::filesystem::path> left_over;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (IsTemporaryName(entry.path())) left_over.push_back(entry.path());
  }
  for (const std::filesystem::path& part : left_over) std::filesystem::remove(part, failure);
  return lock;
}

std::optional<Manifest> ReadManifest(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kFileName;
  if (!std::filesystem::exists(file)) return std::nullopt;
  ManifestText text = ParseManifest(ReadTextFile(file));
  text.is_ours = text.is_ours || (text.is_damaged && HasRegistration(folder));
  return text.is_ours ? std::optional(text.manifest.value_or(Manifest())) : std::nullopt;
}

bool IsManifestDamaged(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kFileName;
  return std::filesystem::exists(file) && !ParseManifest(ReadTextFile(file)).manifest;
}

bool IsOutputFolder(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "registration.json") || ReadManifest(folder).has_value();
}

std::vector<std::string> NumberedPhotographs(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "faces", error)) {
    if (entry.path().extension() == ".png") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  WriteFileAtomically(folder / kFileName, FormatManifest(manifest));
}

}  // namespace groundglass
