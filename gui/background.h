// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "gui/picture.h"
#include "scene/image.h"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace groundglass {

// Draws pictures on a thread of its own, always the newest request; the window never waits.
class PictureWorker {
 public:
  // on_done is called from the worker's thread after each picture. model must outlive the object.
  PictureWorker(const TexturedModel& model, std::function<void()> on_done);
  ~PictureWorker();

  void Post(PictureRequest request);
  // The newest picture that was not taken yet.
  std::optional<Picture> Take();
  bool IsBusy() const;
  // Why nothing can be drawn any more; empty while it can.
  std::string Fault() const;

 private:
  void Run(const TexturedModel& model);

  std::function<void()> on_done_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<PictureRequest> next_;
  std::optional<Picture> done_;
  bool is_drawing_ = false;
  bool is_ending_ = false;
  std::string fault_;
  std::thread thread_;
};

// Photographs, decoded on a thread of its own: those that are asked for first, then small pictures
// of all of them. Keeps the last few whole.
class PhotographCache {
 public:
  PhotographCache(std::vector<std::filesystem::path> files, std::function<void()> on_done);
  ~PhotographCache();

  // The photograph, or null while it is not there yet; asks for it.
  std::shared_ptr<const Image8> Find(int photograph);
  // Why it cannot be read; empty if it can, or nobody knows yet.
  std::string FaultOf(int photograph) const;
  // Small pictures that have come since this was last asked.
  std::map<int, Image8> TakeThumbnails();
  // Whether somebody waits for a photograph.
  bool IsBusy() const;

 private:
  void Run();
  std::optional<int> NextToRead() const;

  static constexpr size_t kMostWhole = 6;
  static constexpr int kThumbnailWidth = 160;

  const std::vector<std::filesystem::path> files_;
  std::function<void()> on_done_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<int> wanted_;  // the last one first
  std::map<int, std::shared_ptr<const Image8>> whole_;
  std::vector<int> order_;  // of whole_, oldest first
  std::map<int, std::string> faults_;
  std::vector<bool> has_thumbnail_;
  std::map<int, Image8> thumbnails_;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace groundglass
