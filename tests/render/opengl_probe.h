/* Whether this machine can draw at all: tests that need it are skipped elsewhere. */
#ifndef TEST_OPENGL_PROBE_H
#define TEST_OPENGL_PROBE_H

/* Finds out, once for the fixture below, in a process of its own: what a driver starts does not survive the
 * forks of the tests. */
void opengl_probe(void);

/* A checked fixture: skips each case on machines that cannot draw. */
void opengl_needed(void);

#endif
