#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Installs the Debian packages that are missing, and only those. Debian 12 or later.
#   ./install-packages.sh [build] [test] [tidy] [format]     default: build
# build: what the program needs; test: GoogleTest, Google Benchmark and COLMAP as well;
# tidy, format: clang-tidy, clang-format.
set -euo pipefail

build=(g++ cmake ninja-build pkg-config
  libopencv-dev libceres-dev libeigen3-dev libtbb-dev libembree-dev
  libopenimageio-dev openimageio-tools  # its CMake file asks for its programs too
  liblcms2-dev libjpeg-dev libtiff-dev libutf8proc-dev libpolyclipping-dev libtinygltf-dev
  libstb-dev nlohmann-json3-dev libcli11-dev libssl-dev libfmt-dev libkainjow-mustache-dev
  libapriltag-dev libosmesa6-dev libegl-dev libsqlite3-dev ffmpeg
  libsdl2-dev libimgui-dev libgeographiclib-dev)
test=(libgtest-dev libgmock-dev libbenchmark-dev colmap xvfb libxtst-dev)
tidy=(clang-tidy)
format=(clang-format)

wanted=()
for group in "${@:-build}"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    tidy) wanted+=("${tidy[@]}") ;;
    format) wanted+=("${format[@]}") ;;
    *) echo "install-packages.sh: no such group: $group" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian: please install what these packages hold: ${wanted[*]}" >&2
  exit 1
fi
missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [[ $status == *" installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "Packages: all installed"
  exit 0
fi

echo "Packages to install: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Please run as root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}"
