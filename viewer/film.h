// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "scene/progress.h"

#include <filesystem>
#include <functional>

namespace groundglass {

struct FilmOptions {
  double frames_per_second = 25;
  // x264's constant rate factor: 0 loses nothing, 18 looks the same, 28 is small.
  int quality = 18;
  std::filesystem::path ffmpeg = "ffmpeg";  // the program; a bare name is sought in PATH

  void Check() const;  // throws Error naming the first field out of range
};

// Encodes frames to H.264 in MP4 by the ffmpeg program, as they are made: frame(0), frame(1), ...
// each sRGB with 3 channels, all of one even size. Written beside its place and renamed into it.
// Error if ffmpeg is missing or fails, with what it said.
void WriteFilm(const std::filesystem::path& file,
               int num_frames,
               const std::function<Image8(int)>& frame,
               const FilmOptions& options = {},
               const Progress& progress = {});

}  // namespace groundglass
