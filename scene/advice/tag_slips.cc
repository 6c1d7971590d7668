// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/tag_slips.h"

#include <utility>

namespace groundglass {
namespace {

// The decimal point one place to the right, or to the left.
template <TagKey kKey>
void TimesTen(ViewTag& tag) {
  SetTagValue(tag, kKey, 10 * GetTagValue(tag, kKey));
}
template <TagKey kKey>
void TenthOf(ViewTag& tag) {
  SetTagValue(tag, kKey, GetTagValue(tag, kKey) / 10);
}

}  // namespace

const std::array<TagSlip, 25> kTagSlips = {{
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
    {"the sign of i changed", [](ViewTag& tag) { tag.lookat_in_site.x() *= -1; }},
    {"the sign of k changed", [](ViewTag& tag) { tag.lookat_in_site.z() *= -1; }},
    {"the sign of z changed", [](ViewTag& tag) { tag.position_in_site.z() *= -1; }},
    {"y and z exchanged",
     [](ViewTag& tag) { std::swap(tag.position_in_site.y(), tag.position_in_site.z()); }},
    {"j and k exchanged",
     [](ViewTag& tag) { std::swap(tag.lookat_in_site.y(), tag.lookat_in_site.z()); }},
    {"a tenth of x", TenthOf<TagKey::kX>},
    {"a tenth of y", TenthOf<TagKey::kY>},
    {"a tenth of z", TenthOf<TagKey::kZ>},
    {"a tenth of i", TenthOf<TagKey::kI>},
    {"a tenth of j", TenthOf<TagKey::kJ>},
    {"a tenth of k", TenthOf<TagKey::kK>},
    {"ten times x", TimesTen<TagKey::kX>},
    {"ten times y", TimesTen<TagKey::kY>},
    {"ten times z", TimesTen<TagKey::kZ>},
    {"ten times i", TimesTen<TagKey::kI>},
    {"ten times j", TimesTen<TagKey::kJ>},
    {"ten times k", TimesTen<TagKey::kK>},
}};

}  // namespace groundglass
