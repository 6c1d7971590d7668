// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/tiles1988/tiles.h"

#include "invrender/photos/face_mask.h"
#include "invrender/photos/prepared_photo.h"
#include "invrender/photos/srgb_codes.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

namespace groundglass {
namespace {

int PixelsAlongSide(const TileOptions& options) {
  int side = 1;
  while (side * side < options.downsample) ++side;
  return side;
}

// The camera of a photograph whose pixels are `side` times as long; what is left over at the right
// and below is cut off.
Camera CameraOfWholeBlocks(const Camera& camera, int side) {
  Camera coarse = camera;
  coarse.width_px /= side;
  coarse.height_px /= side;
  coarse.focal_x_px /= side;
  coarse.focal_y_px /= side;
  coarse.center_x_px /= side;
  coarse.center_y_px /= side;
  return coarse;
}

// One value for each block of pixels: the one that they all have, else `mixed`.
template <typename Code>
Raster<Code> Unanimous(const Raster<Code>& fine, int side, Code mixed) {
  Raster<Code> coarse(fine.width / side, fine.height / side, 1);
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      const Code first = *fine.At(side * x, side * y);
      bool agree = true;
      for (int i = 0; i < side * side; ++i) {
        agree = agree && *fine.At(side * x + i % side, side * y + i / side) == first;
      }
      *coarse.At(x, y) = agree ? first : mixed;
    }
  }
  return coarse;
}

// Which face each coarse pixel shows, from 1; 0 also where the photograph's mask says to ignore it.
Image16 MakeTileLabels(const PolygonModel& model,
                       const Visibility& visibility,
                       const BakePhotograph& photograph,
                       int side) {
  Image16 labels;
  if (photograph.faces_file) {
    const Image16 painted = ReadLabels(*photograph.faces_file);
    CheckFitsCamera(*photograph.faces_file, painted.width, painted.height, photograph.camera);
    labels =
        Unanimous(LabelsFromNumbers(model, painted, *photograph.faces_file), side, uint16_t{0});
  } else {
    labels = MakeFaceMask(model, visibility, CameraOfWholeBlocks(photograph.camera, side));
  }
  if (photograph.mask_file) {
    const Image8 mask = ReadIgnoreMask(*photograph.mask_file,
                                       {photograph.camera.width_px, photograph.camera.height_px});
    const Image8 ignored = Unanimous(mask, side, uint8_t{255});
    for (size_t i = 0; i < labels.values.size(); ++i) {
      if (ignored.values[i] != 0) labels.values[i] = 0;
    }
  }
  return labels;
}

// The photograph with `side` x `side` pixels averaged into one, as sRGB codes from 0 to 1.
ImageF ReadCoarse(const BakePhotograph& photograph, int side) {
  const Image8 fine = ReadSrgb8(photograph.image_file);
  CheckFitsCamera(photograph.image_file, fine.width, fine.height, photograph.camera);
  const float* radiance = RadianceOfCodes<uint8_t>();
  ImageF coarse(fine.width / side, fine.height / side, 3);
  tbb::parallel_for(0, coarse.height, [&](int y) {
    for (int x = 0; x < coarse.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int i = 0; i < side * side; ++i) {
          sum += radiance[fine.At(side * x + i % side, side * y + i / side)[c]];
        }
        coarse.At(x, y)[c] = SrgbFromLinear(sum / static_cast<float>(side * side));
      }
    }
  });
  return coarse;
}

}  // namespace

void TileOptions::Check() const {
  if (downsample == 1 || downsample == 4 || downsample == 9 || downsample == 16) return;
  throw Error("downsample must be 1, 4, 9 or 16");
}

