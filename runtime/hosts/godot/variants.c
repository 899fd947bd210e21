#include "variants.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* ---- Names ---- */

/* StringNames by the address of their literal; equal literals at several addresses are several entries. */
enum { NAME_CAPACITY = 1024 };
typedef struct kept_name {
  const char *literal;
  uint64_t name; /* Godot's StringName: one pointer */
} kept_name;
static kept_name names[NAME_CAPACITY];

static atomic_flag names_lock = ATOMIC_FLAG_INIT; /* resources are loaded by several threads */

GDExtensionConstStringNamePtr gd_string_name(const char *literal) {
  while (atomic_flag_test_and_set_explicit(&names_lock, memory_order_acquire))
    ;
  uint32_t at = (uint32_t)(((uintptr_t)literal * 2654435761u) >> 4) % NAME_CAPACITY;
  while (names[at].literal && names[at].literal != literal) at = (at + 1) % NAME_CAPACITY;
  if (!names[at].literal) {
    gd.string_name_new_with_latin1_chars(&names[at].name, literal, false);
    names[at].literal = literal;
  }
  atomic_flag_clear_explicit(&names_lock, memory_order_release);
  return &names[at].name;
}

void gd_free_names(void) {
  GDExtensionPtrDestructor destroy = gd.variant_get_ptr_destructor(GDEXTENSION_VARIANT_TYPE_STRING_NAME);
  for (uint32_t i = 0; i < NAME_CAPACITY; i++)
    if (names[i].literal) destroy(&names[i].name);
  memset(names, 0, sizeof names);
}

bool gd_is_name(GDExtensionConstStringNamePtr name, const char *literal) {
  return !memcmp(name, gd_string_name(literal), sizeof(uint64_t));
}

/* ---- Making ---- */

/* Conversion functions between variants and raw values, one for each type. */
static gd_variant make(GDExtensionVariantType type, const void *raw) {
  static GDExtensionVariantFromTypeConstructorFunc makers[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX];
  gd_variant made;
  if (!makers[type]) makers[type] = gd.get_variant_from_type_constructor(type);
  makers[type](&made, (GDExtensionTypePtr)(uintptr_t)raw);
  return made;
}

static void read_into(GDExtensionVariantType type, const gd_variant *value, void *raw) {
  static GDExtensionTypeFromVariantConstructorFunc readers[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX];
  if (!readers[type]) readers[type] = gd.get_variant_to_type_constructor(type);
  readers[type](raw, (GDExtensionVariantPtr)(uintptr_t)value);
}

static void destroy_raw(GDExtensionVariantType type, void *raw) {
  gd.variant_get_ptr_destructor(type)(raw);
}

gd_variant gd_nil(void) {
  gd_variant made;
  gd.variant_new_nil(&made);
  return made;
}

gd_variant gd_bool(bool value) {
  GDExtensionBool raw = value;
  return make(GDEXTENSION_VARIANT_TYPE_BOOL, &raw);
}

gd_variant gd_int(int64_t value) {
  return make(GDEXTENSION_VARIANT_TYPE_INT, &value);
}

gd_variant gd_float(double value) {
  return make(GDEXTENSION_VARIANT_TYPE_FLOAT, &value);
}

gd_variant gd_string(const char *utf8) {
  uint64_t raw = 0;
  gd.string_new_with_utf8_chars(&raw, utf8);
  gd_variant made = make(GDEXTENSION_VARIANT_TYPE_STRING, &raw);
  destroy_raw(GDEXTENSION_VARIANT_TYPE_STRING, &raw);
  return made;
}

gd_variant gd_name(const char *literal) {
  return make(GDEXTENSION_VARIANT_TYPE_STRING_NAME, gd_string_name(literal));
}

gd_variant gd_vector3(sbf_vec3 value) {
  return make(GDEXTENSION_VARIANT_TYPE_VECTOR3, &value);
}

gd_variant gd_transform_value(gd_transform value) {
  return make(GDEXTENSION_VARIANT_TYPE_TRANSFORM3D, &value);
}

gd_variant gd_color_value(gd_color value) {
  return make(GDEXTENSION_VARIANT_TYPE_COLOR, &value);
}

