#!/bin/sh
# Builds static versions of the libraries that libsbfmt uses, for an SDK, an add-on or a program that needs only the system's C library:
#   static_libraries.sh FOLDER [TOOLCHAIN.cmake [program]]
# `program`: also the libraries of the program `sbfmt` and its importers.
# Afterwards: cmake -DSBFMT_STATIC_LIBRARIES=FOLDER. Sources come from Debian's archive through apt: upstream archives with the SHA-256
# below, with Debian's patches. Needs apt, dpkg-source and a compiler; without them exit status 77 with the reason.
set -eu
folder=$1
toolchain=${2:-}
what=${3:-library}
emscripten=
case $toolchain in *emscripten.cmake) emscripten=yes ;; esac
# package, SHA-256 of upstream's archive, CMake options
libraries='
zlib 71feb7947e3c00ef125f83b79a4e529bde31171e5babe48b391f06758d1ab0a1
libxml2 4fe913dec8b1ab89d13b489b419a8203176ea39e931eaa0d25b17eafb9c279e9 -DLIBXML2_WITH_ICU=OFF -DLIBXML2_WITH_ICONV=OFF -DLIBXML2_WITH_LZMA=OFF -DLIBXML2_WITH_ZLIB=OFF -DLIBXML2_WITH_PYTHON=OFF -DLIBXML2_WITH_PROGRAMS=OFF -DLIBXML2_WITH_TESTS=OFF -DLIBXML2_WITH_HTTP=OFF -DLIBXML2_WITH_FTP=OFF -DLIBXML2_WITH_MODULES=OFF
qhull b5c2d7eb833278881b952c8a52d20179eab87766b00b865000469a45c1838b7e
meshoptimizer 881ea2cc687f1fef5ce70484e0ca6504e13856dd856677749f3763bc685956d3 -DMESHOPT_BUILD_SHARED_LIBS=OFF'
[ "$what" = library ] || libraries="$libraries
jansson c739578bf6b764aa0752db9a2fdadcfe921c78f1228c7ec0bb47fa804c55d17b -DJANSSON_BUILD_DOCS=OFF -DJANSSON_EXAMPLES=OFF -DJANSSON_WITHOUT_TESTS=ON
libpng1.6 a00e9d2f2f664186e4202db9299397f851aea71b36a35e74910b8820e380d441 -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF
libjpeg-turbo 254f3642b04e309fee775123133c6464181addc150499561020312ec61c1bf7c -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF -DWITH_SIMD=OFF${emscripten:+ -DSIZE_T=4 -DHAVE_SIZE_T=TRUE}
libwebp 7bf5a8a28cc69bcfa8cb214f2c3095703c6b73ac5fba4d5480c205331d9494df -DWEBP_BUILD_ANIM_UTILS=OFF -DWEBP_BUILD_CWEBP=OFF -DWEBP_BUILD_DWEBP=OFF -DWEBP_BUILD_GIF2WEBP=OFF -DWEBP_BUILD_IMG2WEBP=OFF -DWEBP_BUILD_VWEBP=OFF -DWEBP_BUILD_WEBPINFO=OFF -DWEBP_BUILD_WEBPMUX=OFF -DWEBP_BUILD_EXTRAS=OFF
minizip 7d8da446d3b6799e7851f077a66551a46b80fc3de708549e79dbd3e49e842ba1
assimp ee20da341210d15296e74304ebaf88563734048401f71f008d7d6ae1da373e1d -DASSIMP_BUILD_ASSIMP_TOOLS=OFF -DASSIMP_BUILD_TESTS=OFF -DASSIMP_NO_EXPORT=ON -DASSIMP_WARNINGS_AS_ERRORS=OFF -DASSIMP_INJECT_DEBUG_POSTFIX=OFF -DASSIMP_BUILD_DRACO=ON"

case $what$toolchain in
  program*windows.cmake) # the window of `sbfmt view`, a DLL
    libraries="$libraries
libsdl2 b3f2c822151804125d08db94c65852f711c2e5df2145a59da120748dc32eb9c3 -DSDL_SHARED=ON -DSDL_STATIC=OFF -DSDL_TEST=OFF -DSDL2_DISABLE_SDL2MAIN=ON"
    ;;
esac

fail() {
  echo "static_libraries.sh: $1" >&2
  exit "${2:-1}"
}
if [ -n "$emscripten" ]; then
  # Debian's Emscripten does not tell Node.js where Debian's modules are; draco asks where Emscripten is.
  EMSCRIPTEN=$(em-config EMSCRIPTEN_ROOT 2>/dev/null) || fail "needs em++ (Debian's package emscripten)" 77
  export EMSCRIPTEN NODE_PATH=/usr/share/nodejs
fi
[ "$what" = library ] || { [ -e /usr/include/utf8.h ] && [ -d /usr/include/stb ]; } || fail "needs Debian's packages libutfcpp-dev and libstb-dev" 77
for program in apt-get dpkg-source cmake ninja sha256sum; do
  command -v $program >/dev/null 2>&1 || fail "needs $program (Debian's packages apt, dpkg-dev, cmake, ninja-build)" 77
