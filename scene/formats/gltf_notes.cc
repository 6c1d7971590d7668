// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_notes.h"

#include "scene/face_number.h"

#include <algorithm>

namespace groundglass {

void WriteGltfNotes(const PolygonModel& model, tinygltf::Model& gltf) {
  tinygltf::Value::Object notes;
  notes["groundglass_unit"] = tinygltf::Value(UnitName(model.unit));
  if (model.sigma) notes["groundglass_sigma"] = tinygltf::Value(*model.sigma);
  if (model.georeference) {
    const Georeference& place = *model.georeference;
    notes["groundglass_origin"] =
        tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(place.latitude_deg),
                                               tinygltf::Value(place.longitude_deg),
                                               tinygltf::Value(place.height_m),
                                               tinygltf::Value(place.north_deg)});
  }
  gltf.asset.extras = tinygltf::Value(notes);
}

void ReadGltfNotes(const tinygltf::Model& gltf, PolygonModel& model) {
  const tinygltf::Value& notes = gltf.asset.extras;
  if (notes.IsObject() && notes.Has("groundglass_unit")) {
    const tinygltf::Value& unit = notes.Get("groundglass_unit");
    if (unit.IsString()) model.unit = FindUnit(unit.Get<std::string>()).value_or(model.unit);
  }
  if (notes.IsObject() && notes.Has("groundglass_origin")) {
    const tinygltf::Value& origin = notes.Get("groundglass_origin");
    if (origin.IsArray() && origin.ArrayLen() == 4) {
      model.georeference = Georeference{origin.Get(0).GetNumberAsDouble(),
                                        origin.Get(1).GetNumberAsDouble(),
                                        origin.Get(2).GetNumberAsDouble(),
                                        origin.Get(3).GetNumberAsDouble()};
    }
  }
  if (notes.IsObject() && notes.Has("groundglass_sigma")) {
    const tinygltf::Value& sigma = notes.Get("groundglass_sigma");
    if (sigma.IsNumber() && sigma.GetNumberAsDouble() > 0) {
      model.sigma = sigma.GetNumberAsDouble();
    }
  }
}

void WriteGltfPolygons(const PolygonModel& model,
                       const std::vector<int>& faces,
                       tinygltf::Primitive& primitive) {
  tinygltf::Value::Array places;
  tinygltf::Value::Array numbers;
  tinygltf::Value::Array corner_counts;
  tinygltf::Value::Array names;
  for (const int index : faces) {
    const Face& face = model.faces[static_cast<size_t>(index)];
    places.push_back(tinygltf::Value(index));
    numbers.push_back(tinygltf::Value(FaceNumber(model, index)));
    corner_counts.push_back(tinygltf::Value(static_cast<int>(face.points.size())));
    names.push_back(tinygltf::Value(face.name));
  }
  tinygltf::Value::Object notes;
  notes["groundglass_faces"] = tinygltf::Value(places);
  // The faces' numbers in the model's file, where some of its faces are left out.
  if (!FormatFaceNumbers(model).empty()) notes["groundglass_numbers"] = tinygltf::Value(numbers);
  notes["groundglass_corners"] = tinygltf::Value(corner_counts);
  notes["groundglass_names"] = tinygltf::Value(names);
  primitive.extras = tinygltf::Value(notes);
}

std::optional<std::vector<GltfPolygon>> ReadGltfPolygons(const tinygltf::Primitive& primitive,
                                                         size_t num_vertices) {
  const tinygltf::Value& notes = primitive.extras;
  if (!notes.IsObject() || !notes.Has("groundglass_faces") || !notes.Has("groundglass_corners") ||
      !notes.Has("groundglass_names")) {
    return std::nullopt;
  }
  const tinygltf::Value& faces = notes.Get("groundglass_faces");
  const tinygltf::Value& corners = notes.Get("groundglass_corners");
  const tinygltf::Value& names = notes.Get("groundglass_names");
  if (!faces.IsArray() || !corners.IsArray() || !names.IsArray() ||
      faces.ArrayLen() != corners.ArrayLen() || faces.ArrayLen() != names.ArrayLen()) {
    return std::nullopt;
  }
  const tinygltf::Value* numbers = nullptr;  // in the model's file, if they are not the places
  if (notes.Has("groundglass_numbers") && notes.Get("groundglass_numbers").IsArray() &&
      notes.Get("groundglass_numbers").ArrayLen() == faces.ArrayLen()) {
    numbers = &notes.Get("groundglass_numbers");
  }
  size_t sum = 0;
  for (size_t i = 0; i < faces.ArrayLen(); ++i) {
    const int count = corners.Get(i).GetNumberAsInt();
    if (count < 3 || !names.Get(i).IsString()) return std::nullopt;
    sum += static_cast<size_t>(count);
    if (sum > num_vertices) return std::nullopt;
  }
  if (sum != num_vertices) return std::nullopt;
  std::vector<GltfPolygon> polygons;
  int next = 0;
  for (size_t i = 0; i < faces.ArrayLen(); ++i) {
    GltfPolygon& polygon = polygons.emplace_back();
    polygon.corners.resize(static_cast<size_t>(corners.Get(i).GetNumberAsInt()));
    for (int& corner : polygon.corners) corner = next++;
    polygon.name = names.Get(i).Get<std::string>();
    polygon.place = faces.Get(i).GetNumberAsInt();
    const bool has_number = numbers != nullptr && numbers->Get(i).GetNumberAsInt() > 0;
    polygon.number = has_number ? numbers->Get(i).GetNumberAsInt() : std::max(polygon.place, 0) + 1;
  }
  return polygons;
}

}  // namespace groundglass
