# One interface target carries what every target of the project is compiled with.
add_library(sbfmt_compiler INTERFACE)
target_compile_options(sbfmt_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wmissing-prototypes -Wstrict-prototypes -Wundef -Wvla
  -Wpointer-arith -Wwrite-strings
  # The same bits on every machine: no fused multiply-add unless the source asks for it.
  -ffp-contract=off
  # Nobody reads errno after a square root, which is then one instruction.
  -fno-math-errno)
# gcc's vectoriser fuses products with sums and differences (vfmaddsub) in spite of that, seen with 12.2, where the
# processor that it is told of has such instructions, as with -march=native.
include(CheckCSourceCompiles)
check_c_source_compiles("#ifndef __FMA__\n#error\n#endif\nint main(void) { return 0; }" SBFMT_TARGET_HAS_FMA)
if(SBFMT_TARGET_HAS_FMA AND CMAKE_C_COMPILER_ID STREQUAL GNU)
  target_compile_options(sbfmt_compiler INTERFACE -fno-tree-vectorize)
endif()
if(SBFMT_WERROR)
  target_compile_options(sbfmt_compiler INTERFACE -Werror)
endif()
# Invariants of the program's own state are checked (libsbfmt/base/assert.h) where speed does not count.
if(SBFMT_SANITIZE OR SBFMT_FUZZ)
  target_compile_definitions(sbfmt_compiler INTERFACE SBFMT_ASSERTS)
else()
  target_compile_definitions(sbfmt_compiler INTERFACE $<$<CONFIG:Debug>:SBFMT_ASSERTS>)
endif()
if(SBFMT_SANITIZE)
  target_compile_options(sbfmt_compiler INTERFACE -fsanitize=${SBFMT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(sbfmt_compiler INTERFACE -fsanitize=${SBFMT_SANITIZE})
  if(SBFMT_SANITIZE MATCHES "undefined")
    target_compile_options(sbfmt_compiler INTERFACE -fno-sanitize-recover=undefined)
  endif()
endif()
if(SBFMT_FUZZ)
  target_compile_options(sbfmt_compiler INTERFACE -fsanitize=fuzzer-no-link)
endif()

# sbfmt_system_sources(LIST): leaves the sources of this system in the list. What differs is in one file for each.
function(sbfmt_system_sources list)
  set(sources ${${list}})
  if(WIN32)
    list(FILTER sources EXCLUDE REGEX "_posix\\.c$")
  else()
    list(FILTER sources EXCLUDE REGEX "_windows\\.c$")
  endif()
  list(FILTER sources EXCLUDE REGEX "_wasm\\.c$") # for runtime/hosts/web
  if(EMSCRIPTEN) # as POSIX, but where Node.js has a file of its own
    set(own ${sources})
    list(FILTER own INCLUDE REGEX "_node\\.c$")
    set(others ${own})
    list(TRANSFORM own REPLACE "_node\\.c$" "_posix.c")
    list(TRANSFORM others REPLACE "_node\\.c$" ".c")
    list(REMOVE_ITEM sources ${own} ${others})
  else()
    list(FILTER sources EXCLUDE REGEX "_node\\.c$")
  endif()
  set(${list} ${sources} PARENT_SCOPE)
endfunction()

# sbfmt_program(NAME): what programs are linked with.
function(sbfmt_program name)
  if(EMSCRIPTEN)
    # Files are those of Node.js.
    target_link_options(${name} PRIVATE -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1 -sTOTAL_STACK=8MB -fexceptions
      --pre-js=${PROJECT_SOURCE_DIR}/tools/node/program_head.js)
  elseif(SBFMT_STATIC_LIBRARIES) # some of them are C++
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_link_options(${name} PRIVATE -static-libgcc -static-libstdc++)
  endif()
  if(WIN32)
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tools/windows/program.rc ${PROJECT_SOURCE_DIR}/tools/windows/binary_streams.c)
    target_link_options(${name} PRIVATE -Wl,--stack,8388608)
  endif()
endfunction()

# sbfmt_worker_program(NAME CALL): the program NAME-worker, made of what NAME is made of, for a worker of a browser: its script defines the
# function CALL. Files are in memory.
function(sbfmt_worker_program name call)
  if(EMSCRIPTEN)
    get_target_property(libraries ${name} LINK_LIBRARIES)
    add_executable(${name}-worker $<TARGET_OBJECTS:${name}>)
    target_link_libraries(${name}-worker PRIVATE ${libraries})
    target_link_options(${name}-worker PRIVATE -sMODULARIZE=1 -sEXPORT_NAME=${call} -sENVIRONMENT=worker -sWASM_ASYNC_COMPILATION=0 -sINVOKE_RUN=0
      -sEXPORTED_RUNTIME_METHODS=FS,ENV,callMain -sFORCE_FILESYSTEM=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1
      -sTOTAL_STACK=8MB -fexceptions)
    set_target_properties(${name}-worker PROPERTIES LINKER_LANGUAGE C RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/worker)
  endif()
endfunction()

# sbfmt_library(NAME ALIAS FOLDER...): a library of every .c file in the given folders. A folder is a
# module here, so a new file joins its library by lying in the right place.
function(sbfmt_library name alias)
  set(sources)
  foreach(folder IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.c"
      "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*/*.c")
    list(APPEND sources ${found})
  endforeach()
  list(FILTER sources EXCLUDE REGEX "/import/assimp/") # a program of its own
  sbfmt_system_sources(sources)
  if(NOT sources)
    # A library needs a source; a declaration makes an honest empty one.
    file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${name}-empty.c" "typedef int ${alias}_has_no_sources;\n")
    set(sources "${CMAKE_CURRENT_BINARY_DIR}/${name}-empty.c")
  endif()
  add_library(${name} ${sources})
  add_library(sbfmt::${alias} ALIAS ${name})
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:sbfmt_compiler>)
  # Before 1.0 every minor version may change the ABI.
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${alias} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(BUILD_SHARED_LIBS)
    # The libraries share insides, so the list of exported names takes the place of hidden visibility.
    set_target_properties(${name} PROPERTIES C_VISIBILITY_PRESET default)
    target_compile_options(${name} PRIVATE -fno-semantic-interposition)
    target_link_options(${name} PRIVATE LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/symbols.map)
    set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/symbols.map)
  endif()
endfunction()
