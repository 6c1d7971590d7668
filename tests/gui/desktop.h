// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>
#include <nlohmann/json.hpp>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A display without a screen, of this object's own.
class Desktop {
 public:
  // layout: of the keyboard, as setxkbmap calls it; empty: as it comes. Throws if that program is
  // not there (HasLayouts).
  Desktop(int width_px, int height_px, const std::string& layout = "");
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  static bool HasLayouts();
  const std::string& name() const { return name_; }
  // Ends on the spot, as when a cable is pulled.
  void Kill();

 private:
  pid_t server_ = -1;
  std::string name_;
};

// `groundglass view` on a desktop, and a person's hands: key presses and mouse moves come from the
// display's own test extension, as from a keyboard and a mouse.
class WindowUnderTest {
 public:
  WindowUnderTest(const Desktop& desktop,
                  const std::vector<std::string>& arguments,
                  const std::filesystem::path& folder);
  ~WindowUnderTest();
  WindowUnderTest(const WindowUnderTest&) = delete;
  WindowUnderTest& operator=(const WindowUnderTest&) = delete;

  // "Ctrl+Shift+Z", "F3", "Left": down and up again.
  void Key(const std::string& keys);
  // The key where a QWERTY keyboard has this letter or sign, whatever its layout makes of it.
  void Place(char qwerty, bool is_down);
  void MoveTo(const Eigen::Vector2d& window_px);
  void Button(int button, bool is_down);
  void Click(const Eigen::Vector2d& window_px);
  // Presses at the first place, moves in steps, releases at the last.
  void Drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  // Waits until all that was asked for is done and drawn; what the window says of itself then.
  nlohmann::json Fence();
  // What the display shows of it.
  Image8 Picture();
  // The exit status once it has ended; -1 if a signal ended it.
  int Wait();

 private:
  void Flush();

  std::filesystem::path log_;
  pid_t program_ = -1;
  int status_ = 0;
  int num_fences_ = 0;
  void* display_ = nullptr;                              // Xlib's
  Eigen::Vector2d corner_px_ = Eigen::Vector2d::Zero();  // of the window, on the desktop
  Eigen::Vector2i size_px_ = Eigen::Vector2i::Zero();
};

}  // namespace groundglass
