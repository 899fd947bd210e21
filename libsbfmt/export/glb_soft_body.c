/* Writes the extension SBF_soft_body: the asset as JSON by the schema tables, without the lists that the glTF
 * file has already.
 *
 * The writer reads its own glTF file as a reader will, computes each list from it, and leaves the list out if
 * the result is equal. Where rounding or another order of influences makes it differ, only the differences
 * are written. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/glb.h"
#include "gltf/mesh_lists.h"
#include "gltf/soft_body_reader.h"
#include "model/defaults.h"
#include "model/version.h"
#include "packed/packed_attempt.h"
#include "packed/packed_filter.h"

/* A list that a reader can compute from the glTF file. */
typedef struct borrowed_list {
  const void *field;         /* the list in the asset */
  const uint32_t *predicted; /* its scalars as computed; NULL: equal bytes */
} borrowed_list;

/* Member "gltf" of an object: what it is in the glTF file. */
typedef struct source_text {
  const void *object;
  const char *text;
} source_text;

typedef struct writer {
  sbfi_glb *g;
  sbfi_glb_file file;
  sbfi_packed_coder coder;
  sbfi_array lists, sources; /* borrowed_list, source_text; sorted by address before the walk */
  sbfi_text text;            /* of the extension */
} writer;

/* --- streams --- */

/* The bytes may move as they grow. */
static uint32_t add_view(writer *w, const void *bytes, size_t size) {
  uint32_t view = sbfi_glb_view(w->g, bytes, size);
  w->file.binary = (const uint8_t *)w->g->bytes.at;
  return view;
}

static void *copy_little_endian(writer *w, const void *items, size_t size, sbfi_item item) {
  void *copy = sbfi_glb_allocate(w->g, size, 1);
  if (!copy) return NULL;
  memcpy(copy, items, size);
  if (item != SBFI_ITEM_U8) sbfi_scalars_to_host(copy, size / 4);
  return copy;
}

/* Compresses a list; `attempt->size` is 0 if that saves nothing. */
static void compress(
    writer *w, sbfi_packed_attempt *attempt, const void *items, sbfi_item item, uint32_t width, size_t size) {
  *attempt = (sbfi_packed_attempt){sbfi_glb_allocate(w->g, size, 1), sbfi_glb_allocate(w->g, size, 1), 0, 0};
  int first = item == SBFI_ITEM_U8 ? SBFI_FILTER_NONE : SBFI_FILTER_PLANES;
  int last = item == SBFI_ITEM_U8    ? SBFI_FILTER_NONE
             : item == SBFI_ITEM_U32 ? SBFI_FILTER_RECENT
                                     : SBFI_FILTER_DELTA;
  uint32_t stride = (item == SBFI_ITEM_U8 ? 1 : 4) * width;
  for (int f = first; f <= last && !w->g->failed; f++)
    if (!sbfi_packed_try(attempt, &w->coder, items, size, stride, (sbfi_packed_filter)f, size - 1))
      w->g->failed = true;
}

/* Appends a list: an array, or an object with a buffer view. */
static void write_list(
    writer *w, sbfi_text *text, const void *items, sbfi_item item, uint32_t width, uint32_t count) {
  size_t scalars = (size_t)count * width, size = scalars * (item == SBFI_ITEM_U8 ? 1 : 4);
  if (scalars <= SBFI_GLTF_INLINE_SCALARS) {
    sbfi_text_char(text, '[');
    for (size_t i = 0; i < scalars; i++) {
      if (i) sbfi_text_char(text, ',');
      if (item == SBFI_ITEM_F32)
        sbfi_text_f32(text, ((const float *)items)[i]);
      else
        sbfi_text_u32(
            text, item == SBFI_ITEM_U8 ? ((const uint8_t *)items)[i] : ((const uint32_t *)items)[i]);
    }
    sbfi_text_char(text, ']');
    return;
  }
  sbfi_packed_attempt attempt = {0};
  if (!w->g->e->store) compress(w, &attempt, items, item, width, size);
  sbfi_export_print(text, "{\"count\":%u,\"bufferView\":", count);
  if (attempt.size) {
    sbfi_text_u32(text, add_view(w, attempt.best, attempt.size));
    if (attempt.filter != SBFI_FILTER_NONE)
      sbfi_export_print(text, ",\"filter\":\"%s\"", sbfi_gltf_filter_names[attempt.filter]);
    sbfi_text_string(text, ",\"codec\":\"zlib\"}");
    return;
  }
  const void *bytes = copy_little_endian(w, items, size, item);
  if (bytes) sbfi_text_u32(text, add_view(w, bytes, size));
  sbfi_text_char(text, '}');
}

