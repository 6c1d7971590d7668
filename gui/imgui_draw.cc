// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/imgui_draw.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cstddef>
#include <vector>

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
  std::vector<ImDrawIdx> shifted;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr || command.ElemCount == 0) continue;
      const ImVec4& clip = command.ClipRect;
      const SDL_Rect rect = {static_cast<int>(clip.x),
                             static_cast<int>(clip.y),
                             static_cast<int>(clip.z - clip.x),
                             static_cast<int>(clip.w - clip.y)};
      if (rect.w <= 0 || rect.h <= 0) continue;
      SDL_RenderSetClipRect(renderer, &rect);
      // Only the corners that this command draws: SDL looks through all that it is given, and with
      // hundreds of thumbnails there are hundreds of commands.
      const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
      const auto [first, last] = std::minmax_element(indices, indices + command.ElemCount);
      const ImDrawIdx lowest = *first;
      const int num_corners = *last - lowest + 1;
      shifted.assign(indices, indices + command.ElemCount);
      for (ImDrawIdx& index : shifted) index = static_cast<ImDrawIdx>(index - lowest);
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset + lowest;
      const auto* bytes = reinterpret_cast<const char*>(vertices);
      SDL_RenderGeometryRaw(renderer,
                            static_cast<SDL_Texture*>(command.GetTexID()),
                            reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, pos)),
                            sizeof(ImDrawVert),
                            reinterpret_cast<const SDL_Color*>(bytes + offsetof(ImDrawVert, col)),
                            sizeof(ImDrawVert),
                            reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, uv)),
                            sizeof(ImDrawVert),
                            num_corners,
                            shifted.data(),
                            static_cast<int>(command.ElemCount),
                            sizeof(ImDrawIdx));
    }
  }
  SDL_RenderSetClipRect(renderer, nullptr);
}

}  // namespace groundglass
