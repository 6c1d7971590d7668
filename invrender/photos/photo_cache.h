// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/photos/photo_pyramid.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <semaphore>
#include <vector>

namespace groundglass {

constexpr int kDecodedAtOnce = 2;

// Decoded photographs, no more of them than fit into `max_bytes`; those that were not used for the
// longest go first, and come back from their files when they are asked for. One that somebody
// still holds stays in memory until it is let go. Safe to use from many threads; where there is a
// limit, kDecodedAtOnce at most are being decoded.
class PhotoCache {
 public:
  // max_bytes: SIZE_MAX for no limit; bits: 8 or 16, of the decoded photographs' channels.
  PhotoCache(std::vector<std::filesystem::path> files, size_t max_bytes, int bits = 8);

  // Throws Error for a file that cannot be read. on_whole gets the photograph with all its levels
  // if it is decoded now.
  std::shared_ptr<const PhotoPyramid> Get(
      int photo, const std::function<void(const PhotoPyramid&)>& on_whole = {});

  void SetMaxBytes(size_t max_bytes);
  // Photographs that are decoded from now on do without their finest levels.
  void SetNumDropped(int num_dropped);

  int bits() const { return bits_; }
  size_t num_bytes() const;
  long num_decoded() const;

 private:
  void DropOldest();  // until the limit holds; mutex_ is locked

  struct Entry {
    std::filesystem::path file;
    std::mutex decoding;
    std::shared_ptr<const PhotoPyramid> pyramid;  // guarded by mutex_
    std::list<int>::iterator use;                 // in uses_, if there is a pyramid
  };

  std::counting_semaphore<kDecodedAtOnce> decoders_{kDecodedAtOnce};
  mutable std::mutex mutex_;
  const bool is_limited_;
  size_t max_bytes_;
  const int bits_;
  int num_dropped_ = 0;
  size_t num_bytes_ = 0;
  long num_decoded_ = 0;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::list<int> uses_;  // latest first
};

}  // namespace groundglass
