#!/bin/sh
# Draws the charts, maps and throws of docs/media again: draw_docs.sh SBFMT [NAME...], SBFMT being the program of a build that has
# its benchmarks. Charts come from the tables in bench/results, so nothing is timed; maps are computed, which gives the same on
# every machine.
set -eu
[ $# -gt 0 ] || { echo 'draw_docs.sh: give the program: draw_docs.sh build/release/tools/sbfmt [NAME...]' >&2; exit 2; }
sbfmt=$(realpath "$1")
shift
cd "$(dirname "$0")/.."
results=bench/results/xeon-2-cores
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
names=$*
wanted() {
  case " ${names:-$1} " in *" $1 "*) ;; *) return 1 ;; esac
}
# chart NAME DRAWING [FILE]: of the drawings of that table the one that docs show; FILE: whose motion it is
chart() {
  wanted "$1" || return 0
  "$sbfmt" chart ${3:+"$3"} --redraw "$results/$1.csv" -o "$folder" >/dev/null
  cp "$folder/$2.svg" "docs/media/$1.svg"
}
# map NAME CELLS
map() {
  wanted "map-$1" || return 0
  "$sbfmt" chart --map --case "$1" --cells "$2" -o "$folder" >/dev/null
  cp "$folder/map-$1.svg" docs/media
}
chart chart-meshes cantilever-meshes-shape
chart chart-beam beam-amplitude
chart chart-drop drop-volume
chart chart-pendulum pendulum-period
if wanted chart-character; then
  "$sbfmt" convert examples/pup/pup.glb --budget none -o "$folder/pup.sbf" >/dev/null 2>&1
  chart chart-character walk-path_px "$folder/pup.sbf"
fi
map damping 96
map mass-springs 96
map poisson 96
if wanted thrown; then
  "$(dirname "$sbfmt")/../bench/bench_thrown" --draw "$folder"
  for name in figure flesh; do
    "$sbfmt" render "$folder/thrown-$name.sbf" -o "docs/media/thrown-$name.png" --view 12,4 --size 1280x400
  done
fi
if wanted levels; then gnuplot bench/draw_levels.gp; fi
if wanted peers; then gnuplot bench/draw_peers.gp; fi
