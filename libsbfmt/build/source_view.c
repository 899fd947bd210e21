#include "build/source_view.h"

#include "model/element_path.h"

/* The field that marks an element as derived; NULL if it has none. */
static const sbfi_field *mark_of(const sbfi_element *element) {
  return sbfi_element_field(element, "derived");
}

static bool is_derived(const sbfi_element *element, const void *object) {
  const sbfi_field *mark = mark_of(element);
  return mark && sbfi_get_integer(object, mark) != SBF_NONE;
}

static bool view_children(const sbfi_element *element, void *object, sbfi_arena *arena);

/* Copies a list of children without the derived ones. */
static bool view_row(const sbfi_field *field, void *object, sbfi_arena *arena) {
  sbfi_list list = sbfi_get_list(object, field);
  size_t size = field->element->struct_size;
  uint32_t kept = 0;
  if (list.count == 0) return true;
  char *row = sbfi_arena_allocate(arena, list.count, size);
  if (!row) return false;
  for (uint32_t i = 0; i < list.count; i++) {
    const char *child = (const char *)list.at + i * size;
    if (is_derived(field->element, child)) continue;
    memcpy(row + kept * size, child, size);
    if (!view_children(field->element, row + kept++ * size, arena)) return false;
  }
  sbfi_set_list(object, field, kept ? row : NULL, kept);
  return true;
}

/* A single child may have its mark beside it, such as hull with hull_derived: then the mark is removed with
 * it. */
static bool view_optional(
    const sbfi_element *element, const sbfi_field *field, void *object, sbfi_arena *arena) {
  char mark_name[64] = "";
  const void *child = sbfi_get_pointer(object, field);
  if (!child) return true;
  strncat(mark_name, field->name, sizeof mark_name - sizeof "_derived");
  strcat(mark_name, "_derived");
  const sbfi_field *mark = sbfi_element_field(element, mark_name);
  if (mark && sbfi_get_integer(object, mark) != SBF_NONE) {
    sbfi_set_integer(object, mark, SBF_NONE);
    sbfi_set_pointer(object, field, NULL);
    return true;
  }
  void *copy = sbfi_arena_copy(arena, child, 1, field->element->struct_size);
  if (!copy) return false;
  sbfi_set_pointer(object, field, copy);
  return view_children(field->element, copy, arena);
}

static bool view_children(const sbfi_element *element, void *object, sbfi_arena *arena) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    bool good = true;
    if (field->type == SBFI_ONE) good = view_children(field->element, (char *)object + field->offset, arena);
    if (field->type == SBFI_OPTIONAL) good = view_optional(element, field, object, arena);
    if (field->type == SBFI_MANY) good = view_row(field, object, arena);
    if (!good) return false;
  }
  return true;
}

bool sbfi_source_view(const sbf_asset *asset, sbfi_arena *arena, sbf_asset *view) {
  *view = *asset;
  view->derivations = (sbf_derivation_list){NULL, 0};
  return view_children(&sbfi_asset_element, view, arena);
}

void sbfi_find_source_indices(
    const void *items, uint32_t count, size_t size, size_t derived, int32_t *new_from_old) {
  int32_t kept = 0;
  for (uint32_t i = 0; i < count; i++) {
    int32_t mark;
    memcpy(&mark, (const char *)items + i * size + derived, sizeof mark);
    new_from_old[i] = mark == SBF_NONE ? kept++ : SBF_NONE;
  }
}

typedef struct renumber_walk {
  const sbfi_renumbering *renumberings;
  uint32_t count;
  sbfi_lost_reference *lost;
  bool good;
} renumber_walk;

static void renumber_field(renumber_walk *walk, const sbfi_element_path *path, const sbfi_field *field) {
  /* The walk treats the asset as constant; the caller guarantees that its structs are writable. */
  void *object = (void *)(uintptr_t)path->object;
  int32_t value = sbfi_get_integer(object, field);
  for (uint32_t i = 0; i < walk->count && value != SBF_NONE; i++) {
    const sbfi_renumbering *by = &walk->renumberings[i];
    if (by->collection != field->reference.offset) continue;
    int32_t new_value = (uint32_t)value < by->old_count ? by->new_from_old[value] : SBF_NONE;
    if (new_value == SBF_NONE && field->required && walk->good) {
      walk->good = false;
      sbfi_element_path_print(path, field, walk->lost->path, sizeof walk->lost->path);
      walk->lost->collection = field->reference.name;
    }
    sbfi_set_integer(object, field, new_value);
    return;
  }
}

static void renumber(renumber_walk *walk, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (field->type == SBFI_REF) renumber_field(walk, path, field);
    uint32_t children = sbfi_child_count(path->object, field);
    for (uint32_t c = 0; c < children; c++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, c);
      renumber(walk, &child);
    }
  }
}

bool sbfi_references_renumber(
    sbf_asset *asset, const sbfi_renumbering *renumberings, uint32_t count, sbfi_lost_reference *lost) {
  renumber_walk walk = {renumberings, count, lost, true};
  sbfi_element_path root = sbfi_element_path_root(asset);
  renumber(&walk, &root);
  return walk.good;
}
