// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/montage.h"

#include "scene/check_option.h"
#include "scene/quantile.h"
#include "scene/srgb.h"
#include "viewer/montage_model.h"
#include "viewer/renderer.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace groundglass {
namespace {

void CheckSizes(const MontagePhotograph& photograph) {
  const auto check = [&](int width, int height, const std::string& what) {
    if (width == photograph.srgb8.width && height == photograph.srgb8.height) return;
    throw Error("montage: the " + what + " is for a picture of " + std::to_string(width) + " x " +
                std::to_string(height) + ", and the photograph has " +
                std::to_string(photograph.srgb8.width) + " x " +
                std::to_string(photograph.srgb8.height));
  };
  check(photograph.camera.width_px, photograph.camera.height_px, "camera");
  if (photograph.mask != nullptr) {
    check(photograph.mask->width, photograph.mask->height, "mask");
  }
}

// Faces are told apart by labels of 16 bits.
void CheckNumFaces(const PolygonModel& model, const std::string& what) {
  constexpr size_t kMostFaces = 65535;
  if (model.faces.size() <= kMostFaces) return;
  throw Error(
      "montage: the " + what + " has " + std::to_string(model.faces.size()) +
      " faces; no more than 65535 can be drawn: leave out what is not seen, or join triangles");
}

bool IsMasked(const MontagePhotograph& photograph, int x, int y) {
  return photograph.mask != nullptr && *photograph.mask->At(x, y) != 0;
}

// The faces to be drawn.
std::vector<int> ChooseFaces(const PolygonModel& design,
                             const std::vector<bool>& is_repeated,
                             bool new_parts_only) {
  std::vector<int> faces;
  for (int face = 0; face < static_cast<int>(design.faces.size()); ++face) {
    if (!new_parts_only || !is_repeated[face]) faces.push_back(face);
  }
  if (!faces.empty()) return faces;
  throw Error(
      "montage: every face of the design lies on the building, so it has no new parts; "
      "draw it without --new-parts, or give the model that has them");
}

// Pixels of one face of the building, of the photograph and of what else shows it.
struct FacePixels {
  std::vector<std::array<float, 3>> seen;
  std::vector<std::array<float, 3>> on_texture;
  std::vector<std::array<float, 3>> in_design;
};

std::array<float, 3> LinearPixel(const Image8& srgb8, int x, int y) {
  const uint8_t* code = srgb8.At(x, y);
  const std::array<float, 256>& linear = LinearOfSrgb8();
  return {linear[code[0]], linear[code[1]], linear[code[2]]};
}

Eigen::Vector3d MedianColour(const std::vector<std::array<float, 3>>& pixels) {
  Eigen::Vector3d median;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> channel;
    channel.reserve(pixels.size());
    for (const std::array<float, 3>& pixel : pixels) channel.push_back(pixel[c]);
    median[c] = UpperMedian(std::move(channel));
  }
  return median;
}

// Away from borders, where neighbours and errors of the model mix in.
bool IsInside(const Image16& labels, int x, int y, int border_px) {
  if (x < border_px || y < border_px || x + border_px >= labels.width ||
      y + border_px >= labels.height) {
    return false;
  }
  const uint16_t label = *labels.At(x, y);
  return label != 0 && *labels.At(x - border_px, y) == label &&
         *labels.At(x + border_px, y) == label && *labels.At(x, y - border_px) == label &&
         *labels.At(x, y + border_px) == label;
}

