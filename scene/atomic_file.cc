// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/atomic_file.h"

#include "scene/error.h"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <system_error>

namespace groundglass {
namespace {

// A name beside the file that no other process or thread uses; hidden, and with the file's own
// extension, by which writers choose their format.
std::filesystem::path TemporaryName(const std::filesystem::path& file) {
  static std::atomic<unsigned> counter{0};
  std::string name = ".";
  name += file.stem().string() + ".part" + std::to_string(getpid());
  name += "-" + std::to_string(counter++) + file.extension().string();
  return file.parent_path() / name;
}

}  // namespace

void WriteFileAtomically(const std::filesystem::path& file,
                         const std::function<void(const std::filesystem::path&)>& write) {
  std::error_code error;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) {
      throw Error(file.parent_path(), "cannot make this folder: " + error.message());
    }
  }
  const std::filesystem::path temporary = TemporaryName(file);
  try {
    write(temporary);
    std::filesystem::rename(temporary, file, error);
    if (error) throw Error(file, "cannot write here: " + error.message());
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
}

void WriteFileAtomically(const std::filesystem::path& file, const std::string& bytes) {
  WriteFileAtomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw Error(file, "cannot write this file (folder missing, disk full or read-only)");
  });
}

}  // namespace groundglass
