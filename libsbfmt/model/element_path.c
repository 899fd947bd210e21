#include "model/element_path.h"

#include <stdio.h>

sbfi_element_path sbfi_element_path_root(const sbf_asset *asset) {
  return (sbfi_element_path){.element = &sbfi_asset_element, .object = asset};
}

uint32_t sbfi_child_count(const void *object, const sbfi_field *field) {
  switch (field->type) {
  case SBFI_ONE:
    return 1;
  case SBFI_OPTIONAL:
    return sbfi_get_pointer(object, field) != NULL;
  case SBFI_MANY:
    return sbfi_get_list(object, field).count;
  default:
    return 0;
  }
}

sbfi_element_path sbfi_element_path_child(
    const sbfi_element_path *up, const sbfi_field *field, uint32_t index) {
  sbfi_element_path child = {.up = up, .element = field->element, .field = field, .index = index};
  if (field->type == SBFI_ONE)
    child.object = (const char *)up->object + field->offset;
  else if (field->type == SBFI_OPTIONAL)
    child.object = sbfi_get_pointer(up->object, field);
  else
    child.object =
        (const char *)sbfi_get_list(up->object, field).at + (size_t)index * field->element->struct_size;
  return child;
}

/* XPath numbers siblings of equal names; if the child defines the name, only some siblings share it. */
static uint32_t sibling_number(const sbfi_element_path *path) {
  const sbfi_field *field = path->field;
  if (!field->tag.suffix) return path->index + 1;
  const sbfi_field *by = sbfi_element_field(field->element, field->tag.by);
  uint32_t number = 1;
  for (uint32_t i = 0; i < path->index; i++)
    number += sbfi_get_integer(sbfi_element_path_child(path->up, field, i).object, by) ==
              sbfi_get_integer(path->object, by);
  return number;
}

typedef struct path_text {
  char *at;
  size_t size, length;
} path_text;

static void append(path_text *path, const char *separator, const char *name) {
  int added = snprintf(path->at + path->length, path->size - path->length, "%s%s", separator, name);
  if (added > 0) path->length += (size_t)added;
  if (path->length >= path->size) path->length = path->size - 1;
}

static void append_step(path_text *path, const sbfi_element_path *location) {
  if (!location->up) {
    append(path, "/", location->element->xml);
    return;
  }
  append_step(path, location->up);
  if (location->field->tag.wrapper) append(path, "/", location->field->tag.wrapper);
  char name[128], number[16];
  append(path, "/", sbfi_child_xml_name(location->field, location->object, name, sizeof name));
  if (location->field->type != SBFI_MANY) return;
  snprintf(number, sizeof number, "[%u]", sibling_number(location));
  append(path, number, "");
}

void sbfi_element_path_print(
    const sbfi_element_path *location, const sbfi_field *field, char *path, size_t size) {
  path_text text = {path, size, 0};
  path[0] = 0;
  append_step(&text, location);
  if (!field) return;
  const char *name = field->tag.wrapper ? field->tag.wrapper : field->tag.xml ? field->tag.xml : field->name;
  append(&text, sbfi_field_is_attribute(field) ? "/@" : "/", name);
}

bool sbfi_field_is_attribute(const sbfi_field *field) {
  return field->type != SBFI_LIST && field->type != SBFI_TEXT && !field->element;
}

static const sbfi_element_path *path_above(const sbfi_element_path *path, int up) {
  while (path->up && up != 0) {
    path = path->up;
    up--; /* -1 never reaches 0: continues to the root */
  }
  return path;
}

sbfi_list sbfi_term_list(const sbfi_term *term, const sbfi_element_path *path) {
  const sbfi_field at = {.offset = term->value};
  return sbfi_get_list(path_above(path, term->up)->object, &at);
}

static uint64_t sum_of(sbfi_list list) {
  const uint32_t *items = list.at;
  uint64_t sum = 0;
  for (uint32_t i = 0; items && i < list.count; i++) sum += items[i];
  return sum;
}

bool sbfi_length_is_known(const sbfi_length *length, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < length->term_count; i++) {
    sbfi_list list = {NULL, 0};
    if (length->terms[i].kind == SBFI_TERM_SUM) list = sbfi_term_list(&length->terms[i], path);
    if (list.count && !list.at) return false;
  }
  return true;
}

uint64_t sbfi_length_value(const sbfi_length *length, const sbfi_element_path *path) {
  uint64_t value = 0;
  for (uint32_t i = 0; i < length->term_count; i++) {
    const sbfi_term *term = &length->terms[i];
    const sbfi_element_path *owner;
    switch (term->kind) {
    case SBFI_TERM_NUMBER:
      value += term->value;
      break;
    case SBFI_TERM_COUNT:
      value += sbfi_term_list(term, path).count;
      break;
    case SBFI_TERM_SUM:
      value += sum_of(sbfi_term_list(term, path));
      break;
    case SBFI_TERM_SIZE:
      owner = path_above(path, term->up);
      if (owner->element->size) value += sbfi_length_value(owner->element->size, owner);
      break;
    }
  }
  return value;
}
