/* Fills the lists that the extension takes from the glTF file: those of render meshes, clips and images. */
#include "gltf/mesh_lists.h"
#include "gltf/renumbered.h"
#include "gltf/soft_body_reader.h"

/* A render mesh while its lists are restored. */
typedef struct mesh_reader {
  sbfi_gltf_reader *r;
  const sbfi_json *json; /* of the render mesh */
  sbfi_mesh_vertices vertices;
  const uint32_t *point_of_vertex;
  uint32_t *first_vertices; /* (points); NULL until needed */
  uint32_t points;
} mesh_reader;

static bool fault(const sbfi_gltf_reader *r, const char *name, const char *message) {
  return sbfi_glb_fault(&r->file, SBF_CODE_GLTF_EXTENSION, "`%s`: %s", name, message);
}

static bool changed(const sbfi_gltf_reader *r, const char *name) {
  return sbfi_glb_fault(&r->file, SBF_CODE_GLTF_CHANGED,
      "`%s` does not fit the glTF file, which another program changed: use it as it was before", name);
}

/* Counts a list that is being restored; false if it is not borrowed. */
static bool take(sbfi_gltf_reader *r, const sbfi_json *json) {
  if (!json || !sbfi_gltf_is_borrowed(json)) return false;
  r->borrowed_count--;
  return true;
}

/* Zeroed scalars for a borrowed list. Without a correction it has at most `available` items, so that a file
 * cannot ask for more memory than its size justifies. */
static void *begin_list(sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list,
    uint64_t available, uint32_t *count) {
  if (!sbfi_gltf_count(r, json, list, count)) return NULL;
  if (!*count || (*count > available && !sbfi_json_get(json, "correction"))) {
    changed(r, list->name);
    return NULL;
  }
  void *items = sbfi_arena_allocate(r->arena, *count, list->width * 4);
  if (!items)
    sbfi_glb_fault(
        &r->file, SBF_CODE_OUT_OF_MEMORY, "no memory for `%s`, or more than the limit", list->name);
  return items;
}

/* Item of each vertex, as the file lists it. */
static const uint32_t *read_map(mesh_reader *m, const sbfi_json *json, const char *name) {
  const sbfi_gltf_list list = {name, SBFI_ITEM_U32, 1};
  const void *items;
  uint32_t count;
  if (!json) {
    fault(m->r, name, "the list of its vertices is missing");
    return NULL;
  }
  if (!sbfi_gltf_read_list(m->r, json, &list, &m->r->scratch, &items, &count)) return NULL;
  if (count == m->vertices.count && count) return items;
  changed(m->r, name);
  return NULL;
}

/* A list of numbers on vertices, such as positions. */
static bool restore_floats(mesh_reader *m, const sbfi_json *json, const sbfi_gltf_list *list,
    const char *attribute, const uint32_t *map, const void **at, uint32_t *count) {
  if (!take(m->r, json)) return true;
  float *items = begin_list(m->r, json, list, m->vertices.count, count);
  if (!items || !map) return false;
  const float *values = sbfi_mesh_attribute(&m->r->file, &m->vertices, attribute, list->width);
  if (!values) return false;
  if (!sbfi_scatter(&m->vertices, map, values, list->width, items, *count)) return changed(m->r, list->name);
  *at = items;
  return true;
}

/* A list of the corners' items, such as their points. */
static bool restore_corners(
    mesh_reader *m, const sbfi_json *json, const char *name, const uint32_t *map, sbf_u32_list *to) {
  const sbfi_gltf_list list = {name, SBFI_ITEM_U32, 1};
  if (!take(m->r, json)) return true;
  uint32_t *items = begin_list(m->r, json, &list, m->vertices.corner_count, &to->count);
  if (!items || !map) return false;
  if (to->count != m->vertices.corner_count) return changed(m->r, name);
  sbfi_gather_corners(&m->vertices, map, items);
  to->at = items;
  return true;
}

static bool correct(
    mesh_reader *m, const sbfi_json *json, const sbfi_gltf_list *list, const void *at, uint32_t count) {
  if (!json || !sbfi_gltf_is_borrowed(json)) return true;
  return sbfi_gltf_correct(m->r, json, list, (uint32_t *)(uintptr_t)at, count);
}

