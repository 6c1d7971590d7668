// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "pipeline/job_observer.h"

namespace groundglass {

// Prints on stderr what a job tells while it is at work. Before texturing, memory is configured for
// max_memory_mb (ConfigureMallocTrimming).
JobObserver MakeJobPrinter(const CommonOptions& common, int max_memory_mb = 0);

}  // namespace groundglass
