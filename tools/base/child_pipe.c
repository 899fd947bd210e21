#include "base/child_pipe.h"

#include <string.h>

void child_pipe_free(child_pipe *child) {
  if (child->said) fclose(child->said);
  if (child->wrote) fclose(child->wrote);
  *child = (child_pipe){.input = -1};
}

static void copy_output(FILE *file, char *said, size_t size) {
  said[0] = 0;
  if (fseek(file, 0, SEEK_END) != 0) return;
  long end = ftell(file), start = end - (long)size + 1;
  if (fseek(file, start > 0 ? start : 0, SEEK_SET) != 0) return;
  size_t got = fread(said, 1, size - 1, file), kept = 0;
  const char *from = said;
  if (start > 0 && (from = memchr(said, '\n', got)) != NULL) from++;
  if (!from) from = said;
  for (const char *at = from; at < said + got; at++) {
    char c = *at;
    if (c == '\n' || c == '\r') c = kept && said[kept - 1] != ';' ? ';' : ' ';
    if ((c != ' ' || (kept && said[kept - 1] != ' ')) && (unsigned char)c >= ' ') said[kept++] = c;
  }
  while (kept && (said[kept - 1] == ';' || said[kept - 1] == ' ')) kept--;
  said[kept] = 0;
}

bool child_pipe_finish(child_pipe *child, char *said, size_t said_size) {
  int status = child_pipe_wait(child);
  said[0] = 0;
  if (child->said) copy_output(child->said, said, said_size);
  child_pipe_free(child);
  return status == 0;
}
