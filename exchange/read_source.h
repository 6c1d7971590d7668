// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "exchange/camera_exchange.h"

namespace groundglass {

// Whether a run left its cameras here.
bool IsOutputFolder(const std::filesystem::path& folder);

}  // namespace groundglass
