// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace groundglass {
namespace {

constexpr std::array<const char*, 22> kNastyWords = {
    "nan",     "-inf",       "1e999",
    "1e-999",  "0",          "-1",
    "-0",      "4294967296", "99999999999999999999",
    "0x1p3",   "1,5",        "+3",
    "1e",      "%",          "\r\n",
    "\t",      "\"",         "\xEF\xBB\xBF",
    "--1",     "2147483648", ".",
    "\xC3\xA4"};

size_t Below(size_t limit, std::mt19937_64& random) {
  return limit == 0 ? 0 : std::uniform_int_distribution<size_t>(0, limit - 1)(random);
}

std::string PickWord(std::span<const std::string> dictionary, std::mt19937_64& random) {
  const size_t pick = Below(kNastyWords.size() + dictionary.size(), random);
  return pick < kNastyWords.size() ? kNastyWords[pick] : dictionary[pick - kNastyWords.size()];
}

}  // namespace

std::string Mutate(const std::string& text,
                   std::span<const std::string> dictionary,
                   std::mt19937_64& random) {
  std::string damaged = text;
  const size_t num_edits = 1 + Below(4, random);
  for (size_t edit = 0; edit < num_edits; ++edit) {
    const size_t at = Below(damaged.size() + 1, random);
    const size_t length = std::min(Below(24, random), damaged.size() - at);
    switch (Below(7, random)) {
      case 0:  // another byte
        if (at < damaged.size()) damaged[at] = static_cast<char>(Below(256, random));
        break;
      case 1:  // a piece lost
        damaged.erase(at, length);
        break;
      case 2:  // a piece twice
        damaged.insert(at, damaged.substr(at, length));
        break;
      case 3:  // the end lost
        if (Below(4, random) == 0) damaged.resize(at);
        break;
      case 4:  // a word put in
        damaged.insert(at, " " + PickWord(dictionary, random) + " ");
        break;
      case 5: {  // a word exchanged
        const size_t start = damaged.find_first_not_of(" \n", at);
        if (start == std::string::npos) break;
        const size_t end = std::min(damaged.find_first_of(" \n", start), damaged.size());
        damaged.replace(start, end - start, PickWord(dictionary, random));
        break;
      }
      default: {  // a line twice, elsewhere
        const size_t start = damaged.find('\n', at);
        if (start == std::string::npos) break;
        const size_t end = std::min(damaged.find('\n', start + 1), damaged.size());
        damaged.insert(Below(damaged.size() + 1, random), damaged.substr(start, end - start));
      }
    }
  }
  return damaged;
}

int FuzzRounds() {
  const char* rounds = std::getenv("GROUNDGLASS_FUZZ_ROUNDS");
  return rounds != nullptr ? std::atoi(rounds) : 3000;
}

}  // namespace groundglass
