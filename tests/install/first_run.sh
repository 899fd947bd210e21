#!/bin/sh
# The first run of a stranger: makes a fresh system with debootstrap, clones this checkout into it, and does what README.md says.
#   first_run.sh [--full] [--cache DIR] FOLDER SYSTEM...
#     bookworm        Debian 12, nothing but its smallest set of packages
#     bookworm-tools  the same with a compiler, cmake and some libraries installed
#     sid             Debian unstable, its smallest set
# In each: a user without sudo is told one line to type; root (and with --full also that user, once the line is typed) runs the demo,
# the README's C program and the page export. --full adds `./run test` and `./run package`. With --cache these systems have ccache as
# well, and its folder DIR: what this checkout compiled already is not compiled again.
# Needs root, debootstrap and the archive of packages that apt is configured for: else exit status 77 with the reason.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
root_home=/srv/first # of root in these systems
tools='gcc g++ make cmake git python3 libxml2-dev zlib1g-dev nodejs'

skip() {
  echo "SKIP $1: $2"
  exit 77
}
fail() {
  printf 'first run: %s\n' "$@" >&2
  exit 1
}

# Where apt gets this release from; any Debian mirror holds all releases.
mirror() {
  # shellcheck disable=SC2016 # apt fills these in
  apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    awk -v name="$(. /etc/os-release && echo "$VERSION_CODENAME")" '$1 == name {print $2; exit}'
}

# within SYSTEM COMMAND...: as root in that system, with a /proc and a compiler's cache that are gone with the command
within() {
  where=$1
  shift
  # shellcheck disable=SC2016 # the inner shell fills these in
  cache=$cache checkout=$root_home/sbfmt unshare --mount --propagation private sh -c 'mount -t proc proc "$0/proc" &&
    { [ -z "$cache" ] || { mkdir -p "$0/srv/cache" && mount --bind "$cache" "$0/srv/cache"; }; } && exec chroot "$0" /usr/bin/env -i \
    ${cache:+CC=gcc CCACHE_DIR=/srv/cache CCACHE_BASEDIR="$checkout"} $(env | grep "^CCACHE_[NIC]") \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive CI=1 \
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" "$@"' "$where" "$@" </dev/null
}
as_root() {
  where=$1
  shift
  within "$where" HOME=$root_home sh -c "cd \$HOME/sbfmt && $*"
}
# The cache is root's: others only read it.
as_user() {
  where=$1
  shift
  within "$where" HOME=/srv/guest CCACHE_READONLY=1 CCACHE_TEMPDIR=/tmp setpriv --reuid guest --regid guest --clear-groups sh -c "cd \$HOME/sbfmt && $*"
}

# make_base SYSTEM: in $folder/SYSTEM
make_base() {
  suite=${1%-tools}
  [ ! -x "$folder/$1/usr/bin/env" ] || return 0
  echo "making a fresh $1"
  rm -rf --one-file-system "${folder:?}/$1"
  mkdir -p "$folder/$1"
  if ! unshare --mount --propagation private debootstrap --variant=minbase "$suite" "$folder/$1" "$(mirror)" >"$folder/$1.log" 2>&1; then
    tail -n 5 "$folder/$1.log" >&2
    rm -rf --one-file-system "${folder:?}/$1"
    skip "$1" 'debootstrap failed; its last lines stand above'
  fi
  echo force-unsafe-io >"$folder/$1/etc/dpkg/dpkg.cfg.d/thrown-away"
  # The archive may be a snapshot, whose lists are past their date.
  echo 'Acquire::Check-Valid-Until "false";' >"$folder/$1/etc/apt/apt.conf.d/snapshot"
  if [ "$1" != "$suite" ]; then
    within "$folder/$1" sh -c "apt-get update -qq && apt-get install -y -qq --no-install-recommends $tools" >>"$folder/$1.log" 2>&1 ||
      fail "$1: installing $tools failed; all of it is in $folder/$1.log"
  fi
  # As an image has it: no lists of packages.
  rm -rf "$folder/$1/var/lib/apt/lists" "$folder/$1/var/cache/apt"
  mkdir -p "$folder/$1/var/lib/apt/lists/partial" "$folder/$1/var/cache/apt/archives/partial"
  within "$folder/$1" useradd --home-dir /srv/guest --create-home guest
}

