#include "gltf/json.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"

enum { MAX_DEPTH = 64 };
const char sbfi_json_no_memory[] = "no memory for the document, or more than the limit";

typedef struct parser {
  const char *text;
  size_t length, at;
  sbfi_arena *arena;
  sbfi_array values, names; /* of all arrays and objects that are open: sbfi_json, sbfi_span */
  uint32_t depth;
  const char *reason; /* NULL: no fault so far */
} parser;

static bool fail(parser *p, const char *reason) {
  if (!p->reason) p->reason = reason;
  return false;
}

static void skip_space(parser *p) {
  while (p->at < p->length && sbfi_is_space(p->text[p->at])) p->at++;
}

static bool next_is(const parser *p, char c) {
  return p->at < p->length && p->text[p->at] == c;
}

static bool expect(parser *p, char c, const char *reason) {
  if (!next_is(p, c)) return fail(p, reason);
  p->at++;
  return true;
}

static size_t skip_digits(parser *p) {
  size_t from = p->at;
  while (p->at < p->length && p->text[p->at] >= '0' && p->text[p->at] <= '9') p->at++;
  return p->at - from;
}

static bool parse_number(parser *p, sbfi_json *value) {
  size_t from = p->at;
  if (next_is(p, '-')) p->at++;
  bool leads_with_zero = next_is(p, '0');
  size_t digits = skip_digits(p);
  if (!digits || (leads_with_zero && digits > 1)) return fail(p, "a number is malformed");
  if (next_is(p, '.')) {
    p->at++;
    if (!skip_digits(p)) return fail(p, "a number ends with its point");
  }
  if (next_is(p, 'e') || next_is(p, 'E')) {
    p->at++;
    if (next_is(p, '+') || next_is(p, '-')) p->at++;
    if (!skip_digits(p)) return fail(p, "a number has no digits in its exponent");
  }
  value->type = SBFI_JSON_NUMBER;
  value->text = (sbfi_span){p->text + from, p->at - from};
  return true;
}

static bool parse_unit(parser *p, uint32_t *unit) {
  *unit = 0;
  for (int i = 0; i < 4; i++, p->at++) {
    char c = p->at < p->length ? p->text[p->at] : 0;
    uint32_t digit = c >= '0' && c <= '9'   ? (uint32_t)(c - '0')
                     : c >= 'a' && c <= 'f' ? (uint32_t)(c - 'a' + 10)
                     : c >= 'A' && c <= 'F' ? (uint32_t)(c - 'A' + 10)
                                            : 16;
    if (digit == 16) return fail(p, "\\u needs four hexadecimal digits");
    *unit = *unit << 4 | digit;
  }
  return true;
}

static size_t put_utf8(char *to, uint32_t code) {
  if (code < 0x80) return to[0] = (char)code, 1;
  if (code < 0x800) return to[0] = (char)(0xc0 | code >> 6), to[1] = (char)(0x80 | (code & 0x3f)), 2;
  size_t size = code < 0x10000 ? 3 : 4;
  to[0] = (char)(size == 3 ? 0xe0 | code >> 12 : 0xf0 | code >> 18);
  for (size_t i = 1; i < size; i++) to[i] = (char)(0x80 | (code >> (6 * (size - 1 - i)) & 0x3f));
  return size;
}

/* After the backslash. Writes at most as many bytes as the escape has. */
static bool parse_escape(parser *p, char **to) {
  static const char from[] = "\"\\/bfnrt", values[] = "\"\\/\b\f\n\r\t";
  char c = p->at < p->length ? p->text[p->at] : 0;
  const char *found = c ? strchr(from, c) : NULL;
  uint32_t code, low;
  if (c && found) {
    p->at++;
    *(*to)++ = values[found - from];
    return true;
  }
  if (c != 'u') return fail(p, "a string has an unknown escape");
  p->at++;
  if (!parse_unit(p, &code)) return false;
  if (code >= 0xd800 && code < 0xdc00) {
    if (!expect(p, '\\', "half of a surrogate pair is missing") ||
        !expect(p, 'u', "half of a surrogate pair is missing") || !parse_unit(p, &low))
      return false;
    if (low < 0xdc00 || low > 0xdfff) return fail(p, "half of a surrogate pair is missing");
    code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
  } else if (code >= 0xdc00 && code < 0xe000) {
    return fail(p, "half of a surrogate pair is missing");
  }
  if (!code) return fail(p, "a string holds a character NUL");
  *to += put_utf8(*to, code);
  return true;
}

static bool parse_string(parser *p, sbfi_span *string) {
  size_t from = ++p->at;
  while (p->at < p->length && p->text[p->at] != '"') p->at += p->text[p->at] == '\\' ? 2 : 1;
  if (p->at >= p->length) return fail(p, "a string does not end");
  size_t end = p->at;
  char *memory = sbfi_arena_allocate(p->arena, end - from + 1, 1), *to = memory;
  if (!memory) return fail(p, sbfi_json_no_memory);
  for (p->at = from; p->at < end;) {
    unsigned char c = (unsigned char)p->text[p->at++];
    if (c < 0x20) return fail(p, "a string holds a control character");
    if (c != '\\')
      *to++ = (char)c;
    else if (!parse_escape(p, &to))
      return false;
  }
  p->at = end + 1;
  *string = (sbfi_span){memory, (size_t)(to - memory)};
  *to = 0;
  if (sbfi_utf8_check(memory, string->length) != string->length)
    return fail(p, "a string is not valid UTF-8");
  return true;
}

static bool parse_value(parser *p, sbfi_json *value);

static int compare_names(const void *a, const void *b) {
  return strcmp(((const sbfi_span *)a)->at, ((const sbfi_span *)b)->at);
}

