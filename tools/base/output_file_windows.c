/* Output files of commands with Windows calls: written to a temporary file that replaces the old one. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "base/fault.h"
#include "base/output_file.h"
#include "base/system.h"

/* What is left to do if the user ends the program; a thread of the system calls remove_and_end. */
static CRITICAL_SECTION lock;
static const char *pending_path;
static HANDLE pending_process;
static bool is_busy, is_ready;

static BOOL WINAPI remove_and_end(DWORD event) {
  (void)event;
  EnterCriticalSection(&lock); /* for good: the program ends after this */
  if (pending_process) {
    TerminateProcess(pending_process, 1); /* so that it cannot recreate the file */
    WaitForSingleObject(pending_process, 2000);
  }
  if (pending_path) DeleteFileA(pending_path);
  return FALSE;
}

static void set_pending(const char *path, HANDLE process) {
  EnterCriticalSection(&lock);
  pending_path = path;
  pending_process = process;
  LeaveCriticalSection(&lock);
}

static void watch(const char *temporary) {
  if (!is_ready) {
    InitializeCriticalSection(&lock);
    SetConsoleCtrlHandler(remove_and_end, TRUE);
    is_ready = true;
  }
  is_busy = true;
  set_pending(temporary, NULL);
}

static void unwatch(void) {
  set_pending(NULL, NULL);
  is_busy = false;
}

void output_file_tie(intptr_t process) {
  set_pending(pending_path, (HANDLE)process);
}

static int make_temporary(const char *path) {
  HANDLE file = CreateFileA(path, GENERIC_WRITE, 0, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
  if (file != INVALID_HANDLE_VALUE) {
    CloseHandle(file);
    return 0;
  }
  DWORD why = GetLastError();
  return why == ERROR_PATH_NOT_FOUND || why == ERROR_FILE_NOT_FOUND ? ENOENT : EACCES;
}

sbf_status output_file_begin(output_file *output, const char *path, sbf_diagnostic *diagnostic) {
  *output = (output_file){.given = path};
  if (is_busy)
    return fault_set_file(
        diagnostic, SBF_CODE_BAD_CALL, path, "another file is being written: one at a time");
  DWORD facts = GetFileAttributesA(path);
  bool exists = facts != INVALID_FILE_ATTRIBUTES;
  if (exists && facts & FILE_ATTRIBUTE_DIRECTORY) return output_file_refuse(output, EISDIR, diagnostic);
  if (exists && facts & FILE_ATTRIBUTE_READONLY) return output_file_refuse(output, EACCES, diagnostic);
  size_t size = strlen(path) + 32;
  output->final_path = strdup(path);
  output->written_path = malloc(size);
  if (!output->final_path || !output->written_path) { return output_file_no_memory(output, diagnostic); }
  snprintf(output->written_path, size, "%s.%lu.part", path, (unsigned long)GetCurrentProcessId());
  int why = make_temporary(output->written_path);
  if (why) return output_file_refuse(output, why, diagnostic);
  watch(output->written_path);
  return SBF_OK;
}

sbf_status output_file_commit(output_file *output, sbf_diagnostic *diagnostic) {
  int why = 0;
  if (!system_replace_file(output->written_path, output->final_path)) {
    why = errno;
    DeleteFileA(output->written_path);
  }
  unwatch();
  if (why) return output_file_refuse(output, why, diagnostic);
  output_file_release(output);
  return SBF_OK;
}

void output_file_abandon(output_file *output) {
  if (!output->written_path) return;
  DeleteFileA(output->written_path);
  unwatch();
  output_file_release(output);
}
