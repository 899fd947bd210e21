/* Runs a child program whose standard input this program writes; keeps its standard error. POSIX; the
 * renderer's only file with processes. */
#ifndef RENDER_CHILD_PIPE_H
#define RENDER_CHILD_PIPE_H

#include <stdio.h>
#include <sys/types.h>

#include "sbfmt/base.h"

typedef struct child_pipe {
  pid_t process; /* 0: none */
  int input;     /* its standard input; -1: closed */
  FILE *said;    /* file of its standard error */
} child_pipe;

/* `arguments` ends with NULL; arguments[0] is searched in PATH. Returns 0, or an errno: ENOENT if the
 * program does not exist. */
int child_pipe_start(child_pipe *child, char *const *arguments);

/* False if the child has closed its input. Raises no SIGPIPE. */
bool child_pipe_write(child_pipe *child, const void *bytes, size_t size);

/* Closes its input, waits, copies the end of its error output (whole lines joined by "; "). True if it
 * exited with status 0. */
bool child_pipe_finish(child_pipe *child, char *said, size_t said_size);

/* Kills it. Does nothing if none is running. */
void child_pipe_kill(child_pipe *child);

#endif
