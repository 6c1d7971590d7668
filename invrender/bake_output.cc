// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_output.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/photograph_name.h"
#include "scene/formats/textured_model_io.h"
#include "scene/text.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace groundglass {
namespace {

// Photographs in review still show most things right; near equals win over them.
constexpr double kReviewWeight = 0.4;

BakePhotograph MakeBakePhotograph(const Photograph& photograph, const Camera& camera) {
  BakePhotograph bake;
  bake.name = photograph.name;
  bake.image_file = photograph.image_file;
  bake.camera = camera;
  bake.mask_file = photograph.mask_file;
  bake.faces_file = photograph.faces_file;
  return bake;
}

const Photograph* FindInScene(const Scene& scene, const std::string& name) {
  const std::optional<size_t> found = FindPhotograph(name, NamesOf(scene.photographs));
  return found ? &scene.photographs[*found] : nullptr;
}

// STEM_N.ext for N from `first` as long as there are any.
void RemoveFrom(const std::filesystem::path& folder,
                const std::string& stem,
                size_t first,
                const std::string& extension) {
  for (size_t i = first;; ++i) {
    std::error_code failure;
    if (!std::filesystem::remove(folder / (stem + std::to_string(i) + extension), failure)) break;
  }
}

}  // namespace

std::vector<BakePhotograph> SelectPhotographs(const Scene& scene,
                                              const std::vector<Registration>& registrations,
                                              bool accepted_only) {
  std::vector<BakePhotograph> selected;
  for (const Registration& registration : registrations) {
    if (!HasCorrection(registration.verdict)) continue;
    if (registration.verdict == Verdict::kReview && accepted_only) continue;
    const Photograph* photograph = FindInScene(scene, registration.name);
    if (!photograph) continue;
    selected.push_back(MakeBakePhotograph(*photograph, registration.CorrectedCamera()));
    if (registration.verdict == Verdict::kReview) selected.back().weight = kReviewWeight;
  }
  return selected;
}

std::vector<BakePhotograph> SelectPhotographs(const Scene& scene,
                                              const std::vector<NamedCamera>& cameras) {
  std::vector<BakePhotograph> selected;
  for (const NamedCamera& camera : cameras) {
    const Photograph* photograph = FindInScene(scene, camera.name);
    if (photograph) selected.push_back(MakeBakePhotograph(*photograph, camera.camera));
  }
  if (selected.empty()) {
    std::string which;
    if (!cameras.empty() && !scene.photographs.empty()) {
      which = ": the first camera is of " + Quote(cameras.front().name) +
              ", the first photograph is " + Quote(scene.photographs.front().name);
    }
    throw Error(scene.folder, "no photograph has the name of any of the cameras" + which);
  }
  return selected;
}

std::vector<BakePhotograph> SelectPhotographs(const Scene& scene) {
  std::vector<BakePhotograph> selected;
  for (const Photograph& photograph : scene.photographs) {
    selected.push_back(MakeBakePhotograph(
        photograph, CameraFromTag(photograph.tag, photograph.size.width, photograph.size.height)));
  }
  return selected;
}

void WriteBake(const BakeResult& result,
               const std::filesystem::path& out,
               const std::string& page_extension) {
  const TexturedModel& model = result.model;
  tbb::parallel_invoke(
      [&] {
        const JpegPages pages = EncodePages(model);
        WriteGlb(out / "model.glb", model, pages);
        WriteTexturedObj(out / "model.obj", model, page_extension, pages);
      },
      [&] {
        tbb::parallel_for(size_t{0}, model.pages.size(), [&](size_t i) {
          WriteLabels(out / ("provenance_" + std::to_string(i) + ".png"),
                      model.pages[i].provenance);
        });
      });
  for (const std::string extension : {".jpg", ".png", ".tif", ".exr"}) {
    RemoveFrom(out, "model_", extension == page_extension ? model.pages.size() : 0, extension);
  }
  RemoveFrom(out, "provenance_", model.pages.size(), ".png");
  WriteFileAtomically(out / "coverage.json", FormatCoverage(result.coverage));
}

std::vector<std::string> BakeFiles(const BakeResult& result, const std::string& page_extension) {
  std::vector<std::string> files = {"coverage.json", "model.glb", "model.mtl", "model.obj"};
  for (size_t i = 0; i < result.model.pages.size(); ++i) {
    files.push_back("model_" + std::to_string(i) + page_extension);
    files.push_back("provenance_" + std::to_string(i) + ".png");
  }
  return files;
}

std::function<void(const BakePhotograph&, const Image16&)> FaceMaskWriter(
    const std::filesystem::path& out) {
  return [out](const BakePhotograph& photograph, const Image16& numbers) {
    WriteLabels(out / "faces" / (photograph.name + ".png"), numbers);
  };
}

}  // namespace groundglass
