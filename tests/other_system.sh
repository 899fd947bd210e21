#!/bin/sh
# Makes a folder with Debian's unstable suite, its Blender and Godot and what draws them without a graphics card, to test the add-on in
# a newer Blender than the system's, and the extension in Godot:
#   other_system.sh FOLDER [blender] [godot]
# Makes both, or the one that is named. Each is complete or not there; a folder that lacks one gets it. Needs root, debootstrap and Debian's packages: else exit
# status 77 with the reason. Takes some minutes and 1.3 GB.
set -eu
folder=$1
shift
wanted=" ${*:-blender godot} "
packages='blender python3-numpy python3-cattr python3-requests libegl1 libgl1 libgl1-mesa-dri'
packages_godot='godot ca-certificates libgl1 libgl1-mesa-dri libx11-6 libxcursor1 libxinerama1 libxrandr2 libxi6 libxext6 libxrender1'

# has PROGRAM: whether it is not wanted, or runs: that it is there is not enough, an installation may have been cut short.
has() {
  case $wanted in *" $1 "*) ;; *) return 0 ;; esac
  [ -x "$folder/usr/bin/$1" ] && { [ "$(id -u)" -ne 0 ] || chroot "$folder" "$1" --version >/dev/null 2>&1; }
}
! has blender || ! has godot || exit 0
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null 2>&1; then
  echo "SKIP newer Blender and Godot: making $folder takes root and debootstrap"
  exit 77
fi

# get FOLDER PACKAGES: into that system. A snapshot of the suite will do, however old: its lists need not be valid today.
get() {
  chroot "$1" sh -c "dpkg --configure -a && apt-get update -qq -o Acquire::Check-Valid-Until=false && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $2"
}
# failed WHAT LOG
failed() {
  tail -n 3 "$2" >&2
  echo "SKIP $1: debootstrap or apt-get failed; the end of $2 stands above"
  exit 77
}

if [ ! -d "$folder/usr" ]; then
  made=$folder.unfinished
  rm -rf --one-file-system "$made"
  mkdir -p "$made"
  debootstrap --variant=minbase unstable "$made" >"$made.log" 2>&1 || failed 'newer system' "$made.log"
  mv "$made" "$folder"
fi
has blender || get "$folder" "$packages" >"$folder.log" 2>&1 || failed 'newer Blender' "$folder.log"
has godot || get "$folder" "$packages_godot" >"$folder.log" 2>&1 || failed 'Godot' "$folder.log"
chroot "$folder" apt-get clean
