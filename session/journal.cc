// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/journal.h"

#include "scene/error.h"
#include "scene/formats/atomic_file.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

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

// Stands where a work has its JSON, so that earlier versions leave it out.
constexpr std::string_view kMaskMark = "mask\t";

std::string LineOf(const std::string& photograph, const PhotographWork& work) {
  return photograph + "\t" + FormatWork(work) + "\n";
}

std::string LineOf(const std::string& photograph, const JournalMaskStep& step) {
  return photograph + "\t" + std::string(kMaskMark) + step.mask_key + "\t" +
         FormatMaskStep(step.step) + "\n";
}

bool IsOfMask(const std::string& line) {
  const size_t tab = line.find('\t');
  return tab != std::string::npos && line.compare(tab + 1, kMaskMark.size(), kMaskMark) == 0;
}

// Throws Error for a line that is none.
void ReadLine(const std::string& line, JournalContents& contents) {
  const size_t tab = line.find('\t');
  if (tab == std::string::npos) throw Error("not a line of a journal");
  const std::string photograph = line.substr(0, tab);
  if (!IsOfMask(line)) {
    contents.works[photograph] = ParseWork(line.substr(tab + 1));
    return;
  }
  const size_t key = tab + 1 + kMaskMark.size();
  const size_t key_end = line.find('\t', key);
  if (key_end == std::string::npos) throw Error("not a line of a journal");
  JournalMaskStep step = {line.substr(key, key_end - key),
                          ParseMaskStep(std::string_view(line).substr(key_end + 1))};
  contents.mask_steps[photograph].push_back(std::move(step));
}

}  // namespace

fs::path Journal::PlaceFor(const fs::path& scene_folder) {
  return StateFolder() / "groundglass" / (NameOf(scene_folder) + ".journal");
}

JournalContents Journal::Read() const {
  JournalContents contents;
  std::ifstream stream(file_, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    try {
      if (stream.eof()) throw Error("a line without its end");
      ReadLine(line, contents);
    } catch (const Error&) {
      ++contents.num_unreadable;
    }
  }
  return contents;
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

void Journal::AppendLine(const std::string& line) const {
  if (file_.empty()) return;
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  // A line that an earlier session could not finish must not take this one with it.
  std::ifstream before(file_, std::ios::binary | std::ios::ate);
  bool is_cut = before && before.tellg() > 0;
  if (is_cut) {
    before.seekg(-1, std::ios::end);
    is_cut = before.get() != '\n';
  }
  std::ofstream stream(file_, std::ios::binary | std::ios::app);
  if (is_cut) stream << '\n';
  stream << line << std::flush;
}

void Journal::Append(const std::string& photograph, const PhotographWork& work) const {
  AppendLine(LineOf(photograph, work));
}

void Journal::Append(const std::string& photograph, const JournalMaskStep& step) const {
  AppendLine(LineOf(photograph, step));
}

void Journal::Restart(bool keeps_masks, const std::string& lines) const {
  if (file_.empty()) return;
  std::string text;
  std::ifstream stream(file_, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    if (!stream.eof() && !line.empty() && IsOfMask(line) == keeps_masks) text += line + "\n";
  }
  text += lines;
  if (text.empty()) {
    Remove();
    return;
  }
  try {
    WriteFileAtomically(file_, text);
  } catch (const Error&) {
    // Without a place for a journal there is none.
  }
}

void Journal::RestartWorks(const std::map<std::string, PhotographWork>& unsaved) const {
  std::string lines;
  for (const auto& [photograph, work] : unsaved) lines += LineOf(photograph, work);
  Restart(true, lines);
}

void Journal::RestartMasks(const std::map<std::string, JournalMaskStep>& unsaved) const {
  std::string lines;
  for (const auto& [photograph, step] : unsaved) lines += LineOf(photograph, step);
  Restart(false, lines);
}

void Journal::Remove() const {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

}  // namespace groundglass
