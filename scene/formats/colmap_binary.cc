// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/colmap_records.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

// A file's numbers, one after the other, never beyond its end.
class ByteReader {
 public:
  explicit ByteReader(const fs::path& file) : file_(file), bytes_(ReadFileBytes(file)) {}

  template <typename T>
  T Read() {
    T value;
    std::memcpy(&value, Take(sizeof(T)), sizeof(T));
    return value;
  }
  // Up to a zero byte.
  std::string ReadName() {
    const size_t end = bytes_.find('\0', next_);
    if (end == std::string::npos) FailCut();
    std::string name = bytes_.substr(next_, end - next_);
    next_ = end + 1;
    return name;
  }
  void Skip(uint64_t count, size_t size) {
    if (count > (bytes_.size() - next_) / size) FailCut();
    next_ += count * size;
  }
  // How many records of at least this size follow.
  uint64_t ReadCount(size_t least_size) {
    const uint64_t count = Read<uint64_t>();
    if (count > (bytes_.size() - next_) / least_size) FailCut();
    return count;
  }
  void ExpectEnd() const {
    if (next_ == bytes_.size()) return;
    throw Error(file_,
                std::to_string(bytes_.size() - next_) +
                    " bytes follow the last record; not a file of COLMAP's, or damaged");
  }

 private:
  const char* Take(size_t size) {
    if (size > bytes_.size() - next_) FailCut();
    next_ += size;
    return bytes_.data() + next_ - size;
  }
  [[noreturn]] void FailCut() const {
    throw Error(file_,
                "ends in the middle of a record: the file is cut short (" +
                    std::to_string(bytes_.size()) + " bytes), or none of COLMAP's");
  }

  fs::path file_;
  std::string bytes_;
  size_t next_ = 0;
};

std::map<long long, ColmapCamera> ReadCamerasBin(const fs::path& file) {
  ByteReader reader(file);
  std::map<long long, ColmapCamera> cameras;
  const uint64_t count = reader.ReadCount(4 + 4 + 8 + 8);
  for (uint64_t i = 0; i < count; ++i) {
    const auto id = reader.Read<uint32_t>();
    const auto kind_id = reader.Read<int32_t>();
    const auto width = reader.Read<uint64_t>();
    const auto height = reader.Read<uint64_t>();
    const std::string place = file.string() + ": camera " + std::to_string(id);
    const ColmapCameraKind* kind = FindColmapCameraKind(kind_id);
    if (kind == nullptr) {
      // Without its number of parameters nothing after it can be read either.
      throw Error(
          UnreadColmapCamera("number " + std::to_string(kind_id), place, file.parent_path()).fault);
    }
    std::vector<double> parameters;
    for (int k = 0; k < kind->num_parameters; ++k) parameters.push_back(reader.Read<double>());
    constexpr uint64_t kLargest = 1ull << 40;  // any is too large
    ColmapCamera camera;
    try {
      camera = MakeColmapCamera(*kind,
                                static_cast<long long>(std::min(width, kLargest)),
                                static_cast<long long>(std::min(height, kLargest)),
                                parameters,
                                place,
                                file.parent_path());
    } catch (const Error& error) {
      camera.fault = error.what();  // of the images that use it
    }
    if (!cameras.emplace(id, std::move(camera)).second) throw Error(place + " is repeated");
  }
  reader.ExpectEnd();
  return cameras;
}

std::vector<ColmapImage> ReadImagesBin(const fs::path& file) {
  ByteReader reader(file);
  std::vector<ColmapImage> images;
  const uint64_t count = reader.ReadCount(4 + 7 * 8 + 4 + 1 + 8);
  for (uint64_t i = 0; i < count; ++i) {
    ColmapImage& image = images.emplace_back();
    image.place = file.string() + ": image " + std::to_string(reader.Read<uint32_t>());
    for (double& value : image.pose) {
      value = reader.Read<double>();
      if (!std::isfinite(value)) image.fault = image.place + ": its pose is not finite";
    }
    image.camera_id = reader.Read<uint32_t>();
    image.name = reader.ReadName();
    if (image.name.empty()) image.fault = image.place + " has no name";
    reader.Skip(reader.Read<uint64_t>(), 8 + 8 + 8);
  }
  reader.ExpectEnd();
  return images;
}

}  // namespace

ColmapRecords ReadColmapBinary(const fs::path& cameras_file, const fs::path& images_file) {
  return {ReadCamerasBin(cameras_file), ReadImagesBin(images_file), {}};
}

}  // namespace groundglass
