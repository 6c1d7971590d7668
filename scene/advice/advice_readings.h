// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/advice/advice_suitability.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

class PictureJudge;

// Another reading of the whole scene.
struct Reading {
  OtherReading model;
  Retag retag;  // none: as they are
  std::string message;
  std::string remedy;
  std::string option;  // where one is all that it takes
  int num_changes = 1;
};

// One tag may fit a wrong reading by chance.
constexpr size_t kFewestTags = 2;

// The model's axes, other than as they were read.
std::vector<Reading> OtherAxes(const AdviceContext& context);
// y up and z north, as some programs have it.
std::vector<Reading> LeftHandedAxes(const AdviceContext& context);
// The model's numbers in one unit, the tags' in another. `axes_options`: with which the model is
// read, as they are typed, each after a blank.
std::vector<Reading> OtherUnits(const AdviceContext& context, const std::string& axes_options);
std::string AxesOptions(const ModelOptions& options);
// The tags' numbers, written in another order or with another sign.
std::vector<Reading> OtherTags(const AdviceContext& context);
// The angles of tags that have them, in another unit or counted otherwise; none for others.
std::vector<Reading> OtherAngles(const AdviceContext& context);
// Look-at points that are directions; none if they are too long for that.
std::vector<Reading> LookatsAsDirections(const AdviceContext& context);
// The model upside down, with heights that count downwards.
std::vector<Reading> HeightsDownwards(const AdviceContext& context);
// Of these the one that the pictures suit best, if they suit it clearly better than the scene as it
// was read (`fits_as_read`, PictureJudge::Fit) and their mean is above `least_mean`; null if none.
const Reading* FindClearlyBest(const std::vector<Reading>& readings,
                               const PolygonModel& model,
                               const PictureJudge& judge,
                               const std::vector<double>& fits_as_read,
                               double least_mean);
// All heights off by the same: the look-at points lie all above the model, or all below it.
std::vector<Reading> OtherDatums(const AdviceContext& context,
                                 const std::vector<const Photograph*>& photographs);

}  // namespace groundglass
