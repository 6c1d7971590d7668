// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"
#include "tests/bench/anchors/trackers.h"

namespace groundglass {

std::vector<Method> GroundglassMethods() {
  return {{"Groundglass", "defaults", [](const Castle& castle, const PerturbedStart& start) {
             // Before the first call, as the other methods load their model before they track.
             static const EdgeModel edge_model(castle.model);
             RegisterOptions options;
             options.prior.lock = {"v", "a", "shift", "k1"};
             const Image8& grey8 = castle.frames[start.frame].grey8;
             const Registration registration =
                 RegisterPhotograph("castle", grey8, {}, start.tag, {}, edge_model, options);
             return Method::Found{registration.CorrectedCamera(),
                                  registration.verdict == Verdict::kAccepted};
           }}};
}

}  // namespace groundglass
