#include "import/scene/raw_scene.h"

#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "import/quote.h"

typedef struct cursor {
  const uint8_t *at, *end;
  sbfi_arena *scratch;
  sbf_status status; /* first failure; afterwards all reads return zeros */
  sbf_diagnostic *error;
} cursor;

static size_t left(const cursor *c) {
  return (size_t)(c->end - c->at);
}

static void fail(cursor *c, const char *what) {
  if (c->status) return;
  c->status = sbfi_diagnose(c->error, SBF_CODE_IMPORT_STREAM,
      "the output of sbfmt-import is truncated or inconsistent at %s: check that it has the version of this "
      "sbfmt",
      what);
}

static void fail_not_finite(cursor *c, const char *what, sbfi_span name, size_t index) {
  if (c->status) return;
  c->status = sbfi_diagnose(c->error, SBF_CODE_IMPORT_NOT_FINITE,
      "item %zu of %s of \"%s\" is infinite or NaN: export the file again", index, what,
      sbfi_quote_of(name).text);
}

/* Some of assimp's readers do not check the indices of a damaged file. */
static void fail_index(cursor *c, const char *what) {
  if (c->status) return;
  c->status = sbfi_diagnose(c->error, SBF_CODE_IMPORT_INDEX,
      "%s refer to vertices that the file does not have: it is damaged or cut off", what);
}

/* Reads `count` items of `size` bytes, a whole number of words; NULL if the stream ends earlier. */
static const void *take(cursor *c, size_t count, size_t size, const char *what) {
  if (c->status || count > left(c) / size) {
    fail(c, what);
    return NULL;
  }
  const void *taken = c->at;
  c->at += count * size;
  return taken;
}

static uint32_t read_u32(cursor *c, const char *what) {
  uint32_t value = 0;
  const void *from = take(c, 1, sizeof value, what);
  if (from) memcpy(&value, from, sizeof value);
  return value;
}

static double read_f64(cursor *c, const char *what) {
  double value = 0;
  const void *from = take(c, 1, sizeof value, what);
  if (from) memcpy(&value, from, sizeof value);
  return value;
}

/* Reads the count of a list whose items have at least `min` bytes. Rejects a count that cannot fit before
 * any allocation. */
static uint32_t read_count(cursor *c, size_t min, const char *what) {
  uint32_t count = read_u32(c, what);
  if (c->status || count <= left(c) / min) return count;
  fail(c, what);
  return 0;
}

static const void *read_padded(cursor *c, size_t length, const char *what) {
  if (length > left(c)) {
    fail(c, what);
    return NULL;
  }
  return take(c, (length + 3) / 4, 4, what);
}

static sbfi_span read_string(cursor *c, const char *what) {
  uint32_t length = read_u32(c, what);
  const char *at = read_padded(c, length, what);
  return at ? (sbfi_span){at, length} : (sbfi_span){"", 0};
}