// How the photograph shows each face of the building, beside how its texture and the design have
// it. is_repeated: of the design's faces.
std::vector<FaceSighting> SightFaces(const MontagePhotograph& photograph,
                                     const TexturedModel& building,
                                     const TexturedModel& design,
                                     const std::vector<bool>& is_repeated,
                                     const MontageLightOptions& options) {
  Renderer building_renderer(building);
  const Image16 labels = building_renderer.RenderLabels(photograph.camera);
  const Image8 texture = building_renderer.Render(photograph.camera);
  Image16 design_labels(labels.width, labels.height, 1);
  Image8 design_picture;
  if (std::find(is_repeated.begin(), is_repeated.end(), true) != is_repeated.end()) {
    std::vector<int> all(design.model.faces.size());
    std::iota(all.begin(), all.end(), 0);
    // Only faces with a colour of their own tell the light.
    Renderer design_renderer(DesignToDraw(design, all, photograph.camera, 0));
    design_labels = design_renderer.RenderLabels(photograph.camera);
    design_picture = design_renderer.Render(photograph.camera);
  }

  std::vector<FacePixels> pixels(building.model.faces.size());
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (!IsInside(labels, x, y, options.border_px) || IsMasked(photograph, x, y)) continue;
      const uint8_t* code = photograph.srgb8.At(x, y);
      const auto [least, most] = std::minmax({code[0], code[1], code[2]});
      if (least < options.darkest_code || most > options.brightest_code) continue;
      FacePixels& face = pixels[*labels.At(x, y) - 1];
      face.seen.push_back(LinearPixel(photograph.srgb8, x, y));
      face.on_texture.push_back(LinearPixel(texture, x, y));
      const uint16_t design_label = *design_labels.At(x, y);
      if (design_label != 0 && is_repeated[design_label - 1]) {
        face.in_design.push_back(LinearPixel(design_picture, x, y));
      }
    }
  }
  std::vector<FaceSighting> sightings;
  for (size_t face = 0; face < pixels.size(); ++face) {
    const FacePixels& found = pixels[face];
    if (static_cast<int>(found.seen.size()) < options.least_pixels) continue;
    FaceSighting& sighting = sightings.emplace_back();
    sighting.normal_in_world =
        ComputeFacePlane(building.model, static_cast<int>(face)).normal_in_world;
    sighting.num_pixels = static_cast<int>(found.seen.size());
    sighting.seen = MedianColour(found.seen);
    if (!building.faces.empty() && building.faces[face].page >= 0) {
      sighting.on_texture = MedianColour(found.on_texture);
    }
    // What is in front of the face in the design tells nothing of the face.
    if (static_cast<double>(found.in_design.size()) >=
        options.least_in_design * static_cast<double>(found.seen.size())) {
      sighting.in_design = MedianColour(found.in_design);
    }
  }
  return sightings;
}

// The design's reflectance and the light on it, hidden by the building: sRGB with alpha.
struct Layers {
  Image8 albedo;
  Image8 light;
  double light_scale = 1;
};

Layers DrawLayers(const MontagePhotograph& photograph,
                  const TexturedModel& building,
                  const TexturedModel& to_draw,
                  const MontageLight& light,
                  double same_place,
                  const MontageOptions& options,
                  std::vector<std::string>& warnings) {
  RenderOptions render;
  render.background = Background::kTransparent;
  render.supersampling = options.supersampling;
  const auto hidden = [&](TexturedModel model) {
    return HiddenByBuilding(std::move(model), building.model, photograph.camera, same_place);
  };
  Layers layers;
  layers.light_scale = std::max(1e-6, BrightestLight(to_draw, light));
  Renderer renderer(hidden(to_draw));
  warnings = renderer.Warnings();
  layers.albedo = renderer.Render(photograph.camera, render);
  // One value for each face: nothing to be sought along the line of sight.
  render.anisotropy = 1;
  layers.light = Renderer(hidden(LightToDraw(to_draw, light, layers.light_scale)))
                     .Render(photograph.camera, render);
  return layers;
}

// The design's light, linear, and how much of each pixel it covers, by which the light is
// multiplied; 4 channels. The mask's border is as it was painted, by whole pixels.
ImageF LayerOf(const MontagePhotograph& photograph, const Layers& layers) {
  ImageF layer(photograph.srgb8.width, photograph.srgb8.height, 4);
  for (int y = 0; y < layer.height; ++y) {
    for (int x = 0; x < layer.width; ++x) {
      const float cover = layers.albedo.At(x, y)[3] / 255.0f;
      if (cover <= 0 || IsMasked(photograph, x, y)) continue;
      const std::array<float, 3> albedo = LinearPixel(layers.albedo, x, y);
      const std::array<float, 3> light = LinearPixel(layers.light, x, y);
      for (int c = 0; c < 3; ++c) {
        layer.At(x, y)[c] = cover * albedo[c] * light[c] * static_cast<float>(layers.light_scale);
      }
      layer.At(x, y)[3] = cover;
    }
  }
  return layer;
}

