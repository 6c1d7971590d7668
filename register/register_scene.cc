// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_scene.h"

#include "register/refine_accepted.h"
#include "scene/error.h"
#include "scene/image_io.h"

#include <tbb/parallel_for.h>

#include <mutex>

namespace groundglass {
namespace {

// The photograph's mask as registration takes it, 1 channel; empty if there is none.
Image8 ReadIgnoreMask(const Photograph& photograph) {
  if (!photograph.mask_file) return {};
  const Image16 codes = ReadLabels(*photograph.mask_file);
  if (codes.width != photograph.size.width || codes.height != photograph.size.height) {
    throw Error(*photograph.mask_file,
                "mask is " + std::to_string(codes.width) + "x" + std::to_string(codes.height) +
                    ", but its photograph is " + std::to_string(photograph.size.width) + "x" +
                    std::to_string(photograph.size.height));
  }
  Image8 ignore(codes.width, codes.height, 1);
  for (size_t i = 0; i < codes.values.size(); ++i) ignore.values[i] = codes.values[i] >= 128;
  return ignore;
}

}  // namespace

RegisteredScene RegisterScene(const Scene& scene,
                              const std::optional<Lens>& lens,
                              const RegisterOptions& options,
                              const Progress& progress) {
  options.Check();
  const EdgeModel edge_model(scene.model);
  const int total = static_cast<int>(scene.photographs.size());
  std::vector<PhotographAlignment> alignments(scene.photographs.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(0, total, [&](int index) {
    const Photograph& photograph = scene.photographs[index];
    alignments[index] = AlignPhotograph(photograph.name,
                                        ReadGrey8(photograph.image_file),
                                        ReadIgnoreMask(photograph),
                                        photograph.tag,
                                        lens,
                                        edge_model,
                                        options);
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) {
      progress(
          done,
          total,
          photograph.name + " " + std::string(VerdictName(alignments[index].registration.verdict)));
    }
  });
  RegisteredScene registered;
  if (!options.independent) {
    registered.model_errors = FindModelErrors(
        edge_model, RefineAccepted(edge_model, options, alignments), options.model_errors);
  }
  for (PhotographAlignment& alignment : alignments) {
    FinishVerdict(options, alignment);
    registered.registrations.push_back(std::move(alignment.registration));
  }
  return registered;
}

}  // namespace groundglass
