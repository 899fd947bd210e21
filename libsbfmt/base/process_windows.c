/* Child process with limits: a job object, which ends with this process and holds its children too. */
#define _WIN32_WINNT 0x0601
#include "base/process.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "base/wide_path_windows.h"

enum { PIPE_BYTES = 1 << 16, POLL_MS = 2, FAULT_SEVERITY = 0xC0 };

/* The parent's state while the child runs. */
typedef struct child {
  HANDLE process, job, output, errors; /* our ends of its pipes; NULL after their end */
  sbfi_text kept;
  char tail[4096 + SBFI_PROCESS_ERROR_TAIL]; /* the end of its standard error, and space to read more */
  size_t tail_size;
} child;

static void close_handle(HANDLE *handle) {
  if (*handle) CloseHandle(*handle);
  *handle = NULL;
}

/* Adds an argument so that the C library of the child reads it unchanged: backslashes are doubled before a
 * quote only ("Parsing C command-line arguments", Microsoft). */
static void add_argument(sbfi_text *line, const char *argument) {
  size_t slashes = 0;
  if (line->length) sbfi_text_char(line, ' ');
  sbfi_text_char(line, '"');
  for (const char *c = argument; *c; c++) {
    if (*c == '"')
      for (slashes++; slashes > 0; slashes--) sbfi_text_char(line, '\\');
    slashes = *c == '\\' ? slashes + 1 : 0;
    sbfi_text_char(line, *c);
  }
  for (; slashes > 0; slashes--) sbfi_text_char(line, '\\');
  sbfi_text_char(line, '"');
}

/* The command line in UTF-16, in memory of `line`'s allocator; NULL if there is none or it is not UTF-8. */
static wchar_t *command_line(const char *const *arguments, sbfi_text *line, size_t *bytes) {
  for (size_t i = 0; arguments[i]; i++) add_argument(line, arguments[i]);
  sbfi_text_char(line, 0);
  if (line->failed) return NULL;
  int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, line->at, -1, NULL, 0);
  *bytes = (size_t)length * sizeof(wchar_t);
  wchar_t *wide = length > 0 ? sbfi_allocate(&line->allocator, *bytes) : NULL;
  if (wide) MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, line->at, -1, wide, length);
  return wide;
}

static HANDLE make_job(const sbfi_process_limits *limits) {
  HANDLE job = CreateJobObjectW(NULL, NULL);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION rules;
  memset(&rules, 0, sizeof rules);
  rules.BasicLimitInformation.LimitFlags =
      JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
  if (limits->cpu_s) {
    rules.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_TIME;
    rules.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = (LONGLONG)limits->cpu_s * 10000000;
  }
  if (limits->memory_bytes) {
    rules.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    rules.ProcessMemoryLimit = (SIZE_T)limits->memory_bytes;
  }
  if (job) SetInformationJobObject(job, JobObjectExtendedLimitInformation, &rules, sizeof rules);
  return job;
}

/* The three standard handles and no other are inherited. Returns 0 or an error of the system. */
static DWORD launch(child *c, wchar_t *line, HANDLE standard[3]) {
  STARTUPINFOEXW how;
  PROCESS_INFORMATION made;
  uint64_t list_memory[32];
  SIZE_T size = sizeof list_memory;
  memset(&how, 0, sizeof how);
  how.StartupInfo.cb = sizeof how;
  how.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
  how.StartupInfo.hStdInput = standard[0];
  how.StartupInfo.hStdOutput = standard[1];
  how.StartupInfo.hStdError = standard[2];
  how.lpAttributeList = (LPPROC_THREAD_ATTRIBUTE_LIST)list_memory;
  if (!InitializeProcThreadAttributeList(how.lpAttributeList, 1, 0, &size)) return GetLastError();
  DWORD number = 0;
  if (!UpdateProcThreadAttribute(how.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, standard,
          3 * sizeof *standard, NULL, NULL) ||
      !CreateProcessW(NULL, line, NULL, NULL, TRUE,
          CREATE_SUSPENDED | CREATE_NO_WINDOW | EXTENDED_STARTUPINFO_PRESENT, NULL, NULL, &how.StartupInfo,
          &made))
    number = GetLastError();
  DeleteProcThreadAttributeList(how.lpAttributeList);
  if (number) return number;
  c->process = made.hProcess;
  /* Where this process is in a job that allows none within, the child runs without limits of its own. */
  AssignProcessToJobObject(c->job, made.hProcess);
  ResumeThread(made.hThread);
  CloseHandle(made.hThread);
  return 0;
}

