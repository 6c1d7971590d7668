// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <CLI/CLI.hpp>

namespace groundglass {

// What an option's number may be, for CLI::Option::check. The library's own ranges print numbers of
// three hundred digits where there is no bound, and let "nan" through.
CLI::Validator AtLeast(double least);
CLI::Validator Above(double bound);
CLI::Validator FromTo(double least, double most);

}  // namespace groundglass