std::vector<std::vector<int>> PairFacesWithPhotographs(const PolygonModel& model,
                                                       std::span<const BakePhotograph> photographs,
                                                       const TileOptions& options) {
  options.Check();
  const Visibility visibility(model);
  const int side = PixelsAlongSide(options);
  std::vector<double> most(model.faces.size(), 0);
  std::vector<int> photo_of_face(model.faces.size(), -1);
  for (size_t photo = 0; photo < photographs.size(); ++photo) {
    const BakePhotograph& photograph = photographs[photo];
    std::vector<double> num_pixels(model.faces.size(), 0);
    for (const uint16_t label : MakeTileLabels(model, visibility, photograph, side).values) {
      if (label > 0 && label <= num_pixels.size()) num_pixels[label - 1] += photograph.weight;
    }
    const auto try_face = [&](int face) {
      if (num_pixels[face] <= most[face]) return;
      most[face] = num_pixels[face];
      photo_of_face[face] = static_cast<int>(photo);
    };
    if (photograph.faces) {
      for (const int face : *photograph.faces) try_face(face);
    } else {
      for (size_t face = 0; face < num_pixels.size(); ++face) try_face(static_cast<int>(face));
    }
  }
  std::vector<std::vector<int>> faces(photographs.size());
  for (size_t face = 0; face < photo_of_face.size(); ++face) {
    if (photo_of_face[face] >= 0) faces[photo_of_face[face]].push_back(static_cast<int>(face));
  }
  return faces;
}

void MakeTiles(const PolygonModel& model,
               const Visibility& visibility,
               const BakePhotograph& photograph,
               std::span<const int> faces,
               const TileOptions& options,
               const TileSink& sink) {
  constexpr int kBandRows = 64;
  options.Check();
  if (faces.empty()) return;
  const int side = PixelsAlongSide(options);
  const Camera camera = CameraOfWholeBlocks(photograph.camera, side);
  const Image16 labels = MakeTileLabels(model, visibility, photograph, side);
  const ImageF codes = ReadCoarse(photograph, side);
  std::vector<std::optional<FacePlane>> planes(model.faces.size());
  for (const int face : faces) planes[face] = ComputeFacePlane(model, face);
  const Eigen::Vector3d eye = camera.PositionInWorld();

  // False for a face that is seen edge-on or from behind, as one painted by hand may be.
  const auto place = [&](int x, int y, const FacePlane& plane, TileCorner& corner) {
    const Eigen::Vector3d ray = UnprojectToWorld(camera, {x + 0.5, y + 0.5});
    const double towards = plane.normal_in_world.dot(ray);
    const double distance = (plane.offset - plane.normal_in_world.dot(eye)) / towards;
    const Eigen::Vector3f site = SiteFromWorld(eye + distance * ray).cast<float>();
    const float* rgb = codes.At(x, y);
    corner = {site.x(), site.y(), site.z(), rgb[0], rgb[1], rgb[2]};
    return towards < 0 && distance > 0;
  };
  for (int y0 = 0; y0 + 1 < labels.height; y0 += kBandRows) {
    const int num_rows = std::min(kBandRows, labels.height - 1 - y0);
    std::vector<std::vector<Tile>> rows(num_rows);
    tbb::parallel_for(0, num_rows, [&](int row) {
      const int y = y0 + row;
      for (int x = 0; x + 1 < labels.width; ++x) {
        const uint16_t label = *labels.At(x, y);
        if (label == 0 || label > planes.size() || !planes[label - 1]) continue;
        if (*labels.At(x + 1, y) != label || *labels.At(x + 1, y + 1) != label ||
            *labels.At(x, y + 1) != label) {
          continue;
        }
        const FacePlane& plane = *planes[label - 1];
        Tile tile;
        auto& [top_left, top_right, bottom_right, bottom_left] = tile.corners;
        if (place(x, y, plane, top_left) && place(x + 1, y, plane, top_right) &&
            place(x + 1, y + 1, plane, bottom_right) && place(x, y + 1, plane, bottom_left)) {
          rows[row].push_back(tile);
        }
      }
    });
    for (const std::vector<Tile>& row : rows) sink(row);
  }
}

}  // namespace groundglass
