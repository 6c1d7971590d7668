// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/background.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/reduce.h"

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <utility>

namespace groundglass {
namespace {

// The calling thread gives way to the others, and is not starved by them.
void GiveWay() {
#ifdef __linux__
  // There 0 is the thread, and elsewhere the whole program.
  constexpr int kLessUrgent = 10;
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kLessUrgent);
#endif
}

}  // namespace

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
      wanted_thread_([this] { ReadWanted(); }),
      thumbnail_thread_([this] { MakeThumbnails(); }) {}

PhotographCache::~PhotographCache() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  wanted_thread_.join();
  thumbnail_thread_.join();
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

void PhotographCache::LetThumbnailsWait(bool do_wait) {
  {
    const std::lock_guard lock(mutex_);
    if (do_thumbnails_wait_ == do_wait) return;
    do_thumbnails_wait_ = do_wait;
  }
  wake_.notify_all();
}

PhotographCache::Read PhotographCache::ReadOne(const std::filesystem::path& file) {
  Read read;
  try {
    read.picture = ReadSrgb8(file);
    const int width = std::min(kThumbnailWidth, read.picture.width);
    const int height = std::max(1, read.picture.height * width / read.picture.width);
    read.thumbnail = ReducedInLight(read.picture, width, height);
  } catch (const std::exception& error) {
    read.fault = error.what();
  }
  return read;
}

void PhotographCache::Keep(int photograph, Read read, bool is_wanted) {
  {
    const std::lock_guard lock(mutex_);
    if (is_wanted) std::erase(wanted_, photograph);
    const bool is_first = !has_thumbnail_[photograph];
    has_thumbnail_[photograph] = true;
    if (!read.fault.empty()) {
      faults_[photograph] = read.fault;
    } else {
      if (is_first) thumbnails_[photograph] = std::move(read.thumbnail);
      if (is_wanted) {
        whole_[photograph] = std::make_shared<const Image8>(std::move(read.picture));
        order_.push_back(photograph);
      }
    }
    while (order_.size() > kMostWhole) {
      whole_.erase(order_.front());
      order_.erase(order_.begin());
    }
  }
  wake_.notify_all();  // small pictures wait for those that somebody asked for
  on_done_();
}

void PhotographCache::ReadWanted() {
  for (;;) {
    int photograph = 0;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return is_ending_ || !wanted_.empty(); });
      if (is_ending_) return;
      photograph = wanted_.front();
    }
    Keep(photograph, ReadOne(files_[photograph]), true);
  }
}

std::optional<int> PhotographCache::NextThumbnail() const {
  if (do_thumbnails_wait_ || !wanted_.empty()) return std::nullopt;
  const auto without = std::find(has_thumbnail_.begin(), has_thumbnail_.end(), false);
  if (without == has_thumbnail_.end()) return std::nullopt;
  return static_cast<int>(without - has_thumbnail_.begin());
}

void PhotographCache::MakeThumbnails() {
  GiveWay();
  for (;;) {
    int photograph = 0;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return is_ending_ || NextThumbnail(); });
      if (is_ending_) return;
      photograph = *NextThumbnail();
    }
    Keep(photograph, ReadOne(files_[photograph]), false);
  }
}

}  // namespace groundglass
