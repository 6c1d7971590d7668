// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Photographs that are there twice, and tags that were copied from another's.
#include "scene/advice/advice_parts.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/same_picture.h"
#include "scene/reduce.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace groundglass {
namespace {

std::array<double, 6> NumbersOf(const ViewTag& tag) {
  const Eigen::Vector3d& position = tag.position_in_site;
  const Eigen::Vector3d& lookat = tag.lookat_in_site;
  return {position.x(), position.y(), position.z(), lookat.x(), lookat.y(), lookat.z()};
}

// A picture much reduced, less its mean.
Eigen::ArrayXd Gist(const Photograph& photograph) {
  constexpr int kSize = 24;
  const Image8 small = ReducedInLight(ReadSrgb8(photograph.image_file), kSize, kSize);
  const Eigen::ArrayXd codes =
      Eigen::Map<const Eigen::Array<uint8_t, Eigen::Dynamic, 1>>(
          small.values.data(), static_cast<Eigen::Index>(small.values.size()))
          .cast<double>();
  return codes - codes.mean();
}

// How alike two pictures are: 1 for one view from one tripod.
double Likeness(const Photograph& a, const Photograph& b) {
  const Eigen::ArrayXd first = Gist(a);
  const Eigen::ArrayXd second = Gist(b);
  const double scale = std::sqrt(first.square().sum() * second.square().sum());
  return scale > 0 ? (first * second).sum() / scale : 1;
}

// Two exposures from one stand have one tag; two pictures of different things have not.
bool ShowsTheSame(const Photograph& a, const Photograph& b) {
  constexpr double kAlike = 0.8;
  try {
    return Likeness(a, b) > kAlike;
  } catch (const Error&) {
    return true;  // told by those who read them for their own sake
  }
}

}  // namespace

void AdviseOnDoubles(const AdviceContext& context) {
  std::map<std::string, std::vector<const Photograph*>> by_sample;
  std::map<std::array<double, 6>, const Photograph*> first_with_numbers;
  for (const Photograph& later : context.scene.photographs) {
    const std::string sample = SampleOf(later.image_file);
    if (sample.empty()) continue;  // told by those who read it for its own sake
    std::vector<const Photograph*>& alike = by_sample[sample];
    const auto same_file = std::find_if(alike.begin(), alike.end(), [&](const auto* earlier) {
      return IsSamePicture(earlier->image_file, later.image_file);
    });
    const Photograph* first =
        first_with_numbers.emplace(NumbersOf(later.tag), &later).first->second;
    if (same_file != alike.end()) {
      context.Add(
          Advice::Severity::kDetail,
          later.image_file.string(),
          "this is the very same picture as " + (*same_file)->image_file.filename().string(),
          "take one of them out, or put the picture here that was meant");
    } else if (first != &later && !ShowsTheSame(*first, later)) {
      context.Add(Advice::Severity::kDetail,
                  TagPlace(context.scene, later),
                  "has the position and look-at point of " + first->name +
                      ", and the two pictures show different things",
                  "write its own numbers; one of the two was copied");
    }
    alike.push_back(&later);
  }
}

}  // namespace groundglass
