// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/overrule.h"

#include "scene/error.h"

#include <algorithm>

namespace groundglass {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void OverruleOptions::Check() const {
  for (const std::string& name : accept) {
    if (Contains(reject, name)) {
      throw Error("options accept and reject: photograph '" + name + "' is in both");
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
  if (Contains(options.accept, registration.name)) decide(Verdict::kAccepted);
  if (Contains(options.reject, registration.name)) decide(Verdict::kRejected);
}

}  // namespace groundglass
