// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_scene.h"

#include "register/refine_accepted.h"
#include "register/select_photographs.h"
#include "scene/ignore_mask.h"
#include "scene/image_io.h"

#include <tbb/parallel_for.h>

#include <mutex>

namespace groundglass {
namespace {

// The options with photographs called as the scene calls them.
RegisterOptions NamedAsInScene(RegisterOptions options, const Scene& scene) {
  for (std::string& name : options.overrule.accept) name = NameInScene(name, scene);
  for (std::string& name : options.overrule.reject) name = NameInScene(name, scene);
  for (ControlPoint& point : options.control_points) {
    point.photograph = NameInScene(point.photograph, scene);
  }
  return options;
}

}  // namespace

RegisteredScene RegisterScene(const Scene& scene,
                              const std::optional<Lens>& lens,
                              const RegisterOptions& given_options,
                              const Progress& progress) {
  const RegisterOptions options = NamedAsInScene(given_options, scene);
  options.Check();
  const EdgeModel edge_model(scene.model);
  const int total = static_cast<int>(scene.photographs.size());
  std::vector<PhotographAlignment> alignments(scene.photographs.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(0, total, [&](int index) {
    const Photograph& photograph = scene.photographs[index];
    alignments[index] = AlignPhotograph(
        photograph.name,
        ReadGrey8(photograph.image_file),
        photograph.mask_file ? ReadIgnoreMask(*photograph.mask_file, photograph.size) : Image8(),
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
