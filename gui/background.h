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

// Photographs, decoded on threads of their own: one for those that are asked for, of which the last
// few are kept whole, and one for small pictures of all of them, which gives way to all else.
class PhotographCache {
 public:
  PhotographCache(std::vector<std::filesystem::path> files, std::function<void()> on_done);
  ~PhotographCache();

  // The photograph, or null while it is not there yet; asks for it.
  std::shared_ptr<const Image8> Find(int photograph);
  // Why it cannot be read; empty if it can, or nobody knows yet.
  std::string FaultOf(int photograph) const;
  // While the hand moves something no further small picture is begun.
  void LetThumbnailsWait(bool do_wait);
  // Small pictures that have come since this was last asked.
  std::map<int, Image8> TakeThumbnails();
  // Whether somebody waits for a photograph.
  bool IsBusy() const;

 private:
  // What came of reading one.
  struct Read {
    Image8 picture;
    Image8 thumbnail;
    std::string fault;
  };
  static Read ReadOne(const std::filesystem::path& file);
  void ReadWanted();
  void MakeThumbnails();
  void Keep(int photograph, Read read, bool is_wanted);
  std::optional<int> NextThumbnail() const;

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
  bool do_thumbnails_wait_ = false;
  bool is_ending_ = false;
  std::thread wanted_thread_;
  std::thread thumbnail_thread_;
};

}  // namespace groundglass
