/* Base64 (RFC 4648, section 4) for bytes embedded in text. Writing gives no line breaks. Reading skips XML
 * white space anywhere and insists on the rest: padding complete, nothing behind it, unused bits zero, so
 * that each sequence of bytes has one text. */
#ifndef SBFI_BASE64_H
#define SBFI_BASE64_H

#include "base/text.h"

bool sbfi_base64_encode(sbfi_text *to, const uint8_t *bytes, size_t size); /* false: out of memory */

/* A decoder that takes the text in pieces; {0} begins. Not thread safe. */
typedef struct sbfi_base64_reader {
  uint32_t bits;            /* what the digits of the unfinished group of four hold */
  uint8_t digits, paddings; /* of that group */
  bool ended;               /* a padded group was complete */
} sbfi_base64_reader;

/* Room that sbfi_base64_read needs at most for `length` characters of text, whatever came before. */
#define SBFI_BASE64_CAPACITY(length) ((length) / 4 * 3 + 3)

/* Decodes the next piece to `to`; `*size` becomes how many bytes that gave. Returns the offset in `text` of
 * the first character that cannot stand there, or `length`. */
size_t sbfi_base64_read(
    sbfi_base64_reader *reader, const char *text, size_t length, uint8_t *to, size_t *size);
/* Whether the text may end here. */
bool sbfi_base64_is_complete(const sbfi_base64_reader *reader);

#endif
