/* Compares two assets in one walk along the schema tables. */
#include "model/compare.h"

#include <stdio.h>

#include "model/element_path.h"
#include "sbfmt/asset.h"

typedef struct comparison {
  char *path; /* receives the path of the first difference; NULL: not needed */
  size_t path_size;
} comparison;

static bool differ(const comparison *c, const sbfi_element_path *path, const sbfi_field *field) {
  if (c->path) sbfi_element_path_print(path, field, c->path, c->path_size);
  return false;
}

static bool equal_lists(
    const comparison *c, const sbfi_element_path *path, const sbfi_field *field, const void *other) {
  sbfi_list la = sbfi_get_list(path->object, field), lb = sbfi_get_list(other, field);
  size_t item_size = sbfi_item_size(field);
  uint32_t count = la.count < lb.count ? la.count : lb.count, i = 0;
  if (la.count == lb.count && (count == 0 || memcmp(la.at, lb.at, count * item_size) == 0)) return true;
  differ(c, path, field);
  while (i < count &&
         memcmp((const char *)la.at + i * item_size, (const char *)lb.at + i * item_size, item_size) == 0)
    i++;
  if (c->path) {
    size_t length = strlen(c->path);
    snprintf(c->path + length, c->path_size - length, " item %u", i);
  }
  return false;
}

static bool equal_objects(const comparison *c, const sbfi_element_path *path, const void *other);

static bool equal_children(
    const comparison *c, const sbfi_element_path *path, const sbfi_field *field, const void *other) {
  uint32_t count = sbfi_child_count(path->object, field);
  if (count != sbfi_child_count(other, field)) return differ(c, path, field);
  const sbfi_element_path there = {.element = path->element, .object = other};
  for (uint32_t i = 0; i < count; i++) {
    sbfi_element_path child = sbfi_element_path_child(path, field, i);
    if (!equal_objects(c, &child, sbfi_element_path_child(&there, field, i).object)) return false;
  }
  return true;
}

static bool equal_fields(
    const comparison *c, const sbfi_element_path *path, const sbfi_field *field, const void *other) {
  const char *at_a = (const char *)path->object + field->offset, *at_b = (const char *)other + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    return *(const bool *)at_a == *(const bool *)at_b || differ(c, path, field);
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_ENUM:
  case SBFI_REF:
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    return memcmp(at_a, at_b, field->width * sizeof(float)) == 0 || differ(c, path, field);
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return strcmp(sbfi_get_pointer(path->object, field), sbfi_get_pointer(other, field)) == 0 ||
           differ(c, path, field);
  case SBFI_LIST:
    return equal_lists(c, path, field, other);
  case SBFI_ONE:
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    return equal_children(c, path, field, other);
  }
  return true;
}

static bool equal_objects(const comparison *c, const sbfi_element_path *path, const void *other) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (!field->volatile_ && !equal_fields(c, path, field, other)) return false;
  }
  return true;
}

bool sbfi_objects_equal(const sbfi_element *element, const void *a, const void *b) {
  const comparison c = {NULL, 0};
  const sbfi_element_path path = {.element = element, .object = a};
  return equal_objects(&c, &path, b);
}

bool sbf_asset_equal(const sbf_asset *a, const sbf_asset *b, char *path, size_t path_size) {
  const comparison c = {path_size ? path : NULL, path_size};
  if (c.path) path[0] = 0;
  const sbfi_element_path root = sbfi_element_path_root(a);
  return equal_objects(&c, &root, b);
}