/* --- lists that the glTF file has --- */

static void borrow(writer *w, const void *field, const void *predicted) {
  borrowed_list list = {field, predicted};
  if (!sbfi_array_append(&w->lists, &list, 1)) w->g->failed = true;
}

/* Whether a list is long enough for a reference to pay. */
static bool is_long(uint32_t count, uint32_t width) {
  return (uint64_t)count * width > SBFI_GLTF_INLINE_SCALARS;
}

/* `text` is copied. */
static void add_source(writer *w, const void *object, const sbfi_text *text) {
  source_text source = {object, sbfi_arena_string(&w->g->arena, text->at, text->length)};
  if (text->failed || !source.text || !sbfi_array_append(&w->sources, &source, 1)) w->g->failed = true;
}

/* Item of each vertex: of the corners' items, which are equal for all corners of a vertex. */
static uint32_t *map_of(writer *w, const sbfi_mesh_vertices *v, const uint32_t *of_corners) {
  uint32_t *map = sbfi_glb_allocate(w->g, v->count, sizeof *map);
  for (uint32_t c = 0; c < v->corner_count && map; c++) map[v->corner_vertices[c]] = of_corners[c];
  return map;
}

static void write_map(writer *w, sbfi_text *text, const char *name, const uint32_t *map, uint32_t count) {
  sbfi_export_print(text, "\"%s\":", name);
  write_list(w, text, map, SBFI_ITEM_U32, 1, count);
}

/* Plans numbers on vertices, and the corners' list of them if it has one. */
static void borrow_attribute(writer *w, const sbfi_mesh_vertices *v, const char *attribute,
    const uint32_t *map, const void *field, uint32_t count, uint32_t width, const sbf_u32_list *corners) {
  if (is_long(count, width)) {
    const float *values = sbfi_mesh_attribute(&w->file, v, attribute, width);
    float *predicted = sbfi_glb_allocate(w->g, (size_t)count * width, sizeof *predicted);
    if (!values || !predicted || !sbfi_scatter(v, map, values, width, predicted, count)) {
      w->g->failed = true;
      return;
    }
    if (width == 2) sbfi_flip_coordinates(predicted, count);
    borrow(w, field, predicted);
  }
  if (corners && is_long(corners->count, 1)) borrow(w, corners, NULL);
}

static void plan_coordinates(
    writer *w, const sbf_render_mesh *mesh, const sbfi_mesh_vertices *v, const uint32_t *point_map) {
  uint32_t number = 0;
  for (uint32_t s = 0; s < mesh->uv_sets.count && number < SBFI_GLTF_UV_SETS && !w->g->failed; s++) {
    const sbf_uv_set *set = &mesh->uv_sets.at[s];
    char attribute[24];
    sbfi_text text;
    if (!set->coordinates.count) continue;
    snprintf(attribute, sizeof attribute, "TEXCOORD_%u", number++);
    const uint32_t *map = set->corners.count ? map_of(w, v, set->corners.at) : point_map;
    if (!map) return;
    sbfi_text_init(&text, &w->g->e->allocator);
    sbfi_export_print(&text, "{\"attribute\":\"%s\"", attribute);
    if (set->corners.count) {
      sbfi_text_char(&text, ',');
      write_map(w, &text, "vertices", map, v->count);
    }
    sbfi_text_char(&text, '}');
    add_source(w, set, &text);
    sbfi_text_free(&text);
    borrow_attribute(w, v, attribute, map, &set->coordinates, set->coordinates.count, 2,
        set->corners.count ? &set->corners : NULL);
  }
}

static void plan_skin(
    writer *w, const sbf_render_mesh *mesh, const sbfi_mesh_vertices *v, const uint32_t *first) {
  const sbf_skin *skin = mesh->skin;
  if (!skin || !is_long(skin->weights.count, 1) || !w->g->e->asset->bones.count) return;
  float *predicted = sbfi_glb_allocate(w->g, skin->weights.count, sizeof *predicted);
  if (!predicted || !sbfi_gather_weights(&w->file, v, first, skin->influence_counts, skin->bones, predicted))
    w->g->failed = true;
  else
    borrow(w, &skin->weights, predicted);
}