done
case $folder in /*) ;; *) folder=$PWD/$folder ;; esac
case $toolchain in '' | /*) ;; *) toolchain=$PWD/$toolchain ;; esac
stamp=$(cat "$0" ${toolchain:+"$toolchain"} | sha256sum | cut -d' ' -f1)
case $(cat "$folder/stamp" 2>/dev/null) in "$stamp $what" | "$stamp program") exit 0 ;; esac

work=$folder.unfinished
rm -rf "$work" "$folder"
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/sources" "$work/made"
log=$work/log
export PKG_CONFIG_LIBDIR="$work/made$folder/lib/pkgconfig" # not the libraries of this system

# ---- Sources ----------------------------------------------------------------------------------------------

# The release itself, then its updates: an archive may have dropped files that a list of updates still names.
# shellcheck disable=SC2016 # apt expands these
apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 2>/dev/null | sort -u >"$work/all.list"
grep -v -e '-security ' -e '-updates ' "$work/all.list" >"$work/release.list" || fail "apt knows no archive; try: apt-get update" 77

# apt LIST ARGUMENTS...: runs apt with separate lists and archives, and leaves the system's unchanged
apt() {
  known=$1
  shift
  apt-get -q -o Dir::Etc::SourceList="$known" -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" \
    -o Acquire::Check-Valid-Until=false -o APT::Sandbox::User= "$@" >>"$log" 2>&1 </dev/null
}

# fetch PACKAGE SHA256: its sources, in sources/PACKAGE
fetch() {
  for list in release all; do
    rm -rf "$work/fetched"
    mkdir "$work/fetched"
    apt "$work/$list.list" update || continue
    (cd "$work/fetched" && apt "$work/$list.list" source --download-only "$1") || continue
    sum=$(find "$work/fetched" -name "$1_*.orig.tar.*" ! -name '*.asc' -exec sha256sum {} + | cut -d' ' -f1)
    [ "$sum" = "$2" ] || fail "$1 of this archive is not of the version that is known to work (SHA-256 $sum): use Debian 12's archive"
    dpkg-source --no-check -x "$work/fetched/$1"_*.dsc "$work/sources/$1" >>"$log" 2>&1 || break
    mkdir -p "$work/made$folder/licences"
    cp "$work/sources/$1/debian/copyright" "$work/made$folder/licences/$1.txt"
    version=$(basename "$work/fetched/$1"_*.dsc .dsc)
    echo "$1 ${version#*_} $2" >>"$work/made$folder/licences/sources"
    return 0
  done
  tail -n 5 "$log" >&2
  fail "the sources of $1 could not be fetched; the end of $log stands above. Is the network there?" 77
}

# ---- Building ---------------------------------------------------------------------------------------------

build() {
  package=$1
  shift
  tree=$work/build/$package
  generator=Ninja
  # Where every library is static, these two make one file twice, which Ninja refuses.
  case $package in zlib | qhull) generator='Unix Makefiles' ;; esac
  [ "$package" != meshoptimizer ] || sed -i 's/ -Werror)/)/' "$work/sources/$package/CMakeLists.txt"
  if [ "$package" = zlib ]; then # Debian leaves Windows' files out, which its CMake file names on every system
    mkdir -p "$work/sources/zlib/win32"
    echo '1 RCDATA { 0 }' >"$work/sources/zlib/win32/zlib1.rc"
  fi
  [ "$package" != libxml2 ] || sed -i '1i #define LIBXML_STATIC' "$work/sources/libxml2/config.h.cmake.in" # on Windows it would export its calls
  if [ "$package" = assimp ]; then # headers and a library that Debian takes from packages of their own
    cp -rL /usr/include/utf8 /usr/include/utf8.h /usr/include/stb "$work/sources/assimp/include/"
    mkdir "$work/sources/assimp/contrib/unzip"
    (cd "$work/sources/minizip" && cp ioapi.c ioapi.h unzip.c unzip.h crypt.h "$work/sources/assimp/contrib/unzip/")
    : >"$work/sources/assimp/contrib/unzip/crypt.c" # unzip.c includes what is needed
    sed -i -e '/find_package(draco CONFIG REQUIRED)/d' -e '/{DRACO_LIBRARIES}/d' "$work/sources/assimp/code/CMakeLists.txt"
    sed -i 's/if(MSVC OR WIN32)/if(MSVC)/' "$work/sources/assimp/CMakeLists.txt" # draco names its library so for MSVC alone
  fi
  {
    cmake -G "$generator" -S "$work/sources/$package" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
      -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR:STRING=lib -DCMAKE_PREFIX_PATH="$work/made$folder" \
      ${toolchain:+"-DCMAKE_TOOLCHAIN_FILE=$toolchain" "-DCMAKE_FIND_ROOT_PATH=$work/made$folder"} "$@" &&
      cmake --build "$tree" && DESTDIR=$work/made cmake --install "$tree"
  } >>"$log" 2>&1 || {
    tail -n 15 "$log" >&2
    fail "$package could not be built; all that was printed is in $log"
  }
  rm -f "$work/made$folder"/lib/*.so* "$work/made$folder"/lib/*.dll.a # some packages build both kinds, and the linker prefers shared ones
  [ ! -f "$work/made$folder/lib/libzlibstatic.a" ] || mv "$work/made$folder/lib/libzlibstatic.a" "$work/made$folder/lib/libz.a" # on Windows
}

echo "$libraries" | while read -r package sum options; do
  [ -n "$package" ] || continue
  fetch "$package" "$sum"
  [ "$package" != minizip ] || continue # becomes a part of assimp
  # shellcheck disable=SC2086 # options are words
  build "$package" $options
done
if [ "$what" = program ]; then # headers of what the program opens at run time
  mkdir -p "$work/made$folder/include/GL"
  cp /usr/include/GL/glcorearb.h "$work/made$folder/include/GL/"
  cp -r /usr/include/EGL /usr/include/KHR "$work/made$folder/include/"
fi
echo "$stamp $what" >"$work/made$folder/stamp"
mv "$work/made$folder" "$folder"
rm -rf "$work"
