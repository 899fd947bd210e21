# A toolchain: 64-bit Windows with Debian's mingw-w64 (gcc-mingw-w64-x86-64, g++-mingw-w64-x86-64), run by wine. What an engine embeds
# (-DSBFMT_RUNTIME_ONLY=ON) needs libz-mingw-w64-dev; the program needs the libraries that static_libraries.sh builds.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ZLIB_LIBRARY /usr/x86_64-w64-mingw32/lib/libz.a CACHE FILEPATH "zlib, as an archive") # no DLL to carry along
# gcc keeps stacks of this system aligned to 16 bytes alone, and yet stores whole 32-byte lanes there with instructions
# that want 32: the assembler writes those that do not care, which cost the same. printf as C has it.
set(CMAKE_C_FLAGS_INIT "-Wa,-muse-unaligned-vector-move -D__USE_MINGW_ANSI_STDIO=1 -Wno-format -D_FILE_OFFSET_BITS=64 -static")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