gd_variant gd_aabb_value(gd_aabb value) {
  return make(GDEXTENSION_VARIANT_TYPE_AABB, &value);
}

gd_variant gd_object(GDExtensionObjectPtr object) {
  return make(GDEXTENSION_VARIANT_TYPE_OBJECT, &object);
}

gd_variant gd_copy(const gd_variant *value) {
  gd_variant made;
  gd.variant_new_copy(&made, value);
  return made;
}

gd_variant gd_empty(GDExtensionVariantType type) {
  gd_variant made;
  GDExtensionCallError error;
  gd.variant_construct(type, &made, NULL, 0, &error);
  return made;
}

void gd_free(gd_variant *value) {
  gd.variant_destroy(value);
  gd.variant_new_nil(value);
}

void gd_assign(gd_variant *to, gd_variant value) {
  gd.variant_destroy(to);
  *to = value;
}

/* ---- Reading ---- */

GDExtensionVariantType gd_type(const gd_variant *value) {
  return gd.variant_get_type(value);
}

bool gd_as_bool(const gd_variant *value) {
  GDExtensionBool raw = 0;
  read_into(GDEXTENSION_VARIANT_TYPE_BOOL, value, &raw);
  return raw != 0;
}

int64_t gd_as_int(const gd_variant *value) {
  int64_t raw = 0;
  read_into(GDEXTENSION_VARIANT_TYPE_INT, value, &raw);
  return raw;
}

double gd_as_float(const gd_variant *value) {
  double raw = 0;
  read_into(GDEXTENSION_VARIANT_TYPE_FLOAT, value, &raw);
  return raw;
}

sbf_vec3 gd_as_vector3(const gd_variant *value) {
  sbf_vec3 raw = {0, 0, 0};
  read_into(GDEXTENSION_VARIANT_TYPE_VECTOR3, value, &raw);
  return raw;
}

gd_transform gd_as_transform(const gd_variant *value) {
  gd_transform raw;
  read_into(GDEXTENSION_VARIANT_TYPE_TRANSFORM3D, value, &raw);
  return raw;
}

GDExtensionObjectPtr gd_as_object(const gd_variant *value) {
  GDExtensionObjectPtr raw = NULL;
  if (gd_type(value) == GDEXTENSION_VARIANT_TYPE_OBJECT)
    read_into(GDEXTENSION_VARIANT_TYPE_OBJECT, value, &raw);
  return raw;
}

uint64_t gd_as_rid(const gd_variant *value) {
  uint64_t raw = 0;
  if (gd_type(value) == GDEXTENSION_VARIANT_TYPE_RID) read_into(GDEXTENSION_VARIANT_TYPE_RID, value, &raw);
  return raw;
}

size_t gd_as_text(const gd_variant *value, char *text, size_t size) {
  uint64_t raw = 0;
  read_into(GDEXTENSION_VARIANT_TYPE_STRING, value, &raw);
  GDExtensionInt length = gd.string_to_utf8_chars(&raw, text, (GDExtensionInt)size - 1);
  destroy_raw(GDEXTENSION_VARIANT_TYPE_STRING, &raw);
  text[length < (GDExtensionInt)size ? length : (GDExtensionInt)size - 1] = 0;
  return (size_t)length;
}

bool gd_take_bool(gd_variant value) {
  bool read = gd_as_bool(&value);
  gd_free(&value);
  return read;
}

int64_t gd_take_int(gd_variant value) {
  int64_t read = gd_as_int(&value);
  gd_free(&value);
  return read;
}

double gd_take_float(gd_variant value) {
  double read = gd_as_float(&value);
  gd_free(&value);
  return read;
}

gd_rect gd_take_rect(gd_variant value) {
  gd_rect rect = {0, 0, 0, 0};
  if (gd_type(&value) == GDEXTENSION_VARIANT_TYPE_RECT2)
    read_into(GDEXTENSION_VARIANT_TYPE_RECT2, &value, &rect);
  gd_free(&value);
  return rect;
}

sbf_vec3 gd_take_vector3(gd_variant value) {
  sbf_vec3 read = gd_as_vector3(&value);
  gd_free(&value);
  return read;
}

