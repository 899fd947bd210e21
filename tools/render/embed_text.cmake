# cmake -DOUT=file.c -DNAMES=a;b -DFOLDER=dir -P embed_text.cmake: the texts as C arrays, so that the program
# needs no file beside it. Arrays of numbers, because a C compiler need not take long strings.
set(code "/* Made from ${NAMES}. */\n#include \"render/shader_texts.h\"\n")
foreach(name IN LISTS NAMES)
  file(READ "${FOLDER}/${name}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "${name}" identifier)
  string(APPEND code "\nconst char shader_${identifier}[] = {\n${bytes}0};\n")
endforeach()
file(WRITE "${OUT}" "${code}")
