// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/notebook.h"

#include "datasets-synthetic/noise.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace groundglass {

NotebookEntry MakeNotebookEntry(const PlannedView& planned,
                                double aspect,
                                const SynthRecipe& recipe,
                                uint64_t index) {
  const SynthRecipe::Notebook& notebook = recipe.notebook;
  NotebookEntry entry;
  entry.measured.position_in_site = planned.position_in_site;
  entry.measured.lookat_in_site = planned.lookat_in_site;
  entry.measured.aspect = aspect;
  entry.measured.view_angle_deg = planned.view_angle_deg;
  entry.actual = entry.measured;
  const uint64_t seed = SeedFor(recipe.seed, "notebook", index);
  // Without errors of measurement a tape's rounding is none either: the notebook is exact.
  const auto error = [&](double sigma, int which) {
    if (sigma == 0) return 0.0;
    return notebook.error_scale * sigma * NormalOf(HashOf(seed, which, 1)) +
           notebook.tape * (UniformOf(HashOf(seed, which, 2)) - 0.5);
  };
  entry.actual.position_in_site += Eigen::Vector3d(error(notebook.sigma_position, 0),
                                                   error(notebook.sigma_position, 1),
                                                   error(notebook.sigma_height, 2));
  entry.actual.lookat_in_site += Eigen::Vector3d(error(notebook.sigma_lookat, 3),
                                                 error(notebook.sigma_lookat, 4),
                                                 error(notebook.sigma_lookat, 5));
  entry.actual.roll_deg = notebook.sigma_roll_deg * NormalOf(HashOf(seed, 6));
  entry.actual.k1 = recipe.lens.k1;
  if (recipe.lens.focal_scale != 1) {
    const double tangent = std::tan(RadiansFromDegrees(planned.view_angle_deg) / 2);
    entry.actual.view_angle_deg =
        2 * DegreesFromRadians(std::atan(tangent / recipe.lens.focal_scale));
  }
  entry.measured.camera = recipe.lens.name;
  if (notebook.stated_scale > 0) {
    // To a thousandth, as a person would write.
    const auto stated = [&](double sigma) {
      return std::max(0.001, std::round(1000 * notebook.stated_scale * sigma) / 1000);
    };
    entry.measured.sigmas.position = stated(notebook.sigma_position);
    entry.measured.sigmas.height = stated(notebook.sigma_height);
    entry.measured.sigmas.lookat = stated(notebook.sigma_lookat);
  }
  return entry;
}

std::string_view BlunderName(Blunder blunder) {
  switch (blunder) {
    case Blunder::kNone:
      return "none";
    case Blunder::kSwappedCoordinates:
      return "swapped coordinates";
    case Blunder::kWrongSign:
      return "wrong sign";
    case Blunder::kWrongPhotograph:
      return "wrong photograph";
  }
  return "";
}

std::vector<Blunder> DrawBlunders(int num_tags, int num_blunders, uint64_t seed) {
  std::vector<int> order(num_tags);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return SeedFor(seed, "blunder", a) < SeedFor(seed, "blunder", b);
  });
  const Blunder kinds[3] = {
      Blunder::kSwappedCoordinates, Blunder::kWrongSign, Blunder::kWrongPhotograph};
  const uint64_t first_kind = SeedFor(seed, "blunder kind") % 3;
  std::vector<Blunder> blunders(num_tags, Blunder::kNone);
  for (int i = 0; i < std::min(num_tags, num_blunders); ++i) {
    const Blunder kind = kinds[(first_kind + i) % 3];
    blunders[order[i]] =
        kind == Blunder::kWrongPhotograph && num_tags < 2 ? Blunder::kWrongSign : kind;
  }
  return blunders;
}

void CommitBlunders(const std::vector<Blunder>& blunders,
                    uint64_t seed,
                    std::vector<ViewTag>& tags) {
  constexpr double kNoticeable = 20;
  const std::vector<ViewTag> right = tags;
  for (size_t i = 0; i < tags.size(); ++i) {
    const uint64_t chance = SeedFor(seed, "blunder chance", i);
    Eigen::Vector3d& position = tags[i].position_in_site;
    const bool swap_shows = std::abs(position.x() - position.y()) > kNoticeable;
    const double largest = std::max(std::abs(position.x()), std::abs(position.y()));
    const bool sign_shows = 2 * largest > kNoticeable;
    switch (blunders[i]) {
      case Blunder::kNone:
        break;
      case Blunder::kSwappedCoordinates:
      case Blunder::kWrongSign: {
        const bool wants_swap = blunders[i] == Blunder::kSwappedCoordinates;
        if (wants_swap ? swap_shows || !sign_shows : !sign_shows) {
          std::swap(position.x(), position.y());
          break;
        }
        const int other = static_cast<int>(chance % 2);
        const int axis = 2 * std::abs(position[other]) > kNoticeable ? other : 1 - other;
        position[axis] = -position[axis];
        break;
      }
      case Blunder::kWrongPhotograph: {
        const size_t step = 1 + chance % (tags.size() - 1);
        const ViewTag& other = right[(i + step) % tags.size()];
        position = other.position_in_site;
        tags[i].lookat_in_site = other.lookat_in_site;
        break;
      }
    }
  }
}

}  // namespace groundglass
