// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/texture_page.h"

#include "scene/error.h"
#include "scene/reduce.h"

#include <algorithm>

namespace groundglass {
namespace {

Image8 HalvedUntilItFits(const Image8& page, int max_size_px) {
  int width = page.width;
  int height = page.height;
  while (width > max_size_px || height > max_size_px) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
  return ReducedInLight(page, width, height);
}

}  // namespace

GlTexture UploadTexturePage(const GlFunctions& gl,
                            const Image8& page,
                            int number,
                            int max_size_px,
                            std::vector<std::string>& warnings) {
  const std::string name = "texture page " + std::to_string(number);
  if (page.channels != 3 || page.Empty()) {
    throw Error("viewer: " + name + " is empty or has not 3 channels");
  }
  Image8 halved;
  const Image8* shown = &page;
  if (page.width > max_size_px || page.height > max_size_px) {
    halved = HalvedUntilItFits(page, max_size_px);
    shown = &halved;
    warnings.push_back(name + " is shown at " + std::to_string(halved.width) + " x " +
                       std::to_string(halved.height) + " in place of " +
                       std::to_string(page.width) + " x " + std::to_string(page.height) +
                       ": OpenGL takes no more than " + std::to_string(max_size_px));
  }
  GlTexture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.Name());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D,
                0,
                GL_SRGB8_ALPHA8,
                shown->width,
                shown->height,
                0,
                GL_RGB,
                GL_UNSIGNED_BYTE,
                shown->values.data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace groundglass