static DWORD start(child *c, wchar_t *line, const sbfi_process_limits *limits) {
  SECURITY_ATTRIBUTES inherited = {.nLength = sizeof inherited, .bInheritHandle = TRUE};
  HANDLE standard[3] = {CreateFileW(L"NUL", GENERIC_READ, 0, &inherited, OPEN_EXISTING, 0, NULL), NULL, NULL};
  DWORD number = 0;
  if (standard[0] == INVALID_HANDLE_VALUE) standard[0] = NULL;
  c->job = make_job(limits);
  if (!standard[0] || !c->job || !CreatePipe(&c->output, &standard[1], &inherited, PIPE_BYTES) ||
      !CreatePipe(&c->errors, &standard[2], &inherited, PIPE_BYTES))
    number = GetLastError();
  if (!number) number = launch(c, line, standard);
  for (int i = 0; i < 3; i++) close_handle(&standard[i]);
  return number;
}

/* Reads what is available; closes the pipe at its end. */
static size_t read_some(HANDLE *pipe, char *to, size_t size) {
  DWORD there = 0, got = 0;
  if (!*pipe) return 0;
  bool good = PeekNamedPipe(*pipe, NULL, 0, NULL, &there, NULL) != 0;
  if (good && there > 0) good = ReadFile(*pipe, to, there < size ? there : (DWORD)size, &got, NULL) != 0;
  if (!good) close_handle(pipe);
  return got;
}

static bool read_output(child *c) {
  char *to = c->output ? sbfi_text_reserve(&c->kept, PIPE_BYTES) : NULL;
  size_t got = to ? read_some(&c->output, to, PIPE_BYTES) : 0;
  c->kept.length += got;
  return got > 0;
}

static bool read_errors(child *c) {
  size_t got = read_some(&c->errors, c->tail + c->tail_size, sizeof c->tail - c->tail_size);
  c->tail_size += got;
  if (c->tail_size > SBFI_PROCESS_ERROR_TAIL) {
    memmove(c->tail, c->tail + c->tail_size - SBFI_PROCESS_ERROR_TAIL, SBFI_PROCESS_ERROR_TAIL);
    c->tail_size = SBFI_PROCESS_ERROR_TAIL;
  }
  return got > 0;
}

/* Reads the pipes until the program ends or must be killed. */
static sbfi_process_end watch(child *c, const sbfi_process_limits *limits) {
  ULONGLONG began = GetTickCount64();
  for (;;) {
    bool ended = WaitForSingleObject(c->process, 0) == WAIT_OBJECT_0; /* before the last reads */
    bool output_came = read_output(c), errors_came = read_errors(c);
    if (c->kept.failed) return SBFI_PROCESS_EXITED;
    if (limits->output_bytes && c->kept.length > limits->output_bytes) {
      c->kept.length = limits->output_bytes;
      return SBFI_PROCESS_OUTPUT_TOO_LARGE;
    }
    if (output_came || errors_came) continue;
    if (ended) return SBFI_PROCESS_EXITED;
    if (limits->wall_ms && GetTickCount64() - began > limits->wall_ms) return SBFI_PROCESS_TIMED_OUT;
    WaitForSingleObject(c->process, POLL_MS);
  }
}

