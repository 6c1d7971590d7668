// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/atomic_file.h"

#include "scene/error.h"
#include "scene/formats/unfinished_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <list>
#include <system_error>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// A name beside the file that no other process or thread uses; hidden, and with the file's own
// extension, by which writers choose their format.
fs::path TemporaryName(const fs::path& file) {
  static std::atomic<unsigned> counter{0};
  std::string name = ".";
  name += file.stem().string() + ".part" + std::to_string(getpid());
  name += "-" + std::to_string(counter++) + file.extension().string();
  return file.parent_path() / name;
}

[[noreturn]] void Fail(const fs::path& file, int error) {
  const bool is_full = error == ENOSPC || error == EDQUOT;
  throw Error(file,
              std::string("cannot write this file: ") + std::strerror(error) +
                  (is_full ? "; free some space, then run again" : ""));
}

// What a system call answers once no signal interrupts it.
template <typename Call>
auto Uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

// A file that is being written. `name` is what messages call it.
class Descriptor {
 public:
  Descriptor(const fs::path& name, const fs::path& file, int flags)
      : name_(name),
        descriptor_(Uninterrupted([&] { return open(file.c_str(), flags | O_CLOEXEC, 0666); })) {
    if (descriptor_ < 0) Fail(name_, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }

  void Write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written =
          Uninterrupted([&] { return write(descriptor_, bytes.data(), bytes.size()); });
      if (written < 0) Fail(name_, errno);
      bytes.remove_prefix(static_cast<size_t>(written));
    }
  }

  // Some file systems find out only now that there is no room.
  void Finish() {
    // EINVAL, ENOTSUP: what cannot be synchronised has no disk that could be full.
    if (Uninterrupted([&] { return fsync(descriptor_); }) < 0 && errno != EINVAL &&
        errno != ENOTSUP) {
      Fail(name_, errno);
    }
    if (close(std::exchange(descriptor_, -1)) < 0 && errno != EINTR) Fail(name_, errno);
  }

 private:
  fs::path name_;
  int descriptor_;
};

void MakeFolderOf(const fs::path& file) {
  if (!file.has_parent_path()) return;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw Error(file.parent_path(), "cannot make this folder: " + error.message());
}

template <typename Write>
void WriteBesideAndRename(const fs::path& file, const Write& write) {
  std::error_code error;
  MakeFolderOf(file);
  const fs::path temporary = TemporaryName(file);
  const UnfinishedFile unfinished(temporary);
  try {
    write(temporary);
    fs::rename(temporary, file, error);
    if (error) throw Error(file, "cannot write here: " + error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

}  // namespace

// ".NAME.partPROCESS-COUNT", and perhaps an extension.
bool IsTemporaryName(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view kPart = ".part";
  const size_t part = name.rfind(kPart);
  if (name.empty() || name[0] != '.' || part == std::string::npos || part == 0) return false;
  size_t at = part + kPart.size();
  const auto skip_digits = [&] {
    const size_t first = at;
    while (at < name.size() && name[at] >= '0' && name[at] <= '9') ++at;
    return at > first;
  };
  if (!skip_digits() || at == name.size() || name[at++] != '-' || !skip_digits()) return false;
  return at == name.size() || (name[at] == '.' && name.find('.', at + 1) == std::string::npos);
}

void RequireOtherFile(const fs::path& input, const fs::path& output) {
  std::error_code error;
  if (!fs::equivalent(input, output, error) || error) return;
  throw Error(output, "would be written over the input itself; give another name");
}

void WriteFileAtomically(const fs::path& file, std::string_view bytes) {
  StreamFileAtomically(file, [&](const ByteSink& append) { append(bytes); });
}

void WriteFilesAtomically(const std::vector<FileToWrite>& files) {
  std::vector<fs::path> temporary_names;
  std::list<UnfinishedFile> unfinished;
  std::error_code error;
  try {
    for (const FileToWrite& each : files) {
      MakeFolderOf(each.file);
      // What cannot be replaced is found before the first one is.
      if (fs::is_directory(each.file, error)) {
        throw Error(each.file, "cannot write here: a folder has this name");
      }
      temporary_names.push_back(TemporaryName(each.file));
      unfinished.emplace_back(temporary_names.back());
      Descriptor out(each.file, temporary_names.back(), O_WRONLY | O_CREAT | O_TRUNC);
      out.Write(each.bytes);
      out.Finish();
    }
    for (size_t i = 0; i < files.size(); ++i) {
      fs::rename(temporary_names[i], files[i].file, error);
      if (error) throw Error(files[i].file, "cannot write here: " + error.message());
    }
  } catch (...) {
    for (const fs::path& temporary : temporary_names) fs::remove(temporary, error);
    throw;
  }
}

void StreamFileAtomically(const fs::path& file,
                          const std::function<void(const ByteSink& append)>& write) {
  WriteBesideAndRename(file, [&](const fs::path& temporary) {
    Descriptor out(file, temporary, O_WRONLY | O_CREAT | O_TRUNC);
    write([&](std::string_view bytes) { out.Write(bytes); });
    out.Finish();
  });
}

void WriteFileAtomically(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  WriteBesideAndRename(file, [&](const fs::path& temporary) {
    write(temporary);
    // On the disk before it takes the other's place.
    Descriptor(file, temporary, O_WRONLY).Finish();
  });
}

}  // namespace groundglass
