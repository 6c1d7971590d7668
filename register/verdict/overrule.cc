// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict/overrule.h"

#include "scene/check_option.h"

#include <algorithm>

namespace groundglass {

void OverruleOptions::Check() const {
  for (const std::string& name : accept) {
    if (std::ranges::count(reject, name) > 0) {
      throw OptionError("options accept and reject:", "photograph '" + name + "' is in both");
    }
  }
}

void OverruleVerdict(const OverruleOptions& options, Registration& registration) {
  const auto decide = [&](Verdict verdict) {
    if (registration.verdict == verdict) return;
    registration.reasons.insert(registration.reasons.begin(),
                                std::string(VerdictName(verdict)) +
                                    " by a person, overruling the verdict " +
                                    std::string(VerdictName(registration.verdict)));
    registration.verdict = verdict;
  };
  if (registration.verdict == Verdict::kUnreadable) return;  // nobody can decide that
  if (std::ranges::count(options.accept, registration.name) > 0) decide(Verdict::kAccepted);
  if (std::ranges::count(options.reject, registration.name) > 0) decide(Verdict::kRejected);
}

}  // namespace groundglass
