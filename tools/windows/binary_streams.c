/* Part of every program for Windows: files and standard streams have the bytes that are written to them, with
 * no other ends of line. */
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void begin(void) {
  _fmode = _O_BINARY;
  _setmode(_fileno(stdin), _O_BINARY);
  _setmode(_fileno(stdout), _O_BINARY);
  _setmode(_fileno(stderr), _O_BINARY);
}
