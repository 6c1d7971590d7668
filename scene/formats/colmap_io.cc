// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/colmap_io.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/colmap_records.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::string FormatQuaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  return FormatNumber(q.w()) + " " + FormatNumber(q.x()) + " " + FormatNumber(q.y()) + " " +
         FormatNumber(q.z());
}

// A quaternion whose length is off by more than this is none, however few digits it was written
// with.
constexpr double kLengthTolerance = 0.01;

double Length(const double* values, int count) {
  return Eigen::Map<const Eigen::VectorXd>(values, count).norm();
}

Eigen::Quaterniond RotationOf(const ColmapImage& image) {
  const double length = Length(image.pose.data(), 4);
  if (!(length > 1e-6)) throw Error(image.place + ": the quaternion is zero");
  if (std::abs(length - 1) > kLengthTolerance) {
    const bool is_swapped = std::abs(Length(image.pose.data() + 3, 4) - 1) <= kLengthTolerance;
    throw Error(image.place + ": the quaternion QW QX QY QZ has length " +
                FormatNumber(std::round(1000 * length) / 1000) + ", not 1; columns swapped? " +
                (is_swapped ? "TX TY TZ seem to stand before it. " : "") +
                "COLMAP's order is IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
  }
  return Eigen::Quaterniond(image.pose[0], image.pose[1], image.pose[2], image.pose[3])
      .normalized();
}

// The model of this very folder.
std::optional<ColmapFiles> FindHere(const fs::path& folder) {
  const auto exists = [&](const char* name) {
    std::error_code error;
    return fs::is_regular_file(folder / name, error);
  };
  const bool has_text = exists("images.txt");
  const bool has_binary = exists("images.bin");
  if (!has_text && !has_binary) return std::nullopt;
  const std::string extension =
      has_text && (exists("cameras.txt") || !has_binary) ? ".txt" : ".bin";
  ColmapFiles files = {folder / ("cameras" + extension), folder / ("images" + extension), {}};
  if (!exists(("cameras" + extension).c_str())) {
    throw Error(folder, "has images" + extension + " but no cameras" + extension + " beside it");
  }
  if (has_text && has_binary) {
    files.warnings.push_back(
        Error(folder, "holds a COLMAP model as text and as binary; images" + extension + " is read")
            .what());
  }
  return files;
}

// Of folders 0, 1, 2, ... which COLMAP's mapper makes, one for each part that hangs together.
std::optional<ColmapFiles> FindNumbered(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<long long> number = ParseInteger(entry->path().filename().string());
    if (number && *number >= 0 && FindHere(entry->path())) found.push_back(entry->path());
  }
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) {
    std::sort(found.begin(), found.end());
    throw Error(folder,
                "holds " + std::to_string(found.size()) +
                    " COLMAP models, each in a frame of its own; name the one that is meant, as " +
                    found.front().string());
  }
  return FindHere(found.front());
}

}  // namespace

void WriteColmapModel(const fs::path& folder, const std::vector<NamedCamera>& cameras) {
  std::string cameras_text =
      "# CAMERA_ID MODEL WIDTH HEIGHT FX FY CX CY K1 K2 P1 P2; pixel centres at 0.5\n";
  // FULL_OPENCV goes on with K3 K4 K5 K6.
  std::string images_text =
      "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of points (none); "
      "world: x east, y north, z up\n";
  // COLMAP's database numbers the images of a folder by the byte order of their names, and its
  // point_triangulator (3.8) wants a model to have the same numbers.
  std::map<std::string, int> id_of_name;
  for (const NamedCamera& named : cameras) {
    if (!id_of_name.emplace(named.name, 0).second) {
      throw Error(folder, "two images are called " + Quote(named.name));
    }
  }
  int last_id = 0;
  for (auto& [name, id] : id_of_name) id = ++last_id;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i].camera;
    const std::string id = std::to_string(id_of_name.at(cameras[i].name));
    cameras_text += id + (camera.k3 == 0 ? " OPENCV " : " FULL_OPENCV ") +
                    std::to_string(camera.width_px) + " " + std::to_string(camera.height_px);
    for (const double value : {camera.focal_x_px,
                               camera.focal_y_px,
                               camera.center_x_px,
                               camera.center_y_px,
                               camera.k1,
                               camera.k2,
                               camera.p1,
                               camera.p2}) {
      cameras_text += " " + FormatNumber(value);
    }
    if (camera.k3 != 0) cameras_text += " " + FormatNumber(camera.k3) + " 0 0 0";
    cameras_text += "\n";
    images_text += id + " " + FormatQuaternion(camera.cam_from_world.rotation);
    for (const double value : camera.cam_from_world.translation) {
      images_text += " " + FormatNumber(value);
    }
    images_text += " " + id + " " + cameras[i].name + "\n\n";
  }
  WriteFilesAtomically({{folder / "cameras.txt", cameras_text},
                        {folder / "images.txt", images_text},
                        {folder / "points3D.txt", "# no points\n"}});
}

