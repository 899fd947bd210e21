#!/bin/sh
# Draws the films of docs/media from the models here: films.sh SBFMT [NAME...], SBFMT being the program.
set -eu
sbfmt=$1
shift
cd "$(dirname "$0")"
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
# film NAME VIEW SECONDS: a small GIF of the example's script
film() {
  case " ${names:-$1} " in *" $1 "*) ;; *) return 0 ;; esac
  maker=$(echo "$1"/make*bundle.py)
  if [ -f "$maker" ]; then
    python3 -B "$maker" "$sbfmt" "$folder/$1.sbf"
  else
    "$sbfmt" convert "$1/$1.glb" -o "$folder/$1.sbf"
  fi
  "$sbfmt" render "$folder/$1.sbf" --script "$1/walk.txt" --view "$2" --seconds "$3" --size 352x216 --fps 10 \
    --colors 80 -o "../docs/media/$1.gif"
}
names=$*
film pup 62,14 4.5
film calf 60,14 4
film caterpillar 58,20 4
film yeti 60,12 5
film spider 38,24 3.5
film snake 32,30 3.8
film koi 48,26 4
film dragon 48,26 3.8
film pudding 55,16 3.8
