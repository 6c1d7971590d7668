// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"
#include "register/register_options.h"
#include "scene/formats/lens.h"
#include "scene/formats/scene_folder.h"
#include "scene/progress.h"
#include "scene/registration.h"
#include "scene/tie_use.h"

#include <optional>
#include <string>
#include <vector>

// Registration: from the tags in a notebook to the cameras that took the photographs. The stages,
// in order, each in a floor of its own (a file includes its own floor and those above it here):
//
//   camera/   MakeCameraPrior           tag, sigmas, lens        -> prior over 11 free numbers
//             ConditionOnControlPoints  what a person pointed at -> a narrower prior
//   edges/    EdgeEvidence              photograph, mask         -> gradients at every scale
//             SampleVisibleEdges        model, camera            -> samples along edges it sees
//             FindCandidateSamples      samples, evidence        -> where in the picture each is
//             FindEdgeGroups            model                    -> edges that are off as one
//   search/   FindHypotheses            samples, evidence, prior -> starts over the whole prior
//             ScoreAlignment            samples, evidence        -> how much speaks for a camera
//             FindEdgeConflict          samples, a camera        -> parts that want another camera
//   refine/   RefinePhotograph          a start                  -> the best camera near it
//             FindSolutions, FindSecondBest  the three above          -> solutions, best first
//             FindGroupProfiles         a solution, groups       -> how it suits groups elsewhere
//   ties/     MatchWithColmap           pictures, pairs of them  -> keypoints that match (if asked)
//             FollowMatches             matches                  -> tracks through photographs
//             FindTies                  cameras found so far     -> what photographs show alike
//             MeasureTieSupport         tie points, a camera     -> how much others speak for it
//   joint/    RefineTogether            photographs, tie points  -> cameras, lenses, model's edges
//             FindModelErrors           displaced edges          -> lines that the model has wrong
//   verdict/  Judge...                  score, change, precision -> accepted, review, rejected, why
//
// AlignPhotograph runs them for one photograph. FindOverclaim and FindDisplacedGroups may have all
// photographs aligned anew, up to seven times in all: with wider sigmas, or parts of the model
// elsewhere. RefineSet is for all of them together; RegisterScene does all of this.
namespace groundglass {

struct RegisteredScene {
  std::vector<Registration> registrations;  // in the scene's order, then those it calls unreadable
  std::vector<ModelError> model_errors;     // none if the photographs stay alone
  std::vector<std::string> warnings;        // lines for a person
  TieUse ties;                              // what tied photographs together, if anything did
};

// Corrects the tags of a scene's photographs, on every core: each by itself, then those that are
// accepted together (AddColmapTracks if asked, RefineSet), unless options.independent. The same
// whatever the number of threads. Reads the photographs and their masks; one that cannot be read,
// or whose solution fails, gets a verdict with the reason. If the common solution fails, each
// photograph's own is kept, with a warning.
RegisteredScene RegisterScene(const Scene& scene,
                              const std::optional<Lens>& lens,
                              const RegisterOptions& options,
                              const Progress& progress);

// One photograph by itself, with its verdict finished (AlignPhotograph, FinishVerdict).
Registration RegisterPhotograph(const PhotographInput& photograph,
                                const EdgeModel& edge_model,
                                const RegisterOptions& options);

}  // namespace groundglass
