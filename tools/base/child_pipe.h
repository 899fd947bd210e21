/* Runs a child program whose standard input this program writes; keeps what it prints. One implementation
 * per system (child_pipe_posix.c, child_pipe_windows.c, child_pipe_node.c). */
#ifndef BASE_CHILD_PIPE_H
#define BASE_CHILD_PIPE_H

#include <stdio.h>

#include "sbfmt/base.h"

typedef struct child_pipe {
  intptr_t process; /* its id, on Windows its handle; 0: none */
  intptr_t input;   /* its standard input; -1: closed */
  FILE *said;       /* file of its standard error */
  FILE *wrote;      /* file of its standard output; NULL: discarded */
} child_pipe;

/* `arguments` ends with NULL; arguments[0] is searched in PATH unless it has a slash. `keeps_output`: its
 * standard output goes to a file too. Returns 0, or an errno: ENOENT if the program does not exist. */
int child_pipe_start(child_pipe *child, const char *const *arguments, bool keeps_output);

/* False if the child has closed its input. Raises no SIGPIPE. */
bool child_pipe_write(child_pipe *child, const void *bytes, size_t size);

/* Closes its input and waits: its exit status, or -1 if it did not exit. Its files can be read afterwards;
 * end with child_pipe_free. */
int child_pipe_wait(child_pipe *child);
void child_pipe_free(child_pipe *child);

/* Waits, copies the end of its error output (whole lines joined by "; ") and frees it. True if it exited
 * with status 0. */
bool child_pipe_finish(child_pipe *child, char *said, size_t said_size);

/* Kills it. Does nothing if none is running. */
void child_pipe_kill(child_pipe *child);

#endif
