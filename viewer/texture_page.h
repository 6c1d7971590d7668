// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "viewer/gl_functions.h"

#include <string>
#include <vector>

namespace groundglass {

// A texture page with its mipmaps in OpenGL. number: the page's, from 1, for messages. A page
// larger than max_size_px either way is halved until it fits, with a line in `warnings`. Error if
// it is empty or has not 3 channels.
GlTexture UploadTexturePage(const GlFunctions& gl,
                            const Image8& page,
                            int number,
                            int max_size_px,
                            std::vector<std::string>& warnings);

}  // namespace groundglass
