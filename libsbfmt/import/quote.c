#include "import/quote.h"

#include <string.h>

void sbfi_quote_into(char *to, size_t size, sbfi_span text) {
  bool cut = text.length >= size;
  size_t length = cut ? size - 4 : text.length, at = 0;
  if (length) memcpy(to, text.at, length);
  while ((at += sbfi_utf8_check(to + at, length - at)) < length) {
    if (cut && length - at < 4)
      length = at; /* the cut split a character */
    else
      to[at++] = '?';
  }
  for (size_t i = 0; i < length; i++)
    if ((uint8_t)to[i] < 0x20 || to[i] == 0x7f) to[i] = '?';
  memcpy(to + length, cut ? "..." : "", cut ? 4 : 1);
}

sbfi_quote sbfi_quote_of(sbfi_span text) {
  sbfi_quote quote;
  sbfi_quote_into(quote.text, sizeof quote.text, text);
  return quote;
}
