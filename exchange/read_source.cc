// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/camera_exchange.h"
#include "exchange/formats.h"
#include "scene/camera_check.h"
#include "scene/error.h"
#include "scene/formats/convert.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/model_io.h"
#include "scene/formats/model_kind.h"
#include "scene/formats/registration_io.h"
#include "scene/text.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// Unit, place on Earth and the file that other programs take.
void TakeModel(const fs::path& folder, ExchangeSource& source) {
  for (const char* name : {"model.obj", "model.glb"}) {
    if (!fs::exists(folder / name)) continue;
    const PolygonModel model = ReadModel(folder / name).model;
    source.unit = model.unit;
    source.georeference = model.georeference;
    source.model_file = folder / name;
    return;
  }
}

void AddWarnings(const std::vector<std::string>& warnings, ExchangeSource& source) {
  source.warnings.insert(source.warnings.end(), warnings.begin(), warnings.end());
}

void TakeColmap(const ColmapFiles& files, ExchangeSource& source) {
  const ColmapReading reading = ReadColmapImages(files);
  source.files = {files.cameras_file, files.images_file};
  source.cameras = reading.cameras;
  AddWarnings(files.warnings, source);
  AddWarnings(TellColmapFaults(reading.faults), source);
}

// Files of formats that keep one camera in each, in the order in which people count.
std::vector<fs::path> ListCameraFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const CameraFormat* format = FindCameraReader(entry.path());
    if (format && format->is_folder && entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

// Those that can be cameras; the others are told.
void TakeForeign(const std::vector<ForeignCamera>& cameras, ExchangeSource& source) {
  std::vector<ColmapFault> faults;
  for (const ForeignCamera& foreign : cameras) {
    std::string fault = foreign.fault;
    if (fault.empty()) {
      fault = FindCameraFault(foreign.named.camera);
      if (!fault.empty()) fault = foreign.place + ": " + fault;
    }
    if (fault.empty()) {
      source.cameras.push_back(foreign.named);
    } else {
      faults.push_back({foreign.named.name, fault});
    }
  }
  if (source.cameras.empty()) throw Error(faults.front().text);
  AddWarnings(TellColmapFaults(faults), source);
}

// Other programs' names of pictures become paths below the folder that holds them, where one of its
// pictures is meant.
void FindPictures(ExchangeSource& source) {
  const std::vector<std::string> paths = ListImagePaths(source.images);
  const ImagePathFinder finder(paths);
  for (NamedCamera& named : source.cameras) {
    if (fs::is_regular_file(source.images / named.name)) continue;
    if (const auto found = finder.Find(named.name)) named.name = paths[*found];
  }
}

void TakeFiles(const std::vector<fs::path>& files, const fs::path& images, ExchangeSource& source) {
  std::vector<ForeignCamera> cameras;
  for (const fs::path& file : files) {
    for (ForeignCamera& camera : FindCameraReader(file)->read(file)) {
      cameras.push_back(std::move(camera));
    }
  }
  source.files = files;
  TakeForeign(cameras, source);
  // Pictures are named as seen from the file.
  if (images.empty()) source.images = files.front().parent_path();
}

// A rejected photograph's camera is the tag that was found wanting.
void LeaveOutRejected(ExchangeSource& source) {
  std::vector<std::string> images;
  for (const NamedCamera& named : source.cameras) images.push_back(named.name);
  const std::vector<std::string> names = NamePhotographs(images);
  std::vector<NamedCamera> kept;
  std::string rejected;
  for (size_t i = 0; i < names.size(); ++i) {
    const bool is_rejected = std::any_of(source.registrations.begin(),
                                         source.registrations.end(),
                                         [&](const Registration& registration) {
                                           return registration.name == names[i] &&
                                                  registration.verdict == Verdict::kRejected;
                                         });
    if (is_rejected) {
      rejected += (rejected.empty() ? "" : ", ") + names[i];
    } else {
      kept.push_back(source.cameras[i]);
    }
  }
  if (rejected.empty()) return;
  source.cameras = std::move(kept);
  const std::string message = "left out, since their photographs are rejected: " + rejected +
                              "; their tags as written are in views/";
  if (source.cameras.empty()) throw Error("no camera is left: " + message);
  source.warnings.push_back(message);
}

bool HasFoundCameras(const fs::path& folder) {
  return fs::exists(folder / "registration.json") && fs::exists(folder / "cameras");
}

}  // namespace

bool HasExchangeCameras(const fs::path& input) {
  if (fs::is_regular_file(input)) return FindCameraReader(input) != nullptr;
  return fs::is_directory(input) && (HasFoundCameras(input) || !ListCameraFiles(input).empty());
}

namespace {

// Two cameras of one picture would be written over one another.
void LeaveOutRepeated(const fs::path& input, ExchangeSource& source) {
  std::set<std::string> seen;
  std::vector<NamedCamera> kept;
  std::string repeated;
  for (NamedCamera& named : source.cameras) {
    const std::string path = fs::path(named.name).lexically_normal().generic_string();
    if (seen.insert(path).second) {
      kept.push_back(std::move(named));
    } else {
      repeated += (repeated.empty() ? "" : ", ") + Quote(named.name);
    }
  }
  source.cameras = std::move(kept);
  if (repeated.empty()) return;
  source.warnings.push_back(Error(input,
                                  "pictures that have more than one camera: " + repeated +
                                      "; the first of each is taken, the others are left out")
                                .what());
}

ExchangeSource ReadSource(const fs::path& input, const fs::path& images) {
  ExchangeSource source;
  source.images = images;
  if (fs::is_regular_file(input) && FindCameraReader(input)) {
    CheckModelKind(input);  // models have the same endings (CityJSON's .json, CityGML's .xml)
    TakeFiles({input}, images, source);
    // Without --images its folder may be anything, a disk's root too, and is not searched.
    if (!images.empty()) FindPictures(source);
    return source;
  }
  if (!fs::is_directory(input)) {
    throw Error(input,
                fs::exists(input)
                    ? "is no folder of cameras, and none of the files with cameras that are read: "
                      "transforms.json, .fspy, .mlp, Metashape's .xml"
                    : "no such file or folder");
  }
  if (HasFoundCameras(input)) {
    source.registrations = ReadRegistrations(input / "registration.json");
    TakeColmap(*FindColmapModel(input / "cameras"), source);
    LeaveOutRejected(source);
    TakeModel(input, source);
    return source;
  }
  if (const auto files = FindColmapModel(input)) {
    TakeColmap(*files, source);
    return source;
  }
  if (const auto files = ListCameraFiles(input); !files.empty()) {
    TakeFiles(files, images, source);
    FindPictures(source);
    return source;
  }
  ViewCameras views = ReadViewCameras(input, images);
  source.cameras = std::move(views.cameras);
  source.images = std::move(views.images);
  source.warnings = std::move(views.warnings);
  return source;
}

}  // namespace

ExchangeSource ReadExchangeSource(const fs::path& input, const fs::path& images) {
  ExchangeSource source = ReadSource(input, images);
  LeaveOutRepeated(input, source);
  return source;
}

}  // namespace groundglass
