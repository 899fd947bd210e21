/* Text: spans, UTF-8, and the growing buffer that writers fill. Bytes only, no locale. */
#ifndef SBFI_TEXT_H
#define SBFI_TEXT_H

#include "base/memory.h"

/* Characters that someone else owns; not NUL-terminated. `at` may be NULL where length is 0. */
typedef struct sbfi_span {
  const char *at;
  size_t length;
} sbfi_span;

sbfi_span sbfi_span_of(const char *text); /* NULL gives the empty span */
bool sbfi_span_equal(sbfi_span a, sbfi_span b);
bool sbfi_span_is(sbfi_span span, const char *text);
bool sbfi_span_begins(sbfi_span span, const char *prefix);

/* White space as XML has it: space, tab, line feed, carriage return. */
static inline bool sbfi_is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
sbfi_span sbfi_span_trim(sbfi_span span);

/* Takes the next word between white space off the front of `*rest`; false at the end. */
bool sbfi_span_next_word(sbfi_span *rest, sbfi_span *word);
/* Takes the next line off the front of `*rest`, without its LF, CRLF or CR; false at the end. */
bool sbfi_span_next_line(sbfi_span *rest, sbfi_span *line);

/* Offset of the first byte that is not part of well-formed UTF-8 (no overlong form, no surrogate, nothing
 * above U+10FFFF), or `length` where all of it is. */
size_t sbfi_utf8_check(const char *text, size_t length);
/* The longest beginning of well-formed text, `limit` bytes at most, that ends between two characters. */
size_t sbfi_utf8_cut(const char *text, size_t length, size_t limit);

/* Whether a path is absolute, climbs above the folder that it starts in, or has backslashes: a reader must
 * refuse to open it. Looks at the letters alone. */
bool sbfi_path_leaves_folder(const char *path);

/* A growing buffer. When memory runs out `failed` is set, what was there stays, and every further append does
 * nothing: a writer may append freely and look once at the end. Not thread safe. */
typedef struct sbfi_text {
  sbf_allocator allocator;
  char *at; /* not NUL-terminated */
  size_t length, capacity;
  bool failed;
} sbfi_text;

void sbfi_text_init(sbfi_text *text, const sbf_allocator *allocator); /* NULL: malloc's */
void sbfi_text_free(sbfi_text *text);                                 /* back to the state after init */
void sbfi_text_clear(sbfi_text *text);                                /* empty, the memory kept */

/* Makes room for `more` bytes and returns where they go, or NULL; the caller then adds to `length`. */
char *sbfi_text_reserve(sbfi_text *text, size_t more);

/* All return false once the buffer has failed. */
bool sbfi_text_append(sbfi_text *text, const void *bytes, size_t size);
bool sbfi_text_string(sbfi_text *text, const char *string);
bool sbfi_text_char(sbfi_text *text, char c);
bool sbfi_text_repeat(sbfi_text *text, char c, size_t count);
bool sbfi_text_i32(sbfi_text *text, int32_t value);
bool sbfi_text_u32(sbfi_text *text, uint32_t value);
bool sbfi_text_u64(sbfi_text *text, uint64_t value);
/* The canonical form of number.h. False as well, with nothing appended and `failed` unchanged, for an
 * infinity or a NaN. */
bool sbfi_text_f32(sbfi_text *text, float value);

#endif
