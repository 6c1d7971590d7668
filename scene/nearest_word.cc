// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/nearest_word.h"

#include <algorithm>

namespace groundglass {
namespace {

// How many letters to insert, leave out, replace or exchange with their neighbour.
size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> distance(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
  for (size_t k = 0; k <= b.size(); ++k) distance[0][k] = k;
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t k = 1; k <= b.size(); ++k) {
      const size_t replaced = distance[i - 1][k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
      distance[i][k] = std::min({distance[i - 1][k] + 1, distance[i][k - 1] + 1, replaced});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
        distance[i][k] = std::min(distance[i][k], distance[i - 2][k - 2] + 1);
      }
    }
  }
  return distance[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> FindNearest(const std::string& word,
                                       const std::vector<std::string>& known) {
  std::optional<std::string> nearest;
  // More than a third of the letters wrong is another word.
  size_t least = std::max<size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const bool is_cut_short = word.size() >= 3 && candidate.rfind(word, 0) == 0;
    const size_t distance = is_cut_short ? 1 : EditDistance(word, candidate);
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace groundglass