/* ---- Arrays ---- */

gd_variant gd_at(const gd_variant *array, int64_t index) {
  gd_variant found;
  GDExtensionBool valid, outside;
  gd.variant_get_indexed(array, index, &found, &valid, &outside);
  return found;
}

gd_variant gd_key(const gd_variant *dictionary, const char *literal) {
  gd_variant found, key = gd_name(literal);
  GDExtensionBool valid;
  gd.variant_get_keyed(dictionary, &key, &found, &valid);
  gd_free(&key);
  return found;
}

void gd_set_key(const gd_variant *dictionary, const char *literal, gd_variant value) {
  gd_variant key = gd_string(literal);
  GDExtensionBool valid;
  gd.variant_set_keyed((GDExtensionVariantPtr)(uintptr_t)dictionary, &key, &value, &valid);
  gd_free(&key);
  gd_free(&value);
}

void gd_put(const gd_variant *array, int64_t index, gd_variant value) {
  GDExtensionBool valid, outside;
  gd.variant_set_indexed((GDExtensionVariantPtr)(uintptr_t)array, index, &value, &valid, &outside);
  gd_free(&value);
}

int64_t gd_size(const gd_variant *array) {
  return gd_take_int(GD_CALL(array, "size"));
}

static void *inside(GDExtensionVariantType type, const gd_variant *packed) {
  return gd.variant_get_ptr_internal_getter(type)((GDExtensionVariantPtr)(uintptr_t)packed);
}

uint8_t *gd_bytes(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return gd.packed_byte_array_operator_index(inside(GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY, packed), 0);
}

int32_t *gd_int32s(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return gd.packed_int32_array_operator_index(inside(GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY, packed), 0);
}

float *gd_floats(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return gd.packed_float32_array_operator_index(
      inside(GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY, packed), 0);
}

gd_color *gd_colors(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return (gd_color *)gd.packed_color_array_operator_index(
      inside(GDEXTENSION_VARIANT_TYPE_PACKED_COLOR_ARRAY, packed), 0);
}

sbf_vec2 *gd_vector2s(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return (sbf_vec2 *)gd.packed_vector2_array_operator_index(
      inside(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY, packed), 0);
}

sbf_vec3 *gd_vector3s(const gd_variant *packed) {
  if (!gd_size(packed)) return NULL;
  return (sbf_vec3 *)gd.packed_vector3_array_operator_index(
      inside(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, packed), 0);
}

gd_variant gd_packed(GDExtensionVariantType type, int64_t count) {
  gd_variant made = gd_empty(type);
  GD_DO(&made, "resize", gd_int(count));
  return made;
}

/* ---- Calling ---- */

gd_variant gd_call_with(const gd_variant *self, const char *method, uint32_t count, gd_variant *arguments) {
  enum { MAX = 8 };
  GDExtensionConstVariantPtr given[MAX] = {0};
  GDExtensionCallError error;
  gd_variant answer;
  for (uint32_t i = 0; i < count && i < MAX; i++) given[i] = &arguments[i];
  gd.variant_call(
      (GDExtensionVariantPtr)(uintptr_t)self, gd_string_name(method), given, count, &answer, &error);
  for (uint32_t i = 0; i <= count; i++) gd_free(&arguments[i]); /* and the terminating nil */
  if (error.error == GDEXTENSION_CALL_OK) return answer;
  gd_free(&answer);
  gd.print_error_with_message(
      "a call of Godot's failed", method, "gd_call_with", "sbfmt", (int32_t)error.error, false);
  return answer;
}

gd_variant gd_singleton(const char *name) {
  return gd_object(gd.global_get_singleton(gd_string_name(name)));
}

gd_variant gd_new(const char *class_name) {
  gd_variant classes = gd_singleton("ClassDB");
  gd_variant made = GD_CALL(&classes, "instantiate", gd_name(class_name));
  gd_free(&classes);
  return made;
}

void gd_error(const char *message) {
  gd.print_error_with_message("sbfmt", message, "", "", 0, true);
}

void gd_warning(const char *message) {
  gd.print_warning_with_message("sbfmt", message, "", "", 0, true);
}
