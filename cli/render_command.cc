// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/elevation_arguments.h"
#include "cli/empty_view.h"
#include "cli/model_arguments.h"
#include "cli/montage_arguments.h"
#include "cli/option_range.h"
#include "invrender/tiles1988/tiles.h"
#include "scene/assumed_unit.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/input_folders.h"
#include "scene/formats/model_io.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "viewer/camera_path.h"
#include "viewer/film.h"
#include "viewer/overlay.h"
#include "viewer/renderer.h"
#include "viewer/tile_renderer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, DrawMode> kModes = {{"textured", DrawMode::kTextured},
                                                {"shaded", DrawMode::kShaded},
                                                {"wire", DrawMode::kWireframe},
                                                {"labels", DrawMode::kLabels}};
const std::map<std::string, Background> kBackgrounds = {{"white", Background::kWhite},
                                                        {"sky", Background::kSky},
                                                        {"transparent", Background::kTransparent}};

template <typename T>
std::vector<std::string> Names(const std::map<std::string, T>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

struct RenderArguments {
  CommonOptions common;
  ModelArguments model_arguments;
  fs::path model;
  fs::path view_file;
  std::string path;  // "orbit", or a folder of .view files
  fs::path photograph;
  fs::path out;
  std::string mode = "textured";
  std::string background = "white";
  int width_px = 0;
  int height_px = 0;
  double seconds = 10;
  RenderOptions render;
  FilmOptions film;
  OrbitOptions orbit;
  ElevationArguments elevation;
  MontageArguments montage;
};

// What is drawn of a folder is what a run left in it.
fs::path ModelOfFolder(const fs::path& folder) {
  if (fs::exists(folder / "model.glb")) return folder / "model.glb";
  if (!fs::exists(folder / "images")) {
    throw Error(folder, "has no model.glb; expected an output folder or a model file");
  }
  throw Error(folder,
              "is a scene, and what is drawn is a model or the output of a run; give the model's "
              "own file, or first: groundglass run " +
                  folder.string() + " -o OUT");
}

TexturedModelReading ReadModelToRender(const RenderArguments& arguments) {
  fs::path file = arguments.model;
  if (fs::is_directory(file)) file = ModelOfFolder(file);
  TexturedModelReading reading = ReadTexturedModel(file, arguments.model_arguments.Options());
  if (const auto assumed = DescribeAssumedUnit(file, reading.textured.model)) {
    reading.warnings.push_back(*assumed);
  }
  return reading;
}

std::vector<std::string> Together(std::vector<std::string> warnings,
                                  const std::vector<std::string>& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
  return warnings;
}

// The picture's size: as asked for; what is left open follows from the view's aspect.
ImageSize ChooseSize(const RenderArguments& arguments, double aspect) {
  ImageSize size = {arguments.width_px, arguments.height_px};
  if (size.width == 0 && size.height == 0) size.width = 1500;
  if (size.height == 0) size.height = static_cast<int>(std::lround(size.width / aspect));
  if (size.width == 0) size.width = static_cast<int>(std::lround(size.height * aspect));
  return size;
}

void Report(const RenderArguments& arguments,
            const ImageSize& size,
            int num_frames,
            const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
  if (arguments.common.json) {
    const nlohmann::ordered_json json = {{"file", arguments.out.string()},
                                         {"written", !arguments.common.dry_run},
                                         {"width_px", size.width},
                                         {"height_px", size.height},
                                         {"frames", num_frames},
                                         {"warnings", warnings}};
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    std::printf("%s%s: %d x %d, %d %s\n",
                arguments.common.dry_run ? "would write " : "",
                arguments.out.c_str(),
                size.width,
                size.height,
                num_frames,
                num_frames == 1 ? "picture" : "frames");
  }
}

int RenderOverlay(const RenderArguments& arguments) {
  const TexturedModelReading reading = ReadModelToRender(arguments);
  const PolygonModel& model = reading.textured.model;
  const Image8 photograph = ReadSrgb8(arguments.photograph);
  const Camera camera =
      CameraFromTag(ReadView(arguments.view_file), photograph.width, photograph.height);
  if (!arguments.common.dry_run) {
    WriteSrgb8(
        arguments.out,
        DrawOverlay(photograph, model, FindModelEdges(model), Visibility(model), camera, nullptr));
  }
  Report(arguments, {photograph.width, photograph.height}, 1, reading.warnings);
  return kExitDone;
}

int RenderStill(const RenderArguments& arguments) {
  const ViewTag tag = ReadView(arguments.view_file);
  const ImageSize size = ChooseSize(arguments, tag.aspect);
  const TexturedModelReading reading = ReadModelToRender(arguments);
  const Camera camera = CameraFromTag(tag, size.width, size.height);
  Renderer renderer(reading.textured);
  if (!arguments.common.dry_run) {
    WriteSrgb8(arguments.out, renderer.Render(camera, arguments.render));
  }
  std::vector<std::string> warnings = Together(reading.warnings, renderer.Warnings());
  const std::string why_nothing =
      WhyNothingIsDrawn(reading.textured.model, camera, arguments.view_file);
  if (!why_nothing.empty()) warnings.push_back(why_nothing);
  Report(arguments, size, 1, warnings);
  return kExitDone;
}

// The folder's views in natural order, as cameras of the film's frame.
std::vector<Camera> ReadFilmCameras(const fs::path& folder, const ImageSize& size) {
  if (!fs::is_directory(folder)) {
    throw Error(folder, "is no folder of .view files; expected one, or the word orbit");
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".view") files.push_back(entry.path());
  }
  if (files.empty()) throw Error(folder, "holds no .view file");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.stem().string(), b.stem().string());
  });
  std::vector<Camera> cameras;
  for (const fs::path& file : files) {
    const ViewTag tag = ReadView(file);
    const int tag_height_px = static_cast<int>(std::lround(size.width / tag.aspect));
    cameras.push_back(
        ReframedCamera(CameraFromTag(tag, size.width, tag_height_px), size.width, size.height));
  }
  return cameras;
}

