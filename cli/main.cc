// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/groundglass.h"

int main(int argc, char** argv) { return groundglass::RunGroundglass(argc, argv); }