static void plan_shape_keys(
    writer *w, const sbf_render_mesh *mesh, const sbfi_mesh_vertices *v, const uint32_t *first) {
  for (uint32_t k = 0; k < mesh->shape_keys.count && !w->g->failed; k++) {
    const sbf_shape_key *key = &mesh->shape_keys.at[k];
    if (!is_long(key->offsets.count, 3)) continue;
    float *predicted = sbfi_glb_allocate(w->g, 3 * (size_t)key->offsets.count, sizeof *predicted);
    if (!predicted ||
        !sbfi_gather_offsets(&w->file, v, first, mesh->mesh.positions.count, k, key->points, predicted))
      w->g->failed = true;
    else
      borrow(w, &key->offsets, predicted);
  }
}

static void plan_mesh(writer *w, const sbf_render_mesh *mesh, const sbfi_json *gltf_mesh, uint32_t number) {
  sbfi_mesh_vertices v;
  sbfi_text text;
  uint32_t points = mesh->mesh.positions.count, crc = 0;
  if (!sbfi_mesh_vertices_find(&w->file, gltf_mesh, mesh->mesh.polygon_sizes, mesh->polygon_materials, &v)) {
    w->g->failed = true;
    return;
  }
  if (!sbfi_mesh_checksum(&w->file, &v, &crc)) w->g->failed = true;
  const uint32_t *point_map = map_of(w, &v, mesh->mesh.polygon_points.at);
  const uint32_t *normal_map =
      mesh->normal_corners.count ? map_of(w, &v, mesh->normal_corners.at) : point_map;
  const uint32_t *color_map = mesh->color_corners.count ? map_of(w, &v, mesh->color_corners.at) : point_map;
  uint32_t *first = sbfi_glb_allocate(w->g, points, sizeof *first);
  if (w->g->failed || !sbfi_first_vertices(&v, point_map, first, points)) return;
  sbfi_text_init(&text, &w->g->e->allocator);
  sbfi_export_print(&text, "{\"mesh\":%u,\"crc32\":%u,\"vertices\":{", number, crc);
  write_map(w, &text, "points", point_map, v.count);
  if (mesh->normal_corners.count) {
    sbfi_text_char(&text, ',');
    write_map(w, &text, "normals", normal_map, v.count);
  }
  if (mesh->color_corners.count) {
    sbfi_text_char(&text, ',');
    write_map(w, &text, "colors", color_map, v.count);
  }
  sbfi_text_string(&text, "}}");
  add_source(w, mesh, &text);
  sbfi_text_free(&text);
  borrow_attribute(
      w, &v, "POSITION", point_map, &mesh->mesh.positions, points, 3, &mesh->mesh.polygon_points);
  if (mesh->normals.count)
    borrow_attribute(w, &v, "NORMAL", normal_map, &mesh->normals, mesh->normals.count, 3,
        mesh->normal_corners.count ? &mesh->normal_corners : NULL);
  if (mesh->colors.count)
    borrow_attribute(w, &v, "COLOR_0", color_map, &mesh->colors, mesh->colors.count, 4,
        mesh->color_corners.count ? &mesh->color_corners : NULL);
  plan_coordinates(w, mesh, &v, point_map);
  plan_skin(w, mesh, &v, first);
  plan_shape_keys(w, mesh, &v, first);
}

/* Refers to an item of the glTF file by its index. */
static void add_index(writer *w, const void *object, const char *name, uint32_t index) {
  sbfi_text text;
  sbfi_text_init(&text, &w->g->e->allocator);
  sbfi_export_print(&text, "{\"%s\":%u}", name, index);
  add_source(w, object, &text);
  sbfi_text_free(&text);
}

static void plan_numbers(writer *w, const sbf_f32_list *list, const sbfi_json *accessor, const char *type) {
  sbfi_glb_items items;
  if (!is_long(list->count, 1)) return;
  float *predicted = sbfi_glb_allocate(w->g, list->count, sizeof *predicted);
  if (!predicted) return;
  if (!sbfi_glb_file_accessor(&w->file, accessor, type, &items) || items.count * items.width != list->count) {
    w->g->failed = true;
    return;
  }
  for (uint32_t i = 0; i < list->count; i++)
    predicted[i] = sbfi_glb_float(&items, i / items.width, i % items.width);
  borrow(w, list, predicted);
}

