/* WebAssembly under Node.js has no pipes to programs. */
#include <errno.h>

#include "render/child_pipe.h"

int child_pipe_start(child_pipe *child, char *const *arguments) {
  (void)arguments;
  *child = (child_pipe){.input = -1};
  return ENOSYS;
}

bool child_pipe_write(child_pipe *child, const void *bytes, size_t size) {
  (void)child, (void)bytes, (void)size;
  return false;
}

bool child_pipe_finish(child_pipe *child, char *said, size_t said_size) {
  (void)child;
  if (said_size) said[0] = 0;
  return false;
}

void child_pipe_kill(child_pipe *child) {
  (void)child;
}
