// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register.h"
#include "tests/bench/anchors/trackers.h"

#include <memory>

namespace groundglass {

std::vector<Method> GroundglassMethods(const AnchorSet& set) {
  return {
      {"Groundglass",
       "defaults",
       [&set, edge_model = std::make_shared<EdgeModel>(set.model)](const PerturbedStart& start) {
         RegisterOptions options;
         options.prior.lock = {"v", "a", "shift", "k1"};
         const Registration registration = RegisterPhotograph(
             {set.name, set.frames[start.frame].grey8, {}, start.tag, {}}, *edge_model, options);
         return Method::Found{registration.CorrectedCamera(),
                              registration.verdict == Verdict::kAccepted};
       }}};
}

}  // namespace groundglass
