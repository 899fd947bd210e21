#!/bin/sh
# Draws films and pictures of docs/media from the models here: films.sh SBFMT [NAME...], SBFMT being the program.
set -eu
[ $# -gt 0 ] || { echo 'films.sh: give the program: films.sh build/release/tools/sbfmt [NAME...]' >&2; exit 2; }
sbfmt=$(realpath "$1")
shift
cd "$(dirname "$0")"
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
names=$*
wanted() {
  case " ${names:-$1} " in *" $1 "*) ;; *) return 1 ;; esac
}
# bundle NAME: the example as $folder/NAME.sbf
bundle() {
  maker=$(echo "$1"/make*bundle.py)
  if [ -f "$maker" ]; then
    python3 -B "$maker" "$sbfmt" "$folder/$1.sbf"
  elif [ -f "$1/$1.obj" ]; then
    "$sbfmt" convert "$1/$1.obj" --rig "$1/$1.glb" -o "$folder/$1.sbf"
  else
    "$sbfmt" convert "$1/$1.glb" -o "$folder/$1.sbf"
  fi >/dev/null
}
# draw NAME BUNDLE OPTION...: docs/media/NAME.webp
draw() {
  name=$1 source=$2
  shift 2
  "$sbfmt" render "$folder/$source.sbf" -o "../docs/media/$name.webp" --fps 20 --quality 62 "$@"
}
# film NAME VIEW SECONDS: the example's script
film() {
  wanted "$1" || return 0
  bundle "$1"
  draw "$1" "$1" --script "$1/walk.txt" --view "$2" --seconds "$3" --size 640x392
}
film pup 62,14 4.5
film calf 60,14 4
film caterpillar 58,20 4
film yeti 60,12 5
film spider 38,24 3.5
film snake 32,30 3.8
film koi 48,26 4
film dragon 48,26 3.8
film pudding 55,16 3.8
if wanted lizard; then
  "$sbfmt" convert lizard/lizard_skin.obj --rig lizard/lizard_skin.glb -o "$folder/lizard_skin.sbf" >/dev/null
  draw lizard lizard_skin --drive 0.4,-0.12 --ground noise:0.25,7 --seconds 4.5 --size 720x405
fi
if wanted gait; then bundle lizard && draw gait lizard --drive 0.3,0.35 --show surface,feet --view 75,22 --seconds 3 --size 640x392; fi
if wanted crowd; then
  crowd=${CROWD:?name the program of examples/crowd in CROWD}
  bundle lizard
  "$sbfmt" build "$folder/lizard.sbf" --levels 2 -o "$folder/crowd.sbfz" >/dev/null
  mkdir "$folder/frames"
  "$crowd" "$folder/crowd.sbfz" 200 4 0 "$folder/frames" >/dev/null
  ffmpeg -v error -y -framerate 10 -i "$folder/frames/frame%04d.ppm" -vf crop=960:340:0:190 -c:v libwebp_anim -quality 80 \
    -loop 0 ../docs/media/crowd.webp
fi
if wanted crowd-meets; then
  crowd=${CROWD:?name the program of examples/crowd in CROWD}
  "$sbfmt" convert lizard/lizard.obj --rig lizard/lizard.glb --springs tetrahedra --levels 4 -o "$folder/lattices.sbfz" >/dev/null
  mkdir "$folder/meets"
  "$crowd" "$folder/lattices.sbfz" 40 2 0 "$folder/meets" close >/dev/null
  ffmpeg -v error -y -i "$folder/meets/frame0012.ppm" -vf crop=960:340:0:190 ../docs/media/crowd-meets.png
fi
# still NAME BUNDLE OPTION...: $folder/NAME.png
still() {
  name=$1 source=$2
  shift 2
  "$sbfmt" render "$folder/$source" -o "$folder/$name.png" "$@"
}
if wanted bones; then
  for name in figure flesh; do "$sbfmt" build "bones/$name.sbf" -o "$folder/$name.sbfz" --elements 2800 >/dev/null; done
  still bones figure.sbfz --raise 2 --seconds 4 --size 560x560 --view 8,6 --show surface,bones
  still flesh flesh.sbfz --raise 2 --seconds 4 --size 560x560 --view 8,6
  cp "$folder/bones.png" "$folder/flesh.png" ../docs/media
fi
if wanted tear; then
  "$sbfmt" build tear/bar.sbf -o "$folder/bar.sbfz" --elements 1500 >/dev/null
  still tear bar.sbfz --seconds 0.3 --size 480x640 --view 25,10
  cp "$folder/tear.png" ../docs/media
fi
if wanted sections; then
  bundle calf
  for what in hulls springs surface; do
    still "$what" calf.sbf --show "$what" --seconds 1.3 --drive 0.3,0.2 --size 560x440 --view 60,12
  done
  ffmpeg -v error -y -i "$folder/hulls.png" -i "$folder/springs.png" -i "$folder/surface.png" -filter_complex hstack=3 \
    ../docs/media/sections.png
fi
