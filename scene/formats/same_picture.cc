// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/same_picture.h"

#include "scene/formats/view_io.h"

#include <fstream>
#include <ios>
#include <system_error>

namespace groundglass {

std::string SampleOf(const std::filesystem::path& file) {
  constexpr std::streamoff kSampleBytes = 16384;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return "";
  const auto length = static_cast<std::streamoff>(in.tellg());
  std::string sample = std::to_string(length) + ' ';
  std::string bytes(kSampleBytes, '\0');
  for (const std::streamoff at : {length / 3, 2 * length / 3}) {
    in.clear();
    in.seekg(at);
    in.read(bytes.data(), kSampleBytes);
    sample.append(bytes, 0, static_cast<size_t>(in.gcount()));
  }
  return sample;
}

bool IsSamePicture(const std::filesystem::path& file, const std::filesystem::path& other) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error || size != std::filesystem::file_size(other, error) || error) return false;
  const std::string sample = SampleOf(file);
  return !sample.empty() && sample == SampleOf(other) &&
         ReadFileBytes(file) == ReadFileBytes(other);
}

}  // namespace groundglass
