/* How much memory one piece of work takes, measured in a process that does nothing else. */
#ifndef BENCH_PROCESS_MEMORY_H
#define BENCH_PROCESS_MEMORY_H

#include <stddef.h>

typedef struct process_memory {
  size_t peak_bytes; /* most that was resident at once beyond what was before; pages of mapped files count */
  size_t private_bytes; /* of it, still held at the end and shared with no file: what was allocated */
} process_memory;

/* Runs `work` in a fresh process of this program, which sees `arguments` (a list that ends with NULL) behind
 * the one that says so. main must begin with process_memory_work. */
process_memory process_memory_of(const char *const *arguments);

/* In the fresh process: does the work for the arguments given, between two looks at the memory, and ends the
 * process. Elsewhere it returns at once. */
void process_memory_work(int argument_count, char **arguments, void (*work)(char **arguments));

#endif
