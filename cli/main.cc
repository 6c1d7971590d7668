// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/groundglass.h"

#include <glog/logging.h>

int main(int argc, char** argv) {
  // Ceres logs what it cannot solve; whoever asked it tells that in a person's words.
  FLAGS_minloglevel = google::GLOG_FATAL;
  return groundglass::RunGroundglass(argc, argv);
}
