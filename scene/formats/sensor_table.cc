// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/sensor_table.h"

#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct Sensor {
  std::string maker;  // in lower case
  double crop_factor = 0;
};
using SensorsOfModel = std::multimap<std::string, Sensor>;  // by model in lower case

// The texts of the elements of this name, in order.
std::vector<std::string> ElementsOf(std::string_view xml, const std::string& name) {
  std::vector<std::string> texts;
  for (size_t at = xml.find("<" + name); at != std::string_view::npos;
       at = xml.find("<" + name, at + 1)) {
    const size_t after_name = at + 1 + name.size();
    if (after_name >= xml.size() || (xml[after_name] != '>' && xml[after_name] != ' ')) continue;
    const size_t begin = xml.find('>', after_name);
    const size_t end = xml.find("</" + name + ">", after_name);
    if (begin == std::string_view::npos || end == std::string_view::npos) break;
    texts.emplace_back(xml.substr(begin + 1, end - begin - 1));
  }
  return texts;
}

std::string PlainLowerCase(std::string text) {
  for (size_t at = text.find("&amp;"); at != std::string::npos; at = text.find("&amp;")) {
    text.replace(at, 5, "&");
  }
  return LowerCase(TrimBlanks(text));
}

void ReadCameras(const fs::path& file, SensorsOfModel& sensors) {
  for (const std::string& camera : ElementsOf(ReadFileBytes(file), "camera")) {
    const std::vector<std::string> makers = ElementsOf(camera, "maker");
    const std::vector<std::string> factors = ElementsOf(camera, "cropfactor");
    if (makers.empty() || factors.empty()) continue;
    const std::optional<double> factor = ParseNumber(TrimBlanks(factors.front()));
    if (!factor || !(*factor > 0.1 && *factor < 20)) continue;
    for (const std::string& model : ElementsOf(camera, "model")) {
      sensors.emplace(PlainLowerCase(model), Sensor{PlainLowerCase(makers.front()), *factor});
    }
  }
}

// The newest table's files, in order: folders version_1, version_2.
std::vector<fs::path> TableFiles(const fs::path& folder) {
  std::error_code ignored;
  fs::path newest;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const bool is_table =
        entry.is_directory() && entry.path().filename().string().starts_with("version_");
    if (is_table && entry.path() > newest) newest = entry.path();
  }
  std::vector<fs::path> files;
  if (newest.empty()) return files;
  for (const auto& entry : fs::directory_iterator(newest, ignored)) {
    if (entry.path().extension() == ".xml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Each folder's tables are read once, when a photograph first asks for them.
const SensorsOfModel& SensorsIn(const fs::path& folder) {
  static std::mutex mutex;
  static std::map<fs::path, SensorsOfModel> tables;
  const std::lock_guard lock(mutex);
  const auto [table, is_new] = tables.try_emplace(folder);
  if (is_new) {
    for (const fs::path& file : TableFiles(folder)) ReadCameras(file, table->second);
  }
  return table->second;
}

std::string FirstWord(const std::string& text) { return text.substr(0, text.find(' ')); }

}  // namespace

std::optional<double> FindCropFactor(const std::string& maker,
                                     const std::string& model,
                                     const fs::path& folder) {
  if (model.empty()) return std::nullopt;
  const auto [begin, end] = SensorsIn(folder).equal_range(LowerCase(model));
  for (auto sensor = begin; sensor != end; ++sensor) {
    // NIKON CORPORATION, Nikon Corporation and Nikon are one.
    if (maker.empty() || FirstWord(sensor->second.maker) == FirstWord(LowerCase(maker))) {
      return sensor->second.crop_factor;
    }
  }
  return std::nullopt;
}

bool HasSensorTables(const fs::path& folder) { return !SensorsIn(folder).empty(); }

}  // namespace groundglass
