/* The shared library of Python and of the add-on consists of the static ones, whole; a library needs a file
 * of its own. */
extern const char sbfi_whole_library[];
const char sbfi_whole_library[] = "sbfmt";
