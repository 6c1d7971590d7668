// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/sdl_window.h"

#include "gui/imgui_draw.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"

#include <imgui/backends/imgui_impl_sdl.h>
#include <imgui/imgui.h>

#include <cstdlib>
#include <cstring>

namespace groundglass {
namespace {

constexpr const char* kFontFiles[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                      "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
constexpr double kTextSizePx = 16;
constexpr const char* kNoDisplay =
    "view needs a display (X11 or Wayland); `render` and `where` work without";

void RequireDisplay() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != 0;
  };
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) throw Error(kNoDisplay);
  // SDL would silently take a driver that shows nothing.
  SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  const bool is_up = SDL_Init(SDL_INIT_VIDEO) == 0;
  const char* driver = is_up ? SDL_GetCurrentVideoDriver() : nullptr;
  const bool shows = driver != nullptr && std::strcmp(driver, "offscreen") != 0 &&
                     std::strcmp(driver, "dummy") != 0 && std::strcmp(driver, "KMSDRM") != 0;
  if (shows) return;
  if (is_up) SDL_Quit();
  throw Error(kNoDisplay);
}

void UseStyle(double scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsDark();
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.FrameRounding = 3;
  style.AntiAliasedLines = false;
  style.AntiAliasedLinesUseTex = false;
  style.AntiAliasedFill = false;
  style.ScaleAllSizes(static_cast<float>(scale));
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.13f, 0.14f, 0.16f, 1);
  style.Colors[ImGuiCol_Text] = ImVec4(0.93f, 0.93f, 0.93f, 1);
}

}  // namespace

SdlWindow::SdlWindow(const std::string& title, int width_px, int height_px) {
  RequireDisplay();
  window_ = SDL_CreateWindow(title.c_str(),
                             SDL_WINDOWPOS_UNDEFINED,
                             SDL_WINDOWPOS_UNDEFINED,
                             width_px,
                             height_px,
                             SDL_WINDOW_RESIZABLE);
  if (window_ != nullptr) renderer_ = SDL_CreateRenderer(window_, -1, SDL_RENDERER_SOFTWARE);
  if (renderer_ == nullptr) {
    const std::string reason = SDL_GetError();
    if (window_ != nullptr) SDL_DestroyWindow(window_);
    SDL_Quit();
    throw Error("the window cannot be opened: " + reason);
  }
  SDL_StopTextInput();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  // DrawImGui heeds it; without it the frusta of hundreds of photographs are too many for ImGui,
  // which counts corners in 16 bits, and it ends the program.
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  ImGui_ImplSDL2_InitForSDLRenderer(window_);
  SetTextScale(1);
}

SdlWindow::~SdlWindow() {
  font_.reset();
  ImGui_ImplSDL2_Shutdown();
  ImGui::DestroyContext();
  SDL_DestroyRenderer(renderer_);
  SDL_DestroyWindow(window_);
  SDL_Quit();
}

int SdlWindow::width_px() const {
  int width = 0;
  SDL_GetRendererOutputSize(renderer_, &width, nullptr);
  return width;
}

int SdlWindow::height_px() const {
  int height = 0;
  SDL_GetRendererOutputSize(renderer_, nullptr, &height);
  return height;
}

void SdlWindow::SetTitle(const std::string& title) { SDL_SetWindowTitle(window_, title.c_str()); }

void SdlWindow::SetTextScale(double scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  static const ImWchar kRanges[] = {0x20,
                                    0x24F,
                                    0x370,
                                    0x3FF,
                                    0x400,
                                    0x52F,
                                    0x2010,
                                    0x2030,
                                    0x2190,
                                    0x21FF,
                                    0x25A0,
                                    0x25FF,
                                    0x2713,
                                    0x2717,
                                    0};
  ImFont* font = nullptr;
  for (const char* file : kFontFiles) {
    if (font != nullptr || !std::filesystem::exists(file)) continue;
    font =
        fonts.AddFontFromFileTTF(file, static_cast<float>(kTextSizePx * scale), nullptr, kRanges);
  }
  if (font == nullptr) fonts.AddFontDefault();
  ImGui::GetIO().FontGlobalScale = font != nullptr ? 1.0f : static_cast<float>(scale);
  font_.reset(UploadImGuiFont(renderer_));
  UseStyle(scale);
}

void SdlWindow::BeginFrame() {
  ImGui_ImplSDL2_NewFrame();
  ImGui::NewFrame();
  SDL_SetRenderDrawColor(renderer_, 24, 25, 28, 255);
  SDL_RenderClear(renderer_);
}

void SdlWindow::EndFrame() {
  ImGui::Render();
  DrawImGui(renderer_, *ImGui::GetDrawData());
  SDL_RenderPresent(renderer_);
  // Only while a text field has the keyboard, or dead keys would eat shortcuts.
  const bool wants_text = ImGui::GetIO().WantTextInput;
  if (wants_text && SDL_IsTextInputActive() == SDL_FALSE) SDL_StartTextInput();
  if (!wants_text && SDL_IsTextInputActive() == SDL_TRUE) SDL_StopTextInput();
}

void SdlWindow::WriteScreenshot(const std::filesystem::path& file) const {
  Image8 picture(width_px(), height_px(), 3);
  if (SDL_RenderReadPixels(
          renderer_, nullptr, SDL_PIXELFORMAT_RGB24, picture.values.data(), 3 * picture.width) !=
      0) {
    throw Error(file, std::string("the window cannot be read back: ") + SDL_GetError());
  }
  WriteSrgb8(file, picture);
}

TexturePtr SdlWindow::MakeTexture(const Image8& srgb8) const {
  TexturePtr texture(SDL_CreateTexture(
      renderer_, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STATIC, srgb8.width, srgb8.height));
  if (texture) SDL_UpdateTexture(texture.get(), nullptr, srgb8.values.data(), 3 * srgb8.width);
  return texture;
}

TexturePtr SdlWindow::MakeTexture(int width_px,
                                  int height_px,
                                  const std::vector<uint8_t>& bgra) const {
  TexturePtr texture(SDL_CreateTexture(
      renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STATIC, width_px, height_px));
  if (texture) {
    SDL_SetTextureBlendMode(texture.get(), SDL_BLENDMODE_NONE);
    SDL_UpdateTexture(texture.get(), nullptr, bgra.data(), 4 * width_px);
  }
  return texture;
}

}  // namespace groundglass