/* Linear in the number of members for small objects, which all of glTF's are. */
static bool names_are_unique(parser *p, const sbfi_span *names, uint32_t count) {
  for (uint32_t i = 1; i < count && count <= 32; i++)
    for (uint32_t k = 0; k < i; k++)
      if (strcmp(names[i].at, names[k].at) == 0) return fail(p, "an object has two members of one name");
  if (count <= 32) return true;
  sbfi_span *sorted = sbfi_arena_copy(p->arena, names, count, sizeof *names);
  if (!sorted) return fail(p, sbfi_json_no_memory);
  qsort(sorted, count, sizeof *sorted, compare_names);
  for (uint32_t i = 1; i < count; i++)
    if (strcmp(sorted[i].at, sorted[i - 1].at) == 0) return fail(p, "an object has two members of one name");
  return true;
}

static bool parse_member(parser *p, bool in_object) {
  sbfi_json value = {0};
  sbfi_span name = {0};
  skip_space(p);
  if (in_object) {
    if (!next_is(p, '"')) return fail(p, "a member of an object has no name");
    if (!parse_string(p, &name)) return false;
    skip_space(p);
    if (!expect(p, ':', "a colon is missing behind a name")) return false;
  }
  if (!parse_value(p, &value)) return false;
  if (!sbfi_array_append(&p->values, &value, 1) || !sbfi_array_append(&p->names, &name, 1))
    return fail(p, sbfi_json_no_memory);
  return true;
}

static bool parse_children(parser *p, sbfi_json *value) {
  bool in_object = p->text[p->at++] == '{';
  char end = in_object ? '}' : ']';
  size_t first = p->values.count;
  value->type = in_object ? SBFI_JSON_OBJECT : SBFI_JSON_ARRAY;
  if (++p->depth > MAX_DEPTH) return fail(p, "values lie inside each other deeper than 64");
  skip_space(p);
  while (!next_is(p, end)) {
    if (p->values.count > first && !expect(p, ',', "a comma is missing")) return false;
    if (!parse_member(p, in_object)) return false;
    skip_space(p);
    if (p->at >= p->length) return fail(p, "the document ends too early");
  }
  p->at++;
  p->depth--;
  value->count = (uint32_t)(p->values.count - first);
  if (!value->count) return true;
  const sbfi_json *values = (const sbfi_json *)p->values.at + first;
  const sbfi_span *names = (const sbfi_span *)p->names.at + first;
  value->items = sbfi_arena_copy(p->arena, values, value->count, sizeof *values);
  if (in_object) value->names = sbfi_arena_copy(p->arena, names, value->count, sizeof *names);
  p->values.count = p->names.count = first;
  if (!value->items || (in_object && !value->names)) return fail(p, sbfi_json_no_memory);
  return !in_object || names_are_unique(p, value->names, value->count);
}

static bool parse_word(parser *p, sbfi_json *value) {
  static const char *const words[] = {"null", "false", "true"};
  for (int i = 0; i < 3; i++) {
    size_t length = strlen(words[i]);
    if (p->length - p->at < length || memcmp(p->text + p->at, words[i], length) != 0) continue;
    value->type = (sbfi_json_type)(SBFI_JSON_NULL + i);
    p->at += length;
    return true;
  }
  return fail(p, "a value is missing or malformed");
}

static bool parse_value(parser *p, sbfi_json *value) {
  skip_space(p);
  value->offset = p->at;
  if (next_is(p, '{') || next_is(p, '[')) return parse_children(p, value);
  if (next_is(p, '"')) {
    value->type = SBFI_JSON_STRING;
    return parse_string(p, &value->text);
  }
  if (next_is(p, '-') || (p->at < p->length && p->text[p->at] >= '0' && p->text[p->at] <= '9'))
    return parse_number(p, value);
  return parse_word(p, value);
}

bool sbfi_json_parse(const char *text, size_t length, sbfi_arena *arena, const sbfi_json **root,
    size_t *error_offset, const char **reason) {
  parser p = {.text = text, .length = length, .arena = arena};
  sbfi_array_init(&p.values, &arena->allocator, sizeof(sbfi_json));
  sbfi_array_init(&p.names, &arena->allocator, sizeof(sbfi_span));
  sbfi_json *value = sbfi_arena_allocate(arena, 1, sizeof *value);
  *root = value;
  if (!value)
    fail(&p, sbfi_json_no_memory);
  else if (parse_value(&p, value)) {
    skip_space(&p);
    if (p.at < length) fail(&p, "something follows the document");
  }
  sbfi_array_free(&p.values);
  sbfi_array_free(&p.names);
  *error_offset = p.at < length ? p.at : length;
  *reason = p.reason;
  return !p.reason;
}

const sbfi_json *sbfi_json_get(const sbfi_json *object, const char *name) {
  if (!object || object->type != SBFI_JSON_OBJECT) return NULL;
  for (uint32_t i = 0; i < object->count; i++)
    if (strcmp(object->names[i].at, name) == 0) return &object->items[i];
  return NULL;
}

const sbfi_json *sbfi_json_at(const sbfi_json *array, uint32_t index) {
  return array && array->type == SBFI_JSON_ARRAY && index < array->count ? &array->items[index] : NULL;
}

bool sbfi_json_u32(const sbfi_json *value, uint32_t *number) {
  return value && value->type == SBFI_JSON_NUMBER &&
         sbfi_parse_u32(value->text.at, value->text.length, number) == SBFI_NUMBER_READ;
}

bool sbfi_json_is_string(const sbfi_json *value, const char *text) {
  return value && value->type == SBFI_JSON_STRING && strcmp(value->text.at, text) == 0;
}