static bool restore_points(mesh_reader *m, sbf_render_mesh *mesh) {
  const sbfi_gltf_list list = {"positions", SBFI_ITEM_F32, 3};
  const sbfi_json *own = sbfi_json_get(m->json, "mesh"), *json = sbfi_json_get(own, "positions");
  const void *at = mesh->mesh.positions.at;
  uint32_t count = mesh->mesh.positions.count;
  if (!restore_floats(m, json, &list, "POSITION", m->point_of_vertex, &at, &count) ||
      !correct(m, json, &list, at, count))
    return false;
  mesh->mesh.positions = (sbf_vec3_list){at, count};
  m->points = count;
  return restore_corners(m, sbfi_json_get(own, "polygon_points"), "polygon_points", m->point_of_vertex,
      &mesh->mesh.polygon_points);
}

/* Numbers on corners: their own list, and which of them each corner has. */
static bool restore_attribute(mesh_reader *m, const sbfi_json *object, const char *names[3],
    const sbfi_json *vertices, uint32_t width, const void **at, uint32_t *count, sbf_u32_list *corners) {
  const sbfi_gltf_list list = {names[0], SBFI_ITEM_F32, width};
  const sbfi_json *own = sbfi_json_get(object, names[0]), *of_corners = sbfi_json_get(object, names[1]);
  if (!sbfi_gltf_is_borrowed(own) && !sbfi_gltf_is_borrowed(of_corners)) return true;
  const uint32_t *map = vertices ? read_map(m, vertices, names[0]) : m->point_of_vertex;
  if (!map || !restore_floats(m, own, &list, names[2], map, at, count)) return false;
  if (sbfi_gltf_is_borrowed(own) && width == 2) sbfi_flip_coordinates((float *)(uintptr_t)*at, *count);
  return correct(m, own, &list, *at, *count) && restore_corners(m, of_corners, names[1], map, corners);
}

static bool restore_coordinates(mesh_reader *m, sbf_render_mesh *mesh) {
  for (uint32_t s = 0; s < mesh->uv_sets.count; s++) {
    sbf_uv_set *set = (sbf_uv_set *)(uintptr_t)&mesh->uv_sets.at[s];
    const sbfi_json *json = sbfi_json_at(sbfi_json_get(m->json, "uv_sets"), s),
                    *source = sbfi_json_get(json, "gltf");
    const sbfi_json *attribute = sbfi_json_get(source, "attribute");
    if (!source) continue;
    if (!attribute || attribute->type != SBFI_JSON_STRING)
      return fault(m->r, "uv_sets", "the attribute is missing");
    const char *names[3] = {"coordinates", "corners", attribute->text.at};
    const void *at = set->coordinates.at;
    if (!restore_attribute(m, json, names, sbfi_json_get(source, "vertices"), 2, &at, &set->coordinates.count,
            &set->corners))
      return false;
    set->coordinates.at = at;
  }
  return true;
}

static bool find_first_vertices(mesh_reader *m) {
  if (m->first_vertices) return true;
  m->first_vertices =
      sbfi_arena_allocate(&m->r->scratch, m->points ? m->points : 1, sizeof *m->first_vertices);
  if (!m->first_vertices) return sbfi_glb_fault(&m->r->file, SBF_CODE_OUT_OF_MEMORY, "no memory for a mesh");
  return sbfi_first_vertices(&m->vertices, m->point_of_vertex, m->first_vertices, m->points) ||
         changed(m->r, "vertices");
}

static bool restore_weights(mesh_reader *m, sbf_skin *skin) {
  const sbfi_gltf_list list = {"weights", SBFI_ITEM_F32, 1};
  const sbfi_json *json = sbfi_json_get(sbfi_json_get(m->json, "skin"), "weights");
  if (!take(m->r, json)) return true;
  float *weights = begin_list(m->r, json, &list, skin->bones.count, &skin->weights.count);
  if (!weights || !find_first_vertices(m)) return false;
  if (skin->weights.count != skin->bones.count || skin->influence_counts.count != m->points)
    return changed(m->r, "weights");
  if (!sbfi_gather_weights(
          &m->r->file, &m->vertices, m->first_vertices, skin->influence_counts, skin->bones, weights))
    return false;
  skin->weights.at = weights;
  return correct(m, json, &list, weights, skin->weights.count);
}

