// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/gui/desktop.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace groundglass {
namespace {

using namespace std::chrono_literals;

pid_t Start(const std::vector<std::string>& words, const std::vector<std::string>& environment) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::vector<char*> variables;
  for (const std::string& variable : environment) {
    variables.push_back(const_cast<char*>(variable.c_str()));
  }
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  variables.push_back(nullptr);
  pid_t child = -1;
  if (posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), variables.data()) !=
      0) {
    throw std::runtime_error("cannot start " + words[0]);
  }
  return child;
}

KeySym SymbolOf(const std::string& key) {
  static const std::map<std::string, KeySym> kOthers = {{"Ctrl", XK_Control_L},
                                                        {"Shift", XK_Shift_L},
                                                        {"Alt", XK_Alt_L},
                                                        {"Backspace", XK_BackSpace},
                                                        {"PageUp", XK_Prior},
                                                        {"PageDown", XK_Next}};
  const auto other = kOthers.find(key);
  if (other != kOthers.end()) return other->second;
  const KeySym symbol = XStringToKeysym(
      key.size() == 1 ? std::string(1, static_cast<char>(std::tolower(key[0]))).c_str()
                      : key.c_str());
  if (symbol == NoSymbol) throw std::runtime_error("no key is called " + key);
  return symbol;
}

}  // namespace

Desktop::Desktop(int width_px, int height_px, const std::string& layout) {
  int channel[2];
  if (pipe(channel) != 0) throw std::runtime_error("no pipe");
  const std::string size = std::to_string(width_px) + "x" + std::to_string(height_px) + "x24";
  server_ = Start({GROUNDGLASS_XVFB,
                   "-displayfd",
                   std::to_string(channel[1]),
                   "-screen",
                   "0",
                   size,
                   "-nolisten",
                   "tcp",
                   "-noreset"},  // or the layout goes with the program that set it
                  {});
  close(channel[1]);
  // The server writes its number once it listens.
  std::string number;
  for (char c; read(channel[0], &c, 1) == 1 && c != '\n';) number += c;
  close(channel[0]);
  if (number.empty()) throw std::runtime_error("Xvfb does not start");
  name_ = ":" + number;
  if (layout.empty()) return;
  const pid_t setter = Start({GROUNDGLASS_SETXKBMAP, "-display", name_, layout}, {});
  int status = 0;
  waitpid(setter, &status, 0);
  if (status != 0) throw std::runtime_error("the keyboard has no layout " + layout);
}

bool Desktop::HasLayouts() { return std::filesystem::exists(GROUNDGLASS_SETXKBMAP); }

Desktop::~Desktop() { Kill(); }

void Desktop::Kill() {
  if (server_ < 0) return;
  kill(server_, SIGKILL);
  waitpid(server_, nullptr, 0);
  server_ = -1;
}

WindowUnderTest::WindowUnderTest(const Desktop& desktop,
                                 const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder)
    : log_(folder / ("log" + desktop.name())) {
  display_ = XOpenDisplay(desktop.name().c_str());
  if (display_ == nullptr) throw std::runtime_error("cannot reach the display");
  std::filesystem::remove(log_);
  std::vector<std::string> words = {GROUNDGLASS_PROGRAM, "view", "--test-log", log_.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  program_ = Start(words,
                   {"DISPLAY=" + desktop.name(),
                    "SDL_VIDEODRIVER=x11",
                    "XDG_STATE_HOME=" + (folder / "state").string()});
  // It has the keyboard once its window is there, since there is nobody else.
  auto* display = static_cast<Display*>(display_);
  for (bool is_there = false; !is_there && status_ == 0;) {
    Window root = 0;
    Window parent = 0;
    Window* children = nullptr;
    unsigned count = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i) {
      XWindowAttributes attributes;
      if (XGetWindowAttributes(display, children[i], &attributes) == 0) continue;
      if (attributes.map_state != IsViewable || attributes.width < 200) continue;
      XSetInputFocus(display, children[i], RevertToPointerRoot, CurrentTime);
      corner_px_ = {attributes.x, attributes.y};
      size_px_ = {attributes.width, attributes.height};
      is_there = true;
    }
    if (children != nullptr) XFree(children);
    XSync(display, False);
    if (waitpid(program_, &status_, WNOHANG) == program_) {
      program_ = -1;
      throw std::runtime_error("the window closed at once");
    }
    std::this_thread::sleep_for(20ms);
  }
}