static sbf_status cannot_run(sbf_diagnostic *error, const char *program, DWORD number) {
  sbf_status status = number == ERROR_FILE_NOT_FOUND || number == ERROR_PATH_NOT_FOUND
                          ? sbfi_diagnose(error, SBF_CODE_IO_CANNOT_RUN,
                                "cannot start the program: No such file or directory")
                          : sbfi_diagnose(error, SBF_CODE_IO_CANNOT_RUN,
                                "cannot start the program: error %lu of the system", (unsigned long)number);
  if (error) sbfi_copy_text(error->file, sizeof error->file, program);
  return status;
}

/* A program that faults ends with an NTSTATUS of the severity "error". */
static void take_end(const child *c, const sbfi_process_limits *limits, sbfi_process_result *result) {
  DWORD status = 0;
  FILETIME unused[3], user;
  GetExitCodeProcess(c->process, &status);
  if (result->end == SBFI_PROCESS_EXITED && status >> 24 == FAULT_SEVERITY) {
    result->end = SBFI_PROCESS_KILLED;
    result->signal = (int)status;
  } else {
    result->exit_status = (int)status;
  }
  if (result->end == SBFI_PROCESS_EXITED && status == ERROR_NOT_ENOUGH_QUOTA && limits->cpu_s &&
      GetProcessTimes(c->process, &unused[0], &unused[1], &unused[2], &user) &&
      ((uint64_t)user.dwHighDateTime << 32 | user.dwLowDateTime) / 10000000 >= limits->cpu_s) {
    result->end = SBFI_PROCESS_CPU_LIMIT;
    result->exit_status = 0;
  }
}

static sbf_status run(child *c, const char *const *arguments, const sbfi_process_limits *limits,
    sbfi_process_result *result, sbf_diagnostic *error) {
  sbfi_text line;
  size_t bytes = 0;
  sbfi_text_init(&line, &result->allocator);
  wchar_t *wide = command_line(arguments, &line, &bytes);
  DWORD number = wide ? start(c, wide, limits) : ERROR_INVALID_NAME;
  sbfi_free(&result->allocator, wide, bytes);
  sbfi_text_free(&line);
  if (number) return cannot_run(error, arguments[0], number);
  result->end = watch(c, limits);
  if (result->end != SBFI_PROCESS_EXITED || c->kept.failed) TerminateJobObject(c->job, 1);
  WaitForSingleObject(c->process, INFINITE);
  take_end(c, limits, result);
  if (c->kept.failed)
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the output of %s", arguments[0]);
  return SBF_OK;
}

sbf_status sbfi_process_run(const char *const *arguments, const sbfi_process_limits *limits,
    const sbf_allocator *allocator, sbfi_process_result *result, sbf_diagnostic *error) {
  child c = {.process = NULL};
  *result = (sbfi_process_result){.allocator = sbfi_allocator_or_default(allocator)};
  sbfi_text_init(&c.kept, allocator);
  sbf_status status = run(&c, arguments, limits, result, error);
  close_handle(&c.output);
  close_handle(&c.errors);
  close_handle(&c.process);
  close_handle(&c.job); /* ends what the program has left running */
  if (status != SBF_OK || c.kept.length == 0) sbfi_text_free(&c.kept);
  if (status != SBF_OK) return status;
  sbfi_process_copy_tail(c.tail, c.tail_size, result->error_tail);
  result->output = (uint8_t *)c.kept.at;
  result->output_size = c.kept.length;
  result->output_capacity = c.kept.capacity;
  return SBF_OK;
}

void sbfi_process_describe_kill(int number, char *to, size_t size) {
  static const struct {
    uint32_t code;
    const char *meaning;
  } known[] = {{0xC0000005, " (it accessed memory that it does not own)"},
      {0xC00000FD, " (its stack ran out)"}, {0xC0000094, " (an arithmetic error)"},
      {0xC000001D, " (an illegal instruction)"}, {0xC0000409, " (it aborted)"},
      {0xC000013A, " (it was asked to stop)"}};
  const char *meaning = "";
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i].code == (uint32_t)number) meaning = known[i].meaning;
  snprintf(to, size, "stopped by fault 0x%08x%s", (unsigned)number, meaning);
}