static void plan_clips(writer *w) {
  const sbf_asset *asset = w->g->e->asset;
  uint32_t animation = 0;
  for (uint32_t i = 0; i < asset->clips.count && !w->g->failed; i++) {
    const sbf_clip *clip = &asset->clips.at[i];
    uint32_t sampler = 0;
    const sbfi_json *samplers =
        sbfi_json_get(sbfi_json_at(sbfi_json_get(w->file.root, "animations"), animation), "samplers");
    for (uint32_t t = 0; t < clip->tracks.count && !w->g->failed; t++) {
      const sbf_track *track = &clip->tracks.at[t];
      if (!sbfi_glb_writes_track(clip, t)) continue;
      const sbfi_json *from = sbfi_json_at(samplers, sampler);
      add_index(w, track, "sampler", sampler++);
      plan_numbers(w, &track->times, sbfi_json_get(from, "input"), "SCALAR");
      plan_numbers(w, &track->values, sbfi_json_get(from, "output"),
          track->property == SBF_TRACK_PROPERTY_ROTATION ? "VEC4" : "VEC3");
    }
    if (sampler) add_index(w, clip, "animation", animation++);
  }
}

static void plan_indices(writer *w) {
  const sbf_asset *asset = w->g->e->asset;
  for (uint32_t i = 0; i < asset->bones.count; i++) add_index(w, &asset->bones.at[i], "node", i);
  for (uint32_t i = 0; i < asset->materials.count; i++) add_index(w, &asset->materials.at[i], "material", i);
  for (uint32_t i = 0; i < asset->textures.count && w->g->texture_indices; i++) {
    if (w->g->texture_indices[i] < 0) continue;
    add_index(w, &asset->textures.at[i], "image", (uint32_t)w->g->texture_indices[i]);
    if (is_long(asset->textures.at[i].bytes.count, 1)) borrow(w, &asset->textures.at[i].bytes, NULL);
  }
}

static void plan_meshes(writer *w) {
  const sbf_asset *asset = w->g->e->asset;
  uint32_t number = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count && !w->g->failed; i++) {
    if (w->g->meshes[i].node == UINT32_MAX) continue;
    plan_mesh(
        w, &asset->render_meshes.at[i], sbfi_json_at(sbfi_json_get(w->file.root, "meshes"), number), number);
    number++;
  }
}

/* --- the walk --- */

static int compare_addresses(const void *a, const void *b) {
  const void *x = *(const void *const *)a, *y = *(const void *const *)b;
  return ((uintptr_t)x > (uintptr_t)y) - ((uintptr_t)x < (uintptr_t)y);
}

static const void *find(const sbfi_array *array, const void *address) {
  return array->count ? bsearch(&address, array->at, array->count, array->item_size, compare_addresses)
                      : NULL;
}

/* Writes what a reader has to add to the scalars that it computes; nothing if they are equal. */
static void write_borrowed(
    writer *w, const sbfi_field *field, sbfi_list list, const borrowed_list *borrowed) {
  sbfi_export_print(&w->text, "{\"count\":%u,\"gltf\":true", list.count);
  size_t scalars = (size_t)list.count * field->width;
  if (borrowed->predicted && memcmp(borrowed->predicted, list.at, scalars * 4) != 0) {
    uint32_t *differences = sbfi_glb_allocate(w->g, scalars, sizeof *differences);
    for (size_t i = 0; i < scalars && differences; i++)
      differences[i] = sbfi_gltf_difference(((const uint32_t *)list.at)[i], borrowed->predicted[i]);
    sbfi_text_string(&w->text, ",\"correction\":");
    if (differences) write_list(w, &w->text, differences, SBFI_ITEM_U32, field->width, list.count);
  }
  sbfi_text_char(&w->text, '}');
}

static void write_numbers(writer *w, const sbfi_field *field, const char *at) {
  if (field->width > 1) sbfi_text_char(&w->text, '[');
  for (uint32_t i = 0; i < field->width; i++) {
    float value;
    memcpy(&value, at + 4 * (size_t)i, sizeof value);
    if (i) sbfi_text_char(&w->text, ',');
    sbfi_text_f32(&w->text, value);
  }
  if (field->width > 1) sbfi_text_char(&w->text, ']');
}

static void write_members(writer *w, const sbfi_element_path *path);

