// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/tag_slips.h"

#include <utility>

namespace groundglass {

const std::array<TagSlip, 8> kTagSlips = {{
    {"x and y exchanged, and i and j",
     [](ViewTag& tag) {
       std::swap(tag.position_in_site.x(), tag.position_in_site.y());
       std::swap(tag.lookat_in_site.x(), tag.lookat_in_site.y());
     }},
    {"x and y exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site.x(), tag.position_in_site.y()); }},
    {"i and j exchanged",
     [](ViewTag& tag) { std::swap(tag.lookat_in_site.x(), tag.lookat_in_site.y()); }},
    {"the sign of y changed (it counts south)",
     [](ViewTag& tag) { tag.position_in_site.y() *= -1; }},
    {"the sign of j changed (it counts south)", [](ViewTag& tag) { tag.lookat_in_site.y() *= -1; }},
    {"the sign of x changed", [](ViewTag& tag) { tag.position_in_site.x() *= -1; }},
    {"the signs of y and j changed (they count south)",
     [](ViewTag& tag) {
       tag.position_in_site.y() *= -1;
       tag.lookat_in_site.y() *= -1;
     }},
    {"the camera and the point looked at exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site, tag.lookat_in_site); }},
}};

}  // namespace groundglass
