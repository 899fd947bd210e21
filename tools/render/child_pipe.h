/* A program started to be fed: what is written goes to its standard input, and what it says on standard error
 * is kept. POSIX; the only file of the renderer that knows of processes. */
#ifndef RENDER_CHILD_PIPE_H
#define RENDER_CHILD_PIPE_H

#include <stdio.h>
#include <sys/types.h>

#include "sbfmt/base.h"

typedef struct child_pipe {
  pid_t process; /* 0: none */
  int input;     /* its standard input; -1: closed */
  FILE *said;    /* its standard error */
} child_pipe;

/* `arguments` ends with NULL; arguments[0] is looked up in PATH. 0, or the errno that says why not:
 * ENOENT where there is no such program. */
int child_pipe_start(child_pipe *child, char *const *arguments);

/* False when the child no longer takes it. Raises no SIGPIPE. */
bool child_pipe_write(child_pipe *child, const void *bytes, size_t size);

/* Closes its input, waits, copies the end of what it said (cut to whole lines joined by "; ").
 * True when it ended by itself with status 0. */
bool child_pipe_finish(child_pipe *child, char *said, size_t said_size);

/* Ends it at once. Fine when none is running. */
void child_pipe_kill(child_pipe *child);

#endif
