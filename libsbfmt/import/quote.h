/* Quotes text of a file in messages: control bytes must not reach a terminal or a report. */
#ifndef SBFI_QUOTE_H
#define SBFI_QUOTE_H

#include "base/text.h"

typedef struct sbfi_quote {
  char text[64];
} sbfi_quote;

/* Copies the beginning of the text. Replaces invalid UTF-8 and control characters by '?', and ends with
 * "..." if it is cut. */
sbfi_quote sbfi_quote_of(sbfi_span text);

/* The same into a buffer of `size` bytes, at least 8. */
void sbfi_quote_into(char *to, size_t size, sbfi_span text);

#endif
