// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Right tags beside wrong photographs: a table's lines that slipped by one, or two that were
// exchanged. Each tag by its numbers is sound; the pictures tell which it belongs to.
#include "scene/advice/advice_judge.h"
#include "scene/advice/advice_parts.h"
#include "scene/advice/edge_fit.h"
#include "scene/advice/picture_fit.h"
#include "scene/error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace groundglass {
namespace {

// Below this a picture does not suit its tag: right ones' mean is above, wrong ones' is 2.
constexpr double kPoorScore = 3;
// What a picture must reach with another's tag, and by how much it must suit it better.
constexpr double kOtherScore = 3.5;
constexpr double kOtherLead = 1.5;
// More would take long, and as many wrong tags have another cause.
constexpr size_t kMostExchanged = 10;
constexpr size_t kMostTried = 600;
constexpr size_t kFewestShifted = 3;
// So many tell.
constexpr size_t kMostShifted = 24;

// Scores pictures with other photographs' tags. Pictures are read once.
class OrderJudge {
 public:
  explicit OrderJudge(const AdviceContext& context)
      : context_(context),
        edges_(FindModelEdges(context.scene.model)),
        fits_(context.scene.photographs.size()) {}

  // The picture of each photograph with the tag of its `tag_of`; 0 where it cannot be told.
  std::vector<double> Score(const std::vector<size_t>& pictures,
                            const std::vector<size_t>& tag_of) {
    Read(pictures);
    std::vector<double> scores(pictures.size(), 0.0);
    tbb::parallel_for(size_t{0}, pictures.size(), [&](size_t i) {
      const Photograph& photograph = context_.scene.photographs[pictures[i]];
      const std::optional<EdgeFit>& fit = fits_[pictures[i]];
      if (!fit) return;
      ViewTag tag = context_.scene.photographs[tag_of[i]].tag;
      tag.aspect = photograph.tag.aspect;  // it goes with the picture
      scores[i] = fit->Score(context_.scene.model,
                             edges_,
                             context_.visibility,
                             CameraFromTag(tag, photograph.size.width, photograph.size.height),
                             kTagReach);
    });
    return scores;
  }

 private:
  void Read(std::vector<size_t> pictures) {
    std::sort(pictures.begin(), pictures.end());
    pictures.erase(std::unique(pictures.begin(), pictures.end()), pictures.end());
    tbb::parallel_for(size_t{0}, pictures.size(), [&](size_t i) {
      std::optional<EdgeFit>& fit = fits_[pictures[i]];
      try {
        if (!fit) fit.emplace(ReadGrey8(context_.scene.photographs[pictures[i]].image_file));
      } catch (const Error&) {
        // Told by those who read it for its own sake.
      }
    });
  }

  const AdviceContext& context_;
  std::vector<ModelEdge> edges_;
  std::vector<std::optional<EdgeFit>> fits_;
};

std::string WhereTagsStand(const Scene& scene) {
  const bool is_table = scene.photographs.front().view_file.empty();
  return (scene.folder / (is_table ? "tags.csv" : "views")).string();
}

// All tags one photograph too far on, or too far back.
bool AdviseOnShift(const AdviceContext& context, std::vector<double> as_read, OrderJudge& judge) {
  const size_t count = as_read.size();
  if (count < kFewestShifted || PictureJudge::Mean(as_read) >= kPoorScore) return false;
  as_read.resize(std::min(count, kMostShifted));
  std::vector<size_t> pictures(as_read.size());
  std::iota(pictures.begin(), pictures.end(), size_t{0});
  const std::vector<Photograph>& photographs = context.scene.photographs;
  for (const size_t step : {size_t{1}, count - 1}) {
    std::vector<size_t> tag_of;
    for (const size_t picture : pictures) tag_of.push_back((picture + step) % count);
    const std::vector<double> shifted = judge.Score(pictures, tag_of);
    if (PictureJudge::Mean(shifted) < kPoorScore ||
        !PictureJudge::IsClearlyBetter(shifted, as_read))
      continue;
    context.Add(Advice::Severity::kScene,
                WhereTagsStand(context.scene),
                "each tag stands beside the photograph " +
                    std::string(step == 1 ? "after" : "before") +
                    " its own, as the pictures tell: " + photographs[0].name + " shows what the " +
                    "tag of " + photographs[tag_of[0]].name + " looks at",
                "move all of them by one");
    return true;
  }
  return false;
}

// Two that were exchanged: at least one of them is a picture that does not suit its tag.
// Returns these.
std::vector<size_t> AdviseOnPairs(const AdviceContext& context,
                                  const std::vector<double>& as_read,
                                  OrderJudge& judge) {
  // 0: it is not known.
  const auto is_poor = [&](size_t i) { return as_read[i] > 0 && as_read[i] < kPoorScore; };
  std::vector<size_t> poor;
  for (size_t i = 0; i < as_read.size(); ++i) {
    if (is_poor(i)) poor.push_back(i);
  }
  if (poor.empty() || poor.size() > kMostExchanged ||
      2 * poor.size() * as_read.size() > kMostTried) {
    return {};
  }
  std::vector<size_t> pictures;
  std::vector<size_t> tag_of;
  for (const size_t i : poor) {
    for (size_t j = 0; j < as_read.size(); ++j) {
      if (j == i || (is_poor(j) && j < i)) continue;
      pictures.insert(pictures.end(), {i, j});
      tag_of.insert(tag_of.end(), {j, i});
    }
  }
  const std::vector<double> scores = judge.Score(pictures, tag_of);
  const auto suits = [&](size_t index) {
    return scores[index] >= std::max(kOtherScore, as_read[pictures[index]] + kOtherLead);
  };
  std::vector<size_t> exchanged;
  for (size_t i = 0; i < pictures.size(); i += 2) {
    if (!suits(i) || !suits(i + 1)) continue;
    const std::vector<Photograph>& photographs = context.scene.photographs;
    const auto [first, second] = std::minmax(pictures[i], pictures[i + 1]);
    context.Add(Advice::Severity::kScene,
                WhereTagsStand(context.scene),
                "the tags of " + photographs[first].name + " and " + photographs[second].name +
                    " are exchanged: each picture shows what the other's tag looks at",
                "exchange them");
    exchanged.insert(exchanged.end(), {first, second});
  }
  return exchanged;
}

}  // namespace

bool AdviseOnOrder(const AdviceContext& context,
                   std::vector<PictureFit>& fits,
                   std::vector<TagDoubt>& doubts) {
  std::vector<double> as_read;
  for (const PictureFit& fit : fits) as_read.push_back(fit.nearby);
  if (as_read.size() < 2 || HaveCommonAlternative(fits)) return false;
  OrderJudge judge(context);
  if (AdviseOnShift(context, as_read, judge)) return true;
  for (const size_t exchanged : AdviseOnPairs(context, as_read, judge)) {
    fits[exchanged] = {};
    fits[exchanged].is_explained = true;
    if (!doubts.empty()) doubts[exchanged] = {};
  }
  return false;
}

}  // namespace groundglass
