/* Writes words and strings to standard output; errors are reported once, by write_end. */
#ifndef STREAM_WRITER_H
#define STREAM_WRITER_H

#include <stddef.h>
#include <stdint.h>

void write_bytes(const void *bytes, size_t size); /* pads with zeros to a whole word */
void write_u32(uint32_t value);
void write_f32s(const float *values, size_t count);
void write_f64(double value);
void write_string(const char *text, size_t length);

/* Returns 0 if everything was written. */
int write_end(void);

#endif
