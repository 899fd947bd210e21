# Writes the module definition of a DLL: the public functions of static libraries, as cmake/symbols.map exports them elsewhere.
#   cmake -DNM=PROGRAM -DLIBRARIES=A;B -DOUT=FILE.def -P exports.cmake
execute_process(COMMAND ${NM} --extern-only --defined-only ${LIBRARIES} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " T sb[fr]_[A-Za-z0-9_]+" functions "${symbols}")
list(TRANSFORM functions REPLACE "^ T " "  ")
list(SORT functions)
list(JOIN functions "\n" lines)
file(WRITE ${OUT} "EXPORTS\n${lines}\n")