static bool restore_shape_keys(mesh_reader *m, sbf_render_mesh *mesh) {
  const sbfi_gltf_list list = {"offsets", SBFI_ITEM_F32, 3};
  for (uint32_t k = 0; k < mesh->shape_keys.count; k++) {
    sbf_shape_key *key = (sbf_shape_key *)(uintptr_t)&mesh->shape_keys.at[k];
    const sbfi_json *json = sbfi_json_get(sbfi_json_at(sbfi_json_get(m->json, "shape_keys"), k), "offsets");
    if (!take(m->r, json)) continue;
    float *offsets = begin_list(m->r, json, &list, key->points.count, &key->offsets.count);
    if (!offsets || !find_first_vertices(m)) return false;
    if (key->offsets.count != key->points.count) return changed(m->r, "offsets");
    if (!sbfi_gather_offsets(
            &m->r->file, &m->vertices, m->first_vertices, m->points, k, key->points, offsets) ||
        !correct(m, json, &list, offsets, key->offsets.count))
      return false;
    key->offsets.at = (const sbf_vec3 *)(const void *)offsets;
  }
  return true;
}

static bool restore_mesh(sbfi_gltf_reader *r, const sbfi_json *json, sbf_render_mesh *mesh) {
  const sbfi_json *source = sbfi_json_get(json, "gltf"), *maps = sbfi_json_get(source, "vertices");
  mesh_reader m = {.r = r, .json = json};
  uint32_t number;
  if (!source) return true;
  if (!sbfi_json_u32(sbfi_json_get(source, "mesh"), &number))
    return fault(r, "render_meshes", "the mesh is missing");
  const sbfi_gltf_list points = {"vertices", SBFI_ITEM_U32, 1};
  sbfi_stated_mesh stated = {
      .number = number, .sizes = mesh->mesh.polygon_sizes, .materials = mesh->polygon_materials};
  if (!sbfi_json_u32(sbfi_json_get(source, "crc32"), &stated.crc32))
    return fault(r, "render_meshes", "the checksum is missing");
  if (!sbfi_json_get(maps, "points")) return fault(r, "vertices", "the list of its vertices is missing");
  if (!sbfi_gltf_count(r, sbfi_json_get(maps, "points"), &points, &stated.vertex_count) ||
      !sbfi_find_stated_mesh(r, &stated, &m.vertices))
    return false;
  if (!(m.point_of_vertex = read_map(&m, sbfi_json_get(maps, "points"), "vertices")) ||
      !restore_points(&m, mesh))
    return false;
  const char *normals[3] = {"normals", "normal_corners", "NORMAL"},
             *colors[3] = {"colors", "color_corners", "COLOR_0"};
  const void *at = mesh->normals.at;
  if (!restore_attribute(&m, json, normals, sbfi_json_get(maps, "normals"), 3, &at, &mesh->normals.count,
          &mesh->normal_corners))
    return false;
  mesh->normals.at = at;
  at = mesh->colors.at;
  if (!restore_attribute(
          &m, json, colors, sbfi_json_get(maps, "colors"), 4, &at, &mesh->colors.count, &mesh->color_corners))
    return false;
  mesh->colors.at = at;
  return restore_coordinates(&m, mesh) &&
         (!mesh->skin || restore_weights(&m, (sbf_skin *)(uintptr_t)mesh->skin)) &&
         restore_shape_keys(&m, mesh);
}

/* --- clips and images --- */

static bool restore_numbers(sbfi_gltf_reader *r, const sbfi_json *json, const char *name, const char *type,
    const sbfi_json *accessor, sbf_f32_list *to) {
  const sbfi_gltf_list list = {name, SBFI_ITEM_F32, 1};
  sbfi_glb_items items;
  if (!take(r, json)) return true;
  if (!sbfi_glb_file_accessor(&r->file, accessor, type, &items) || !sbfi_glb_is_float(&r->file, &items))
    return false;
  float *numbers = begin_list(r, json, &list, (uint64_t)items.count * items.width, &to->count);
  if (!numbers) return false;
  if (to->count != (uint64_t)items.count * items.width) return changed(r, name);
  for (uint32_t i = 0; i < to->count; i++)
    numbers[i] = sbfi_glb_float(&items, i / items.width, i % items.width);
  to->at = numbers;
  return sbfi_gltf_correct(r, json, &list, (uint32_t *)(void *)numbers, to->count);
}

