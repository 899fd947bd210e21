# Writes OUT, a header that says which commit of SOURCE is built; left alone where it says so already.
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=9 --dirty=+
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
set(text "#define SBFMT_COMMIT \"${commit}\"\n")
set(written "")
if(EXISTS ${OUT})
  file(READ ${OUT} written)
endif()
if(NOT written STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