static void write_children(writer *w, const sbfi_element_path *path, const sbfi_field *field) {
  uint32_t count = sbfi_child_count(path->object, field);
  if (field->type == SBFI_MANY) sbfi_text_char(&w->text, '[');
  for (uint32_t i = 0; i < count; i++) {
    sbfi_element_path child = sbfi_element_path_child(path, field, i);
    if (i) sbfi_text_char(&w->text, ',');
    write_members(w, &child);
  }
  if (field->type == SBFI_MANY) sbfi_text_char(&w->text, ']');
}

static void write_value(writer *w, const sbfi_element_path *path, const sbfi_field *field) {
  const char *at = (const char *)path->object + field->offset;
  const borrowed_list *borrowed;
  sbfi_list list;
  switch (field->type) {
  case SBFI_BOOL:
    sbfi_text_string(&w->text, *(const bool *)(const void *)at ? "true" : "false");
    break;
  case SBFI_INT:
  case SBFI_REF:
    sbfi_text_i32(&w->text, sbfi_get_integer(path->object, field));
    break;
  case SBFI_UINT:
    sbfi_text_u32(&w->text, (uint32_t)sbfi_get_integer(path->object, field));
    break;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    write_numbers(w, field, at);
    break;
  case SBFI_ENUM:
    sbfi_glb_write_string(&w->text, field->words.at[sbfi_get_integer(path->object, field)]);
    break;
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    sbfi_glb_write_string(&w->text, sbfi_get_pointer(path->object, field));
    break;
  case SBFI_LIST:
    list = sbfi_get_list(path->object, field);
    borrowed = find(&w->lists, at);
    if (borrowed)
      write_borrowed(w, field, list, borrowed);
    else
      write_list(w, &w->text, list.at, field->item, field->width, list.count);
    break;
  case SBFI_ONE:
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    write_children(w, path, field);
    break;
  }
}

static void write_members(writer *w, const sbfi_element_path *path) {
  const source_text *source = find(&w->sources, path->object);
  const char *comma = "";
  sbfi_text_char(&w->text, '{');
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    char version[SBFI_VERSION_TEXT];
    bool is_version = !path->up && strcmp(field->name, "version") == 0;
    if (!is_version && !field->required && sbfi_field_is_default(path, field)) continue;
    sbfi_export_print(&w->text, "%s\"%s\":", comma, field->name);
    comma = ",";
    if (is_version)
      sbfi_glb_write_string(&w->text, sbfi_version_to_state(w->g->e->asset, version));
    else
      write_value(w, path, field);
  }
  /* No element with a source begins with another one, so an address identifies an object. */
  if (source) sbfi_export_print(&w->text, "%s\"gltf\":", comma), sbfi_text_string(&w->text, source->text);
  sbfi_text_char(&w->text, '}');
}

void sbfi_glb_write_soft_body(sbfi_glb *g, const sbfi_text *json, sbfi_text *extension) {
  writer w = {.g = g};
  sbf_diagnostic unused;
  sbfi_packed_coder_init(&w.coder, &g->e->allocator, g->e->compression);
  sbfi_array_init(&w.lists, &g->e->allocator, sizeof(borrowed_list));
  sbfi_array_init(&w.sources, &g->e->allocator, sizeof(source_text));
  sbfi_text_init(&w.text, &g->e->allocator);
  if (sbfi_glb_file_parse(&w.file, json->at, json->length, (const uint8_t *)g->bytes.at, g->bytes.length,
          &g->arena, &unused) != SBF_OK)
    g->failed = true;
  if (!g->failed) plan_clips(&w);
  if (!g->failed) plan_indices(&w);
  if (!g->failed) plan_meshes(&w);
  if (!g->failed) {
    if (w.lists.count) qsort(w.lists.at, w.lists.count, w.lists.item_size, compare_addresses);
    if (w.sources.count) qsort(w.sources.at, w.sources.count, w.sources.item_size, compare_addresses);
    sbfi_element_path root = sbfi_element_path_root(g->e->asset);
    write_members(&w, &root);
    sbfi_text_append(extension, w.text.at, w.text.length);
    g->failed = g->failed || w.text.failed;
  }
  sbfi_text_free(&w.text);
  sbfi_array_free(&w.sources);
  sbfi_array_free(&w.lists);
  sbfi_packed_coder_free(&w.coder);
}
