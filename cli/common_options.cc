// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "cli/option_range.h"

#include <tbb/global_control.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

namespace groundglass {
namespace {

constexpr int kMostLogLines = 20;

}  // namespace

void AddCommonOptions(CLI::App* command, CommonOptions& options) {
  command->add_flag("--json", options.json, "machine-readable result on stdout");
  command->add_flag("--quiet", options.quiet, "no progress on stderr");
  command->add_flag("--dry-run", options.dry_run, "say what would be done, write nothing");
  command->add_option("--threads", options.threads, "threads to use; 0: every core")
      ->check(AtLeast(0));
  command->add_option("--seed", options.seed, "seed of everything that is drawn by chance")
      ->check(AtLeast(0))
      ->capture_default_str();
}

void AddExample(CLI::App* command, const std::string& example) {
  command->footer("\nExample:\n  " + example);
}

CLI::Option* AddChoice(CLI::App* command,
                       const std::string& name,
                       const std::vector<std::string>& words,
                       const std::string& description,
                       std::string& word) {
  std::string list;
  for (const std::string& known : words) list += (list.empty() ? "" : "|") + known;
  return command->add_option(name, word, description)
      ->check(CLI::IsMember(words).description(""))
      ->option_text(list);
}

int RunWithThreads(const CommonOptions& options, const std::function<int()>& work) {
  const unsigned threads = options.threads > 0 ? static_cast<unsigned>(options.threads)
                                               : std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return work();
}

Progress MakeProgress(const CommonOptions& options, const std::string& title) {
  if (options.quiet) return {};
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  const auto start = std::chrono::steady_clock::now();
  return [=](int done, int total, const std::string& what) {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!on_terminal) {
      // A log holds all of a few steps, and of many every twentieth part.
      if (total > kMostLogLines && done < total &&
          done * kMostLogLines / total == (done - 1) * kMostLogLines / total) {
        return;
      }
      std::fprintf(stderr, "%s %d/%d %s\n", title.c_str(), done, total, what.c_str());
      return;
    }
    const double rate = seconds > 0 ? done / seconds : 0;
    const double left = rate > 0 ? (total - done) / rate : 0;
    std::fprintf(stderr,
                 "\r\033[K%s %d/%d %s  %.1f/s  %.0f s left",
                 title.c_str(),
                 done,
                 total,
                 what.c_str(),
                 rate,
                 left);
    if (done >= total) std::fputc('\n', stderr);
    std::fflush(stderr);
  };
}

}  // namespace groundglass