int RenderFilm(const RenderArguments& arguments) {
  // H.264's colour planes are half as large each way: even sizes only.
  ImageSize size = ChooseSize(arguments, 16.0 / 9);
  size.width += size.width % 2;
  size.height += size.height % 2;
  const int num_frames = std::max(
      1, static_cast<int>(std::lround(arguments.seconds * arguments.film.frames_per_second)));
  const TexturedModelReading reading = ReadModelToRender(arguments);
  const TexturedModel& model = reading.textured;
  std::vector<Camera> path;
  if (arguments.path == "orbit") {
    OrbitOptions orbit = arguments.orbit;
    orbit.width_px = size.width;
    orbit.height_px = size.height;
    path = MakeOrbit(model.model, num_frames, orbit);
  } else {
    path = MakeFlight(model.model, ReadFilmCameras(arguments.path, size), num_frames);
  }
  Renderer renderer(model);
  if (!arguments.common.dry_run) {
    WriteFilm(
        arguments.out,
        num_frames,
        [&](int frame) { return renderer.Render(path[frame], arguments.render); },
        arguments.film,
        MakeProgress(arguments.common, "film"));
  }
  Report(arguments, size, num_frames, Together(reading.warnings, renderer.Warnings()));
  return kExitDone;
}

// The tile files that a path stands for: itself, or those in the folder, in order.
std::vector<fs::path> FindTileFiles(const fs::path& path) {
  if (!fs::is_directory(path)) {
    return path.extension() == ".tiles" ? std::vector<fs::path>{path} : std::vector<fs::path>();
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".tiles") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool IsTileRecord(const fs::path& path) { return fs::exists(path / "record.json"); }

int RenderTiles(const RenderArguments& arguments) {
  if (arguments.view_file.empty()) throw Error(arguments.model, "tiles are drawn from a --view");
  const ViewTag tag = ReadView(arguments.view_file);
  const ImageSize size = ChooseSize(arguments, tag.aspect);
  const Camera camera = CameraFromTag(tag, size.width, size.height);
  TileRenderer renderer(camera, arguments.render.supersampling);
  const auto draw = [&](std::span<const Tile> tiles) { renderer.Draw(tiles); };
  if (IsTileRecord(arguments.model)) {
    RecomputeTiles(ReadTileRecord(arguments.model), camera, draw);
  }
  for (const fs::path& file : FindTileFiles(arguments.model)) draw(MappedTiles(file).Tiles());
  if (!arguments.common.dry_run) WriteSrgb8(arguments.out, renderer.Picture());
  Report(arguments, size, 1, {});
  return kExitDone;
}

int RenderToScale(const RenderArguments& arguments) {
  TexturedModelReading reading = ReadModelToRender(arguments);
  return RenderElevations(arguments.elevation,
                          arguments.common,
                          reading.textured,
                          fs::is_directory(arguments.model) ? arguments.model : fs::path(),
                          arguments.out,
                          reading.warnings);
}

int RunRender(const RenderArguments& arguments) {
  arguments.render.Check();
  arguments.film.Check();
  arguments.orbit.Check();
  for (const fs::path& input : {arguments.model, arguments.photograph, arguments.view_file}) {
    RequireOtherFile(input, arguments.out);
  }
  RefuseFilledInputs(arguments.out);
  if (arguments.montage.IsAsked()) {
    MontageArguments montage = arguments.montage;
    montage.montage.supersampling = arguments.render.supersampling;
    return RenderMontage(montage,
                         arguments.common,
                         arguments.model,
                         arguments.model_arguments.Options(),
                         arguments.out);
  }
  if (IsTileRecord(arguments.model) || !FindTileFiles(arguments.model).empty()) {
    return RenderTiles(arguments);
  }
  if (arguments.elevation.IsAsked()) return RenderToScale(arguments);
  if (!arguments.path.empty()) {
    if (arguments.out.extension() != ".mp4") throw Error(arguments.out, "a film ends in .mp4");
    if (arguments.render.background == Background::kTransparent) {
      throw Error(arguments.out, "a film cannot be transparent");
    }
    return RenderFilm(arguments);
  }
  if (arguments.out.extension() == ".jpg" &&
      arguments.render.background == Background::kTransparent) {
    throw Error(arguments.out, "JPEG cannot be transparent; write a .png");
  }
  return arguments.photograph.empty() ? RenderStill(arguments) : RenderOverlay(arguments);
}

}  // namespace

