/* Words and numbers of a text or binary file of another program, with the line they stand on. */
#ifndef SBFI_WORD_READER_H
#define SBFI_WORD_READER_H

#include "base/diagnostic.h"
#include "base/text.h"

typedef struct sbfi_word_reader {
  const char *at, *end;
  const char *file;
  uint32_t line;     /* of `at`, from 1 */
  char comment;      /* from it to the end of the line nothing counts; 0: none */
  bool swap_bytes;   /* binary numbers stand in the other order than the machine's */
  sbf_status status; /* of the first failure; then every call fails */
  sbf_diagnostic *error;
} sbfi_word_reader;

void sbfi_word_reader_init(
    sbfi_word_reader *r, const char *bytes, size_t size, const char *file, sbf_diagnostic *error);

/* Records a failure at the present line; returns false. */
bool sbfi_word_fail(sbfi_word_reader *r, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The next word; false at the end of the file, which is no failure. */
bool sbfi_word_next(sbfi_word_reader *r, sbfi_span *word);
/* The rest of the present line, without its end; false at the end of the file. */
bool sbfi_word_line(sbfi_word_reader *r, sbfi_span *line);

/* The next word as a number; false, with the failure recorded, where there is none. `what` names it in the
 * message, as in "a node's place". */
bool sbfi_word_f32(sbfi_word_reader *r, float *value, const char *what);
bool sbfi_word_u32(sbfi_word_reader *r, uint32_t *value, const char *what);
bool sbfi_word_i32(sbfi_word_reader *r, int32_t *value, const char *what);
/* A count of things of which each takes at least `min_bytes` of the file: more cannot be true. */
bool sbfi_word_count(sbfi_word_reader *r, uint32_t *value, uint32_t min_bytes, const char *what);

/* Binary numbers at the present place, as the file has them. */
bool sbfi_binary_u32(sbfi_word_reader *r, uint32_t *value, const char *what);
bool sbfi_binary_u64(sbfi_word_reader *r, uint64_t *value, const char *what);
bool sbfi_binary_f32(sbfi_word_reader *r, float *value, const char *what);
bool sbfi_binary_f64(sbfi_word_reader *r, double *value, const char *what);

/* `count` new zeroed items of an array, NULL with the failure recorded where memory runs out. */
void *sbfi_word_push(sbfi_word_reader *r, sbfi_array *array, size_t count);

#endif
