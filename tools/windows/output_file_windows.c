/* Output files of commands with Windows calls: written to a temporary file that replaces the old one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "render/fault.h"
#include "render/output_file.h"

/* Passes paths to the C library unchanged; it reports UTF-8 paths that it cannot represent. */

static void release(output_file *output) {
  free(output->final_path);
  free(output->written_path);
  *output = (output_file){.given = NULL};
}

static sbf_status cannot_write(output_file *output, sbf_diagnostic *diagnostic) {
  sbf_status status = fault_set_file(diagnostic, SBF_CODE_IO_CANNOT_WRITE, output->given,
      "cannot write: error %lu of the system; check the folder, its permissions and the free space",
      (unsigned long)GetLastError());
  release(output);
  return status;
}

sbf_status output_file_begin(output_file *output, const char *path, sbf_diagnostic *diagnostic) {
  size_t size = strlen(path) + 32;
  *output = (output_file){.given = path, .final_path = strdup(path), .written_path = malloc(size)};
  if (!output->final_path || !output->written_path) {
    release(output);
    return fault_set_file(diagnostic, SBF_CODE_OUT_OF_MEMORY, path, "no memory for a file's name");
  }
  snprintf(output->written_path, size, "%s.%lu.part", path, (unsigned long)GetCurrentProcessId());
  DWORD there = GetFileAttributesA(path);
  if (there != INVALID_FILE_ATTRIBUTES && there & (FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_READONLY)) {
    SetLastError(ERROR_ACCESS_DENIED);
    return cannot_write(output, diagnostic);
  }
  HANDLE file =
      CreateFileA(output->written_path, GENERIC_WRITE, 0, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
  if (file == INVALID_HANDLE_VALUE) return cannot_write(output, diagnostic);
  CloseHandle(file);
  return SBF_OK;
}

void output_file_tie(int process) {
  (void)process; /* no process is started here */
}

sbf_status output_file_commit(output_file *output, sbf_diagnostic *diagnostic) {
  if (!MoveFileExA(
          output->written_path, output->final_path, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) {
    DWORD why = GetLastError();
    DeleteFileA(output->written_path);
    SetLastError(why);
    return cannot_write(output, diagnostic);
  }
  release(output);
  return SBF_OK;
}

void output_file_abandon(output_file *output) {
  if (!output->written_path) return;
  DeleteFileA(output->written_path);
  release(output);
}
