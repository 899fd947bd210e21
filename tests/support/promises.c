#include "promises.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "model/element_path.h"

enum { MESSAGE_BYTES = 768 };

typedef struct finder {
  const sbf_asset *asset;
  const char **ids;
  size_t id_count, id_room;
  char message[MESSAGE_BYTES]; /* "": nothing found */
} finder;

static void found(finder *f, const sbfi_element_path *location, const sbfi_field *field, const char *what) {
  char path[256];
  if (f->message[0]) return;
  sbfi_element_path_print(location, field, path, sizeof path);
  snprintf(f->message, sizeof f->message, "%s: %s", path, what);
}

static bool in_range(const sbfi_field *field, double value) {
  if (!field->range.is_stated) return true;
  if (field->range.min_open ? !(value > field->range.min) : !(value >= field->range.min)) return false;
  return field->range.max_open ? value < field->range.max : value <= field->range.max;
}

static void see_floats(
    finder *f, const sbfi_element_path *path, const sbfi_field *field, const float *at, size_t n) {
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(at[i])) found(f, path, field, "a number that is not finite");
    if (!in_range(field, (double)at[i])) found(f, path, field, "a number out of its range");
  }
}

static void see_text(finder *f, const sbfi_element_path *path, const sbfi_field *field) {
  const char *text = sbfi_get_pointer(path->object, field);
  if (!text) {
    found(f, path, field, "a text that is NULL");
    return;
  }
  if (sbfi_utf8_check(text, strlen(text)) != strlen(text)) found(f, path, field, "a text that is not UTF-8");
  if (field->type != SBFI_ID) return;
  if (!*text) found(f, path, field, "an id of nothing");
  if (f->id_count == f->id_room) {
    f->id_room = f->id_room ? 2 * f->id_room : 64;
    f->ids = realloc(f->ids, f->id_room * sizeof *f->ids);
    if (!f->ids) abort();
  }
  f->ids[f->id_count++] = text;
}

static void see_reference(finder *f, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t value = sbfi_get_integer(path->object, field);
  if (value == SBF_NONE) {
    if (field->required) found(f, path, field, "a required reference to nothing");
    return;
  }
  sbfi_list collection;
  memcpy(&collection.at, (const char *)f->asset + field->reference.offset, sizeof collection.at);
  memcpy(&collection.count, (const char *)f->asset + field->reference.offset + sizeof collection.at,
      sizeof collection.count);
  if (value < 0 || (uint32_t)value >= collection.count) found(f, path, field, "a reference out of range");
  if (field->earlier && value >= (int32_t)path->index) found(f, path, field, "a reference to a later item");
}

static double orientation(const sbf_vec3 *p, const uint32_t *t) {
  double a[3], b[3], c[3];
  const sbf_vec3 *o = &p[t[0]];
  double *const edges[3] = {a, b, c};
  for (int k = 0; k < 3; k++) {
    const sbf_vec3 *q = &p[t[k + 1]];
    edges[k][0] = (double)q->x - (double)o->x;
    edges[k][1] = (double)q->y - (double)o->y;
    edges[k][2] = (double)q->z - (double)o->z;
  }
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static void see_indices(finder *f, const sbfi_element_path *path, const sbfi_field *field, sbfi_list list) {
  const uint32_t *at = list.at;
  uint64_t limit = sbfi_length_value(field->index, path);
  for (size_t i = 0; i < (size_t)list.count * field->width; i++)
    if (at[i] >= limit) {
      found(f, path, field, "an index out of range");
      return;
    }
  if (!field->positive) return;
  const sbf_vec3 *positions = sbfi_term_list(&field->index->terms[0], path).at;
  for (uint32_t i = 0; i < list.count; i++)
    if (!(orientation(positions, at + 4 * (size_t)i) > 0))
      found(f, path, field, "a tetrahedron without positive volume");
}

static void see_list(finder *f, const sbfi_element_path *path, const sbfi_field *field) {
  sbfi_list list = sbfi_get_list(path->object, field);
  size_t scalars = (size_t)list.count * field->width;
  bool length_allowed = field->length_count == 0;
  for (uint32_t i = 0; i < field->length_count; i++)
    if (sbfi_length_value(&field->lengths[i], path) == list.count) length_allowed = true;
  if (!length_allowed) found(f, path, field, "a list of a length that no rule allows");
  if ((list.count == 0) != (list.at == NULL)) {
    found(f, path, field, "a list that is NULL and not empty, or the reverse");
    return;
  }
  if (field->item == SBFI_ITEM_F32) see_floats(f, path, field, list.at, scalars);
  if (field->item != SBFI_ITEM_U32) return;
  for (size_t i = 0; i < scalars; i++)
    if (!in_range(field, ((const uint32_t *)list.at)[i])) found(f, path, field, "a number out of its range");
  if (field->index) see_indices(f, path, field, list);
}

static void see_integer(finder *f, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t value = sbfi_get_integer(path->object, field);
  double number = field->type == SBFI_INT ? (double)value : (double)(uint32_t)value;
  if (!in_range(field, number)) found(f, path, field, "a number out of its range");
}

static void see_object(finder *f, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count && !f->message[0]; i++) {
    const sbfi_field *field = &path->element->fields[i];
    const char *at = (const char *)path->object + field->offset;
    switch (field->type) {
    case SBFI_BOOL:
      if ((unsigned char)*at > 1) found(f, path, field, "a bool that is neither");
      break;
    case SBFI_INT:
    case SBFI_UINT:
      see_integer(f, path, field);
      break;
    case SBFI_FLOAT:
    case SBFI_VEC2:
    case SBFI_VEC3:
    case SBFI_VEC4:
    case SBFI_QUAT:
      see_floats(f, path, field, (const float *)(const void *)at, field->width);
      break;
    case SBFI_STRING:
    case SBFI_TEXT:
    case SBFI_ID:
      see_text(f, path, field);
      break;
    case SBFI_ENUM:
      if ((uint32_t)sbfi_get_integer(path->object, field) >= field->words.count)
        found(f, path, field, "a word of no meaning");
      break;
    case SBFI_REF:
      see_reference(f, path, field);
      break;
    case SBFI_LIST:
      see_list(f, path, field);
      break;
    case SBFI_ONE:
    case SBFI_OPTIONAL:
    case SBFI_MANY:
      for (uint32_t k = 0; k < sbfi_child_count(path->object, field) && !f->message[0]; k++) {
        sbfi_element_path child = sbfi_element_path_child(path, field, k);
        see_object(f, &child);
      }
      break;
    }
  }
}

