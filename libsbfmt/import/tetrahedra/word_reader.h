/* Reads words and numbers of a text or binary file, with line numbers. */
#ifndef SBFI_WORD_READER_H
#define SBFI_WORD_READER_H

#include "base/diagnostic.h"
#include "base/text.h"

typedef struct sbfi_word_reader {
  const char *at, *end;
  const char *file;
  uint32_t line;     /* of `at`, from 1 */
  char comment;      /* starts a comment to the end of the line; 0: none */
  bool swap_bytes;   /* byte order of binary numbers differs from the machine's */
  sbf_status status; /* first failure; all later calls fail */
  sbf_diagnostic *error;
} sbfi_word_reader;

void sbfi_word_reader_init(
    sbfi_word_reader *r, const char *bytes, size_t size, const char *file, sbf_diagnostic *error);

/* Records a failure at the current line; returns false. */
bool sbfi_word_fail(sbfi_word_reader *r, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Next word; false at the end of the file, which is not a failure. */
bool sbfi_word_next(sbfi_word_reader *r, sbfi_span *word);
/* Rest of the current line without its end; false at the end of the file. */
bool sbfi_word_line(sbfi_word_reader *r, sbfi_span *line);

/* Next word as a number; false, with a recorded failure, if it is not one. `what` names it in the message,
 * as in "a node's place". */
bool sbfi_word_f32(sbfi_word_reader *r, float *value, const char *what);
bool sbfi_word_u32(sbfi_word_reader *r, uint32_t *value, const char *what);
bool sbfi_word_i32(sbfi_word_reader *r, int32_t *value, const char *what);
/* Count of items that each take at least `min_bytes` of the file; larger counts are rejected. */
bool sbfi_word_count(sbfi_word_reader *r, uint32_t *value, uint32_t min_bytes, const char *what);

/* Binary numbers at the current position in the file's byte order. */
bool sbfi_binary_u32(sbfi_word_reader *r, uint32_t *value, const char *what);
bool sbfi_binary_u64(sbfi_word_reader *r, uint64_t *value, const char *what);
bool sbfi_binary_f32(sbfi_word_reader *r, float *value, const char *what);
bool sbfi_binary_f64(sbfi_word_reader *r, double *value, const char *what);

/* Appends `count` zeroed items to an array; NULL with a recorded failure if memory runs out. */
void *sbfi_word_push(sbfi_word_reader *r, sbfi_array *array, size_t count);

#endif
