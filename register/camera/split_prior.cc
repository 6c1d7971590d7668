// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/split_prior.h"

#include "scene/least_norm.h"

#include <cmath>

namespace groundglass {

SplitPrior SplitIntoOwnAndLens(const CameraPrior& prior, const LensParameters& own_shares) {
  SplitPrior parted;
  parted.whole = prior;
  parted.own_root = prior.root;
  for (int i = 0; i < kNumLensParameters; ++i) {
    const int row = kLensParameters[i];
    parted.own_root.row(row) *= std::sqrt(own_shares[i]);
    parted.lens_root(row, i) = prior.sigmas[row] * std::sqrt(1 - own_shares[i]);
  }
  Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters + kNumLensParameters> parts;
  parts << parted.own_root, parted.lens_root;
  // Locked parameters have no whitened direction.
  parted.whole_from_parts = SolveLeastNorm(prior.root, parts);
  return parted;
}

}  // namespace groundglass
