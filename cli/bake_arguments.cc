// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"

#include "invrender/selection.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/photograph_name.h"
#include "scene/text.h"

#include <malloc.h>

#include <algorithm>

namespace groundglass {
namespace {

// Leaves out the photographs whose masks from --masks cannot be used, and tells why.
std::vector<std::string> DropThoseWithFaultyMasks(const std::filesystem::path& folder,
                                                  std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> faults;
  std::erase_if(photographs, [&](const BakePhotograph& photograph) {
    const auto& file = photograph.mask_file;
    if (!file || *file != folder / file->filename()) return false;
    try {
      const Image16 mask = ReadLabels(*file);
      if (mask.width == photograph.camera.width_px && mask.height == photograph.camera.height_px) {
        return false;
      }
      faults.push_back(Error(*file,
                             "mask has " + std::to_string(mask.width) + " x " +
                                 std::to_string(mask.height) + " pixels, its photograph " +
                                 std::to_string(photograph.camera.width_px) + " x " +
                                 std::to_string(photograph.camera.height_px))
                           .what());
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
    faults.back() += "; " + photograph.name + " is left out of the texture";
    return true;
  });
  return faults;
}

// Those that cannot be used or were left out included: a table that names them is right.
std::vector<PhotographName> AllNames(const Scene& scene) {
  std::vector<PhotographName> names = NamesOf(scene.photographs);
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    const Photograph& photograph = unreadable.photograph;
    names.push_back({photograph.name, photograph.image_file.filename().string()});
  }
  for (const std::string& name : scene.left_out) names.push_back({name, ""});
  std::sort(names.begin(), names.end(), [](const PhotographName& a, const PhotographName& b) {
    return NaturalLess(a.name, b.name);
  });
  return names;
}

}  // namespace

BakeOptions BakeArguments::Options() const {
  if (options.bits == 16 && format == "jpg") {
    throw CLI::ValidationError("--bits",
                               "a JPEG has 8 bits; give --format png, tif or exr with --bits 16");
  }
  BakeOptions result = options;
  result.match_colour = !no_colour;
  result.reject_occluders = !no_consensus;
  return result;
}

void AddBakeArguments(CLI::App* command, BakeArguments& arguments, const std::string& only_option) {
  const std::string group = "Texture";
  command
      ->add_option("--texel-size",
                   arguments.options.texel_size,
                   "side of a texel, model's unit; 0: as fine as the photographs, face by face")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--max-texture",
                   arguments.options.max_page_texels,
                   "texels along a side of the largest page")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--memory",
                   arguments.options.max_memory_mb,
                   "MB of memory that texturing may take; 0: no limit. Texels become larger where "
                   "it must be")
      ->capture_default_str()
      ->group(group);
  command->add_option("--exclude", arguments.exclude, "photographs to leave out, by name")
      ->delimiter(',')
      ->group(group);
  command->add_option(only_option, arguments.only, "faces to texture: 3, 3-7, or a name")
      ->delimiter(',')
      ->group(group);
  command
      ->add_option("--masks", arguments.masks_folder, "folder of masks (white = ignore), as s5.png")
      ->type_name("FOLDER")
      ->group(group);
  command->add_option("--format", arguments.format, "of the OBJ's pages; the GLB's are always JPEG")
      ->capture_default_str()
      ->check(CLI::IsMember({"jpg", "png", "tif", "exr"}))
      ->group(group);
  command
      ->add_option("--bits",
                   arguments.options.bits,
                   "16: read photographs and write pages with 16 bits a channel (png, tif; exr)")
      ->capture_default_str()
      ->check(CLI::IsMember({8, 16}))
      ->group(group);
  command
      ->add_flag("--fill",
                 arguments.options.fill_gaps,
                 "paint over what no photograph shows; provenance says 65535 there")
      ->group(group);
  command->add_flag("--accepted-only", arguments.accepted_only, "leave out photographs in review")
      ->group(group);
  command
      ->add_flag("--no-colour",
                 arguments.no_colour,
                 "keep the photographs' own exposure, white balance and light")
      ->group(group);
  command
      ->add_flag("--no-consensus",
                 arguments.no_consensus,
                 "keep what only one photograph shows: trees, cars, shadows")
      ->group(group);
}

void AddTileArguments(CLI::App* command, BakeArguments& arguments) {
  const std::string group = "Texture";
  CLI::Option* tiles = command
                           ->add_flag("--tiles",
                                      arguments.tiles,
                                      "also write tiles/, the texture database of 1988: NAME.tiles "
                                      "for each photograph, 96 bytes a tile")
                           ->group(group);
  CLI::Option* record = command
                            ->add_flag("--tile-record",
                                       arguments.tile_record,
                                       "also write tiles/ with the view transformations only: "
                                       "tiles are computed when they are viewed")
                            ->group(group);
  tiles->excludes(record);
  command
      ->add_option("--downsample",
                   arguments.tile_options.downsample,
                   "of tiles: average this many pixels into one")
      ->capture_default_str()
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->group(group);
}

void WriteTilesIfAsked(const BakeArguments& arguments,
                       const PolygonModel& model,
                       std::vector<BakePhotograph> photographs,
                       const std::filesystem::path& out) {
  if (!arguments.tiles && !arguments.tile_record) return;
  const std::filesystem::path folder = out / "tiles";
  const std::vector<std::vector<int>> faces =
      PairFacesWithPhotographs(model, photographs, arguments.tile_options);
  for (size_t i = 0; i < photographs.size(); ++i) photographs[i].faces = faces[i];
  if (arguments.tile_record) {
    WriteTileRecord(folder, {model, photographs, arguments.tile_options});
    return;
  }
  const Visibility visibility(model);
  for (const BakePhotograph& photograph : photographs) {
    if (photograph.faces->empty()) continue;
    WriteTiles(folder / (photograph.name + ".tiles"), [&](const TileSink& append) {
      MakeTiles(model, visibility, photograph, *photograph.faces, arguments.tile_options, append);
    });
  }
}

void ConfigureMallocTrimming(const BakeArguments& arguments) {
  const bool is_limited = arguments.options.max_memory_mb > 0;
  mallopt(M_MMAP_THRESHOLD, is_limited ? 1 << 20 : 64 << 20);
  mallopt(M_TRIM_THRESHOLD, is_limited ? 1 << 20 : 256 << 20);
}

std::vector<std::string> NarrowPhotographs(const BakeArguments& arguments,
                                           const Scene& scene,
                                           std::vector<BakePhotograph>& photographs) {
  std::vector<std::string> faults;
  // That the scene has them all is known; some may be missing here for other reasons.
  std::vector<std::string> exclude = arguments.exclude;
  std::erase_if(exclude, [&](const std::string& name) {
    return std::none_of(
        photographs.begin(), photographs.end(), [&](const BakePhotograph& photograph) {
          return photograph.name == name || photograph.image_file.filename() == name;
        });
  });
  ExcludePhotographs(exclude, photographs);
  if (photographs.empty()) return faults;
  if (arguments.masks_folder) {
    UseMasks(*arguments.masks_folder, photographs);
    faults = DropThoseWithFaultyMasks(*arguments.masks_folder, photographs);
  }
  const std::filesystem::path pairs = scene.folder / "pairs.csv";
  if (std::filesystem::exists(pairs)) {
    RestrictToPairs(pairs, scene.model, photographs, AllNames(scene));
  }
  if (!arguments.only.empty()) {
    RestrictToFaces(scene.model, FindFaces(scene.model, arguments.only), photographs);
  }
  return faults;
}

}  // namespace groundglass
