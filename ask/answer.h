// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/measure.h"
#include "ask/sightings.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// All that can be said of one to three places.
struct Answer {
  std::vector<Place> places;
  std::vector<std::vector<Sighting>> sightings;  // of each place
  std::optional<Measure> distance;               // of the first two
  std::optional<Measure> area;                   // of the triangle of the first three
};
Answer AnswerPlaces(const Survey& survey,
                    const Visibility& visibility,
                    std::vector<Place> places,
                    const SightingOptions& options = {});

// The answer in one object; positions in `site`, lengths in the model's unit (docs/where.md).
std::string FormatAnswerJson(const Survey& survey, const Answer& answer);
// A row for each place and photograph, with a header.
std::string FormatAnswerCsv(const Survey& survey, const Answer& answer);

}  // namespace groundglass
