// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "exchange/formats.h"

#include <filesystem>

namespace groundglass {

// Error if cameras in this folder would spoil what it holds: a scene, an output folder, or cameras
// of another format that have pictures or sidecars of the same names.
void RequireExportFolder(const std::filesystem::path& folder, const CameraFormat& format);

}  // namespace groundglass
