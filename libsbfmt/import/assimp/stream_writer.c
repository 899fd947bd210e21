#include "stream_writer.h"

#include <stdio.h>

void write_bytes(const void *bytes, size_t size) {
  static const char zeros[4];
  fwrite(bytes, 1, size, stdout);
  fwrite(zeros, 1, -size & 3, stdout);
}

void write_u32(uint32_t value) {
  fwrite(&value, sizeof value, 1, stdout);
}

void write_f32s(const float *values, size_t count) {
  fwrite(values, sizeof *values, count, stdout);
}

void write_f64(double value) {
  fwrite(&value, sizeof value, 1, stdout);
}

void write_string(const char *text, size_t length) {
  write_u32((uint32_t)length);
  write_bytes(text, length);
}

int write_end(void) {
  return fflush(stdout) != 0 || ferror(stdout) ? -1 : 0;
}
