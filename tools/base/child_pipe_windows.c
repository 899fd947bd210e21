#include "base/child_pipe.h"

#include <errno.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "base/system.h"

static HANDLE handle_of(FILE *file) {
  return (HANDLE)_get_osfhandle(_fileno(file));
}

/* Writes an argument so that the C library of the child reads it unchanged: backslashes are doubled before a
 * quote only ("Parsing C command-line arguments", Microsoft). Returns the end. */
static char *put_argument(char *to, const char *argument) {
  size_t slashes = 0;
  *to++ = '"';
  for (const char *c = argument; *c; c++) {
    if (*c == '"')
      for (slashes++; slashes > 0; slashes--) *to++ = '\\';
    slashes = *c == '\\' ? slashes + 1 : 0;
    *to++ = *c;
  }
  for (; slashes > 0; slashes--) *to++ = '\\';
  *to++ = '"';
  *to = 0;
  return to;
}

static char *command_line(const char *const *arguments) {
  size_t size = 1;
  for (size_t i = 0; arguments[i]; i++) size += 2 * strlen(arguments[i]) + 3;
  char *line = malloc(size), *to = line;
  for (size_t i = 0; line && arguments[i]; i++) {
    if (i) *to++ = ' ';
    to = put_argument(to, arguments[i]);
  }
  return line;
}

static int launch(child_pipe *child, char *line, HANDLE input, HANDLE output) {
  STARTUPINFOA how = {.cb = sizeof how,
      .dwFlags = STARTF_USESTDHANDLES,
      .hStdInput = input,
      .hStdOutput = output,
      .hStdError = handle_of(child->said)};
  PROCESS_INFORMATION made;
  SetHandleInformation(how.hStdInput, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  SetHandleInformation(how.hStdOutput, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  SetHandleInformation(how.hStdError, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  bool good = CreateProcessA(NULL, line, NULL, NULL, TRUE, 0, NULL, NULL, &how, &made) != 0;
  DWORD why = GetLastError();
  SetHandleInformation(how.hStdError, HANDLE_FLAG_INHERIT, 0);
  SetHandleInformation(how.hStdOutput, HANDLE_FLAG_INHERIT, 0);
  if (!good) return why == ERROR_FILE_NOT_FOUND || why == ERROR_PATH_NOT_FOUND ? ENOENT : EACCES;
  CloseHandle(made.hThread);
  child->process = (intptr_t)made.hProcess;
  return 0;
}

/* One child after the other: handles of another one that starts meanwhile would be inherited. */
static SRWLOCK starting = SRWLOCK_INIT;

static int start(child_pipe *child, char *line) {
  HANDLE input = NULL, ours = NULL, nothing = INVALID_HANDLE_VALUE;
  int error = line && CreatePipe(&input, &ours, NULL, 1 << 16) ? 0 : ENOMEM;
  if (!error && !child->wrote) nothing = CreateFileA("NUL", GENERIC_WRITE, 0, NULL, OPEN_EXISTING, 0, NULL);
  if (!error) error = launch(child, line, input, child->wrote ? handle_of(child->wrote) : nothing);
  if (nothing != INVALID_HANDLE_VALUE) CloseHandle(nothing);
  if (input) CloseHandle(input);
  if (error && ours) CloseHandle(ours);
  child->input = error ? -1 : (intptr_t)ours;
  return error;
}

int child_pipe_start(child_pipe *child, const char *const *arguments, bool keeps_output) {
  *child = (child_pipe){.input = -1};
  child->said = system_temporary_file();
  if (keeps_output) child->wrote = system_temporary_file();
  char *line = child->said && (child->wrote || !keeps_output) ? command_line(arguments) : NULL;
  AcquireSRWLockExclusive(&starting);
  int error = start(child, line);
  ReleaseSRWLockExclusive(&starting);
  free(line);
  if (error) child_pipe_free(child);
  return error;
}

bool child_pipe_write(child_pipe *child, const void *bytes, size_t size) {
  const char *at = bytes;
  while (size) {
    DWORD put = 0;
    if (!WriteFile((HANDLE)child->input, at, size < (1 << 20) ? (DWORD)size : 1 << 20, &put, NULL))
      return false;
    at += put, size -= put;
  }
  return true;
}

int child_pipe_wait(child_pipe *child) {
  DWORD status = 0;
  if (child->input != -1) CloseHandle((HANDLE)child->input);
  child->input = -1;
  WaitForSingleObject((HANDLE)child->process, INFINITE);
  GetExitCodeProcess((HANDLE)child->process, &status);
  CloseHandle((HANDLE)child->process);
  child->process = 0;
  return status >> 24 == 0xC0 ? -1 : (int)status; /* NTSTATUS of the severity "error": a fault */
}

void child_pipe_kill(child_pipe *child) {
  if (!child->process) return;
  TerminateProcess((HANDLE)child->process, 1);
  child_pipe_wait(child);
  child_pipe_free(child);
}
