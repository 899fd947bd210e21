/* Text of a file inside a message: hostile bytes must not reach a terminal or a report. */
#ifndef SBFI_QUOTE_H
#define SBFI_QUOTE_H

#include "base/text.h"

typedef struct sbfi_quote {
  char text[64];
} sbfi_quote;

/* The beginning of the text, '?' in place of what is not UTF-8 and of control characters, "..." where cut. */
sbfi_quote sbfi_quote_of(sbfi_span text);

/* The same into a buffer of `size` bytes, at least 8. */
void sbfi_quote_into(char *to, size_t size, sbfi_span text);

#endif
