// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/photo_cache.h"

#include "scene/formats/image_io.h"

#include <tbb/task_arena.h>

#include <cstdint>
#include <utility>

namespace groundglass {
namespace {

// One of the places for those who decode, held until the end of the scope.
class DecoderPlace {
 public:
  explicit DecoderPlace(std::counting_semaphore<kDecodedAtOnce>* places) : places_(places) {
    if (places_) places_->acquire();
  }
  ~DecoderPlace() {
    if (places_) places_->release();
  }
  DecoderPlace(const DecoderPlace&) = delete;
  DecoderPlace& operator=(const DecoderPlace&) = delete;

 private:
  std::counting_semaphore<kDecodedAtOnce>* places_;
};

}  // namespace

PhotoCache::PhotoCache(std::vector<std::filesystem::path> files, size_t max_bytes, int bits)
    : is_limited_(max_bytes != SIZE_MAX), max_bytes_(max_bytes), bits_(bits) {
  for (std::filesystem::path& file : files) {
    entries_.push_back(std::make_unique<Entry>());
    entries_.back()->file = std::move(file);
  }
}

std::shared_ptr<const PhotoPyramid> PhotoCache::Get(
    int photo, const std::function<void(const PhotoPyramid&)>& on_whole) {
  Entry& entry = *entries_[photo];
  const auto find = [&]() -> std::shared_ptr<const PhotoPyramid> {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (entry.pyramid) uses_.splice(uses_.begin(), uses_, entry.use);
    return entry.pyramid;
  };
  if (auto pyramid = find()) return pyramid;
  const std::lock_guard<std::mutex> decoding(entry.decoding);
  if (auto pyramid = find()) return pyramid;
  std::shared_ptr<PhotoPyramid> pyramid;
  const DecoderPlace place(is_limited_ ? &decoders_ : nullptr);
  // Isolated: this thread must not take up other work that waits for the same photograph.
  tbb::this_task_arena::isolate([&] {
    pyramid = bits_ == 16 ? std::make_shared<PhotoPyramid>(ReadSrgb16(entry.file))
                          : std::make_shared<PhotoPyramid>(ReadSrgb8(entry.file));
    if (on_whole) on_whole(*pyramid);
    pyramid->DropLevels(num_dropped_);
  });
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_decoded_;
  num_bytes_ += pyramid->NumBytes();
  DropOldest();
  uses_.push_front(photo);
  entry.use = uses_.begin();
  entry.pyramid = pyramid;
  return pyramid;
}

void PhotoCache::DropOldest() {
  while (num_bytes_ > max_bytes_ && !uses_.empty()) {
    Entry& oldest = *entries_[uses_.back()];
    num_bytes_ -= oldest.pyramid->NumBytes();
    oldest.pyramid.reset();
    uses_.pop_back();
  }
}

void PhotoCache::SetMaxBytes(size_t max_bytes) {
  const std::lock_guard<std::mutex> lock(mutex_);
  max_bytes_ = max_bytes;
  DropOldest();
}

void PhotoCache::SetNumDropped(int num_dropped) {
  const std::lock_guard<std::mutex> lock(mutex_);
  num_dropped_ = num_dropped;
}

size_t PhotoCache::num_bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return num_bytes_;
}

long PhotoCache::num_decoded() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return num_decoded_;
}

}  // namespace groundglass