void Blur(double blur_px, ImageF& layer) {
  if (blur_px <= 0) return;
  cv::Mat values(layer.height, layer.width, CV_32FC4, layer.values.data());
  cv::GaussianBlur(values, values, {0, 0}, blur_px, blur_px, cv::BORDER_REPLICATE);
}

// Lays the design over the photograph in linear light, with grain in codes, as film has it.
void Compose(const MontagePhotograph& photograph,
             const ImageF& layer,
             const PhotoGrain& grain,
             Montage& montage) {
  const Image8& photo = photograph.srgb8;
  montage.srgb8 = photo;
  montage.cover = ImageF(photo.width, photo.height, 1);
  const ImageF laid = LayGrain(grain, photo.width, photo.height, 1986);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const float* design = layer.At(x, y);
      const float cover = design[3];
      // What a blur leaves far outside is no design.
      if (cover < 1.0f / 512) continue;
      *montage.cover.At(x, y) = cover;
      const std::array<float, 3> behind = LinearPixel(photo, x, y);
      std::array<float, 3> codes = {};
      for (int c = 0; c < 3; ++c) {
        codes[c] = 255 * SrgbFromLinear(design[c] + (1 - cover) * behind[c]);
      }
      const auto sigma = static_cast<float>(grain.SigmaAt(Luma(codes[0], codes[1], codes[2])));
      for (int c = 0; c < 3; ++c) {
        const float code = codes[c] + cover * sigma * laid.At(x, y)[c];
        montage.srgb8.At(x, y)[c] = static_cast<uint8_t>(std::clamp(code, 0.0f, 255.0f) + 0.5f);
      }
    }
  }
}

}  // namespace

void MontageOptions::Check() const {
  CheckFromTo(same_place_share, 1e-6, 0.1, "montage options: same_place_share");
  CheckFromTo(exposure_stops, -10, 10, "montage options: exposure_stops");
  CheckFromTo(plain_albedo, 0.01, 1, "montage options: plain_albedo");
  CheckFromTo(supersampling, 1, 4, "montage options: supersampling");
  CheckFromTo(blur_px, 0, 20, "montage options: blur_px");
  light.Check();
  photo_grain.Check();
}

Montage DrawMontage(const MontagePhotograph& photograph,
                    const TexturedModel& building,
                    const TexturedModel& design,
                    const MontageOptions& options) {
  options.Check();
  CheckSizes(photograph);
  CheckNumFaces(building.model, "building");
  CheckNumFaces(design.model, "design");
  const double same_place = options.same_place_share * ComputeBounds(building.model).Diagonal();
  const std::vector<bool> is_repeated =
      FindRepeatedFaces(design.model, Visibility(building.model), same_place);
  const std::vector<int> faces = ChooseFaces(design.model, is_repeated, options.new_parts_only);

  Montage montage;
  montage.num_faces = static_cast<int>(faces.size());
  montage.light = FitMontageLight(
      SightFaces(photograph, building, design, is_repeated, options.light), options.light);
  montage.light.gain *= std::exp2(options.exposure_stops);
  PhotoGrain grain;
  if (options.grain) grain = MeasurePhotoGrain(photograph.srgb8, options.photo_grain);
  montage.grain_sigma = grain.SigmaAt(128);

  const TexturedModel to_draw =
      DesignToDraw(design, faces, photograph.camera, options.plain_albedo);
  const Layers layers = DrawLayers(
      photograph, building, to_draw, montage.light, same_place, options, montage.warnings);
  ImageF layer = LayerOf(photograph, layers);
  Blur(options.blur_px, layer);
  Compose(photograph, layer, grain, montage);
  return montage;
}

}  // namespace groundglass
