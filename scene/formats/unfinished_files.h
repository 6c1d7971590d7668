// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>

namespace groundglass {

// A file that is being written under a name of its own, and is of no use to anybody until it is
// renamed. As long as this lives, a signal that ends the program removes the file.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

 private:
  int slot_;  // -1: there was none left, or the name is too long; nothing is removed then
};

// For main: SIGINT, SIGTERM and SIGHUP remove unfinished files, then end the program as they would
// have without. One that is ignored stays so (nohup).
void RemoveUnfinishedFilesOnSignals();

// What SIGINT says to the person at the keyboard before it ends the program: one line on stderr. As
// long as this lives.
class WordsOnInterrupt {
 public:
  // `words`: a literal.
  explicit WordsOnInterrupt(const char* words);
  WordsOnInterrupt(const WordsOnInterrupt&) = delete;
  WordsOnInterrupt& operator=(const WordsOnInterrupt&) = delete;
  ~WordsOnInterrupt();
};

}  // namespace groundglass
