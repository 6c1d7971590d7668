// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"

#include "register/add_tracks.h"
#include "register/displaced_groups.h"
#include "register/notebook_overclaim.h"
#include "register/refine_set.h"
#include "register/shared_conflict.h"
#include "register/surveyed_tags_in_set.h"
#include "scene/error.h"
#include "scene/formats/ignore_mask.h"
#include "scene/formats/image_io.h"
#include "scene/formats/select_photographs.h"
#include "scene/formats/tag_corners.h"

#include <tbb/parallel_for.h>

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

// The tag stands as it was measured.
Registration RejectedRegistration(const Photograph& photograph, const std::string& reason) {
  Registration registration;
  registration.name = photograph.name;
  registration.width_px = photograph.size.width;
  registration.height_px = photograph.size.height;
  registration.reasons = {reason};
  registration.measured = photograph.tag;
  registration.corrected = photograph.tag;
  return registration;
}

// Reasons name files by their path from the scene's folder, which may lie anywhere.
Registration UnreadableRegistration(const Scene& scene,
                                    const std::string& name,
                                    std::vector<std::string> reasons) {
  const std::string folder = (scene.folder / "").string();
  for (std::string& reason : reasons) {
    if (reason.starts_with(folder)) reason.erase(0, folder.size());
  }
  Registration registration;
  registration.name = name;
  registration.verdict = Verdict::kUnreadable;
  registration.reasons = std::move(reasons);
  return registration;
}

std::vector<NamedTag> OtherTags(const Scene& scene, const Photograph& photograph) {
  std::vector<NamedTag> others;
  for (const Photograph& other : scene.photographs) {
    if (other.name != photograph.name) others.push_back({other.name, other.tag});
  }
  return others;
}

// The lens that serves a photograph: the one given, if it is of all cameras or of the tag's; else
// what the scene's folder has for it.
std::optional<Lens> LensOf(const Photograph& photograph, const std::optional<Lens>& given) {
  if (given && (given->name.empty() || given->name == photograph.tag.camera)) return given;
  return photograph.lens;
}

// One photograph that spoils its own alignment is news about it, and no end of the others' work.
PhotographAlignment AlignOrSayWhyNot(const Scene& scene,
                                     const Photograph& photograph,
                                     const std::optional<Lens>& lens,
                                     const EdgeModel& edge_model,
                                     const RegisterOptions& options) {
  PhotographInput input{photograph.name,
                        {},
                        {},
                        photograph.tag,
                        LensOf(photograph, lens),
                        OtherTags(scene, photograph),
                        !options.independent && options.displaced.most_trials > 0};
  try {
    input.grey8 = ReadGrey8(photograph.image_file);
    if (photograph.mask_file) input.ignore = ReadIgnoreMask(*photograph.mask_file, photograph.size);
  } catch (const Error& error) {
    return {UnreadableRegistration(scene, photograph.name, {error.what()})};
  }
  try {
    PhotographAlignment alignment = AlignPhotograph(input, edge_model, options);
    const Registration& found = alignment.registration;
    if (ParametersFromTag(found.corrected).allFinite() && found.covariance.allFinite()) {
      return alignment;
    }
    PhotographAlignment rejected{
        RejectedRegistration(photograph, "the solution for this photograph is not determined")};
    rejected.keep_fault = std::move(alignment.keep_fault);
    return rejected;
  } catch (const Error& error) {
    return {RejectedRegistration(photograph, error.what())};
  }
}

// Each photograph by itself, on every core.
std::vector<PhotographAlignment> AlignAll(const Scene& scene,
                                          const std::optional<Lens>& lens,
                                          const EdgeModel& edge_model,
                                          const RegisterOptions& options,
                                          const Progress& progress) {
  const int total = static_cast<int>(scene.photographs.size());
  std::vector<PhotographAlignment> alignments(scene.photographs.size());
  ProgressCounter steps(progress, total);
  tbb::parallel_for(0, total, [&](int index) {
    const Photograph& photograph = scene.photographs[index];
    alignments[index] = AlignOrSayWhyNot(scene, photograph, lens, edge_model, options);
    steps.Tell(photograph.name + " " +
               std::string(VerdictName(alignments[index].registration.verdict)));
  });
  return alignments;
}

