/* The part of jansson that the program uses, since jansson is not packaged for Windows. Objects keep their
 * insertion order, and the text is byte for byte the same. Calls behave as in jansson's manual. */
#ifndef JANSSON_FOR_WINDOWS_H
#define JANSSON_FOR_WINDOWS_H

#include <stddef.h>

typedef struct json_t json_t;
typedef long long json_int_t;

#define JSON_INDENT(n) ((size_t)(n))
#define JSON_ENCODE_ANY ((size_t)0x200)
#define JSON_REAL_PRECISION(n) ((size_t)(n) << 11)

json_t *json_object(void);
json_t *json_array(void);
json_t *json_string(const char *text);
json_t *json_integer(json_int_t value);
json_t *json_real(double value); /* NULL if not finite */
json_t *json_boolean(int value);
json_t *json_null(void);
size_t json_object_size(const json_t *object); /* number of keys; 0 for NULL */
/* Both take ownership of the value. A value of NULL is a failure: not 0. */
int json_object_set_new(json_t *object, const char *key, json_t *value);
int json_array_append_new(json_t *array, json_t *value);
/* Only objects of strings: "{s:s, ...}". */
json_t *json_pack(const char *format, ...);
void json_decref(json_t *value);                     /* frees it: values are never shared */
char *json_dumps(const json_t *value, size_t flags); /* free with free(); NULL: out of memory */

/* The n-th key and value of an object; NULL beyond the last. */
const char *json_object_key_at(const json_t *object, size_t n, json_t **value);
#define json_object_foreach(object, key, value)                                                              \
  for (size_t json_at = 0; ((key) = json_object_key_at((object), json_at, &(value))) != NULL; json_at++)

#endif
