#include "model/defaults.h"

static bool object_is_default(const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count; i++)
    if (!sbfi_field_is_default(path, &path->element->fields[i])) return false;
  return true;
}

/* Value required by the parent, or the schema's default. */
static int32_t expected_integer(const sbfi_element_path *path, const sbfi_field *field) {
  const sbfi_field *holder = path->field;
  bool fixed = holder && holder->fixed.name && strcmp(holder->fixed.name, field->name) == 0;
  return fixed ? holder->fixed.value : (int32_t)field->initial.integer;
}

bool sbfi_field_is_default(const sbfi_element_path *path, const sbfi_field *field) {
  const char *at = (const char *)path->object + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    return *(const bool *)at == (field->initial.integer != 0);
  case SBFI_INT:
  case SBFI_UINT:
  case SBFI_ENUM:
    return sbfi_get_integer(path->object, field) == expected_integer(path, field);
  case SBFI_REF:
    return sbfi_get_integer(path->object, field) == SBF_NONE;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    return memcmp(at, field->initial.scalars, field->width * sizeof(float)) == 0;
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return strcmp(sbfi_get_pointer(path->object, field), field->initial.text) == 0;
  case SBFI_LIST:
    return sbfi_get_list(path->object, field).count == 0;
  case SBFI_ONE: {
    sbfi_element_path child = sbfi_element_path_child(path, field, 0);
    return object_is_default(&child);
  }
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    return sbfi_child_count(path->object, field) == 0;
  }
  return false;
}
