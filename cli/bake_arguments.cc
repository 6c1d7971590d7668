// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/bake_arguments.h"

#include <malloc.h>

namespace groundglass {
BakeOptions BakeArguments::Options() const {
  if (options.pages.bits == 16 && format == "jpg") {
    throw CLI::ValidationError("--bits",
                               "a JPEG has 8 bits; give --format png, tif or exr with --bits 16");
  }
  BakeOptions result = options;
  result.match_colour = !no_colour;
  result.reject_occluders = !no_consensus;
  return result;
}

TilesToWrite BakeArguments::Tiles() const {
  using Form = TilesToWrite::Form;
  return {tile_record ? Form::kRecord : tiles ? Form::kTiles : Form::kNone, tile_options};
}

void AddBakeArguments(CLI::App* command, BakeArguments& arguments, const std::string& only_option) {
  const std::string group = "Texture";
  command
      ->add_option("--texel-size",
                   arguments.options.pages.texel_size,
                   "side of a texel, model's unit; 0: as fine as the photographs, face by face")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--max-texture",
                   arguments.options.pages.max_page_texels,
                   "texels along a side of the largest page")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--memory",
                   arguments.options.memory.max_memory_mb,
                   "MB of memory that texturing may take; 0: no limit. Texels become larger where "
                   "it must be")
      ->capture_default_str()
      ->group(group);
  command->add_option("--exclude", arguments.selection.exclude, "photographs to leave out, by name")
      ->delimiter(',')
      ->group(group);
  command
      ->add_option(
          only_option, arguments.selection.only_faces, "faces to texture: 3, 3-7, or a name")
      ->delimiter(',')
      ->group(group);
  command
      ->add_option("--masks",
                   arguments.selection.masks_folder,
                   "folder of masks (white = ignore), as s5.png")
      ->type_name("FOLDER")
      ->group(group);
  command->add_option("--format", arguments.format, "of the OBJ's pages; the GLB's are always JPEG")
      ->capture_default_str()
      ->check(CLI::IsMember({"jpg", "png", "tif", "exr"}))
      ->group(group);
  command
      ->add_option("--bits",
                   arguments.options.pages.bits,
                   "16: read photographs and write pages with 16 bits a channel (png, tif; exr)")
      ->capture_default_str()
      ->check(CLI::IsMember({8, 16}))
      ->group(group);
  command
      ->add_flag("--fill",
                 arguments.options.fill_gaps,
                 "paint over what no photograph shows; provenance says 65535 there")
      ->group(group);
  command
      ->add_flag(
          "--accepted-only", arguments.selection.accepted_only, "leave out photographs in review")
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

void KeepFreedMemory(int max_memory_mb) {
  const bool is_limited = max_memory_mb > 0;
  // The C library takes no threshold above 32 MB.
  mallopt(M_MMAP_THRESHOLD, is_limited ? 1 << 20 : 32 << 20);
  mallopt(M_TRIM_THRESHOLD, is_limited ? 1 << 20 : 256 << 20);
  mallopt(M_TOP_PAD, is_limited ? 128 << 10 : 16 << 20);
}

}  // namespace groundglass
