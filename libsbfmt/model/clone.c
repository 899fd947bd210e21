/* Deep copy of an asset along the schema tables. */
#include "model/asset_box.h"
#include "model/schema.h"
#include "sbfmt/asset.h"

static bool clone_element(sbfi_arena *arena, const sbfi_element *element, void *to, const void *from);

/* Copies an array of `count` elements; NULL if memory runs out. */
static void *clone_row(sbfi_arena *arena, const sbfi_element *element, const void *from, uint32_t count) {
  char *row = sbfi_arena_allocate(arena, count, element->struct_size);
  for (uint32_t i = 0; row && i < count; i++) {
    size_t index = (size_t)i * element->struct_size;
    if (!clone_element(arena, element, row + index, (const char *)from + index)) return NULL;
  }
  return row;
}

/* `to` is a shallow copy of `from`; replaces its pointers by copies. */
static bool clone_field(sbfi_arena *arena, const sbfi_field *field, void *to, const void *from) {
  char *destination = (char *)to + field->offset;
  sbfi_list list;
  void *copy;
  switch (field->type) {
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID: {
    const char *text = sbfi_get_pointer(from, field);
    copy = sbfi_arena_string(arena, text, strlen(text));
    sbfi_set_pointer(to, field, copy);
    return copy != NULL;
  }
  case SBFI_LIST:
    list = sbfi_get_list(from, field);
    if (list.count == 0) return true;
    copy = sbfi_arena_copy(arena, list.at, list.count, sbfi_item_size(field));
    sbfi_set_list(to, field, copy, list.count);
    return copy != NULL;
  case SBFI_ONE:
    return clone_element(arena, field->element, destination, (const char *)from + field->offset);
  case SBFI_OPTIONAL: {
    const void *child = sbfi_get_pointer(from, field);
    if (!child) return true;
    copy = clone_row(arena, field->element, child, 1);
    sbfi_set_pointer(to, field, copy);
    return copy != NULL;
  }
  case SBFI_MANY:
    list = sbfi_get_list(from, field);
    if (list.count == 0) return true;
    copy = clone_row(arena, field->element, list.at, list.count);
    sbfi_set_list(to, field, copy, list.count);
    return copy != NULL;
  default:
    return true;
  }
}

static bool clone_element(sbfi_arena *arena, const sbfi_element *element, void *to, const void *from) {
  memcpy(to, from, element->struct_size);
  for (uint32_t i = 0; i < element->field_count; i++)
    if (!clone_field(arena, &element->fields[i], to, from)) return false;
  return true;
}

sbf_asset *sbf_asset_clone(const sbf_asset *asset, const sbf_allocator *allocator) {
  sbf_asset *copy = sbf_asset_create(allocator);
  if (copy && !clone_element(&sbfi_asset_box_of(copy)->arena, &sbfi_asset_element, copy, asset)) {
    sbf_asset_free(copy);
    return NULL;
  }
  return copy;
}
