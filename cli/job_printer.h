// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "cli/commands.h"
#include "pipeline/job_observer.h"

#include <string>
#include <vector>

namespace groundglass {

// Prints on stderr what a job tells while it is at work. Before texturing, memory is configured for
// max_memory_mb (KeepFreedMemory).
JobObserver MakeJobPrinter(const CommonOptions& common, int max_memory_mb = 0);

// The line of a dry run, with the break before it, that names the stages which would be kept; empty
// if there are none.
std::string DescribeKept(const std::vector<std::string>& kept);

}  // namespace groundglass
