// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/film.h"

#include "scene/check_option.h"
#include "scene/child_process.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"

#include <string>
#include <vector>

namespace groundglass {
namespace {

// Waits for the encoder to end; Error with its own last words if it failed.
void FinishFilm(ChildProcess& encoder, const FilmOptions& options) {
  const ProgramResult result = encoder.Finish();
  // It may end with 0 although it could not write the end; with -loglevel error, whatever it says
  // is a failure.
  const bool is_silent = result.errors.empty() && result.output.empty();
  if (result.exit_code == 0 && is_silent) return;
  throw Error("film: " + options.ffmpeg.string() + " failed: " + LastWords(result));
}

std::vector<std::string> EncoderCommand(const Image8& first_frame,
                                        const FilmOptions& options,
                                        const std::filesystem::path& file) {
  return {options.ffmpeg.string(),
          "-hide_banner",
          "-loglevel",
          "error",
          "-nostdin",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(first_frame.width) + "x" + std::to_string(first_frame.height),
          "-r",
          std::to_string(options.frames_per_second),
          "-i",
          "pipe:0",
          // Players take untagged small films for BT.601 and large ones for BT.709: say which.
          "-vf",
          "scale=out_color_matrix=bt709:out_range=tv",
          "-c:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-preset",
          "medium",
          "-crf",
          std::to_string(options.quality),
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "iec61966-2-1",
          // x264's output depends on its number of threads.
          "-threads",
          "4",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          file.string()};
}

}  // namespace

void FilmOptions::Check() const {
  if (!(frames_per_second > 0 && frames_per_second <= 240)) {
    throw OptionError("film options: frames_per_second", "must be above 0 and at most 240");
  }
  CheckFromTo(quality, 0, 51, "film options: quality");
  if (ffmpeg.empty()) throw Error("film options: ffmpeg names no program");
}

void WriteFilm(const std::filesystem::path& file,
               int num_frames,
               const std::function<Image8(int)>& frame,
               const FilmOptions& options,
               const Progress& progress) {
  options.Check();
  if (num_frames < 1) throw Error(file, "a film needs at least one frame");
  Image8 picture = frame(0);
  if (picture.channels != 3 || picture.width % 2 != 0 || picture.height % 2 != 0) {
    throw Error(file,
                "frames must have 3 channels and an even size; this one is " +
                    std::to_string(picture.width) + " x " + std::to_string(picture.height) + " x " +
                    std::to_string(picture.channels));
  }
  const size_t frame_size = picture.values.size();
  WriteFileAtomically(file, [&](const std::filesystem::path& temporary) {
    ProgramOptions program;
    program.package = "ffmpeg";
    ChildProcess encoder(EncoderCommand(picture, options, temporary), program);
    for (int i = 0; i < num_frames; ++i) {
      if (i > 0) picture = frame(i);
      if (picture.values.size() != frame_size) throw Error(file, "its frames differ in size");
      if (!encoder.Write(picture.values)) break;
      if (progress) progress(i + 1, num_frames, "frame");
    }
    FinishFilm(encoder, options);
  });
}

}  // namespace groundglass
