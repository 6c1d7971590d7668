// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/joint/joint_refinement.h"
#include "register/joint/model_errors.h"
#include "register/refine/find_solutions.h"
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

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "overclaim options: ") const;
};

// The options of all stages, in the order in which they work.
struct RegisterOptions {
  PriorOptions prior;
  SolutionOptions solutions;
  ReadingOptions readings;
  OverclaimOptions overclaim;
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
