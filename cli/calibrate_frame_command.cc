// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/slide_frame.h"
#include "cli/calibrate_parts.h"
#include "cli/calibration_scene.h"
#include "cli/json_output.h"
#include "cli/option_range.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/image_paths.h"
#include "scene/frames.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

struct FrameArguments {
  CalibrationArguments calibration;
  FrameOptions options;
  std::optional<fs::path> images_folder;
};

// The frame's part of a scan, its sides along the pixels: what is lost at the corners of a turned
// one is less than resampling would lose everywhere.
template <typename T>
Raster<T> Cropped(const Raster<T>& scan, int left, int top, int width, int height) {
  Raster<T> crop(width, height, scan.channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::copy_n(
          scan.At(std::clamp(left + x, 0, scan.width - 1), std::clamp(top + y, 0, scan.height - 1)),
          scan.channels,
          crop.At(x, y));
    }
  }
  return crop;
}

// White where a crop shows the border; empty if it shows none.
Image16 BorderMask(const SlideFrame& frame, double blur_px, int width, int height) {
  Image16 mask(width, height, 1);
  const double turn = RadiansFromDegrees(frame.turn_deg);
  bool shows_border = false;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector2d off(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0);
      const double across = std::abs(std::cos(turn) * off.x() + std::sin(turn) * off.y());
      const double along = std::abs(-std::sin(turn) * off.x() + std::cos(turn) * off.y());
      const bool is_border =
          across > frame.width_px / 2 - blur_px || along > frame.height_px / 2 - blur_px;
      if (is_border) *mask.At(x, y) = 65535;
      shows_border = shows_border || is_border;
    }
  }
  return shows_border ? mask : Image16();
}

KnownKeys KeysOfFrame(const SlideFrame& frame, const FrameOptions& options) {
  KnownKeys keys;
  const double aspect = frame.width_px / frame.height_px;
  AddKnown(keys, "a", aspect, "the mount's opening");
  AddKnown(keys,
           "sigma_a",
           aspect * std::max(options.least_aspect_sigma, 2 * frame.sigma_px / frame.height_px));
  AddKnown(keys, "roll", -frame.turn_deg, "turned in the scan");
  AddKnown(keys, "sigma_shift", options.mount_play, "the film's play in the mount");
  return keys;
}

KnownKeys KeysOfVideo(const VideoAspect& video, bool is_given) {
  KnownKeys keys;
  AddKnown(keys,
           "a",
           video.aspect,
           is_given ? "--aspect, of a television frame"
                    : "a television frame: a camera's 4:3, or a slide squeezed into it");
  AddKnown(keys, "sigma_a", video.sigma);
  return keys;
}

// Where the photographs of a scene lie, if any has this name already.
bool HasPhotograph(const fs::path& folder, const std::string& name) {
  for (const std::string& path : ListFilesBelow(folder)) {
    if (WithoutExtension(path) == name) return true;
  }
  return false;
}

// Writes the frame's part of a scan, and its mask; returns what was written, or why not.
std::string WriteCrop(const FrameArguments& arguments,
                      const CalibrationScene& scene,
                      const CalibrationPhotograph& scan,
                      const SlideFrame& frame) {
  fs::path images;
  if (arguments.images_folder) {
    images = *arguments.images_folder;
  } else if (!scene.scene_folder.empty()) {
    images = scene.scene_folder / "images";
  } else {
    return "";
  }
  const fs::path masks = images.parent_path() / "masks";
  for (const fs::path& folder : {images, masks}) {
    if (HasPhotograph(folder, scan.name)) {
      return "not cropped, since " + folder.string() + " has it";
    }
  }
  const int width = static_cast<int>(std::lround(frame.width_px));
  const int height = static_cast<int>(std::lround(frame.height_px));
  const int left = static_cast<int>(std::lround(frame.center_px.x() - frame.width_px / 2));
  const int top = static_cast<int>(std::lround(frame.center_px.y() - frame.height_px / 2));
  const fs::path file = images / (scan.name + ".png");
  WriteSrgb8(file, Cropped(ReadSrgb8(scan.file), left, top, width, height));
  const Image16 mask = BorderMask(frame, arguments.options.blur_px, width, height);
  if (!mask.Empty()) WriteLabels(masks / (scan.name + ".png"), mask);
  return file.string();
}

