// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/background.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/reduce.h"

#include <algorithm>

namespace groundglass {

PictureWorker::PictureWorker(const TexturedModel& model, std::function<void()> on_done)
    : on_done_(std::move(on_done)), thread_([this, &model] { Run(model); }) {}

PictureWorker::~PictureWorker() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void PictureWorker::Post(PictureRequest request) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(request);
  }
  wake_.notify_all();
}

std::optional<Picture> PictureWorker::Take() {
  const std::lock_guard lock(mutex_);
  std::optional<Picture> taken;
  taken.swap(done_);
  return taken;
}

bool PictureWorker::IsBusy() const {
  const std::lock_guard lock(mutex_);
  return fault_.empty() && (is_drawing_ || next_ || done_);
}

std::string PictureWorker::Fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void PictureWorker::Run(const TexturedModel& model) {
  try {
    PictureMaker maker(model);
    for (;;) {
      PictureRequest request;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return is_ending_ || next_; });
        if (is_ending_) return;
        request = std::move(*next_);
        next_.reset();
        is_drawing_ = true;
      }
      // One that cannot be drawn does not end the others.
      std::optional<Picture> picture;
      std::string fault;
      try {
        picture = maker.Make(request);
      } catch (const std::exception& error) {
        fault = error.what();
      }
      {
        const std::lock_guard lock(mutex_);
        if (picture) done_ = std::move(picture);
        fault_ = fault;
        is_drawing_ = false;
      }
      on_done_();
    }
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    fault_ = error.what();
    is_drawing_ = false;
  }
  on_done_();
}

PhotographCache::PhotographCache(std::vector<std::filesystem::path> files,
                                 std::function<void()> on_done)
    : files_(std::move(files)),
      on_done_(std::move(on_done)),
      has_thumbnail_(files_.size(), false),
      thread_([this] { Run(); }) {}

PhotographCache::~PhotographCache() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::shared_ptr<const Image8> PhotographCache::Find(int photograph) {
  std::shared_ptr<const Image8> found;
  {
    const std::lock_guard lock(mutex_);
    if (const auto whole = whole_.find(photograph); whole != whole_.end()) return whole->second;
    if (faults_.count(photograph) > 0) return nullptr;
    std::erase(wanted_, photograph);
    wanted_.insert(wanted_.begin(), photograph);
  }
  wake_.notify_all();
  return nullptr;
}

std::string PhotographCache::FaultOf(int photograph) const {
  const std::lock_guard lock(mutex_);
  const auto fault = faults_.find(photograph);
  return fault == faults_.end() ? "" : fault->second;
}

std::map<int, Image8> PhotographCache::TakeThumbnails() {
  const std::lock_guard lock(mutex_);
  std::map<int, Image8> taken;
  taken.swap(thumbnails_);
  return taken;
}

bool PhotographCache::IsBusy() const {
  const std::lock_guard lock(mutex_);
  return !wanted_.empty();
}

std::optional<int> PhotographCache::NextToRead() const {
  if (!wanted_.empty()) return wanted_.front();
  const auto without = std::find(has_thumbnail_.begin(), has_thumbnail_.end(), false);
  if (without == has_thumbnail_.end()) return std::nullopt;
  return static_cast<int>(without - has_thumbnail_.begin());
}

void PhotographCache::Run() {
  for (;;) {
    int photograph = 0;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return is_ending_ || NextToRead(); });
      if (is_ending_) return;
      photograph = *NextToRead();
    }
    Image8 picture;
    Image8 thumbnail;
    std::string fault;
    try {
      picture = ReadSrgb8(files_[photograph]);
      const int width = std::min(kThumbnailWidth, picture.width);
      const int height = std::max(1, picture.height * width / picture.width);
      thumbnail = ReducedInLight(picture, width, height);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    {
      const std::lock_guard lock(mutex_);
      const bool was_wanted = std::erase(wanted_, photograph) > 0;
      has_thumbnail_[photograph] = true;
      if (!fault.empty()) {
        faults_[photograph] = fault;
      } else {
        thumbnails_[photograph] = std::move(thumbnail);
        if (was_wanted) {
          whole_[photograph] = std::make_shared<const Image8>(std::move(picture));
          order_.push_back(photograph);
        }
      }
      while (order_.size() > kMostWhole) {
        whole_.erase(order_.front());
        order_.erase(order_.begin());
      }
    }
    on_done_();
  }
}

}  // namespace groundglass
