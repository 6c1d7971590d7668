// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// A mistyped tag looks at the model from another place, and its picture's edges are not where the
// model's are. The other photographs tell how well a right tag fits here, and the slip after which
// this one fits as well is the one that was made.
#include "scene/advice/edge_fit.h"
#include "scene/advice/picture_fit.h"
#include "scene/error.h"
#include "scene/quantile.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Fewer others do not tell what a right tag reaches here.
constexpr size_t kFewestOthers = 3;
// A right tag's score, at the least, as a share of the median of the others' (0.6 and more in the
// bundled and outside scenes); and below which a tag is told though no slip explains it.
constexpr double kPoorShare = 0.62;
constexpr double kWrongShare = 0.5;
// Medians below this say little: the pictures show too few of the model's edges.
constexpr double kTellingScore = 3.5;
// What a slip must reach, as a share of the median, and at the least.
constexpr double kFoundShare = 0.72;
constexpr double kFoundScore = 3.5;
// A digit that was left out or is another one is tried in a hundred ways, so it must do better.
constexpr double kDigitHandicap = 0.5;
// Slips whose scores are nearer explain a tag as well as each other.
constexpr double kEquallyGood = 0.4;

struct WeighedTag {
  MeantTag meant;
  double score = 0;
};

// The median of the others' scores; 0 where it is not known.
double ExpectedScore(const std::vector<PictureFit>& fits, size_t index) {
  std::vector<double> others;
  for (size_t i = 0; i < fits.size(); ++i) {
    if (i != index && fits[i].nearby > 0) others.push_back(fits[i].nearby);
  }
  if (others.size() < kFewestOthers) return 0;
  const double median = UpperMedian(std::move(others));
  return median < kTellingScore ? 0 : median;
}

class Scale {
 public:
  Scale(const AdviceContext& context, const Photograph& photograph)
      : context_(context),
        photograph_(photograph),
        edges_(FindModelEdges(context.scene.model)),
        fit_(ReadGrey8(photograph.image_file)) {}

  double Score(const ViewTag& tag) const {
    const Camera camera = CameraFromTag(tag, photograph_.size.width, photograph_.size.height);
    return fit_.Score(context_.scene.model, edges_, context_.visibility, camera, kTagReach);
  }

  // The picture's score less the handicap; 0 for those with which the camera cannot stand or look.
  std::vector<WeighedTag> Weigh(const std::vector<MeantTag>& meant, double handicap) const {
    std::vector<WeighedTag> weighed(meant.size());
    tbb::parallel_for(size_t{0}, meant.size(), [&](size_t i) {
      weighed[i].meant = meant[i];
      const Standpoint standpoint = FindStandpoint(context_.bounds,
                                                   context_.visibility,
                                                   context_.scene.model,
                                                   meant[i].tag,
                                                   photograph_.size);
      if (IsPlausible(standpoint)) weighed[i].score = Score(meant[i].tag) - handicap;
    });
    return weighed;
  }

 private:
  const AdviceContext& context_;
  const Photograph& photograph_;
  std::vector<ModelEdge> edges_;
  EdgeFit fit_;
};

double BestScore(const std::vector<WeighedTag>& weighed) {
  double best = 0;
  for (const WeighedTag& one : weighed) best = std::max(best, one.score);
  return best;
}

// The likeliest of those that fit about as well as the best, which come in their order, and the
// likeliest of these that changes other numbers.
std::vector<MeantTag> Name(const std::vector<WeighedTag>& weighed) {
  const double least = BestScore(weighed) - kEquallyGood;
  std::vector<MeantTag> named;
  for (const WeighedTag& one : weighed) {
    if (one.score < least) continue;
    if (!named.empty() && named.front().is_changed == one.meant.is_changed) continue;
    named.push_back(one.meant);
    if (named.size() == 2) break;
  }
  return named;
}

// The slips that the picture confirms; none if it confirms none.
std::vector<MeantTag> FindConfirmed(const Scale& scale,
                                    const Scene& scene,
                                    const PictureFit& fit,
                                    const ViewTag& tag,
                                    double expected) {
  const double least =
      std::max(expected > 0 ? std::max(kFoundScore, kFoundShare * expected) : kClearScore,
               std::max(0.0, fit.nearby) + kClearLead);
  std::vector<MeantTag> meant = FindMeantTags(tag);
  std::erase_if(meant, [&](const auto& one) { return ChangesWhatIsNotWritten(scene, one); });
  std::vector<WeighedTag> weighed = scale.Weigh(meant, 0);
  if (BestScore(weighed) < least && expected > 0) {
    weighed = scale.Weigh(FindMeantTagsByDigits(tag), kDigitHandicap);
  }
  return BestScore(weighed) >= least ? Name(weighed) : std::vector<MeantTag>();
}

void WeighTag(const AdviceContext& context,
              const Photograph& photograph,
              const PictureFit& fit,
              double expected,
              TagDoubt& doubt) {
  const bool is_poor = expected > 0 ? fit.nearby < kPoorShare * expected
                                    : fit.as_read > 0 && fit.as_read < kClearScore - kClearLead;
  if ((doubt.wrong.empty() && !is_poor) || !SuitsPicture(photograph) ||
      SeemsCropped(context.scene, photograph)) {
    return;
  }
  const Scale scale(context, photograph);
  if (doubt.is_only_unusual && scale.Score(doubt.meant.front().tag) < fit.nearby - kEquallyGood) {
    doubt = {};  // the picture suits the tag as it is
    return;
  }
  if (doubt.is_only_unusual && !is_poor) return;
  const std::vector<MeantTag> confirmed =
      FindConfirmed(scale, context.scene, fit, photograph.tag, expected);
  if (!confirmed.empty()) {
    if (doubt.wrong.empty()) doubt.wrong = "the picture does not show what its tag looks at";
    doubt.meant = confirmed;
  } else if (doubt.wrong.empty() && expected > 0 && fit.nearby < kWrongShare * expected &&
             !HasClearAlternative(fit)) {
    doubt.wrong =
        "the picture does not show the model where its tag looks at it, as the other pictures do";
    doubt.remedy =
        "look at its numbers, at the overlay (groundglass check SCENE -o DIR), and whether it is "
        "this photograph's tag";
  }
}

}  // namespace

void WeighTags(const AdviceContext& context,
               const std::vector<PictureFit>& fits,
               std::vector<TagDoubt>& doubts) {
  if (doubts.empty() || HaveCommonAlternative(fits)) return;
  for (size_t i = 0; i < doubts.size(); ++i) {
    if (fits[i].is_explained) continue;
    const Photograph& photograph = context.scene.photographs[i];
    try {
      WeighTag(context, photograph, fits[i], ExpectedScore(fits, i), doubts[i]);
    } catch (const Error&) {
      // A picture that cannot be read is told by those who read it for its own sake.
    }
  }
}

}  // namespace groundglass
