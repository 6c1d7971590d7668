#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Installs what is missing (Debian 12 or later), builds, and runs every test.
set -euo pipefail

usage() {
  cat <<END
./test.sh [OPTIONS] [-- CTEST ARGUMENTS]
  (none)       build with optimisation, run every test
  --sanitize   the same under AddressSanitizer and UndefinedBehaviorSanitizer
  --sanitize-readers
               under these, only what reads files from elsewhere: scene and tests/fuzz
  --long       every test, longer fuzzing, the benchmarks, then --sanitize
  --tidy       read every source with clang-tidy; warnings are errors
  --names      the same for the rooms without their tests, and only names and sizes of functions
  --format     check the formatting only; nothing is built
  --no-install leave the machine's packages alone
  -- ARGS      handed to ctest, e.g.  -- -R register/
END
}

cd "$(dirname "${BASH_SOURCE[0]}")"
preset=release
long=no
install=yes
while (($#)); do
  case $1 in
    --sanitize) preset=dev ;;
    --sanitize-readers) preset=readers ;;
    --long) long=yes ;;
    --tidy) preset=tidy ;;
    --names) preset=names ;;
    --format) preset=format ;;
    --no-install) install=no ;;
    -h | --help) usage; exit 0 ;;
    --) shift; break ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

packages() { if [[ $install == yes ]]; then ./install-packages.sh "$@"; fi; }

if [[ $preset == format ]]; then
  packages format
  echo "== clang-format"
  find scene calibrate register ask session invrender viewer gui drawing exchange report pipeline \
    datasets-synthetic evaluate cli tests -name '*.h' -o -name '*.cc' | sort | xargs clang-format --dry-run -Werror
  echo "The formatting is as .clang-format says."
  exit 0
fi

# configure_and_build PRESET [TARGET]: with ccache where the machine has it.
configure_and_build() {
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  echo "== Configuring and building ($1)"
  cmake --log-level=WARNING --preset "$1" "${launcher[@]}"
  cmake --build --preset "$1" --parallel "$(nproc)" ${2:+--target "$2"}
}

if [[ $preset == tidy || $preset == names ]]; then
  checks=()
  if [[ $preset == names ]]; then
    checks=('--checks=-*,readability-identifier-naming,readability-function-size')
    packages build tidy
  else
    packages build test tidy
  fi
  echo "== clang-tidy"
  cmake --log-level=WARNING --preset "$preset"
  cmake --build --preset "$preset" --target embedded_files
  # Several sources at a time, as they are compiled: most of the work is reading what they include.
  # The largest first, so that no core waits for the last one.
  grep -o '"file": "[^"]*"' "build/$preset/compile_commands.json" | cut -d'"' -f4 |
    grep -v cmake_pch | sort -u | xargs wc -l | grep -v ' total$' | sort -rn | awk '{print $2}' |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "build/$preset" "${checks[@]}"
  echo "clang-tidy found nothing."
  exit 0
fi

packages build test
if [[ $preset == readers ]]; then
  configure_and_build dev fuzz_tests
  echo "== Testing (dev, damaged files)"
  ctest --preset dev -j "$(nproc)" -R '^fuzz/' "$@"
  exit 0
fi
if [[ $long == yes ]]; then export GROUNDGLASS_FUZZ_ROUNDS=200000; fi
configure_and_build "$preset"
echo "== Testing ($preset)"
ctest --preset "$preset" -j "$(nproc)" "$@"

if [[ $long == yes && $preset == release ]]; then
  echo "== Benchmarks"
  find build/release/tests/bench -maxdepth 1 -type f -name '*bench*' -executable | sort |
    while read -r bench; do "$bench"; done
  configure_and_build dev
  echo "== Testing (dev)"
  ctest --preset dev -j "$(nproc)" "$@"
fi