nlohmann::ordered_json JsonFromFrame(const std::string& name, const SlideFrame& frame) {
  if (!frame.is_found) return {{"name", name}, {"found", false}, {"reason", frame.reason}};
  return {{"name", name},
          {"found", true},
          {"center_px", {frame.center_px.x(), frame.center_px.y()}},
          {"width_px", frame.width_px},
          {"height_px", frame.height_px},
          {"turn_deg", frame.turn_deg},
          {"sigma_turn_deg", frame.sigma_turn_deg}};
}

// A folder that is no scene stands for the pictures in it.
CalibrationArguments WithPicturesOfFolder(CalibrationArguments arguments) {
  if (arguments.inputs.size() != 1 || !fs::is_directory(arguments.inputs.front())) return arguments;
  const fs::path folder = arguments.inputs.front();
  if (fs::is_directory(folder / "scans") || fs::is_directory(folder / "images")) return arguments;
  const std::vector<fs::path> files = ListImageFiles(folder);
  if (files.empty()) {
    throw Error(folder,
                "no scans; expected scans/ with pictures in it (for a scene), or a folder of "
                "pictures, or pictures");
  }
  arguments.inputs = files;
  return arguments;
}

int RunCalibrateFrame(const FrameArguments& arguments) {
  const CommonOptions& common = arguments.calibration.common;
  const std::vector<fs::path>& inputs = arguments.calibration.inputs;
  const bool has_scans = inputs.size() == 1 && fs::is_directory(inputs.front() / "scans");
  const CalibrationScene scene = ReadCalibrationScene(WithPicturesOfFolder(arguments.calibration),
                                                      has_scans ? "scans" : "images");
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  size_t num_failed = 0;
  for (const CalibrationPhotograph& scan : scene.photographs) {
    SlideFrame frame;
    KnownKeys keys;
    std::string crop;
    try {
      const Image8 grey = ReadGrey8(scan.file);
      const std::optional<VideoAspect> video = VideoAspectOf(scan.file, arguments.options);
      frame = FindSlideFrame(grey, arguments.options);
      if (frame.is_found && (has_scans || scene.scene_folder.empty())) {
        keys = KeysOfFrame(frame, arguments.options);
        if (!common.dry_run) crop = WriteCrop(arguments, scene, scan, frame);
      } else if (frame.is_found) {
        frame.is_found = false;
        frame.reason = "it shows its mount; put it into scans/ in place of images/";
      } else if (video) {
        keys = KeysOfVideo(*video, arguments.options.aspect.has_value());
      }
      if (!common.dry_run) WriteKnownKeys(scene, scan.name, keys, "frame");
    } catch (const Error& error) {
      ++num_failed;
      frame = {};
      keys.clear();
      frame.reason = error.what();
    }
    if (common.json) {
      json.push_back(JsonFromFrame(scan.name, frame));
    } else {
      std::printf("%s: %s%s%s\n",
                  scan.name.c_str(),
                  keys.empty() ? ("nothing, since " + frame.reason).c_str()
                               : DescribeKnownKeys(keys).c_str(),
                  crop.empty() ? "" : "; ",
                  crop.c_str());
    }
  }
  if (common.json) PrintJson({{"photographs", json}});
  return ExitOfCalibration(num_failed, scene.photographs.size());
}

}  // namespace

void AddCalibrateFrame(CLI::App* calibrate, int& exit_status) {
  auto arguments = std::make_shared<FrameArguments>();
  CLI::App* command = calibrate->add_subcommand(
      "frame", "Slides' pictures cut from scans that show their mounts; prints from their borders");
  AddCalibrationArguments(command, arguments->calibration);
  command->get_option("input")->description(
      "a scene folder with scans/ in it, a folder of scans, or scans");
  command
      ->add_option("--images",
                   arguments->images_folder,
                   "where to write the pictures; images/ of the scene folder if not given")
      ->type_name("FOLDER");
  command
      ->add_option("--aspect",
                   arguments->options.aspect,
                   "width / height of the openings, where a side lies outside of the scan, or of "
                   "what television frames hold")
      ->check(Above(0));
  AddExample(command, "groundglass calibrate frame hall     # hall/scans/ into hall/images/");
  command->callback([arguments, &exit_status] {
    exit_status = RunWithThreads(arguments->calibration.common,
                                 [&] { return RunCalibrateFrame(*arguments); });
  });
}

}  // namespace groundglass
