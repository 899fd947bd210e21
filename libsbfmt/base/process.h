/* Runs a program as a child process with limits and captures its output, for work that may crash, hang or
 * exhaust memory. One implementation per system (process_posix.c, process_windows.c, process_node.c). */
#ifndef SBFI_PROCESS_H
#define SBFI_PROCESS_H

#include "base/diagnostic.h"
#include "base/memory.h"

/* 0 means no limit. */
typedef struct sbfi_process_limits {
  uint32_t wall_ms;      /* time from the start to the end of the program */
  uint32_t cpu_s;        /* processor time */
  uint64_t memory_bytes; /* address space; not applied in a build with the address sanitizer, which needs
                            terabytes */
  size_t output_bytes;   /* of standard output, which is kept completely */
} sbfi_process_limits;

typedef enum sbfi_process_end {
  SBFI_PROCESS_EXITED = 0,      /* normally: see exit_status */
  SBFI_PROCESS_KILLED,          /* by a signal or a fault, its own or another's: see signal */
  SBFI_PROCESS_TIMED_OUT,       /* by us, at the wall time limit */
  SBFI_PROCESS_CPU_LIMIT,       /* by the system, at the processor time limit */
  SBFI_PROCESS_OUTPUT_TOO_LARGE /* by us, when it wrote more than the limit */
} sbfi_process_end;

enum { SBFI_PROCESS_ERROR_TAIL = 512 };

typedef struct sbfi_process_result {
  sbfi_process_end end;
  int exit_status; /* if it exited, else 0 */
  int signal;      /* if a signal (including ours) ended it, on Windows the code of a fault; else 0 */
  uint8_t *output; /* its standard output; NULL if output_size is 0 */
  size_t output_size, output_capacity;
  char error_tail[SBFI_PROCESS_ERROR_TAIL]; /* the last part of its standard error: UTF-8, NUL-terminated */
  sbf_allocator allocator;
} sbfi_process_result;

/* Runs arguments[0], a path with a slash (no PATH search, no shell), with `arguments`, terminated by NULL,
 * and waits for its end. Its standard input is empty. It inherits no other descriptor and no blocked or
 * ignored signals. It leads its own process group, which is killed when it ends. SBF_OK means that the
 * program ran, however it ended; then free the result with sbfi_process_result_free. IO_CANNOT_RUN: the
 * program could not be started, or its status not read (if the host ignores SIGCHLD or waits for any child).
 * OUT_OF_MEMORY: its output could not be kept. Thread safe. */
sbf_status sbfi_process_run(const char *const *arguments, const sbfi_process_limits *limits,
    const sbf_allocator *allocator, sbfi_process_result *result, sbf_diagnostic *error);
void sbfi_process_result_free(sbfi_process_result *result);

/* Copies the last `length` bytes of standard error, at most SBFI_PROCESS_ERROR_TAIL, to an error_tail: drops
 * a truncated first character, replaces invalid bytes by "?". */
void sbfi_process_copy_tail(const char *tail, size_t length, char *to);

/* One line about its end, such as "ended with status 1". */
void sbfi_process_describe(const sbfi_process_result *result, char *to, size_t size);
/* The same for the `signal` of SBFI_PROCESS_KILLED (process_end_posix.c, process_windows.c). */
void sbfi_process_describe_kill(int number, char *to, size_t size);

#endif
