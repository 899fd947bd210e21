#!/bin/sh
# The example lizard's sections, loose, dropped from a metre, with its own surface and with one four times as fine.
# The program is $SBFMT, or that of build/release; what it makes goes into drop-out/, or the folder named.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
lizard=$here/../lizard/lizard
sbfmt=${SBFMT:-$here/../../build/release/tools/sbfmt}
out=${1:-drop-out}
mkdir -p "$out"
cp "$lizard.obj" "$out/as-it-is.obj"
cp "$lizard.mtl" "$out"
python3 "$here/subdivide.py" "$lizard.obj" "$out/subdivided.obj"
for name in as-it-is subdivided; do
  "$sbfmt" convert "$out/$name.obj" --rig "$lizard.glb" -o "$out/$name.sbfz"
  "$sbfmt" run "$out/$name.sbfz" --free --raise 1 --seconds 5 | tee "$out/$name.txt"
  "$sbfmt" render "$out/$name.sbfz" --free --raise 1 --seconds 5 --size 960x540 -o "$out/$name.png"
done