# enter SYSTEM NAME: a copy of it to be used up, with a clone of this checkout for root and for the guest
enter() {
  rm -rf --one-file-system "${folder:?}/$2"
  cp -a --reflink=auto "$folder/$1" "$folder/$2"
  for home in first guest; do
    git -c safe.directory='*' clone -q --no-hardlinks "$source" "$folder/$2/srv/$home/sbfmt"
  done
  within "$folder/$2" chown -R guest: /srv/guest
}

# readme SYSTEM WHO: what README.md shows, in that order
readme() {
  "$2" "$1" './run demo' || fail "$2: ./run demo failed"
  "$2" "$1" "sed -n '/^\`\`\`c\$/,/^\`\`\`\$/p' README.md | sed '/^\`\`\`/d' >out/demo/engine.c &&
    { echo 'cmake_minimum_required(VERSION 3.16)'; echo 'project(my_engine C)'
      echo 'add_executable(my_engine engine.c)'; sed -n '/^\`\`\`cmake\$/,/^\`\`\`\$/p' README.md | sed '/^\`\`\`/d'; } >out/demo/CMakeLists.txt &&
    sed -i '/^add_executable/{h;d};/^find_package/{G}' out/demo/CMakeLists.txt &&
    cmake --install build/release --prefix out/installed >/dev/null &&
    cmake -G Ninja -S out/demo -B out/engine -DCMAKE_PREFIX_PATH=\$PWD/out/installed >/dev/null && cmake --build out/engine &&
    cd out/demo && ../engine/my_engine | tee walked && grep -Eq '^walked [1-9][0-9]*\\.[0-9] m\$' walked" ||
    fail "$2: the README's C program failed"
  "$2" "$1" 'cd out/demo && sbfmt=../installed/bin/sbfmt && $sbfmt export lizard.sbf -o page.html && grep -q "<script" page.html &&
    test "$(wc -c <page.html)" -gt 200000' || fail "$2: the page export failed"
}

# told SYSTEM: a user without sudo gets one line to type, and nothing happens; the line is left in the system's /line
told() {
  status=0
  as_user "$1" './run demo' >"$1.told" 2>&1 || status=$?
  [ "$status" -eq 2 ] || fail "a user without sudo: ./run demo ended with $status" "$(tail -n 5 "$1.told")"
  [ "$(grep -c '^  sudo apt-get update && sudo apt-get install ' "$1.told")" -eq 1 ] || fail 'a user without sudo is not told what to type'
  sed -n 's/^  sudo apt-get/apt-get/p' "$1.told" | sed 's/&& sudo /\&\& /' >"$1/line"
}

try() {
  echo "== $1, root"
  enter "$1" "$1.root"
  told "$folder/$1.root"
  readme "$folder/$1.root" as_root
  if [ -n "$full" ]; then
    as_root "$folder/$1.root" './run test' || fail "$1: ./run test failed"
    as_root "$folder/$1.root" './run package' || fail "$1: ./run package failed"
    echo "== $1, a user without sudo"
    enter "$1" "$1.user"
    told "$folder/$1.user"
    within "$folder/$1.user" sh /line >"$folder/$1.user.log" 2>&1 || fail "$1: the line to type failed; see $folder/$1.user.log"
    readme "$folder/$1.user" as_user
    rm -rf --one-file-system "$folder/$1.user"
  fi
  rm -rf --one-file-system "$folder/$1.root"
}

full= cache=
[ "${1:-}" != --full ] || { full=yes && shift; }
[ "${1:-}" != --cache ] || { cache=$2 && tools="$tools ccache" && shift 2; }
[ $# -ge 2 ] || fail 'usage: first_run.sh [--full] [--cache DIR] FOLDER SYSTEM...'
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
[ "$(id -u)" -eq 0 ] || skip 'fresh systems' 'only root can make them'
for command in debootstrap unshare apt-get git; do
  command -v $command >/dev/null 2>&1 || skip 'fresh systems' "$command is not installed"
done
[ -n "$(mirror)" ] || apt-get update -qq || true
[ -n "$(mirror)" ] || skip 'fresh systems' 'apt names no archive of this release'
for system; do
  case $system in bookworm | bookworm-tools | sid) ;; *) fail "no such system: $system" ;; esac
  make_base "$system"
  try "$system"
done
echo "first run: good on $*"
