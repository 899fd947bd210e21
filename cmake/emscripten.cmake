# The program for Node.js: Emscripten as Debian installs it. C++ exceptions, which assimp throws, go through
# JavaScript: clang 14 fails to compile some code for those of WebAssembly.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE SBFMT_EMSCRIPTEN_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "Emscripten is not there (Debian: emscripten)")
endif()
include(${SBFMT_EMSCRIPTEN_ROOT}/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fexceptions")
# Debian's Emscripten does not tell Node.js where Debian's modules are.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
