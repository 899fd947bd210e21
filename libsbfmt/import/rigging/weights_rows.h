/* Rows of a weights file as text: CSV with a header line, or JSON.
 *
 * CSV (RFC 4180): columns vertex, bone and weight in any order; others are ignored. JSON: a list of
 * objects with these keys, or an object whose key "weights" contains it. */
#ifndef SBFI_WEIGHTS_ROWS_H
#define SBFI_WEIGHTS_ROWS_H

#include "base/diagnostic.h"
#include "base/text.h"

typedef struct sbfi_weights_row {
  uint32_t vertex, line; /* the line counts from 1 */
  float weight;
  const char *bone; /* owned by the arena */
} sbfi_weights_row;

typedef struct sbfi_weights_rows {
  sbfi_array rows; /* sbfi_weights_row */
  sbfi_arena *arena;
  sbf_diagnostic *error;
} sbfi_weights_rows;

/* Adds the file's rows. On failure `*error` has the location and the reason: RIG_WEIGHTS_FILE,
 * OUT_OF_MEMORY. */
sbf_status sbfi_weights_rows_csv(sbfi_weights_rows *to, sbfi_span text);
sbf_status sbfi_weights_rows_json(sbfi_weights_rows *to, sbfi_span text);

/* RIG_WEIGHTS_FILE with the line. */
sbf_status sbfi_weights_rows_fail(sbfi_weights_rows *of, uint32_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Parses the text of one row's vertex and weight. */
sbf_status sbfi_weights_rows_add(
    sbfi_weights_rows *to, uint32_t line, sbfi_span vertex, const char *bone, sbfi_span weight);

#endif
