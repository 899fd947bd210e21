/* WebAssembly under Node.js has no pipes to programs. */
#include <errno.h>

#include "base/child_pipe.h"

int child_pipe_start(child_pipe *child, const char *const *arguments, bool keeps_output) {
  (void)arguments, (void)keeps_output;
  *child = (child_pipe){.input = -1};
  return ENOSYS;
}

bool child_pipe_write(child_pipe *child, const void *bytes, size_t size) {
  (void)child, (void)bytes, (void)size;
  return false;
}

int child_pipe_wait(child_pipe *child) {
  (void)child;
  return -1;
}

void child_pipe_kill(child_pipe *child) {
  (void)child;
}
