/* JSON (RFC 8259) as a tree. The text is untrusted. */
#ifndef SBFI_JSON_H
#define SBFI_JSON_H

#include "base/memory.h"
#include "base/text.h"

typedef enum sbfi_json_type {
  SBFI_JSON_NULL,
  SBFI_JSON_FALSE,
  SBFI_JSON_TRUE,
  SBFI_JSON_NUMBER,
  SBFI_JSON_STRING,
  SBFI_JSON_ARRAY,
  SBFI_JSON_OBJECT
} sbfi_json_type;

typedef struct sbfi_json sbfi_json;
struct sbfi_json {
  sbfi_json_type type;
  uint32_t count;         /* of an array's or object's values */
  size_t offset;          /* in the text */
  sbfi_span text;         /* of a number as written; of a string without escapes, followed by NUL */
  const sbfi_json *items; /* (count) values */
  const sbfi_span *names; /* (count) of an object's values, each followed by NUL and unique */
};

/* Parses `text` into memory of `arena`. False if it is not JSON or memory runs out; `*error_offset` is then
 * the offset of the first fault, and `*reason` says what is wrong: sbfi_json_no_memory is one reason. Limits:
 * 64 nested values; no NUL inside strings. */
extern const char sbfi_json_no_memory[];
bool sbfi_json_parse(const char *text, size_t length, sbfi_arena *arena, const sbfi_json **root,
    size_t *error_offset, const char **reason);

/* Value of a member, or NULL. `object` may be NULL or no object. */
const sbfi_json *sbfi_json_get(const sbfi_json *object, const char *name);
/* Item of an array, or NULL. `array` may be NULL or no array. */
const sbfi_json *sbfi_json_at(const sbfi_json *array, uint32_t index);
/* Whole number from 0 to 2^32 - 1; false if `value` is none. `value` may be NULL. */
bool sbfi_json_u32(const sbfi_json *value, uint32_t *number);
bool sbfi_json_is_string(const sbfi_json *value, const char *text);

#endif
