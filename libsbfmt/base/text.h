/* Text: spans, UTF-8, and a growing buffer for writers. Bytes only, no locale. */
#ifndef SBFI_TEXT_H
#define SBFI_TEXT_H

#include "base/memory.h"

/* Characters owned by someone else; not NUL-terminated. `at` may be NULL if length is 0. */
typedef struct sbfi_span {
  const char *at;
  size_t length;
} sbfi_span;

sbfi_span sbfi_span_of(const char *text); /* NULL gives the empty span */
bool sbfi_span_equal(sbfi_span a, sbfi_span b);
bool sbfi_span_is(sbfi_span span, const char *text);
bool sbfi_span_begins(sbfi_span span, const char *prefix);

/* White space of XML: space, tab, line feed, carriage return. */
static inline bool sbfi_is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
sbfi_span sbfi_span_trim(sbfi_span span);

/* Splits the next word off the front of `*rest`; false at the end. */
bool sbfi_span_next_word(sbfi_span *rest, sbfi_span *word);
/* Splits the next line off the front of `*rest`, without its LF, CRLF or CR; false at the end. */
bool sbfi_span_next_line(sbfi_span *rest, sbfi_span *line);

/* Offset of the first byte that is not well-formed UTF-8 (overlong form, surrogate, above U+10FFFF), or
 * `length` if none. */
size_t sbfi_utf8_check(const char *text, size_t length);
/* Longest prefix of well-formed text, at most `limit` bytes, that ends between two characters. */
size_t sbfi_utf8_cut(const char *text, size_t length, size_t limit);

/* Whether a path is absolute, climbs above its starting folder, or has backslashes: a reader must not open
 * it. Checks only the characters. */
bool sbfi_path_leaves_folder(const char *path);

/* A growing buffer. If memory runs out, `failed` is set, the content stays, and further appends do nothing: a
 * writer may append freely and check once at the end. Not thread safe. */
typedef struct sbfi_text {
  sbf_allocator allocator;
  char *at; /* not NUL-terminated */
  size_t length, capacity;
  bool failed;
} sbfi_text;

void sbfi_text_init(sbfi_text *text, const sbf_allocator *allocator); /* NULL: malloc's */
void sbfi_text_free(sbfi_text *text);                                 /* back to the state after init */
void sbfi_text_clear(sbfi_text *text);                                /* empty, keeps the memory */

/* Reserves `more` bytes and returns a pointer to them, or NULL; the caller then adds to `length`. */
char *sbfi_text_reserve(sbfi_text *text, size_t more);

/* All return false once the buffer has failed. */
bool sbfi_text_append(sbfi_text *text, const void *bytes, size_t size);
bool sbfi_text_string(sbfi_text *text, const char *string);
bool sbfi_text_char(sbfi_text *text, char c);
bool sbfi_text_repeat(sbfi_text *text, char c, size_t count);
bool sbfi_text_i32(sbfi_text *text, int32_t value);
bool sbfi_text_u32(sbfi_text *text, uint32_t value);
bool sbfi_text_u64(sbfi_text *text, uint64_t value);
/* In the canonical form of number.h. For an infinity or a NaN it also returns false, appends nothing and
 * leaves `failed` unchanged. */
bool sbfi_text_f32(sbfi_text *text, float value);

#endif
