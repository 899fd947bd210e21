/* Files with Windows calls: reading, mapping, and writing to a temporary file that replaces the old one. */
#include <stdio.h>
#include <string.h>

#include "base/file_system.h"
#include "base/wide_path_windows.h"

enum { LARGEST_TRANSFER = 1 << 30, FIRST_READ_BYTES = 1 << 16, TEMPORARY_TRIES = 100 };

static HANDLE handle_of(intptr_t number) {
  return (HANDLE)number; /* -1 is INVALID_HANDLE_VALUE */
}

sbf_status sbfi_file_fault(
    sbf_diagnostic *error, sbf_code code, const char *path, const char *doing, int number) {
  static const struct {
    int number;
    const char *why;
  } known[] = {{ERROR_FILE_NOT_FOUND, "No such file or directory"},
      {ERROR_PATH_NOT_FOUND, "No such file or directory"}, {ERROR_ACCESS_DENIED, "Permission denied"},
      {ERROR_SHARING_VIOLATION, "another program has it open"}, {ERROR_DISK_FULL, "No space left on device"},
      {ERROR_HANDLE_DISK_FULL, "No space left on device"}, {ERROR_NOT_ENOUGH_MEMORY, "no memory"},
      {ERROR_DIRECTORY, "Is a directory"}, {ERROR_INVALID_NAME, "no system path"},
      {ERROR_FILENAME_EXCED_RANGE, "the path is too long, or is not UTF-8"}};
  char why[64];
  snprintf(why, sizeof why, "system error %d", number);
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i].number == number) sbfi_copy_text(why, sizeof why, known[i].why);
  if (number == ERROR_NOT_ENOUGH_MEMORY) code = SBF_CODE_OUT_OF_MEMORY;
  sbf_status status = sbfi_diagnose(error, code, "cannot %s the file: %s", doing, why);
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

/* Opens for reading; INVALID_HANDLE_VALUE and an error on failure. `*size` is 0 if the file has none. */
static HANDLE open_to_read(const char *path, uint64_t *size, sbf_status *status, sbf_diagnostic *error) {
  wchar_t wide[SBFI_WIDE_PATH];
  HANDLE handle = INVALID_HANDLE_VALUE;
  DWORD number = ERROR_FILENAME_EXCED_RANGE;
  *size = 0;
  if (sbfi_wide_path(path, wide)) {
    DWORD facts = GetFileAttributesW(wide);
    if (facts != INVALID_FILE_ATTRIBUTES && facts & FILE_ATTRIBUTE_DIRECTORY) {
      number = ERROR_DIRECTORY;
    } else {
      handle = CreateFileW(wide, GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
          OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
      number = GetLastError();
    }
  }
  LARGE_INTEGER bytes;
  if (handle == INVALID_HANDLE_VALUE)
    *status = sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, path, "open", (int)number);
  else if (GetFileType(handle) == FILE_TYPE_DISK && GetFileSizeEx(handle, &bytes))
    *size = (uint64_t)bytes.QuadPart;
  return handle;
}

/* Reads to the end. One byte more than the expected size detects the end without growing. */
static sbf_status read_to_end(HANDLE handle, const char *path, uint64_t expected_bytes, uint64_t limit_bytes,
    sbfi_file_content *content, sbf_diagnostic *error) {
  if (limit_bytes && expected_bytes > limit_bytes) return sbfi_file_too_large(error, path, limit_bytes);
  size_t capacity =
      expected_bytes && expected_bytes < SIZE_MAX ? (size_t)expected_bytes + 1 : FIRST_READ_BYTES;
  for (;;) {
    if (content->size == content->allocated_bytes) {
      if (content->size && !sbfi_multiply_size(content->size, 2, &capacity)) capacity = 0;
      if (!capacity || !sbfi_file_grow(content, capacity))
        return sbfi_file_fault(error, SBF_CODE_OUT_OF_MEMORY, path, "read", ERROR_NOT_ENOUGH_MEMORY);
    }
    size_t left = content->allocated_bytes - content->size;
    DWORD got = 0;
    if (!ReadFile(handle, (uint8_t *)content->at + content->size,
            (DWORD)(left < LARGEST_TRANSFER ? left : LARGEST_TRANSFER), &got, NULL) &&
        GetLastError() != ERROR_BROKEN_PIPE)
      return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, path, "read", (int)GetLastError());
    if (got == 0) return SBF_OK;
    content->size += got;
    if (limit_bytes && content->size > limit_bytes) return sbfi_file_too_large(error, path, limit_bytes);
  }
}

