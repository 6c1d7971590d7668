// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/gl_context.h"

#include "scene/view_tag.h"
#include "tests/support/thrown_message.h"
#include "tests/viewer/sample_models.h"
#include "viewer/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

namespace groundglass {
namespace {

using testing::HasSubstr;

// The environment variable for as long as this lives.
class WantedBackend {
 public:
  explicit WantedBackend(const std::string& name) {
    if (const char* before = std::getenv("GROUNDGLASS_GL")) before_ = before;
    setenv("GROUNDGLASS_GL", name.c_str(), 1);
  }
  ~WantedBackend() {
    if (before_) {
      setenv("GROUNDGLASS_GL", before_->c_str(), 1);
    } else {
      unsetenv("GROUNDGLASS_GL");
    }
  }

 private:
  std::optional<std::string> before_;
};

Camera LookingAtTheBox() {
  ViewTag tag;
  tag.position_in_site = {9, 12, 6};
  tag.lookat_in_site = {0, 0, 0};
  tag.aspect = 1.5;
  tag.view_angle_deg = 40;
  return CameraFromTag(tag, 150, 100);
}

TEST(GlContext, EveryBackendDrawsTheSamePicture) {
  ASSERT_GE(GlBackends().size(), 1);
  const TexturedModel box = MakeCheckeredBox();
  RenderOptions options;
  options.multisamples = 1;
  std::optional<Image8> first;
  for (const GlBackend& backend : GlBackends()) {
    const WantedBackend wanted(backend.name);
    Renderer renderer(box);
    const Image8 picture = renderer.Render(LookingAtTheBox(), options);
    if (!first) first = picture;
    ASSERT_EQ(picture.values.size(), first->values.size()) << backend.name;
    // Another card may round otherwise, and see an edge in the next pixel.
    size_t num_other = 0;
    for (size_t i = 0; i < picture.values.size(); ++i) {
      num_other += std::abs(picture.values[i] - first->values[i]) > 2 ? 1 : 0;
    }
    EXPECT_LT(num_other, picture.values.size() / 200) << backend.name;
    EXPECT_EQ(renderer.RenderLabels(LookingAtTheBox()).values.size(), 150 * 100);
  }
}

// The window makes its renderer in one thread and may draw in another.
TEST(GlContext, ARendererMayGoFromThreadToThread) {
  for (const GlBackend& backend : GlBackends()) {
    const WantedBackend wanted(backend.name);
    Renderer renderer(MakeCheckeredBox());
    const Image8 here = renderer.Render(LookingAtTheBox());
    Image8 there;
    std::thread([&] { there = renderer.Render(LookingAtTheBox()); }).join();
    EXPECT_EQ(there.values, here.values) << backend.name;
    EXPECT_EQ(renderer.Render(LookingAtTheBox()).values, here.values) << backend.name;
  }
}

TEST(GlContext, TwoRenderersKeepToThemselves) {
  for (const GlBackend& backend : GlBackends()) {
    const WantedBackend wanted(backend.name);
    Renderer box(MakeCheckeredBox());
    const Image8 alone = box.Render(LookingAtTheBox());
    {
      Renderer other(MakeCheckeredBox());
      other.Render(LookingAtTheBox());
    }
    EXPECT_EQ(box.Render(LookingAtTheBox()).values, alone.values) << backend.name;
  }
}

TEST(GlContext, AnUnknownBackendIsNamedWithThoseThatThereAre) {
  const WantedBackend wanted("metal");
  const std::string message = ThrownMessage([] { MakeGlContext(); });
  EXPECT_THAT(message, HasSubstr("GROUNDGLASS_GL is 'metal'"));
  EXPECT_THAT(message, HasSubstr(GlBackends().front().name));
}

}  // namespace
}  // namespace groundglass
