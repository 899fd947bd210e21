#include "jansson_for_windows.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum json_kind { KIND_OBJECT, KIND_ARRAY, KIND_STRING, KIND_INTEGER, KIND_REAL, KIND_WORD } json_kind;

struct json_t {
  json_kind kind;
  json_int_t integer;
  double real;
  char *text;      /* of a string or a word */
  char **keys;     /* (count) of an object */
  json_t **values; /* (count) */
  size_t count;
};

static json_t *make(json_kind kind) {
  json_t *made = calloc(1, sizeof *made);
  if (made) made->kind = kind;
  return made;
}
static json_t *make_text(json_kind kind, const char *text) {
  json_t *made = text ? make(kind) : NULL;
  if (made && !(made->text = strdup(text))) {
    free(made);
    return NULL;
  }
  return made;
}

json_t *json_object(void) {
  return make(KIND_OBJECT);
}
json_t *json_array(void) {
  return make(KIND_ARRAY);
}
json_t *json_string(const char *text) {
  return make_text(KIND_STRING, text);
}
json_t *json_boolean(int value) {
  return make_text(KIND_WORD, value ? "true" : "false");
}
json_t *json_null(void) {
  return make_text(KIND_WORD, "null");
}
json_t *json_integer(json_int_t value) {
  json_t *made = make(KIND_INTEGER);
  if (made) made->integer = value;
  return made;
}
json_t *json_real(double value) {
  json_t *made = isfinite(value) ? make(KIND_REAL) : NULL;
  if (made) made->real = value;
  return made;
}

size_t json_object_size(const json_t *object) {
  return object && object->kind == KIND_OBJECT ? object->count : 0;
}

void json_decref(json_t *value) {
  if (!value) return;
  for (size_t i = 0; i < value->count; i++) {
    json_decref(value->values[i]);
    if (value->keys) free(value->keys[i]);
  }
  free(value->text);
  free(value->keys);
  free(value->values);
  free(value);
}

/* Reserves space for one more; false if memory runs out. */
static int grow(json_t *into) {
  json_t **values = realloc(into->values, (into->count + 1) * sizeof *values);
  if (!values) return 0;
  into->values = values;
  if (into->kind != KIND_OBJECT) return 1;
  char **keys = realloc(into->keys, (into->count + 1) * sizeof *keys);
  if (keys) into->keys = keys;
  return keys != NULL;
}

int json_array_append_new(json_t *array, json_t *value) {
  if (!array || !value || !grow(array)) {
    json_decref(value);
    return -1;
  }
  array->values[array->count++] = value;
  return 0;
}

int json_object_set_new(json_t *object, const char *key, json_t *value) {
  for (size_t i = 0; object && value && i < object->count; i++)
    if (strcmp(object->keys[i], key) == 0) {
      json_decref(object->values[i]);
      object->values[i] = value;
      return 0;
    }
  char *copy = object && value && grow(object) ? strdup(key) : NULL;
  if (!copy) {
    json_decref(value);
    return -1;
  }
  object->keys[object->count] = copy;
  object->values[object->count++] = value;
  return 0;
}

json_t *json_pack(const char *format, ...) {
  va_list arguments;
  json_t *object = json_object();
  va_start(arguments, format);
  for (const char *c = strstr(format, "s:s"); object && c; c = strstr(c + 3, "s:s")) {
    const char *key = va_arg(arguments, const char *), *text = va_arg(arguments, const char *);
    if (json_object_set_new(object, key, json_string(text)) == 0) continue;
    json_decref(object);
    object = NULL;
  }
  va_end(arguments);
  return object;
}

const char *json_object_key_at(const json_t *object, size_t n, json_t **value) {
  if (!object || n >= object->count) return NULL;
  *value = object->values[n];
  return object->keys[n];
}

/* ---- Writing ---- */

typedef struct text {
  char *at;
  size_t length, capacity;
  int failed;
} text;

static void add(text *t, const char *words, size_t length) {
  if (t->length + length + 1 > t->capacity) {
    size_t capacity = 2 * (t->length + length) + 256;
    char *grown = realloc(t->at, capacity);
    if (!grown) {
      t->failed = 1;
      return;
    }
    t->at = grown;
    t->capacity = capacity;
  }
  memcpy(t->at + t->length, words, length);
  t->length += length;
  t->at[t->length] = 0;
}
static void add_words(text *t, const char *words) {
  add(t, words, strlen(words));
}

static void add_string(text *t, const char *words) {
  static const char plain[] = "\"\\\b\f\n\r\t", escaped[] = "\"\\bfnrt";
  add(t, "\"", 1);
  for (const char *c = words; *c; c++) {
    const char *known = strchr(plain, *c);
    char code[8];
    if (known)
      snprintf(code, sizeof code, "\\%c", escaped[known - plain]);
    else if ((unsigned char)*c < 0x20)
      snprintf(code, sizeof code, "\\u%04X", (unsigned)(unsigned char)*c);
    else
      snprintf(code, sizeof code, "%c", *c);
    add_words(t, code);
  }
  add(t, "\"", 1);
}

/* With a point or an exponent, to avoid reading it as an integer; exponents without plus or leading zeros. */
static void add_real(text *t, double value, int precision) {
  char number[64];
  snprintf(number, sizeof number - 4, "%.*g", precision ? precision : 17, value);
  char *exponent = strchr(number, 'e');
  if (!exponent && !strchr(number, '.')) strcat(number, ".0");
  if (exponent) {
    char *from = ++exponent;
    if (*from == '-') exponent++;
    if (*from == '-' || *from == '+') from++;
    while (*from == '0' && from[1]) from++;
    memmove(exponent, from, strlen(from) + 1);
  }
  add_words(t, number);
}

static void add_line(text *t, size_t indent, int depth) {
  if (!indent) return;
  add(t, "\n", 1);
  for (size_t i = 0; i < indent * (size_t)depth; i++) add(t, " ", 1);
}

static void add_value(text *t, const json_t *value, size_t flags, int depth) {
  size_t indent = flags & 0x1F;
  char number[32];
  int is_object = value->kind == KIND_OBJECT;
  switch (value->kind) {
  case KIND_STRING:
    add_string(t, value->text);
    return;
  case KIND_WORD:
    add_words(t, value->text);
    return;
  case KIND_REAL:
    add_real(t, value->real, (int)(flags >> 11 & 0x1F));
    return;
  case KIND_INTEGER:
    snprintf(number, sizeof number, "%lld", value->integer);
    add_words(t, number);
    return;
  default:
    break;
  }
  add_words(t, is_object ? "{" : "[");
  for (size_t i = 0; i < value->count; i++) {
    if (i) add_words(t, indent ? "," : ", ");
    add_line(t, indent, depth + 1);
    if (is_object) {
      add_string(t, value->keys[i]);
      add_words(t, ": ");
    }
    add_value(t, value->values[i], flags, depth + 1);
  }
  if (value->count) add_line(t, indent, depth);
  add_words(t, is_object ? "}" : "]");
}

char *json_dumps(const json_t *value, size_t flags) {
  text t = {.at = NULL};
  if (!value) return NULL;
  add_value(&t, value, flags, 0);
  if (!t.failed) return t.at;
  free(t.at);
  return NULL;
}
