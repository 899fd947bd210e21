/* Whether this machine can draw at all: tests that need it are skipped elsewhere. */
#ifndef TEST_OPENGL_PROBE_H
#define TEST_OPENGL_PROBE_H

#include <stdbool.h>

/* Asked in a process of its own, because what a driver starts does not survive the forks of the tests. Says
 * why not on standard error. */
bool opengl_probe(void);

#endif
