// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/lens.h"
#include "scene/view_tag.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace groundglass {

// The tag of any photograph that the lens took, without its place.
ViewTag TagOfLens(const Lens& lens);

// Other programs' files of one camera: COLMAP's cameras.txt, OpenCV's YAML (camera_matrix), ROS'
// camera_info, Kalibr's camchain. They are of a picture of one size in pixels.
enum class LensFormat { kColmap, kOpenCv, kRos, kKalibr };
constexpr std::array<std::string_view, 4> kLensFormatNames = {"colmap", "opencv", "ros", "kalibr"};

// The lens that such a file describes, told by its text; nothing if it is none of them. Their
// standard deviations are not known. OpenCV, ROS and Kalibr count pixels' centres as whole numbers.
// Throws Error naming the file for several cameras, other lens models, and numbers that are
// missing or impossible.
std::optional<Lens> ReadForeignLens(const std::string& text, const std::filesystem::path& file);

// The lens as such a file for pictures of this size. Kalibr and ROS' camera_info have k1 k2 p1 p2
// (and k3); throws Error if a format has no place for the lens' k3.
std::string FormatForeignLens(const Lens& lens, LensFormat format, int width_px, int height_px);

}  // namespace groundglass
