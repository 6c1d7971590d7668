// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_sources.h"

#include "scene/coverage.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/image_io.h"
#include "scene/formats/output_folder.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/registration_io.h"
#include "scene/registration.h"
#include "scene/text.h"

#include <algorithm>
#include <map>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// The names of masks are files', which some systems write in another Unicode form than was asked
// for.
std::vector<PhotographName> MaskNames(const std::vector<std::string>& photographs) {
  std::vector<PhotographName> names;
  for (const std::string& name : photographs) names.push_back({name, ""});
  return names;
}

// By the photographs' places in the list; those of others are left out.
std::map<size_t, Registration> ReadRegistrationsOf(const fs::path& folder,
                                                   const std::vector<PhotographName>& names) {
  std::map<size_t, Registration> registrations;
  if (!fs::exists(folder / "registration.json")) return registrations;
  for (Registration& registration : ReadRegistrations(folder / "registration.json")) {
    const std::optional<size_t> place = FindPhotograph(registration.name, names);
    if (place) registrations[*place] = std::move(registration);
  }
  return registrations;
}

std::vector<Image16> ReadProvenance(const fs::path& folder,
                                    const TexturedModel& textured,
                                    size_t num_photographs) {
  std::vector<Image16> pages;
  for (size_t i = 0; i < textured.pages.size(); ++i) {
    const fs::path file = folder / ("provenance_" + std::to_string(i) + ".png");
    pages.push_back(ReadLabels(file));
    const Image8& colours = textured.pages[i].srgb8;
    if (pages.back().width != colours.width || pages.back().height != colours.height) {
      throw Error(file, "has another size than the model's texture page; run again");
    }
    for (const uint16_t number : pages.back().values) {
      if (number != kProvenanceFilled && number > num_photographs) {
        throw Error(file,
                    "names photograph " + std::to_string(number) + ", but faces/ has " +
                        std::to_string(num_photographs) + "; run again");
      }
    }
  }
  return pages;
}

Eigen::Vector3d MiddleOfFace(const PolygonModel& model, int face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int point : model.faces[face].points) sum += model.points_in_world[point];
  return sum / static_cast<double>(model.faces[face].points.size());
}

// The tangent of the angle at which a place is seen.
double SlantOf(const Eigen::Vector3d& normal, const Eigen::Vector3d& to_camera) {
  const double along = std::abs(normal.dot(to_camera));
  return (to_camera - normal.dot(to_camera) * normal).norm() / std::max(along, 1e-9);
}

}  // namespace

const DrawnSource* DrawingSources::Find(int face, int photograph) const {
  if (face >= static_cast<int>(faces.size())) return nullptr;
  for (const DrawnSource& source : faces[face]) {
    if (source.photograph == photograph) return &source;
  }
  return nullptr;
}

DrawingSources ReadDrawingSources(const fs::path& folder,
                                  const TexturedModel& textured,
                                  bool needs_provenance) {
  const PolygonModel& model = textured.model;
  DrawingSources sources;
  sources.photographs = NumberedPhotographs(folder);
  sources.faces.resize(model.faces.size());
  const std::vector<PhotographName> names = MaskNames(sources.photographs);
  const std::map<size_t, Registration> registrations = ReadRegistrationsOf(folder, names);
  const std::optional<Coverage> coverage = ReadCoverage(folder / "coverage.json");
  for (const FaceCoverage& covered : coverage ? coverage->faces : std::vector<FaceCoverage>()) {
    const std::optional<int> face = FindFaceByNumber(model, covered.number);
    if (!face) continue;
    const Eigen::Vector3d normal = ComputeFacePlane(model, *face).normal_in_world;
    for (const FaceCoverage::Source& each : covered.sources) {
      const std::optional<size_t> place = FindPhotograph(each.photograph, names);
      if (!place) continue;
      DrawnSource source;
      source.photograph = static_cast<int>(*place);
      source.texels = static_cast<double>(each.num_texels);
      source.footprint = each.footprint;
      const auto known = registrations.find(*place);
      if (known != registrations.end() && HasCorrection(known->second.verdict)) {
        source.camera_sigma = known->second.vertex_sigma_px * each.footprint;
        source.slant = SlantOf(
            normal, known->second.CorrectedCamera().PositionInWorld() - MiddleOfFace(model, *face));
      }
      sources.faces[*face].push_back(source);
    }
  }
  if (fs::exists(folder / "provenance_0.png")) {
    sources.provenance = ReadProvenance(folder, textured, sources.photographs.size());
  } else if (needs_provenance) {
    throw Error(folder, "has no provenance_0.png, so layers cannot be drawn; run again");
  }
  return sources;
}

}  // namespace groundglass
