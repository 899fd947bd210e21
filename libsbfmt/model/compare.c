/* Equality of two assets: one walk over both along the schema tables. */
#include <stdio.h>

#include "model/path.h"
#include "sbfmt/asset.h"

typedef struct comparison {
  char *path; /* receives where they differ; NULL: not wanted */
  size_t path_size;
} comparison;

static bool differ(const comparison *c, const sbfi_path *path, const sbfi_field *field) {
  if (c->path) sbfi_path_write(path, field, c->path, c->path_size);
  return false;
}

static bool equal_lists(
    const comparison *c, const sbfi_path *path, const sbfi_field *field, const void *a, const void *b) {
  sbfi_list la = sbfi_get_list(a, field), lb = sbfi_get_list(b, field);
  size_t item_size = sbfi_item_size(field);
  uint32_t count = la.count < lb.count ? la.count : lb.count, i = 0;
  if (la.count == lb.count && (count == 0 || memcmp(la.at, lb.at, count * item_size) == 0)) return true;
  differ(c, path, field);
  while (i < count &&
         memcmp((const char *)la.at + i * item_size, (const char *)lb.at + i * item_size, item_size) == 0)
    i++;
  if (c->path) {
    size_t length = strlen(c->path);
    snprintf(c->path + length, c->path_size - length, "[%u]", i);
  }
  return false;
}

static bool equal_elements(
    const comparison *c, const sbfi_element *element, const void *a, const void *b, const sbfi_path *path);

static bool equal_children(
    const comparison *c, const sbfi_path *path, const sbfi_field *field, const void *a, const void *b) {
  sbfi_list la = sbfi_get_list(a, field), lb = sbfi_get_list(b, field);
  size_t size = field->element->struct_size;
  if (la.count != lb.count) return differ(c, path, field);
  for (uint32_t i = 0; i < la.count; i++) {
    const char *child_a = (const char *)la.at + i * size, *child_b = (const char *)lb.at + i * size;
    const sbfi_path step = {path, field, child_a, i};
    if (!equal_elements(c, field->element, child_a, child_b, &step)) return false;
  }
  return true;
}

static bool equal_fields(
    const comparison *c, const sbfi_field *field, const void *a, const void *b, const sbfi_path *path) {
  const char *place_a = (const char *)a + field->offset, *place_b = (const char *)b + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    return *(const bool *)place_a == *(const bool *)place_b || differ(c, path, field);
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_ENUM:
  case SBFI_REF:
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    return memcmp(place_a, place_b, field->width * sizeof(float)) == 0 || differ(c, path, field);
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return strcmp(sbfi_get_pointer(a, field), sbfi_get_pointer(b, field)) == 0 || differ(c, path, field);
  case SBFI_LIST:
    return equal_lists(c, path, field, a, b);
  case SBFI_ONE: {
    const sbfi_path step = {path, field, place_a, 0};
    return equal_elements(c, field->element, place_a, place_b, &step);
  }
  case SBFI_OPTIONAL: {
    const void *child_a = sbfi_get_pointer(a, field), *child_b = sbfi_get_pointer(b, field);
    const sbfi_path step = {path, field, child_a, 0};
    if (!child_a || !child_b) return child_a == child_b || differ(c, path, field);
    return equal_elements(c, field->element, child_a, child_b, &step);
  }
  case SBFI_MANY:
    return equal_children(c, path, field, a, b);
  }
  return true;
}

static bool equal_elements(
    const comparison *c, const sbfi_element *element, const void *a, const void *b, const sbfi_path *path) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    if (!field->volatile_ && !equal_fields(c, field, a, b, path)) return false;
  }
  return true;
}

bool sbf_asset_equal(const sbf_asset *a, const sbf_asset *b, char *path, size_t path_size) {
  const comparison c = {path_size ? path : NULL, path_size};
  if (c.path) path[0] = 0;
  return equal_elements(&c, &sbfi_asset_element, a, b, NULL);
}
