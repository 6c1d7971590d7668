// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/charts/packing.h"

#include <algorithm>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace groundglass {
namespace {

// Packs what fits into one page; true if everything did.
bool PackPage(int width, int height, std::vector<stbrp_rect>& rects) {
  std::vector<stbrp_node> nodes(static_cast<size_t>(width));
  stbrp_context context;
  stbrp_init_target(&context, width, height, nodes.data(), width);
  return stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size())) != 0;
}

}  // namespace

std::vector<PageSize> PackCharts(std::vector<Chart>& charts,
                                 int gutter_texels,
                                 int max_page_texels) {
  std::vector<stbrp_rect> waiting;
  for (size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].texel_size <= 0) continue;
    stbrp_rect rect = {};
    rect.id = static_cast<int>(i);
    rect.w = charts[i].width_texels + 2 * gutter_texels;
    rect.h = charts[i].height_texels + 2 * gutter_texels;
    waiting.push_back(rect);
  }
  std::vector<PageSize> pages;
  while (!waiting.empty()) {
    // The smallest square-ish page that takes everything, or a full one.
    double area = 0;
    int widest = 0;
    for (const stbrp_rect& rect : waiting) {
      area += static_cast<double>(rect.w) * rect.h;
      widest = std::max({widest, rect.w, rect.h});
    }
    int side = std::max(widest, static_cast<int>(std::sqrt(area)));
    side = std::min((side + 15) / 16 * 16, max_page_texels);
    std::vector<stbrp_rect> packed;
    for (;;) {
      packed = waiting;
      if (PackPage(side, side, packed) || side == max_page_texels) break;
      side = std::min((side + side / 32 + 16) / 16 * 16, max_page_texels);
    }
    PageSize size;
    std::vector<stbrp_rect> left;
    for (const stbrp_rect& rect : packed) {
      if (!rect.was_packed) {
        left.push_back(rect);
        continue;
      }
      Chart& chart = charts[rect.id];
      chart.page = static_cast<int>(pages.size());
      chart.x_on_page = rect.x + gutter_texels;
      chart.y_on_page = rect.y + gutter_texels;
      size.width = std::max(size.width, rect.x + rect.w);
      size.height = std::max(size.height, rect.y + rect.h);
    }
    size.width = std::min((size.width + 15) / 16 * 16, max_page_texels);
    size.height = std::min((size.height + 15) / 16 * 16, max_page_texels);
    pages.push_back(size);
    waiting = std::move(left);
  }
  return pages;
}

}  // namespace groundglass
