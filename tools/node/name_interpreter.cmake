# npm runs a program by its first line: cmake -DPROGRAM=FILE -P name_interpreter.cmake
file(READ ${PROGRAM} text)
file(WRITE ${PROGRAM} "#!/usr/bin/env node\n${text}")