void AddRenderCommand(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<RenderArguments>();
  arguments->render.supersampling = 2;
  CLI::App* command = app.add_subcommand(
      "render", "Draw a model: stills from views, overlays, films, elevations, montages");
  command
      ->add_option("model",
                   arguments->model,
                   "an output folder, its tiles/, or a .glb, .obj, .osu, ... model")
      ->required();
  command
      ->add_option(
          "-o,--out",
          arguments->out,
          "the picture (.png, .jpg, .tif), film (.mp4) or drawing (.tif, .pdf, .svg, .dxf)")
      ->required();
  CLI::Option* view = command->add_option("--view", arguments->view_file, "the view to draw");
  CLI::Option* path = command->add_option(
      "--path", arguments->path, "a film: 'orbit', or a folder of .view files to fly through");
  command->add_option("--photo", arguments->photograph, "draw the model's edges over this one")
      ->needs(view);
  view->excludes(path);
  AddChoice(command, "--mode", Names(kModes), "how faces are drawn", arguments->mode);
  AddChoice(
      command, "--background", Names(kBackgrounds), "behind the model", arguments->background);
  command->add_flag("--edges", arguments->render.edges, "the model's edges over the picture");
  command
      ->add_option("--width", arguments->width_px, "px; 1500 if neither width nor height is given")
      ->check(FromTo(1, 16384));
  command
      ->add_option("--height", arguments->height_px, "px; else from the view's aspect (film: 16:9)")
      ->check(FromTo(1, 16384));
  command->add_option("--supersampling", arguments->render.supersampling, "1 (fast) to 4 (fine)")
      ->check(FromTo(1, 4))
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "length of the film")
      ->check(FromTo(1e-3, 3600))
      ->capture_default_str();
  command->add_option("--fps", arguments->film.frames_per_second, "frames a second")
      ->check(FromTo(1, 240))
      ->capture_default_str();
  command->add_option("--orbit-height", arguments->orbit.height_deg, "degrees above the model")
      ->capture_default_str();
  AddElevationOptions(command, arguments->elevation);
  AddMontageOptions(command, arguments->montage);
  // A montage has its photograph's view, size and background.
  for (const char* other : {"--view",
                            "--path",
                            "--photo",
                            "--elevation",
                            "--section",
                            "--developed",
                            "--mode",
                            "--background",
                            "--edges",
                            "--width",
                            "--height"}) {
    command->get_option("--over")->excludes(command->get_option(other));
  }
  AddModelOptions(command, arguments->model_arguments);
  AddCommonOptions(command, arguments->common);
  AddExample(
      command,
      "groundglass render hall-out --view from-the-roof.view -o roof.png\n"
      "  groundglass render hall-out --path orbit -o around.mp4\n"
      "  groundglass render hall-out --elevation all --scale 1:50 -o hall.tif --also pdf,dxf\n"
      "  groundglass render hall-out --over s5.jpg --model new-wing.obj -o montage.jpg");
  command->callback([arguments, view, path, &exit_status] {
    if (view->count() + path->count() == 0 && !arguments->elevation.IsAsked() &&
        !arguments->montage.IsAsked()) {
      throw CLI::RequiredError("--view, --path, --elevation, --section, --developed or --over");
    }
    arguments->render.mode = kModes.at(arguments->mode);
    arguments->render.background = kBackgrounds.at(arguments->background);
    exit_status = RunWithThreads(arguments->common, [&] { return RunRender(*arguments); });
  });
}

}  // namespace groundglass
