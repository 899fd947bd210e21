#include <stdio.h>

#include "base/process.h"
#include "base/text.h"

void sbfi_process_copy_tail(const char *tail, size_t length, char *to) {
  size_t from = 0, size = 0;
  if (length == SBFI_PROCESS_ERROR_TAIL) /* one byte for the NUL, at most three of a broken character */
    for (from = 1; from < 4 && ((unsigned char)tail[from] & 0xC0) == 0x80;) from++;
  while (from < length) {
    size_t good = sbfi_utf8_check(tail + from, length - from);
    for (size_t i = 0; i < good; i++, from++)
      if (tail[from] != 0) to[size++] = tail[from];
    if (from == length) break;
    to[size++] = '?';
    from++;
  }
  while (size && sbfi_is_space(to[size - 1])) size--;
  to[size] = 0;
}

void sbfi_process_result_free(sbfi_process_result *result) {
  sbfi_free(&result->allocator, result->output, result->output_capacity);
  *result = (sbfi_process_result){.allocator = result->allocator};
}

void sbfi_process_describe(const sbfi_process_result *result, char *to, size_t size) {
  switch (result->end) {
  case SBFI_PROCESS_EXITED:
    snprintf(to, size, "ended with status %d", result->exit_status);
    break;
  case SBFI_PROCESS_KILLED:
    sbfi_process_describe_kill(result->signal, to, size);
    break;
  case SBFI_PROCESS_TIMED_OUT:
    snprintf(to, size, "stopped at the time limit");
    break;
  case SBFI_PROCESS_CPU_LIMIT:
    snprintf(to, size, "stopped at the processor time limit");
    break;
  case SBFI_PROCESS_OUTPUT_TOO_LARGE:
    snprintf(to, size, "stopped at the output limit");
    break;
  }
}
