#include "decoded_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_file.h"

static size_t read_items(struct aiFile *file, char *to, size_t size, size_t count) {
  return fread(to, size, count, (FILE *)file->UserData);
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count) {
  (void)file, (void)from, (void)size, (void)count;
  return 0;
}

static size_t position_of(struct aiFile *file) {
  long at = ftell((FILE *)file->UserData);
  return at < 0 ? 0 : (size_t)at;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
  int from = origin == aiOrigin_CUR ? SEEK_CUR : origin == aiOrigin_END ? SEEK_END : SEEK_SET;
  return fseek((FILE *)file->UserData, (long)offset, from) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static size_t size_of(struct aiFile *file) {
  size_t at = position_of(file), size;
  seek(file, 0, aiOrigin_END);
  size = position_of(file);
  seek(file, at, aiOrigin_SET);
  return size;
}

static void flush(struct aiFile *file) {
  (void)file;
}

static FILE *open_decoded(const char *path) {
  size_t size = strlen(path) + 1;
  char *decoded = malloc(size);
  if (!decoded) return NULL;
  memcpy(decoded, path, size);
  percent_decode(decoded);
  FILE *stream = fopen(decoded, "rb");
  free(decoded);
  return stream;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode) {
  (void)io;
  if (*mode != 'r') return NULL;
  FILE *stream = fopen(path, "rb");
  if (!stream && !(stream = open_decoded(path))) return NULL;
  struct aiFile *file = malloc(sizeof *file);
  if (!file) {
    fclose(stream);
    return NULL;
  }
  *file = (struct aiFile){read_items, write_nothing, position_of, size_of, seek, flush, (char *)stream};
  return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file) {
  (void)io;
  fclose((FILE *)file->UserData);
  free(file);
}

struct aiFileIO decoded_files = {open_file, close_file, NULL};
