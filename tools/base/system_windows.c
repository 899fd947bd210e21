/* Paths go to the system's narrow functions, which take UTF-8: the program's manifest says so
 * (program.manifest). */
#include "base/system.h"

#include <direct.h>
#include <errno.h>
#include <io.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <windows.h>

void system_begin(int argc, char **argv) {
  SetConsoleOutputCP(CP_UTF8);
  setvbuf(stderr, NULL, _IOFBF, BUFSIZ); /* else each character is written by itself */
  for (int i = 1; i < argc; i++)
    for (char *c = argv[i]; *c; c++)
      if (*c == '\\') *c = '/';
}

bool system_make_folder(const char *path) {
  return _mkdir(path) == 0 || (errno == EEXIST && system_is_folder(path, true));
}

bool system_make_unique_folder(char *path) {
  static const char letters[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  LARGE_INTEGER now;
  QueryPerformanceCounter(&now);
  uint64_t mark = (uint64_t)now.QuadPart ^ (uint64_t)GetCurrentProcessId() << 20;
  char *end = path + strlen(path) - 6;
  for (int tries = 0; tries < 100; tries++) {
    for (int i = 0; i < 6; i++, mark = mark * 6364136223846793005u + 1442695040888963407u)
      end[i] = letters[(mark >> 33) % 36];
    if (_mkdir(path) == 0) return true;
    if (errno != EEXIST) return false;
  }
  return false;
}

bool system_can_write_folder(const char *path) {
  char trial[4096];
  if (snprintf(trial, sizeof trial, "%s/sbf-XXXXXX", path) >= (int)sizeof trial) return false;
  if (!system_make_unique_folder(trial)) return false; /* permissions are too rich to be asked for */
  _rmdir(trial);
  return true;
}

bool system_is_folder(const char *path, bool follow_link) {
  DWORD facts = GetFileAttributesA(path);
  return facts != INVALID_FILE_ATTRIBUTES && facts & FILE_ATTRIBUTE_DIRECTORY &&
         (follow_link || !(facts & FILE_ATTRIBUTE_REPARSE_POINT));
}

bool system_replace_file(const char *from, const char *to) {
  if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) return true;
  DWORD why = GetLastError();
  errno = why == ERROR_FILE_NOT_FOUND || why == ERROR_PATH_NOT_FOUND ? ENOENT
          : why == ERROR_DISK_FULL                                   ? ENOSPC
                                                                     : EACCES;
  return false;
}

bool system_sync_file(FILE *file) {
  return _commit(_fileno(file)) == 0;
}

/* tmpfile of this system's C library writes to the root of the drive, where users may not. */
FILE *system_temporary_file(void) {
  char folder[MAX_PATH + 1], path[MAX_PATH + 1];
  DWORD length = GetTempPathA(sizeof folder, folder);
  if (length == 0 || length >= sizeof folder || !GetTempFileNameA(folder, "sbf", 0, path)) return NULL;
  FILE *file = fopen(path, "w+bTD"); /* T: in memory while there is room; D: deleted when it is closed */
  if (!file) DeleteFileA(path);
  return file;
}

FILE *system_memory_stream_open(system_memory_stream *stream) {
  *stream = (system_memory_stream){NULL, NULL, 0};
  return stream->file = system_temporary_file();
}

char *system_memory_stream_close(system_memory_stream *stream, size_t *size) {
  FILE *file = stream->file;
  long end = file && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  char *bytes = end >= 0 && !ferror(file) ? malloc((size_t)end + 1) : NULL;
  bool good = bytes && fseek(file, 0, SEEK_SET) == 0 && fread(bytes, 1, (size_t)end, file) == (size_t)end;
  if (file) fclose(file);
  *size = good ? (size_t)end : 0;
  if (good) {
    bytes[end] = 0;
    return bytes;
  }
  free(bytes);
  return NULL;
}

bool system_program_path(char *to, size_t size) {
  DWORD length = GetModuleFileNameA(NULL, to, (DWORD)size);
  return length > 0 && length < size;
}

uint32_t system_processor_count(void) {
  DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
  return count ? count : 1;
}

double system_load(void) {
  return (double)NAN;
}

void *system_open_library(const char *name) {
  return (void *)LoadLibraryA(name);
}

system_function system_library_function(void *library, const char *name) {
  return (system_function)GetProcAddress((HMODULE)library, name);
}