/* The view keeps the mapping alive. */
static void map(HANDLE handle, uint64_t size, sbfi_file_content *content) {
  HANDLE mapping = CreateFileMappingW(handle, NULL, PAGE_READONLY, 0, 0, NULL);
  if (!mapping) return;
  content->at = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, (SIZE_T)size);
  if (content->at) content->size = (size_t)size;
  CloseHandle(mapping);
}

sbf_status sbfi_file_get(const char *path, bool mapped, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  *content = (sbfi_file_content){.allocator = sbfi_allocator_or_default(allocator)};
  uint64_t size;
  sbf_status status = SBF_OK;
  HANDLE handle = open_to_read(path, &size, &status, error);
  if (handle == INVALID_HANDLE_VALUE) return status;
  if (mapped && size > 0 && size <= SIZE_MAX && !(limit_bytes && size > limit_bytes))
    map(handle, size, content);
  if (!content->at) status = read_to_end(handle, path, size, limit_bytes, content, error);
  CloseHandle(handle);
  if (status != SBF_OK || content->size == 0) sbfi_file_content_free(content);
  return status;
}

void sbfi_file_content_free(sbfi_file_content *content) {
  if (content->allocated_bytes)
    sbfi_free(&content->allocator, (void *)content->at, content->allocated_bytes);
  else if (content->at)
    UnmapViewOfFile(content->at);
  *content = (sbfi_file_content){.allocator = content->allocator};
}

sbf_status sbfi_file_open(const char *path, sbfi_file *file, sbf_diagnostic *error) {
  *file = (sbfi_file){.handle = -1, .path = path};
  sbf_status status = SBF_OK;
  HANDLE handle = open_to_read(path, &file->size, &status, error);
  if (handle == INVALID_HANDLE_VALUE) return status;
  if (GetFileType(handle) != FILE_TYPE_DISK) {
    CloseHandle(handle);
    return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, path, "read parts of", ERROR_INVALID_FUNCTION);
  }
  file->handle = (intptr_t)handle;
  return SBF_OK;
}

sbf_status sbfi_file_read_at(
    const sbfi_file *file, uint64_t offset, void *to, size_t size, sbf_diagnostic *error) {
  uint8_t *at = to;
  while (size > 0) {
    OVERLAPPED overlapped = {.Offset = (DWORD)offset, .OffsetHigh = (DWORD)(offset >> 32)};
    DWORD got = 0;
    if (offset <= INT64_MAX &&
        !ReadFile(handle_of(file->handle), at, (DWORD)(size < LARGEST_TRANSFER ? size : LARGEST_TRANSFER),
            &got, &overlapped)) {
      if (GetLastError() != ERROR_HANDLE_EOF)
        return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, file->path, "read", (int)GetLastError());
      got = 0;
    }
    if (got == 0) return sbfi_file_ends_early(error, file->path, offset, size);
    at += got;
    offset += got;
    size -= got;
  }
  return SBF_OK;
}

void sbfi_file_close(sbfi_file *file) {
  if (file->handle != -1) CloseHandle(handle_of(file->handle));
  file->handle = -1;
}

const char *sbfi_path_name(const char *path) {
  const char *name = path + strlen(path);
  while (name > path && !strchr("/\\:", name[-1])) name--;
  return name;
}

FILE *sbfi_file_discard(void) {
  return fopen("NUL", "w");
}

