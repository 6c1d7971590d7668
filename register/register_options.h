// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/joint/joint_refinement.h"
#include "register/joint/model_errors.h"
#include "register/refine/find_solutions.h"
#include "register/refine/group_profile.h"
#include "register/refine/tag_readings.h"
#include "register/search/edge_conflict.h"
#include "register/ties/colmap_matches.h"
#include "register/ties/tie_support.h"
#include "register/verdict/overrule.h"
#include "register/verdict/verdict.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace groundglass {

// When the tags of a scene claim more than they hold (FindOverclaim).
struct OverclaimOptions {
  // They do if it is at least so many times too much, and taken to be so many times at the most.
  double least_overclaim = 1.5;
  double most_overclaim = 6;
  int least_photographs = 3;  // so many tell
  // Of photographs in a common solution, where less is uncertain: from so many times too much on a
  // tag is judged by what its notebook errs by, if so many photographs tell.
  double least_overclaim_of_set = 1.2;
  int least_photographs_of_set = 5;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "overclaim options: ") const;
};

// When a group of the model's edges is taken to lie elsewhere than it is drawn
// (FindDisplacedGroups).
struct DisplacedGroupOptions {
  GroupProfileOptions profile;
  // Nearer to its place the common solution finds it, sigmas of the model.
  double least_offset_sigmas = 2;
  // A trial is made where the photographs' profiles say so much more for a group elsewhere, nats,
  // and so many of them show it; so many trials at the most.
  double least_suspicion_nats = 40;
  int least_photographs = 2;
  int most_trials = 3;
  // What one photograph may add to what all say; with how much it counts as one that says so; and
  // how much they must say together once all are aligned anew.
  double most_nats_of_photograph = 40;
  double least_nats_of_photograph = 10;
  double least_gain_nats = 40;
  // Which of two parallel walls is the misplaced one is in doubt where one says this much more than
  // the other, or less: what is claimed for cameras covers both, by a share that falls with it.
  double doubtful_nats = 40;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "displaced group options: ") const;
};

// The options of all stages, in the order in which they work.
struct RegisterOptions {
  PriorOptions prior;
  SolutionOptions solutions;
  ReadingOptions readings;
  OverclaimOptions overclaim;
  DisplacedGroupOptions displaced;
  TieOptions ties;
  TieSupportOptions tie_support;
  JointOptions joint;
  ModelErrorOptions model_errors;
  ConflictOptions conflict;
  VerdictOptions verdict;
  OverruleOptions overrule;  // whose verdicts a person decides

  // Each photograph by itself; else those that are accepted are refined together.
  bool independent = false;
  // Photographs wider than this are registered at this width, their light averaged: edges of
  // buildings are no sharper.
  int max_width_px = 1600;
  // Places that a person has recognised, of all photographs, in pixels of theirs.
  std::vector<ControlPoint> control_points;
  // Whether what photographs see alike ties them together: patches, compared in the planes of faces
  // (ties.use_patches), and keypoints.
  bool use_ties = true;
  // Whether COLMAP, another program, also follows keypoints through them (docs/registration.md);
  // with ties.use_patches false these alone tie them. Where it fails, a warning says so.
  bool use_colmap = false;
  ColmapOptions colmap;
  // How often they are compared anew, through the cameras found so far.
  int num_tie_rounds = 2;
  // Where what each photograph's stages hand to one another is written, to be looked at
  // (KeepStages, KeepJointStage); nowhere if empty.
  std::filesystem::path keep_folder;
  // How the accepted photographs are refined together; another function is another method.
  std::function<JointRefinement(const EdgeModel&,
                                const std::vector<AlignedPhotograph>&,
                                const std::vector<int>& lenses,
                                const std::vector<TiePoint>& ties,
                                const JointOptions&)>
      refine_together = RefineTogether;

  void Check() const;  // throws Error naming the first field out of range
};

}  // namespace groundglass
