#!/bin/sh
# Makes a folder with Debian's unstable suite, its Blender and what draws it without a graphics card, to test the add-on in a newer one
# than the system's:
#   other_system.sh FOLDER
# It is complete or not there. Needs root, debootstrap and Debian's packages; takes some minutes and 1 GB.
set -eu
folder=$1
# A snapshot of the suite will do, however old: its lists need not be valid today.
packages='blender python3-numpy python3-cattr python3-requests libegl1 libgl1 libgl1-mesa-dri'

[ ! -x "$folder/usr/bin/blender" ] || exit 0
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null 2>&1; then
  echo "no newer Blender: making $folder takes root and debootstrap" >&2
  exit 0
fi
made=$folder.unfinished
rm -rf --one-file-system "$made"
mkdir -p "$made"
if debootstrap --variant=minbase unstable "$made" >"$made.log" 2>&1 &&
  chroot "$made" sh -c "apt-get update -qq -o Acquire::Check-Valid-Until=false && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages" \
    >>"$made.log" 2>&1; then
  chroot "$made" apt-get clean
  mv "$made" "$folder"
else
  echo "no newer Blender: debootstrap or apt-get failed; the end of $made.log says why:" >&2
  tail -n 3 "$made.log" >&2
fi