std::optional<ColmapFiles> FindColmapModel(const fs::path& folder) {
  for (const fs::path& candidate : {folder, folder / "sparse"}) {
    if (auto files = FindHere(candidate)) return files;
  }
  for (const fs::path& candidate : {folder, folder / "sparse"}) {
    if (auto files = FindNumbered(candidate)) return files;
  }
  return std::nullopt;
}

ColmapReading ReadColmapImages(const ColmapFiles& files) {
  const ColmapRecords records = files.images_file.extension() == ".bin"
                                    ? ReadColmapBinary(files.cameras_file, files.images_file)
                                    : ReadColmapText(files.cameras_file, files.images_file);
  ColmapReading reading;
  std::set<std::string> names;
  for (const ColmapImage& image : records.images) {
    std::string name = image.name;
    std::replace(name.begin(), name.end(), '\\', '/');
    try {
      if (!image.fault.empty()) throw Error(image.fault);
      const Eigen::Quaterniond rotation = RotationOf(image);
      const auto camera = records.cameras.find(image.camera_id);
      if (camera == records.cameras.end()) {
        throw Error(image.place + ": camera " + std::to_string(image.camera_id) + " is not in " +
                    files.cameras_file.filename().string());
      }
      if (!camera->second.fault.empty()) throw Error(camera->second.fault);
      if (!names.insert(name).second) {
        throw Error(image.place + ": image " + Quote(image.name) + " is repeated");
      }
      NamedCamera& named = reading.cameras.emplace_back();
      named.name = name;
      named.camera = camera->second.camera;
      named.camera.cam_from_world = {rotation.toRotationMatrix(),
                                     {image.pose[4], image.pose[5], image.pose[6]}};
    } catch (const Error& error) {
      reading.faults.push_back({name, error.what()});
    }
  }
  for (const std::string& fault : records.stray_faults) reading.faults.push_back({"", fault});
  if (!reading.cameras.empty()) return reading;
  if (!reading.faults.empty()) throw Error(reading.faults.front().text);
  throw Error(files.images_file, "no images in this model");
}

std::vector<std::string> TellColmapFaults(const std::vector<ColmapFault>& faults) {
  constexpr size_t kMost = 5;
  std::vector<std::string> lines;
  for (size_t i = 0; i < std::min(kMost, faults.size()); ++i) {
    lines.push_back(faults[i].text + (faults[i].name.empty()
                                          ? std::string()
                                          : "; image " + Quote(faults[i].name) + " is left out"));
  }
  if (faults.size() > kMost) {
    lines.back() += "; and " + std::to_string(faults.size() - kMost) + " more";
  }
  return lines;
}

std::vector<NamedCamera> ReadColmapModel(const ColmapFiles& files) {
  ColmapReading reading = ReadColmapImages(files);
  if (!reading.faults.empty()) throw Error(reading.faults.front().text);
  return std::move(reading.cameras);
}

std::vector<NamedCamera> ReadColmapModel(const fs::path& folder) {
  const std::optional<ColmapFiles> files = FindColmapModel(folder);
  if (!files) {
    throw Error(folder,
                "no COLMAP model here; expected cameras.txt and images.txt, or cameras.bin and "
                "images.bin, or a folder sparse/0 with them");
  }
  return ReadColmapModel(*files);
}

}  // namespace groundglass