WindowUnderTest::~WindowUnderTest() {
  if (program_ > 0) {
    kill(program_, SIGKILL);
    waitpid(program_, nullptr, 0);
  }
  // A display whose server is gone cannot be closed: Xlib would end this process.
  std::error_code ignored;
  std::filesystem::remove(log_, ignored);
}

void WindowUnderTest::Flush() { XFlush(static_cast<Display*>(display_)); }

void WindowUnderTest::Key(const std::string& keys) {
  auto* display = static_cast<Display*>(display_);
  std::vector<KeyCode> codes;
  for (size_t start = 0; start < keys.size();) {
    const size_t end = std::min(keys.find('+', start), keys.size());
    codes.push_back(XKeysymToKeycode(display, SymbolOf(keys.substr(start, end - start))));
    start = end + 1;
  }
  for (const KeyCode code : codes) XTestFakeKeyEvent(display, code, True, 0);
  for (size_t i = codes.size(); i > 0; --i) XTestFakeKeyEvent(display, codes[i - 1], False, 0);
  Flush();
}

void WindowUnderTest::Place(char qwerty, bool is_down) {
  // By evdev's numbers, which Xvfb has.
  static const std::map<char, unsigned> kCodes = {{'5', 14}, {'W', 25}, {']', 35}, {'A', 38}};
  XTestFakeKeyEvent(static_cast<Display*>(display_), kCodes.at(qwerty), is_down, 0);
  Flush();
}

void WindowUnderTest::MoveTo(const Eigen::Vector2d& window_px) {
  XTestFakeMotionEvent(static_cast<Display*>(display_),
                       -1,
                       static_cast<int>(std::lround(corner_px_.x() + window_px.x())),
                       static_cast<int>(std::lround(corner_px_.y() + window_px.y())),
                       0);
  Flush();
}

void WindowUnderTest::Button(int button, bool is_down) {
  XTestFakeButtonEvent(static_cast<Display*>(display_), button, is_down, 0);
  Flush();
}

void WindowUnderTest::Click(const Eigen::Vector2d& window_px) {
  MoveTo(window_px);
  Fence();
  Button(1, true);
  Fence();
  Button(1, false);
}

void WindowUnderTest::Drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  MoveTo(from);
  Fence();
  Button(1, true);
  Fence();
  constexpr int kSteps = 4;
  for (int i = 1; i <= kSteps; ++i) MoveTo(from + (to - from) * i / kSteps);
  Fence();
  Button(1, false);
}

nlohmann::json WindowUnderTest::Fence() {
  ++num_fences_;
  Key("Pause");
  for (;;) {
    std::ifstream stream(log_);
    std::string line;
    int count = 0;
    while (count < num_fences_ && std::getline(stream, line) && !stream.eof()) ++count;
    if (count == num_fences_) return nlohmann::json::parse(line);
    if (waitpid(program_, &status_, WNOHANG) == program_) {
      program_ = -1;
      throw std::runtime_error("the window is gone");
    }
    std::this_thread::sleep_for(10ms);
  }
}

Image8 WindowUnderTest::Picture() {
  auto* display = static_cast<Display*>(display_);
  XImage* shown = XGetImage(display,
                            DefaultRootWindow(display),
                            static_cast<int>(corner_px_.x()),
                            static_cast<int>(corner_px_.y()),
                            static_cast<unsigned>(size_px_.x()),
                            static_cast<unsigned>(size_px_.y()),
                            AllPlanes,
                            ZPixmap);
  if (shown == nullptr) throw std::runtime_error("the display shows nothing");
  Image8 picture(size_px_.x(), size_px_.y(), 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const unsigned long rgb = XGetPixel(shown, x, y);
      for (int c = 0; c < 3; ++c) {
        picture.At(x, y)[c] = static_cast<uint8_t>(rgb >> (16 - 8 * c) & 0xff);
      }
    }
  }
  XDestroyImage(shown);
  return picture;
}

int WindowUnderTest::Wait() {
  if (program_ > 0) waitpid(program_, &status_, 0);
  program_ = -1;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

}  // namespace groundglass