static void *make(cursor *c, size_t count, size_t size) {
  if (c->status) return NULL;
  void *made = sbfi_arena_allocate(c->scratch, count ? count : 1, size);
  if (!made)
    c->status = sbfi_diagnose(c->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while a scene was read");
  return made;
}

static const float *read_f32s(cursor *c, size_t count, size_t width, const char *what, sbfi_span name) {
  const float *values = take(c, count, width * sizeof(float), what);
  for (size_t i = 0; values && i < count * width; i++)
    if (!isfinite(values[i])) {
      fail_not_finite(c, what, name, i / width);
      return NULL;
    }
  return values;
}

static sbfi_matrix read_matrix(cursor *c, const char *what, sbfi_span name) {
  sbfi_matrix matrix = sbfi_matrix_identity();
  const float *values = read_f32s(c, 1, 16, what, name);
  for (int i = 0; values && i < 12; i++) matrix.at[i / 4][i % 4] = values[i];
  return matrix;
}

static bool all_below(const uint32_t *values, size_t count, uint32_t bound) {
  for (size_t i = 0; i < count; i++)
    if (values[i] >= bound) return false;
  return true;
}

static void read_header(cursor *c, sbfi_raw_scene *scene) {
  if (read_u32(c, "its beginning") != SBFI_STREAM_MAGIC) fail(c, "its beginning");
  if (read_u32(c, "its version") != SBFI_STREAM_VERSION) fail(c, "its version");
  scene->generator = read_string(c, "the generator");
  scene->unit_scale_factor = read_f64(c, "the unit");
  if (!isfinite(scene->unit_scale_factor)) fail_not_finite(c, "the unit", sbfi_span_of("scene"), 0);
  for (int i = 0; i < 6; i++) scene->axes[i] = (int32_t)read_u32(c, "the axes");
  scene->incomplete = read_u32(c, "the header") != 0;
}

static void read_limits(cursor *c, sbfi_raw_node *node) {
  uint32_t stated = read_u32(c, "the limits of a node");
  if (stated >> SBFI_LIMITS) fail(c, "the limits of a node");
  for (int i = 0; !c->status && i < SBFI_LIMITS; i++) {
    if (!(stated >> i & 1)) continue;
    const float *bounds = read_f32s(c, 1, 2, "the limits", node->name);
    if (bounds) node->limits[i] = (sbfi_scene_limit){true, bounds[0], bounds[1]};
  }
}

static void read_nodes(cursor *c, sbfi_raw_scene *scene) {
  scene->node_count = read_count(c, 88, "the nodes");
  if (scene->node_count > INT32_MAX) fail(c, "the nodes");
  scene->nodes = make(c, scene->node_count, sizeof *scene->nodes);
  for (uint32_t i = 0; !c->status && i < scene->node_count; i++) {
    sbfi_raw_node *node = &scene->nodes[i];
    node->name = read_string(c, "a node");
    node->parent = (int32_t)read_u32(c, "a node");
    uint32_t kind = read_u32(c, "a node");
    node->number = (int32_t)read_u32(c, "a node");
    node->local = read_matrix(c, "the transform", node->name);
    read_limits(c, node);
    node->mesh_count = read_count(c, 4, "the meshes of a node");
    node->meshes = take(c, node->mesh_count, 4, "the meshes of a node");
    if (node->number < SBF_NONE) fail(c, "the number of a node");
    if (node->parent < SBF_NONE || node->parent >= (int32_t)i) fail(c, "the parent of a node");
    if (kind > SBFI_STREAM_BONE) fail(c, "the kind of a node");
    node->kind = (sbfi_stream_kind)kind;
  }
}

static void read_polygons(cursor *c, sbfi_raw_mesh *mesh) {
  mesh->polygon_count = read_count(c, 4, "the polygons");
  mesh->polygon_sizes = take(c, mesh->polygon_count, 4, "the polygons");
  mesh->corner_count = read_count(c, 4, "the corners");
  mesh->corners = take(c, mesh->corner_count, 4, "the corners");
  if (c->status) return;
  uint64_t sum = 0;
  for (uint32_t i = 0; i < mesh->polygon_count; i++) sum += mesh->polygon_sizes[i];
  if (sum != mesh->corner_count) fail(c, "the sizes of the polygons");
  if (!all_below(mesh->corners, mesh->corner_count, mesh->vertex_count)) fail_index(c, "polygons");
}

static void read_bones(cursor *c, sbfi_raw_mesh *mesh) {
  mesh->bone_count = read_count(c, 72, "the bones of a mesh");
  sbfi_raw_bone *bones = make(c, mesh->bone_count, sizeof *bones);
  mesh->bones = bones;
  for (uint32_t i = 0; !c->status && i < mesh->bone_count; i++) {
    bones[i].name = read_string(c, "a bone");
    bones[i].bind = read_matrix(c, "the bind transform", bones[i].name);
    bones[i].weight_count = read_count(c, 8, "the weights of a bone");
    bones[i].vertices = take(c, bones[i].weight_count, 4, "the weights of a bone");
    bones[i].weights = read_f32s(c, bones[i].weight_count, 1, "the weights", bones[i].name);
    if (!c->status && !all_below(bones[i].vertices, bones[i].weight_count, mesh->vertex_count))
      fail_index(c, "weights of a bone");
  }
}

static void read_shapes(cursor *c, sbfi_raw_mesh *mesh) {
  mesh->shape_count = read_count(c, 8, "the shapes");
  sbfi_raw_shape *shapes = make(c, mesh->shape_count, sizeof *shapes);
  mesh->shapes = shapes;
  for (uint32_t i = 0; !c->status && i < mesh->shape_count; i++) {
    shapes[i].name = read_string(c, "a shape");
    const float *weight = read_f32s(c, 1, 1, "the weight of shape", shapes[i].name);
    shapes[i].weight = weight ? *weight : 0;
    shapes[i].positions =
        (const sbf_vec3 *)read_f32s(c, mesh->vertex_count, 3, "the positions of shape", shapes[i].name);
  }
}

static void read_mesh(cursor *c, sbfi_raw_mesh *mesh) {
  mesh->name = read_string(c, "a mesh");
  mesh->material = (int32_t)read_u32(c, "a mesh");
  mesh->vertex_count = read_count(c, 12, "the vertices");
  mesh->positions = (const sbf_vec3 *)read_f32s(c, mesh->vertex_count, 3, "the positions", mesh->name);
  uint32_t has_normals = read_u32(c, "the normals");
  if (has_normals > 1) fail(c, "the normals");
  if (has_normals == 1)
    mesh->normals = (const sbf_vec3 *)read_f32s(c, mesh->vertex_count, 3, "the normals", mesh->name);
  uint32_t has_colors = read_u32(c, "the colours");
  if (has_colors > 1) fail(c, "the colours");
  if (has_colors == 1)
    mesh->colors = (const sbf_vec4 *)read_f32s(c, mesh->vertex_count, 4, "the colours", mesh->name);
  mesh->uv_set_count = read_u32(c, "the uv sets");
  if (mesh->uv_set_count > 64) fail(c, "the uv sets");
  const sbf_vec2 **uvs = make(c, c->status ? 0 : mesh->uv_set_count, sizeof *uvs);
  for (uint32_t i = 0; !c->status && i < mesh->uv_set_count; i++)
    uvs[i] = (const sbf_vec2 *)read_f32s(c, mesh->vertex_count, 2, "the texture coordinates", mesh->name);
  mesh->uvs = uvs;
  read_polygons(c, mesh);
  read_bones(c, mesh);
  read_shapes(c, mesh);
}

static void read_meshes(cursor *c, sbfi_raw_scene *scene) {
  scene->mesh_count = read_count(c, 40, "the meshes");
  sbfi_raw_mesh *meshes = make(c, scene->mesh_count, sizeof *meshes);
  scene->meshes = meshes;
  for (uint32_t i = 0; !c->status && i < scene->mesh_count; i++) read_mesh(c, &meshes[i]);
  for (uint32_t i = 0; !c->status && i < scene->node_count; i++)
    if (!all_below(scene->nodes[i].meshes, scene->nodes[i].mesh_count, scene->mesh_count))
      fail(c, "the meshes of a node");
}

static sbfi_span read_image(cursor *c, sbfi_scene_uv_transform *uv, sbfi_span material) {
  sbfi_span path = read_string(c, "the images of a material");
  uv->uv_set = read_u32(c, "the images of a material");
  const float *values = read_f32s(c, 1, 5, "the texture transforms", material);
  if (!values) return path;
  memcpy(uv->offset, values, sizeof uv->offset);
  uv->rotation = values[2];
  memcpy(uv->scale, values + 3, sizeof uv->scale);
  return path;
}

static void read_materials(cursor *c, sbfi_raw_scene *scene) {
  scene->material_count = read_count(c, 136, "the materials");
  sbfi_raw_material *materials = make(c, scene->material_count, sizeof *materials);
  scene->materials = materials;
  for (uint32_t i = 0; !c->status && i < scene->material_count; i++) {
    sbfi_raw_material *m = &materials[i];
    m->name = read_string(c, "a material");
    const float *values = read_f32s(c, 1, 10, "the values", m->name);
    uint32_t alpha_mode = read_u32(c, "a material"), double_sided = read_u32(c, "a material");
    sbfi_scene_uv_transform *const uvs[SBFI_RAW_MAPS] = {
        &m->values.base_color_uv, &m->values.metallic_roughness_uv, &m->values.normal_uv};
    for (int k = 0; k < SBFI_RAW_MAPS; k++) m->images[k] = read_image(c, uvs[k], m->name);
    if (alpha_mode > SBFI_ALPHA_BLEND) fail(c, "a material");
    if (c->status) return;
    memcpy(m->values.base_color, values, sizeof m->values.base_color);
    memcpy(m->values.emissive, values + 4, sizeof m->values.emissive);
    m->values.metallic = values[7];
    m->values.roughness = values[8];
    m->values.alpha_cutoff = values[9];
    m->values.alpha_mode = (sbfi_alpha_mode)alpha_mode;
    m->values.double_sided = double_sided != 0;
  }
  /* Materials come after the meshes in the stream: an invalid index means that the mesh has no material. */
  sbfi_raw_mesh *meshes = scene->meshes;
  for (uint32_t i = 0; !c->status && i < scene->mesh_count; i++)
    if ((uint32_t)meshes[i].material >= scene->material_count) meshes[i].material = SBF_NONE;
}

static void read_images(cursor *c, sbfi_raw_scene *scene) {
  scene->image_count = read_count(c, 12, "the images");
  sbfi_raw_image *images = make(c, scene->image_count, sizeof *images);
  scene->images = images;
  for (uint32_t i = 0; !c->status && i < scene->image_count; i++) {
    images[i].name = read_string(c, "an image");
    images[i].extension = read_string(c, "an image");
    images[i].byte_count = read_u32(c, "an image");
    images[i].bytes = read_padded(c, images[i].byte_count, "an image");
  }
}

double sbfi_raw_key(const sbfi_raw_keys *keys, uint32_t width, uint32_t index, float *values) {
  const uint8_t *at = keys->at + (size_t)index * (sizeof(double) + width * sizeof(float));
  double time;
  memcpy(&time, at, sizeof time);
  memcpy(values, at + sizeof time, width * sizeof(float));
  return time;
}

static void read_keys(cursor *c, sbfi_raw_keys *keys, uint32_t width, sbfi_span name) {
  size_t size = sizeof(double) + width * sizeof(float);
  keys->count = read_count(c, size, "the keys");
  keys->at = take(c, keys->count, size, "the keys");
  for (uint32_t i = 0; !c->status && i < keys->count; i++) {
    float values[4];
    double time = sbfi_raw_key(keys, width, i, values);
    bool good = isfinite(time);
    for (uint32_t k = 0; k < width; k++) good = good && isfinite(values[k]);
    if (!good) fail_not_finite(c, "the keys", name, i);
  }
}

static void read_clips(cursor *c, sbfi_raw_scene *scene) {
  scene->clip_count = read_count(c, 24, "the clips");
  sbfi_raw_clip *clips = make(c, scene->clip_count, sizeof *clips);
  scene->clips = clips;
  for (uint32_t i = 0; !c->status && i < scene->clip_count; i++) {
    clips[i].name = read_string(c, "a clip");
    clips[i].duration_ticks = read_f64(c, "a clip");
    clips[i].ticks_per_second = read_f64(c, "a clip");
    if (!isfinite(clips[i].duration_ticks) || !isfinite(clips[i].ticks_per_second))
      fail_not_finite(c, "the duration", clips[i].name, 0);
    clips[i].channel_count = read_count(c, 16, "the channels");
    sbfi_raw_channel *channels = make(c, clips[i].channel_count, sizeof *channels);
    clips[i].channels = channels;
    for (uint32_t k = 0; !c->status && k < clips[i].channel_count; k++) {
      channels[k].node_name = read_string(c, "a channel");
      for (int track = 0; track < SBFI_RAW_TRACKS; track++)
        read_keys(c, &channels[k].keys[track], track == SBFI_RAW_ROTATION ? 4 : 3, channels[k].node_name);
    }
  }
}

sbf_status sbfi_raw_scene_read(
    sbfi_raw_scene *scene, const uint8_t *bytes, size_t size, sbfi_arena *scratch, sbf_diagnostic *error) {
  if (size == 0) bytes = (const uint8_t *)"";
  cursor c = {.at = bytes, .end = bytes + size, .scratch = scratch, .error = error};
  *scene = (sbfi_raw_scene){0};
  read_header(&c, scene);
  read_nodes(&c, scene);
  read_meshes(&c, scene);
  read_materials(&c, scene);
  read_images(&c, scene);
  read_clips(&c, scene);
  if (read_u32(&c, "its end") != SBFI_STREAM_END || left(&c)) fail(&c, "its end");
  return c.status;
}
