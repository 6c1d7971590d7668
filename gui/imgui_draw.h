// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to gui.
#pragma once

#include <SDL2/SDL.h>

struct ImDrawData;

namespace groundglass {

// The font's picture as a texture, which ImGui knows from then on.
SDL_Texture* UploadImGuiFont(SDL_Renderer* renderer);
// Draws what ImGui has built. Textures are SDL's.
void DrawImGui(SDL_Renderer* renderer, const ImDrawData& data);

}  // namespace groundglass
