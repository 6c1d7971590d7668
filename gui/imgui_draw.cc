// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/imgui_draw.h"

#include <imgui/imgui.h>

#include <cstddef>

namespace groundglass {

SDL_Texture* UploadImGuiFont(SDL_Renderer* renderer) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  SDL_Texture* texture = SDL_CreateTexture(
      renderer, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width, height);
  SDL_UpdateTexture(texture, nullptr, pixels, 4 * width);
  SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_BLEND);
  fonts.SetTexID(texture);
  return texture;
}

void DrawImGui(SDL_Renderer* renderer, const ImDrawData& data) {
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr) continue;
      const ImVec4& clip = command.ClipRect;
      const SDL_Rect rect = {static_cast<int>(clip.x),
                             static_cast<int>(clip.y),
                             static_cast<int>(clip.z - clip.x),
                             static_cast<int>(clip.w - clip.y)};
      if (rect.w <= 0 || rect.h <= 0) continue;
      SDL_RenderSetClipRect(renderer, &rect);
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      const auto* bytes = reinterpret_cast<const char*>(vertices);
      SDL_RenderGeometryRaw(renderer,
                            static_cast<SDL_Texture*>(command.GetTexID()),
                            reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, pos)),
                            sizeof(ImDrawVert),
                            reinterpret_cast<const SDL_Color*>(bytes + offsetof(ImDrawVert, col)),
                            sizeof(ImDrawVert),
                            reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, uv)),
                            sizeof(ImDrawVert),
                            list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
                            list.IdxBuffer.Data + command.IdxOffset,
                            static_cast<int>(command.ElemCount),
                            sizeof(ImDrawIdx));
    }
  }
  SDL_RenderSetClipRect(renderer, nullptr);
}

}  // namespace groundglass
