/* Godot's values, and calls by name.
 *
 * A gd_variant owns its value: the owner frees it with gd_free, or passes it to a function that takes
 * ownership. Names of methods, classes and keys are string literals. Values may be used on any thread, one
 * thread at a time. */
#ifndef SBFMT_GODOT_VARIANTS_H
#define SBFMT_GODOT_VARIANTS_H

#include "godot_api.h"

#include "sbrun/sbrun.h"

/* A value of any type; 24 bytes in single precision builds, which Godot ships. */
typedef struct gd_variant {
  uint64_t bytes[3];
} gd_variant;

/* Godot's layout, in single precision. */
typedef struct gd_transform {
  float basis[3][3]; /* rows */
  sbf_vec3 origin;
} gd_transform;
typedef struct gd_color {
  float r, g, b, a;
} gd_color;
typedef struct gd_aabb {
  sbf_vec3 position, size;
} gd_aabb;
typedef struct gd_rect {
  float x, y, width, height;
} gd_rect;

/* ---- Making ---- */

gd_variant gd_nil(void);
gd_variant gd_bool(bool value);
gd_variant gd_int(int64_t value);
gd_variant gd_float(double value);
gd_variant gd_string(const char *utf8);
gd_variant gd_name(const char *literal);
gd_variant gd_vector3(sbf_vec3 value);
gd_variant gd_transform_value(gd_transform value);
gd_variant gd_color_value(gd_color value);
gd_variant gd_aabb_value(gd_aabb value);
gd_variant gd_object(GDExtensionObjectPtr object); /* NULL: null */
gd_variant gd_copy(const gd_variant *value);
/* Default value of a type, such as an empty array. */
gd_variant gd_empty(GDExtensionVariantType type);
void gd_free(gd_variant *value);
void gd_assign(gd_variant *to, gd_variant value); /* takes ownership of `value`, frees the old one */

/* ---- Reading ---- */

GDExtensionVariantType gd_type(const gd_variant *value);
bool gd_as_bool(const gd_variant *value);
int64_t gd_as_int(const gd_variant *value);
double gd_as_float(const gd_variant *value);
sbf_vec3 gd_as_vector3(const gd_variant *value);
gd_transform gd_as_transform(const gd_variant *value);
GDExtensionObjectPtr gd_as_object(const gd_variant *value);
uint64_t gd_as_rid(const gd_variant *value);
/* Copies a string, truncated to `size`; returns its length in bytes. */
size_t gd_as_text(const gd_variant *value, char *text, size_t size);
/* The same for values that are freed after reading. */
bool gd_take_bool(gd_variant value);
int64_t gd_take_int(gd_variant value);
double gd_take_float(gd_variant value);
sbf_vec3 gd_take_vector3(gd_variant value);
gd_rect gd_take_rect(gd_variant value);

/* Item of an array or a dictionary; nil: none. */
gd_variant gd_at(const gd_variant *array, int64_t index);
gd_variant gd_key(const gd_variant *dictionary, const char *literal);
void gd_put(const gd_variant *array, int64_t index, gd_variant value); /* takes ownership of `value` */
/* Sets a key of a dictionary; takes ownership of `value`. */
void gd_set_key(const gd_variant *dictionary, const char *literal, gd_variant value);
int64_t gd_size(const gd_variant *array);

/* Writable items of a packed array; NULL if it is empty. */
uint8_t *gd_bytes(const gd_variant *packed);
int32_t *gd_int32s(const gd_variant *packed);
float *gd_floats(const gd_variant *packed);
gd_color *gd_colors(const gd_variant *packed);
sbf_vec2 *gd_vector2s(const gd_variant *packed);
sbf_vec3 *gd_vector3s(const gd_variant *packed);
/* An array of that type with `count` zeros. */
gd_variant gd_packed(GDExtensionVariantType type, int64_t count);

/* ---- Calling ---- */

/* Calls a method by its name and frees the arguments; on failure nil, and an error in Godot's log. */
gd_variant gd_call_with(const gd_variant *self, const char *method, uint32_t count, gd_variant *arguments);
#define GD_CALL(self, ...) GD_CALL_NAMED(self, __VA_ARGS__, gd_nil())
#define GD_CALL_NAMED(self, method, ...)                                                                     \
  gd_call_with((self), (method), (uint32_t)(sizeof((gd_variant[]){__VA_ARGS__}) / sizeof(gd_variant)) - 1,   \
      (gd_variant[]){__VA_ARGS__})
/* Calls without using the result. */
#define GD_DO(self, ...)                                                                                     \
  do {                                                                                                       \
    gd_variant gd_answer = GD_CALL(self, __VA_ARGS__);                                                       \
    gd_free(&gd_answer);                                                                                     \
  } while (0)

/* A new object of an engine class, and an engine singleton. */
gd_variant gd_new(const char *class_name);
gd_variant gd_singleton(const char *name);

/* A StringName of a literal: shared, kept until gd_free_names. */
GDExtensionConstStringNamePtr gd_string_name(const char *literal);
void gd_free_names(void);
/* Whether a StringName equals that text. */
bool gd_is_name(GDExtensionConstStringNamePtr name, const char *literal);

/* Logs an error with advice in Godot's log. */
void gd_error(const char *message);
void gd_warning(const char *message);

#endif