/* Creates a file with a new name in the target's folder. */
static HANDLE create_temporary(sbfi_file_writer *writer) {
  wchar_t wide[SBFI_WIDE_PATH];
  size_t folder = (size_t)(sbfi_path_name(writer->final_path) - writer->final_path);
  LARGE_INTEGER now;
  QueryPerformanceCounter(&now);
  uint32_t mark = (uint32_t)now.QuadPart ^ (uint32_t)GetCurrentProcessId() << 12;
  memcpy(writer->temporary_path, writer->final_path, folder);
  for (int i = 0; i < TEMPORARY_TRIES; i++, mark = mark * 1664525 + 1013904223) {
    snprintf(writer->temporary_path + folder, SBFI_TEMPORARY_NAME_BYTES, ".sbf-%08x.tmp", (unsigned)mark);
    if (!sbfi_wide_path(writer->temporary_path, wide)) {
      SetLastError(ERROR_FILENAME_EXCED_RANGE);
      return INVALID_HANDLE_VALUE;
    }
    HANDLE handle = CreateFileW(wide, GENERIC_WRITE, 0, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
    if (handle != INVALID_HANDLE_VALUE || GetLastError() != ERROR_FILE_EXISTS) return handle;
  }
  return INVALID_HANDLE_VALUE;
}

/* Resolves a link, so that the link itself is kept. */
static bool follow(const wchar_t *path, char *to, size_t size) {
  wchar_t wide[SBFI_WIDE_PATH];
  HANDLE handle = CreateFileW(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
  if (handle == INVALID_HANDLE_VALUE) return false;
  DWORD length = GetFinalPathNameByHandleW(handle, wide, SBFI_WIDE_PATH, FILE_NAME_NORMALIZED);
  CloseHandle(handle);
  return length > 0 && length < SBFI_WIDE_PATH && sbfi_narrow_path(wide, to, size);
}

/* Opens the file to write to; 0 or an error number. */
int sbfi_file_writer_target(sbfi_file_writer *writer, const char *path) {
  wchar_t wide[SBFI_WIDE_PATH];
  char followed[3 * SBFI_WIDE_PATH];
  if (!sbfi_wide_path(path, wide)) return ERROR_FILENAME_EXCED_RANGE;
  DWORD facts = GetFileAttributesW(wide);
  bool exists = facts != INVALID_FILE_ATTRIBUTES, direct = false;
  if (exists && facts & FILE_ATTRIBUTE_DIRECTORY) return ERROR_DIRECTORY;
  if (exists && facts & FILE_ATTRIBUTE_READONLY) return ERROR_ACCESS_DENIED;
  if (exists && facts & FILE_ATTRIBUTE_REPARSE_POINT) {
    if (!follow(wide, followed, sizeof followed)) return (int)GetLastError();
    path = followed;
  }
  /* A device, such as CON or a pipe, has no file attributes. */
  HANDLE device = INVALID_HANDLE_VALUE;
  if (!exists)
    device =
        CreateFileW(wide, GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, NULL, OPEN_EXISTING, 0, NULL);
  direct = device != INVALID_HANDLE_VALUE && GetFileType(device) != FILE_TYPE_DISK;
  if (device != INVALID_HANDLE_VALUE && !direct) CloseHandle(device);
  if (!sbfi_file_writer_reserve(writer, path)) {
    if (direct) CloseHandle(device);
    return ERROR_NOT_ENOUGH_MEMORY;
  }
  if (direct) writer->temporary_path = NULL;
  writer->handle = (intptr_t)(direct ? device : create_temporary(writer));
  return writer->handle == -1 ? (int)GetLastError() : 0;
}

void sbfi_file_put(sbfi_file_writer *writer, const uint8_t *at, size_t size) {
  while (size > 0 && writer->failure == 0) {
    DWORD put = 0;
    if (!WriteFile(handle_of(writer->handle), at, (DWORD)(size < LARGEST_TRANSFER ? size : LARGEST_TRANSFER),
            &put, NULL)) {
      writer->failure = (int)GetLastError();
      continue;
    }
    at += put;
    size -= put;
  }
}

int sbfi_file_sync(sbfi_file_writer *writer) {
  return FlushFileBuffers(handle_of(writer->handle)) ? 0 : (int)GetLastError();
}

int sbfi_file_shut(sbfi_file_writer *writer) {
  HANDLE handle = handle_of(writer->handle);
  writer->handle = -1;
  return handle == INVALID_HANDLE_VALUE || CloseHandle(handle) ? 0 : (int)GetLastError();
}

int sbfi_file_rename(sbfi_file_writer *writer) {
  wchar_t from[SBFI_WIDE_PATH], to[SBFI_WIDE_PATH];
  if (!sbfi_wide_path(writer->temporary_path, from) || !sbfi_wide_path(writer->final_path, to))
    return ERROR_FILENAME_EXCED_RANGE;
  return MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) ? 0 : (int)GetLastError();
}

void sbfi_file_remove(const char *path) {
  wchar_t wide[SBFI_WIDE_PATH];
  if (sbfi_wide_path(path, wide)) DeleteFileW(wide);
}