// Aligns photographs anew where groups of the model's edges lie elsewhere, and warns of them.
void HeedDisplacedGroups(const Scene& scene,
                         const std::optional<Lens>& lens,
                         const RegisterOptions& options,
                         const Progress& progress,
                         EdgeModel& edge_model,
                         std::vector<PhotographAlignment>& alignments,
                         RegisteredScene& registered) {
  // What a trial hands on is not kept: it may be in vain.
  RegisterOptions unkept = options;
  unkept.keep_folder.clear();
  const std::vector<DisplacedGroup> displaced = FindDisplacedGroups(
      options.displaced,
      [&] { return AlignAll(scene, lens, edge_model, unkept, progress); },
      edge_model,
      alignments);
  if (displaced.empty()) return;
  for (const DisplacedGroup& group : displaced) {
    registered.warnings.push_back(DescribeDisplacedGroup(group, edge_model));
  }
  if (options.keep_folder.empty()) return;
  std::vector<PhotographAlignment> kept = AlignAll(scene, lens, edge_model, options, progress);
  for (size_t i = 0; i < kept.size(); ++i) {
    alignments[i].keep_fault = std::move(kept[i].keep_fault);
  }
}

// What calibration/ has of surveyed AprilTags; that it cannot be read is a warning.
std::vector<SeenTagCorner> TagCornersOf(const Scene& scene, std::vector<std::string>& warnings) {
  for (const std::filesystem::path& file : scene.lens_files) {
    if (file.filename() != kTagCornersFile) continue;
    try {
      return ReadTagCorners(file);
    } catch (const Error& error) {
      warnings.push_back(std::string("AprilTags are left out: ") + error.what());
    }
  }
  return {};
}

// What photographs share ties them together; what cannot be had of it is a warning.
void RefineWhatIsShared(const EdgeModel& edge_model,
                        const RegisterOptions& options,
                        const std::vector<SeenTagCorner>& tag_corners,
                        const Progress& progress,
                        std::vector<PhotographAlignment>& alignments,
                        RegisteredScene& registered) {
  registered.ties.patches = options.use_ties && options.ties.use_patches;
  if (options.use_ties && options.use_colmap) {
    ProgressCounter(progress, 1).Tell("what photographs share, as COLMAP finds it");
    try {
      registered.ties.colmap = AddColmapTracks(edge_model, options.colmap, alignments);
    } catch (const Error& error) {
      registered.warnings.push_back(std::string("COLMAP's matches are left out: ") + error.what());
    }
  }
  try {
    std::vector<MovedTag> moved_tags;
    std::vector<std::string> names;
    for (const PhotographAlignment& alignment : alignments) {
      names.push_back(alignment.registration.name);
    }
    registered.model_errors =
        FindModelErrors(edge_model,
                        RefineSet(edge_model, options, alignments, tag_corners, &moved_tags),
                        names,
                        options.model_errors);
    for (const MovedTag& tag : moved_tags) {
      registered.warnings.push_back(DescribeMovedTag(tag, UnitName(edge_model.model.unit)));
    }
  } catch (const Error& error) {
    registered.warnings.push_back(
        std::string("the photographs stay as they were found one by one, since they could not "
                    "be refined together: ") +
        error.what());
  }
}

}  // namespace

RegisteredScene RegisterScene(const Scene& scene,
                              const std::optional<Lens>& lens,
                              const RegisterOptions& given_options,
                              const Progress& progress) {
  RegisterOptions options = NamedAsInScene(given_options, scene);
  options.Check();
  EdgeModel edge_model(scene.model);
  std::vector<PhotographAlignment> alignments =
      AlignAll(scene, lens, edge_model, options, progress);
  RegisteredScene registered;
  if (!options.independent) {
    if (const auto overclaim = FindOverclaim(alignments, options.overclaim)) {
      registered.warnings.push_back(DescribeOverclaim(*overclaim));
      options.prior.overclaim = *overclaim;
      alignments = AlignAll(scene, lens, edge_model, options, progress);
    }
    HeedDisplacedGroups(scene, lens, options, progress, edge_model, alignments, registered);
    const std::vector<SeenTagCorner> tag_corners = TagCornersOf(scene, registered.warnings);
    RefineWhatIsShared(edge_model, options, tag_corners, progress, alignments, registered);
  }
  JudgeSharedConflict(options.conflict, alignments);
  for (PhotographAlignment& alignment : alignments) {
    FinishVerdict(options, alignment);
    if (!alignment.keep_fault.empty()) registered.warnings.push_back(alignment.keep_fault);
    registered.registrations.push_back(std::move(alignment.registration));
  }
  for (const UnreadablePhotograph& unreadable : scene.unreadable) {
    registered.registrations.push_back(
        UnreadableRegistration(scene, unreadable.photograph.name, unreadable.reasons));
  }
  return registered;
}

Registration RegisterPhotograph(const PhotographInput& photograph,
                                const EdgeModel& edge_model,
                                const RegisterOptions& options) {
  PhotographAlignment alignment = AlignPhotograph(photograph, edge_model, options);
  FinishVerdict(options, alignment);
  return std::move(alignment.registration);
}

}  // namespace groundglass
