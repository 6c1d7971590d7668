// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/journal.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <system_error>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

fs::path StateFolder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state) return state;
  if (const char* home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".local" / "state";
  }
  return fs::temp_directory_path();
}

// A path as one name: letters and digits kept, all else as its code.
std::string NameOf(const fs::path& folder) {
  std::error_code ignored;
  const std::string path = fs::weakly_canonical(folder, ignored).string();
  std::string name;
  for (const unsigned char c : path) {
    if (std::isalnum(c) || c == '-' || c == '_') {
      name += static_cast<char>(c);
    } else {
      constexpr char kDigits[] = "0123456789abcdef";
      name += {'.', kDigits[c >> 4], kDigits[c & 15]};
    }
  }
  constexpr size_t kLongestName = 200;
  return name.size() > kLongestName ? name.substr(name.size() - kLongestName) : name;
}

std::string LineOf(const std::string& photograph, const PhotographWork& work) {
  return photograph + "\t" + FormatWork(work) + "\n";
}

}  // namespace

fs::path Journal::PlaceFor(const fs::path& scene_folder) {
  return StateFolder() / "groundglass" / (NameOf(scene_folder) + ".journal");
}

std::map<std::string, PhotographWork> Journal::Read() const {
  std::map<std::string, PhotographWork> works;
  std::ifstream stream(file_, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    const size_t tab = line.find('\t');
    if (tab == std::string::npos || stream.eof()) continue;
    try {
      works[line.substr(0, tab)] = ParseWork(line.substr(tab + 1));
    } catch (const Error&) {
      // A line that was cut short, or another version's.
    }
  }
  return works;
}

std::string Journal::LastStepAt() const {
  std::error_code error;
  const auto written = fs::last_write_time(file_, error);
  if (error) return "";
  const auto since = fs::file_time_type::clock::now() - written;
  const std::time_t when = std::chrono::system_clock::to_time_t(
      std::chrono::system_clock::now() -
      std::chrono::duration_cast<std::chrono::system_clock::duration>(since));
  std::tm local = {};
  localtime_r(&when, &local);
  char text[32];
  std::strftime(text, sizeof text, "%H:%M", &local);
  return text;
}

void Journal::Append(const std::string& photograph, const PhotographWork& work) const {
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  std::ofstream stream(file_, std::ios::binary | std::ios::app);
  stream << LineOf(photograph, work) << std::flush;
}

void Journal::Restart(const std::map<std::string, PhotographWork>& unsaved) const {
  std::error_code ignored;
  if (unsaved.empty()) {
    fs::remove(file_, ignored);
    return;
  }
  std::string text;
  for (const auto& [photograph, work] : unsaved) text += LineOf(photograph, work);
  try {
    WriteFileAtomically(file_, text);
  } catch (const Error&) {
    // Without a place for a journal there is none.
  }
}

}  // namespace groundglass
