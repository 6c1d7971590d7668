// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/embedded_picture.h"
#include "report/model_modes.h"
#include "report/report_data.h"
#include "report/report_page.h"
#include "scene/error.h"
#include "scene/formats/model_io.h"
#include "scene/formats/textured_model_io.h"
#include "scene/formats/view_io.h"

#include <algorithm>
#include <utility>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
namespace mustache = kainjow::mustache;

// Of what the page may weigh, before Base64 adds a third to it.
constexpr double kModelShare = 0.3;
constexpr double kModesShare = 0.05;
// Software OpenGL in browsers takes pages no larger than 8192 px.
constexpr int kLargestPagePx = 4096;

// Places on pages move with them.
void HalvePages(TexturedModel& textured) {
  for (size_t i = 0; i < textured.pages.size(); ++i) {
    TexturePage& page = textured.pages[i];
    const int width_px = page.srgb8.width;
    page.srgb8 = ShrunkPicture(page.srgb8, std::max(1, width_px / 2));
    const double scale = static_cast<double>(page.srgb8.width) / width_px;
    for (FaceTexture& face : textured.faces) {
      if (face.page != static_cast<int>(i)) continue;
      for (Eigen::Vector2d& texel : face.corners_texel) texel *= scale;
    }
  }
}

int LargestPage(const TexturedModel& textured) {
  int largest = 0;
  for (const TexturePage& page : textured.pages) {
    largest = std::max({largest, page.srgb8.width, page.srgb8.height});
  }
  return largest;
}

// The model as a GLB of no more bytes; empty if even small pages are too much.
std::string SmallGlb(const fs::path& folder, size_t max_bytes) {
  std::string bytes = ReadFileBytes(folder / "model.glb");
  TexturedModel textured = ReadTexturedModel(folder / "model.glb", {}).textured;
  const fs::path smaller = folder / ".report-model.glb";
  while (bytes.size() > max_bytes || LargestPage(textured) > kLargestPagePx) {
    if (LargestPage(textured) < 64) return "";
    HalvePages(textured);
    WriteGlb(smaller, textured);
    bytes = ReadFileBytes(smaller);
  }
  std::error_code error;
  fs::remove(smaller, error);
  return bytes;
}

// The model is there without them if what they are made of is damaged, and the page says why.
void AddModes(const fs::path& folder, size_t max_bytes, mustache::data& turned) {
  turned["modes"] = false;
  turned["modes_fault"] = false;
  try {
    const std::string modes = ModelModesJson(folder, max_bytes);
    if (!modes.empty()) turned["modes"] = mustache::data("json", modes);
  } catch (const Error& error) {
    turned["modes_fault"] = mustache::data("text", error.what());
  }
}

}  // namespace

mustache::data ModelData(const ReportInput& input) {
  if (!fs::exists(input.folder / "model.glb")) return false;
  mustache::data data;
  data["turned"] = false;
  if (kModelScript[0] == '\0') return data;
  try {
    const double max_bytes = 1e6 * input.options.max_megabytes;
    const std::string glb = SmallGlb(input.folder, static_cast<size_t>(kModelShare * max_bytes));
    if (glb.empty()) return data;
    mustache::data turned;
    turned["glb"] = EncodeBase64({reinterpret_cast<const uint8_t*>(glb.data()), glb.size()});
    turned["script"] = kModelScript;
    AddModes(input.folder, static_cast<size_t>(kModesShare * max_bytes), turned);
    data["turned"] = std::move(turned);
  } catch (const Error&) {
    // A model that cannot be read is told by the stage that made it; the page goes without.
  }
  return data;
}

}  // namespace groundglass
