// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// The whole program: what main() is given and what it returns.
int RunGroundglass(int argc, char** argv);

}  // namespace groundglass
