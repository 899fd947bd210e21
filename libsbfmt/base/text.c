#include "base/text.h"

#include <string.h>

#include "base/number.h"

sbfi_span sbfi_span_of(const char *text) {
  return (sbfi_span){text, text ? strlen(text) : 0};
}

bool sbfi_span_equal(sbfi_span a, sbfi_span b) {
  return a.length == b.length && (a.length == 0 || memcmp(a.at, b.at, a.length) == 0);
}

bool sbfi_span_is(sbfi_span span, const char *text) {
  return sbfi_span_equal(span, sbfi_span_of(text));
}

bool sbfi_span_begins(sbfi_span span, const char *prefix) {
  size_t length = strlen(prefix);
  return span.length >= length && sbfi_span_is((sbfi_span){span.at, length}, prefix);
}

sbfi_span sbfi_span_trim(sbfi_span span) {
  while (span.length && sbfi_is_space(span.at[0])) span = (sbfi_span){span.at + 1, span.length - 1};
  while (span.length && sbfi_is_space(span.at[span.length - 1])) span.length--;
  return span;
}

/* Splits the first `length` characters off the front of the span. */
static sbfi_span take(sbfi_span *rest, size_t length) {
  sbfi_span taken = {rest->at, length};
  if (length) *rest = (sbfi_span){rest->at + length, rest->length - length};
  return taken;
}

bool sbfi_span_next_word(sbfi_span *rest, sbfi_span *word) {
  size_t length = 0;
  while (length < rest->length && sbfi_is_space(rest->at[length])) length++;
  take(rest, length);
  for (length = 0; length < rest->length && !sbfi_is_space(rest->at[length]);) length++;
  *word = take(rest, length);
  return length > 0;
}

bool sbfi_span_next_line(sbfi_span *rest, sbfi_span *line) {
  if (rest->length == 0) {
    *line = *rest;
    return false;
  }
  size_t length = 0;
  while (length < rest->length && rest->at[length] != '\n' && rest->at[length] != '\r') length++;
  *line = take(rest, length);
  if (rest->length) take(rest, rest->length > 1 && rest->at[0] == '\r' && rest->at[1] == '\n' ? 2 : 1);
  return true;
}

/* Length of the well-formed character at `at`; 0 if none (Unicode 15.0, table 3-7). */
static size_t character_length(const unsigned char *at, size_t left) {
  unsigned char first = at[0], min = 0x80, max = 0xBF;
  size_t length;
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF)
    length = 2;
  else if (first >= 0xE0 && first <= 0xEF)
    length = 3;
  else if (first >= 0xF0 && first <= 0xF4)
    length = 4;
  else
    return 0;
  if (length > left) return 0;
  if (first == 0xE0) min = 0xA0; /* else overlong */
  if (first == 0xED) max = 0x9F; /* else a surrogate */
  if (first == 0xF0) min = 0x90; /* else overlong */
  if (first == 0xF4) max = 0x8F; /* else above U+10FFFF */
  if (at[1] < min || at[1] > max) return 0;
  for (size_t i = 2; i < length; i++)
    if ((at[i] & 0xC0) != 0x80) return 0;
  return length;
}

size_t sbfi_utf8_check(const char *text, size_t length) {
  const unsigned char *at = (const unsigned char *)text;
  size_t i = 0;
  while (i < length) {
    uint64_t eight;
    /* Most text is ASCII: eight bytes at a time while no top bit is set. */
    while (length - i >= sizeof eight) {
      memcpy(&eight, at + i, sizeof eight);
      if (eight & UINT64_C(0x8080808080808080)) break;
      i += sizeof eight;
    }
    if (i == length) break;
    size_t step = character_length(at + i, length - i);
    if (step == 0) return i;
    i += step;
  }
  return length;
}

size_t sbfi_utf8_cut(const char *text, size_t length, size_t limit) {
  if (length <= limit) return length;
  while (limit && ((unsigned char)text[limit] & 0xC0) == 0x80) limit--;
  return limit;
}

bool sbfi_path_leaves_folder(const char *path) {
  if (path[0] == '/' || strchr(path, '\\') || (path[0] && path[1] == ':')) return true;
  int depth = 0;
  for (const char *step = path; *step;) {
    size_t length = strcspn(step, "/");
    if (length == 2 && memcmp(step, "..", 2) == 0)
      depth--;
    else if (length > 0 && !(length == 1 && *step == '.'))
      depth++;
    if (depth < 0) return true;
    step += length + (step[length] == '/');
  }
  return false;
}

void sbfi_text_init(sbfi_text *text, const sbf_allocator *allocator) {
  *text = (sbfi_text){.allocator = sbfi_allocator_or_default(allocator)};
}

void sbfi_text_free(sbfi_text *text) {
  sbfi_free(&text->allocator, text->at, text->capacity);
  *text = (sbfi_text){.allocator = text->allocator};
}

void sbfi_text_clear(sbfi_text *text) {
  text->length = 0;
  text->failed = false;
}

char *sbfi_text_reserve(sbfi_text *text, size_t more) {
  size_t needed, grown;
  if (text->failed) return NULL;
  if (text->at && more <= text->capacity - text->length) return text->at + text->length;
  bool fits = sbfi_add_size(text->length, more, &needed);
  if (!sbfi_add_size(text->capacity, text->capacity / 2 + 64, &grown) || grown < needed) grown = needed;
  char *at = fits ? text->allocator.reallocate(text->allocator.user, text->at, text->capacity, grown) : NULL;
  if (!at) {
    text->failed = true;
    return NULL;
  }
  text->at = at;
  text->capacity = grown;
  return at + text->length;
}

bool sbfi_text_append(sbfi_text *text, const void *bytes, size_t size) {
  char *destination = sbfi_text_reserve(text, size);
  if (!destination) return false;
  if (size) memcpy(destination, bytes, size);
  text->length += size;
  return true;
}

bool sbfi_text_string(sbfi_text *text, const char *string) {
  return sbfi_text_append(text, string, strlen(string));
}

bool sbfi_text_char(sbfi_text *text, char c) {
  return sbfi_text_append(text, &c, 1);
}

bool sbfi_text_repeat(sbfi_text *text, char c, size_t count) {
  char *destination = sbfi_text_reserve(text, count);
  if (!destination) return false;
  memset(destination, c, count);
  text->length += count;
  return true;
}

bool sbfi_text_i32(sbfi_text *text, int32_t value) {
  char *destination = sbfi_text_reserve(text, SBFI_INTEGER_TEXT_SIZE);
  if (destination) text->length += sbfi_print_i32(destination, value);
  return destination;
}

bool sbfi_text_u32(sbfi_text *text, uint32_t value) {
  return sbfi_text_u64(text, value);
}

bool sbfi_text_u64(sbfi_text *text, uint64_t value) {
  char *destination = sbfi_text_reserve(text, SBFI_INTEGER_TEXT_SIZE);
  if (destination) text->length += sbfi_print_u64(destination, value);
  return destination;
}

bool sbfi_text_f32(sbfi_text *text, float value) {
  char *destination = sbfi_text_reserve(text, SBFI_F32_TEXT_SIZE);
  size_t length = destination ? sbfi_print_f32(destination, value) : 0;
  text->length += length;
  return length > 0;
}
