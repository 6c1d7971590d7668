// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/unfinished_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <string>

namespace groundglass {
namespace {

// A signal handler may neither lock nor allocate: names lie in slots that are never freed. More
// files than threads are written at once only where several go together.
struct Slot {
  std::atomic<bool> is_taken = false;
  std::atomic<bool> holds_name = false;
  std::array<char, PATH_MAX> name = {};
};
constexpr int kNumSlots = 64;

std::array<Slot, kNumSlots>& Slots() {
  static std::array<Slot, kNumSlots> slots;
  return slots;
}

std::atomic<const char*> words_on_interrupt = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free);

void WriteToStandardError(const char* text) {
  size_t length = 0;
  while (text[length] != 0) ++length;
  // Nobody is left to be told that it cannot be written.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, length);
}

extern "C" void RemoveAndEnd(int signal) {
  const char* const words = words_on_interrupt.load();
  if (signal == SIGINT && words != nullptr) {
    WriteToStandardError("\n");  // after ^C
    WriteToStandardError(words);
    WriteToStandardError("\n");
  }
  for (Slot& slot : Slots()) {
    if (slot.holds_name.load(std::memory_order_acquire)) unlink(slot.name.data());
  }
  // The handler is gone (SA_RESETHAND); the signal takes effect once this returns.
  raise(signal);
}

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& file) : slot_(-1) {
  // The program may change its working directory.
  std::error_code error;
  const std::string name = std::filesystem::absolute(file, error).string();
  if (error || name.size() >= PATH_MAX) return;
  for (int i = 0; i < kNumSlots; ++i) {
    Slot& slot = Slots()[static_cast<size_t>(i)];
    if (slot.is_taken.exchange(true)) continue;
    std::copy(name.begin(), name.end(), slot.name.begin());
    slot.name[name.size()] = 0;
    slot.holds_name.store(true, std::memory_order_release);
    slot_ = i;
    return;
  }
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ < 0) return;
  Slot& slot = Slots()[static_cast<size_t>(slot_)];
  slot.holds_name.store(false);
  slot.is_taken.store(false);
}

WordsOnInterrupt::WordsOnInterrupt(const char* words) { words_on_interrupt.store(words); }
WordsOnInterrupt::~WordsOnInterrupt() { words_on_interrupt.store(nullptr); }

void RemoveUnfinishedFilesOnSignals() {
  Slots();  // made before a signal could need them
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    struct sigaction removal = {};
    removal.sa_handler = RemoveAndEnd;
    removal.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &removal, nullptr);
  }
}

}  // namespace groundglass
