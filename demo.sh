#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Installs what is missing (Debian 12 or later), builds the program with the commands that are needed
# here, and runs the main job on the bundled brick scene:
#   ./demo.sh [OUTPUT FOLDER]       default: out/demo
set -euo pipefail

from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"
out=out/demo
if (($#)); then
  case $1 in
    -*) echo "./demo.sh [OUTPUT FOLDER]" >&2; exit 2 ;;
    /*) out=$1 ;;
    *) out=$from/$1 ;;
  esac
fi
scene=datasets-synthetic/brick

# run COMMAND...: status 3 says that some photographs want a person's eye, which is no failure.
run() {
  local status=0
  "$@" || status=$?
  if ((status != 0 && status != 3)); then exit "$status"; fi
}

./install-packages.sh build
echo "== Building"
if [[ ! -f build/release/build.ninja ]]; then  # else as test.sh left it
  launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  cmake --log-level=WARNING --preset release "${launcher[@]}" \
    -DGROUNDGLASS_EVERY_COMMAND=OFF -DGROUNDGLASS_TESTS=OFF -DGROUNDGLASS_BENCH=OFF
fi
# One compiler for each core: more at once take longer, and more of the processor.
cmake --build --preset release --target groundglass --parallel "$(nproc)"
groundglass=build/release/cli/groundglass

echo "== Correcting the tags and baking the texture"
run "$groundglass" run "$scene" -o "$out"

echo "== Rendering views that nobody photographed"
mkdir -p "$out/novel"
for view in "$scene"/truth/novel/*.view; do
  "$groundglass" render "$out/model.glb" --view "$view" \
    -o "$out/novel/$(basename "$view" .view).png"
done

echo "== Comparing with the truth"
run "$groundglass" evaluate "$out" --truth "$scene/truth"

out=$(cd "$out" && pwd)
cat <<END

Done. Please look at
  $out/report.html     the whole story
  $out/overlays/       the model's edges on each photograph: measured in grey, corrected in colour
  $out/novel/          the textured model from new viewpoints; $PWD/$scene/truth/novel/ has the truth
  $out/model.glb       the textured model, for any glTF viewer
  $out/views/          the corrected tags

END
# What the demo did without, as the program itself says.
build_it=$("$groundglass" help calibrate | sed -n 's/.*this builds it: //p')
if [[ -n $build_it ]]; then
  cat <<END
The demo does without view, where, calibrate, synth and parts of render, evaluate and convert; this
builds them:
  $build_it

END
fi
cat <<END
A window on it, where there is a display:
  $groundglass view $out --scene $scene
END