static bool restore_clip(sbfi_gltf_reader *r, const sbfi_json *json, const sbf_clip *clip) {
  uint32_t number;
  const sbfi_json *source = sbfi_json_get(json, "gltf");
  if (!source) return true;
  if (!sbfi_json_u32(sbfi_json_get(source, "animation"), &number))
    return fault(r, "clips", "the animation is missing");
  const sbfi_json *animation =
      sbfi_find_named_item(r, "animations", number, *clip->name ? clip->name : clip->id);
  if (!animation) return false;
  for (uint32_t t = 0; t < clip->tracks.count; t++) {
    sbf_track *track = (sbf_track *)(uintptr_t)&clip->tracks.at[t];
    const sbfi_json *own = sbfi_json_at(sbfi_json_get(json, "tracks"), t);
    uint32_t sampler;
    if (!sbfi_json_get(own, "gltf")) continue;
    if (!sbfi_json_u32(sbfi_json_get(sbfi_json_get(own, "gltf"), "sampler"), &sampler))
      return fault(r, "tracks", "the sampler is missing");
    const sbfi_json *from = sbfi_json_at(sbfi_json_get(animation, "samplers"), sampler);
    const char *type = track->property == SBF_TRACK_PROPERTY_ROTATION ? "VEC4" : "VEC3";
    if (!restore_numbers(
            r, sbfi_json_get(own, "times"), "times", "SCALAR", sbfi_json_get(from, "input"), &track->times) ||
        !restore_numbers(
            r, sbfi_json_get(own, "values"), "values", type, sbfi_json_get(from, "output"), &track->values))
      return false;
  }
  return true;
}

static bool restore_image(sbfi_gltf_reader *r, const sbfi_json *json, sbf_texture *texture) {
  uint32_t number, view;
  sbfi_glb_bytes bytes;
  const sbfi_json *source = sbfi_json_get(json, "gltf");
  bool is_extra = r->options.with_images && source && !texture->bytes.count && *texture->path;
  if (!take(r, sbfi_json_get(json, "bytes")) && !is_extra) return true;
  if (!sbfi_json_u32(sbfi_json_get(source, "image"), &number))
    return fault(r, "textures", "the image is missing");
  const sbfi_json *image =
      sbfi_find_named_item(r, "images", number, *texture->name ? texture->name : texture->id);
  if (!image) return false;
  if (!sbfi_json_u32(sbfi_json_get(image, "bufferView"), &view)) return changed(r, "textures");
  if (!sbfi_glb_file_view(&r->file, view, &bytes)) return false;
  if (bytes.size > r->options.limits.list_items) return changed(r, "textures");
  texture->bytes.count = (uint32_t)bytes.size;
  texture->bytes.at = bytes.size ? sbfi_arena_copy(r->arena, bytes.at, bytes.size, 1) : NULL;
  return !bytes.size || texture->bytes.at ||
         sbfi_glb_fault(&r->file, SBF_CODE_OUT_OF_MEMORY, "no memory for an image, or more than the limit");
}

bool sbfi_gltf_restore(sbfi_gltf_reader *r, const sbfi_json *extension, sbf_asset *asset) {
  const sbfi_json *meshes = sbfi_json_get(extension, "render_meshes"),
                  *clips = sbfi_json_get(extension, "clips"),
                  *textures = sbfi_json_get(extension, "textures");
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (!restore_mesh(r, sbfi_json_at(meshes, i), (sbf_render_mesh *)(uintptr_t)&asset->render_meshes.at[i]))
      return false;
  for (uint32_t i = 0; i < asset->clips.count; i++)
    if (!restore_clip(r, sbfi_json_at(clips, i), &asset->clips.at[i])) return false;
  for (uint32_t i = 0; i < asset->textures.count; i++)
    if (!restore_image(r, sbfi_json_at(textures, i), (sbf_texture *)(uintptr_t)&asset->textures.at[i]))
      return false;
  if (r->borrowed_count)
    return fault(
        r, SBFI_GLTF_EXTENSION, "a list is to be taken from the glTF file that no mesh, clip or image has");
  return true;
}
