/* What ended a child process, for systems that have signals. */
#include <signal.h>
#include <stdio.h>

#include "base/process.h"

static const char *meaning(int number) {
  switch (number) {
  case SIGABRT:
    return " (it aborted)";
  case SIGSEGV:
    return " (it accessed memory that it does not own)";
  case SIGBUS:
    return " (it accessed memory that does not exist)";
  case SIGFPE:
    return " (an arithmetic error)";
  case SIGILL:
    return " (an illegal instruction)";
  case SIGKILL:
    return " (it was killed, for example by the system when memory ran out)";
  case SIGTERM:
  case SIGINT:
    return " (it was asked to stop)";
  default:
    return "";
  }
}

void sbfi_process_describe_kill(int number, char *to, size_t size) {
  snprintf(to, size, "stopped by signal %d%s", number, meaning(number));
}