static int compare_texts(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static void see_ids(finder *f) {
  if (f->id_count) qsort(f->ids, f->id_count, sizeof *f->ids, compare_texts);
  for (size_t i = 1; i < f->id_count && !f->message[0]; i++)
    if (strcmp(f->ids[i - 1], f->ids[i]) == 0)
      snprintf(f->message, sizeof f->message, "the id %.200s stands twice", f->ids[i]);
}

/* Said without the schema's tables, which may themselves be wrong. */
static void see_meshes(finder *f, const sbf_polygon_mesh *mesh, const char *name) {
  uint64_t corners = 0;
  for (uint32_t i = 0; i < mesh->polygon_sizes.count; i++) {
    if (mesh->polygon_sizes.at[i] < 3)
      snprintf(f->message, sizeof f->message, "%.200s has a polygon of less than three corners", name);
    corners += mesh->polygon_sizes.at[i];
  }
  if (corners != mesh->polygon_points.count)
    snprintf(f->message, sizeof f->message, "%.200s has polygons that do not use up their corners", name);
  for (uint32_t i = 0; i < mesh->polygon_points.count; i++)
    if (mesh->polygon_points.at[i] >= mesh->positions.count)
      snprintf(f->message, sizeof f->message, "%.200s has a corner out of range", name);
}

static void see_model(finder *f) {
  const sbf_asset *asset = f->asset;
  for (uint32_t i = 0; i < asset->bones.count; i++)
    if (asset->bones.at[i].parent != SBF_NONE && (uint32_t)asset->bones.at[i].parent >= i)
      snprintf(f->message, sizeof f->message, "bone %u stands before its parent", i);
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    see_meshes(f, &asset->render_meshes.at[i].mesh, asset->render_meshes.at[i].id);
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    see_meshes(f, &body->surface, body->id);
    for (uint32_t k = 0; k < body->levels.count; k++) {
      const sbf_level *level = &body->levels.at[k];
      for (uint32_t s = 0; s < level->springs.count; s++)
        for (uint32_t e = 0; e < level->springs.at[s].ends.count; e++)
          if (level->springs.at[s].ends.at[e].at[0] >= level->positions.count ||
              level->springs.at[s].ends.at[e].at[1] >= level->positions.count)
            snprintf(f->message, sizeof f->message, "a spring of %.200s ends nowhere", body->id);
    }
  }
}

static void keep_first(void *user, const sbf_diagnostic *diagnostic) {
  finder *f = user;
  if (!f->message[0])
    snprintf(f->message, sizeof f->message, "%s: %s", diagnostic->path, diagnostic->message);
}

const char *promise_broken(const sbf_asset *asset) {
  static char message[MESSAGE_BYTES];
  finder f = {.asset = asset};
  if (!asset) return "there is no asset";
  uint32_t count = sbf_asset_check(asset, keep_first, &f, 0);
  if (count && !f.message[0]) snprintf(f.message, sizeof f.message, "a fault that was not told");
  sbfi_element_path root = sbfi_element_path_root(asset);
  if (!f.message[0]) see_object(&f, &root);
  if (!f.message[0]) see_ids(&f);
  if (!f.message[0]) see_model(&f);
  free(f.ids);
  memcpy(message, f.message, sizeof message);
  return message[0] ? message : NULL;
}
