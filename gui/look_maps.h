// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "ask/survey_map.h"
#include "gui/look_map.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The maps of one model, made on a thread of their own when they are first asked for, and kept. To
// be used by one thread.
class LookMaps {
 public:
  // folder: the output folder, if it is one. All must outlive the object. on_done is called from
  // the thread after each map.
  LookMaps(const std::filesystem::path& folder,
           const TexturedModel& textured,
           const Survey& survey,
           const Visibility& visibility,
           std::function<void()> on_done);
  ~LookMaps();
  LookMaps(const LookMaps&) = delete;
  LookMaps& operator=(const LookMaps&) = delete;

  // The map; null while it is being made. Throws Error if it cannot be.
  std::shared_ptr<const ColouredModel> Find(LookMap map);
  // What was asked of the photographs, face by face; null before a map is there.
  const std::vector<FaceCells>* Cells() const;

 private:
  struct Asked {
    std::vector<FaceCells> cells;
    std::optional<TexelSources> texels;
    std::string fault;         // why there are no cells
    std::string texels_fault;  // why texels cannot be told, where pictures say whose they are
  };
  // Null if the object ended meanwhile.
  std::shared_ptr<const Asked> AskAll() const;
  std::shared_ptr<const ColouredModel> Colour(LookMap map, const Asked& asked) const;

  std::filesystem::path folder_;
  const TexturedModel& textured_;
  const Survey& survey_;
  const Visibility& visibility_;
  std::function<void()> on_done_;
  std::atomic<bool> is_ending_ = false;
  std::shared_future<std::shared_ptr<const Asked>> asked_;
  std::map<LookMap, std::shared_future<std::shared_ptr<const ColouredModel>>> maps_;
};

}  // namespace groundglass
