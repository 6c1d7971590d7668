// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include "scene/image.h"

#include <SDL2/SDL.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {

struct TextureDeleter {
  void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }
};
using TexturePtr = std::unique_ptr<SDL_Texture, TextureDeleter>;

// A window that ImGui draws into, by SDL's software renderer: no graphics card is asked for.
// Throws Error without a display.
class SdlWindow {
 public:
  SdlWindow(const std::string& title, int width_px, int height_px);
  ~SdlWindow();
  SdlWindow(const SdlWindow&) = delete;
  SdlWindow& operator=(const SdlWindow&) = delete;

  SDL_Renderer* renderer() const { return renderer_; }
  int width_px() const;
  int height_px() const;
  void SetTitle(const std::string& title);
  // Fonts of another size; 1 is 18 px.
  void SetTextScale(double scale);

  void BeginFrame();
  // Draws what ImGui has built over what was copied, and shows it.
  void EndFrame();
  // What was last drawn, as a PNG.
  void WriteScreenshot(const std::filesystem::path& file) const;

  TexturePtr MakeTexture(const Image8& srgb8) const;
  TexturePtr MakeTexture(int width_px, int height_px, const std::vector<uint8_t>& bgra) const;

 private:
  SDL_Window* window_ = nullptr;
  SDL_Renderer* renderer_ = nullptr;
  TexturePtr font_;
};

}  // namespace groundglass
