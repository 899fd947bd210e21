/* Base64 (RFC 4648, section 4) for bytes embedded in text. The writer produces no line breaks. The reader
 * skips XML white space anywhere and is strict otherwise: complete padding, nothing after it, unused bits
 * zero. Each sequence of bytes therefore has exactly one text. */
#ifndef SBFI_BASE64_H
#define SBFI_BASE64_H

#include "base/text.h"

bool sbfi_base64_encode(sbfi_text *to, const uint8_t *bytes, size_t size); /* false: out of memory */

/* A decoder that reads the text in pieces. Initialise with {0}. Not thread safe. */
typedef struct sbfi_base64_reader {
  uint32_t bits;            /* bits of the unfinished group of four digits */
  uint8_t digits, paddings; /* number in that group */
  bool ended;               /* a padded group is complete */
} sbfi_base64_reader;

/* Upper bound of the bytes that sbfi_base64_read decodes from `length` characters, for any earlier input. */
#define SBFI_BASE64_CAPACITY(length) ((length) / 4 * 3 + 3)

/* Decodes the next piece to `to`; `*size` receives the number of bytes. Returns the offset in `text` of the
 * first invalid character, or `length`. */
size_t sbfi_base64_read(
    sbfi_base64_reader *reader, const char *text, size_t length, uint8_t *to, size_t *size);
/* Whether the text may end here. */
bool sbfi_base64_is_complete(const sbfi_base64_reader *reader);

#endif
