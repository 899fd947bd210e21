/* Reads the extensions of a glTF file, and relates its nodes to those of the scene. */
#include <string.h>

#include "base/base64.h"
#include "import/physics/physics.h"
#include "import/scene/trs.h"
#include "import/sibling_path.h"

static const char RIGID_BODIES[] = "KHR_physics_rigid_bodies", SHAPES[] = "KHR_implicit_shapes";

static bool no_memory(const sbfi_physics *p) {
  sbfi_diagnose(p->file.error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading the rigid bodies");
  return false;
}

static bool contains(const sbfi_file_content *content, const char *word) {
  size_t length = strlen(word);
  for (size_t i = 0; i + length <= content->size; i++) {
    const uint8_t *found = memchr(content->at + i, word[0], content->size - length + 1 - i);
    if (!found) return false;
    i = (size_t)(found - content->at);
    if (memcmp(found, word, length) == 0) return true;
  }
  return false;
}

/* Reads the first buffer of a glTF of text; a file without a readable buffer has none. */
static bool read_buffer(sbfi_physics *p, const char *path, const sbf_allocator *allocator) {
  static const char data[] = "data:";
  char beside[4096];
  const sbfi_json *uri = sbfi_json_get(sbfi_json_at(sbfi_json_get(p->file.root, "buffers"), 0), "uri");
  if (!uri || uri->type != SBFI_JSON_STRING) return true;
  const char *text = uri->text.at, *comma = strchr(text, ',');
  if (strncmp(text, data, strlen(data)) == 0) {
    sbfi_base64_reader reader = {0};
    size_t length = comma ? strlen(comma + 1) : 0, size = 0;
    uint8_t *bytes = sbfi_arena_allocate(&p->arena, SBFI_BASE64_CAPACITY(length), 1);
    if (!bytes) return no_memory(p);
    if (sbfi_base64_read(&reader, comma ? comma + 1 : "", length, bytes, &size) == length)
      p->file.binary = bytes, p->file.binary_size = size;
    return true;
  }
  if (sbfi_sibling_path(beside, sizeof beside, path, uri->text) &&
      sbfi_file_read(beside, (uint64_t)4 << 30, allocator, &p->buffer, NULL) == SBF_OK)
    p->file.binary = p->buffer.at, p->file.binary_size = p->buffer.size;
  return true;
}

static const sbfi_json *list_of(const sbfi_json *extension, const char *name) {
  const sbfi_json *list = sbfi_json_get(extension, name);
  return list && list->type == SBFI_JSON_ARRAY ? list : NULL;
}

static const sbfi_json *extension_of(const sbfi_json *object, const char *name) {
  return sbfi_json_get(sbfi_json_get(object, "extensions"), name);
}

/* A node has one parent, and no node is above itself. */
static bool find_parents(sbfi_physics *p) {
  for (uint32_t i = 0; i < p->node_count; i++) p->nodes[i].parent = SBF_NONE;
  for (uint32_t i = 0; i < p->node_count; i++) {
    const sbfi_json *children = sbfi_json_get(p->nodes[i].json, "children");
    for (uint32_t k = 0; children && children->type == SBFI_JSON_ARRAY && k < children->count; k++) {
      uint32_t child;
      if (!sbfi_json_u32(sbfi_json_at(children, k), &child) || child >= p->node_count)
        return sbfi_physics_fault(p, "node %u has a child that the file does not have", i);
      if (p->nodes[child].parent != SBF_NONE)
        return sbfi_physics_fault(
            p, "node %u is a child of the nodes %d and %u", child, (int)p->nodes[child].parent, i);
      p->nodes[child].parent = (int32_t)i;
    }
  }
  for (uint32_t i = 0; i < p->node_count; i++) {
    uint32_t depth = 0;
    for (int32_t up = p->nodes[i].parent; up != SBF_NONE; up = p->nodes[up].parent)
      if (++depth > p->node_count) return sbfi_physics_fault(p, "node %u is below itself", i);
  }
  return true;
}

/* ---- Nodes of the scene ---- */

/* The importer keeps the order of children; names need not be unique. */
typedef struct tree {
  sbfi_physics *p;
  int32_t *first, *next; /* (scene nodes) first child, and next child of the same parent */
  uint32_t *queue;       /* (count) matched glTF nodes */
  uint32_t count;
} tree;

static bool list_children(tree *t, const sbfi_scene *scene) {
  t->first = sbfi_arena_allocate(&t->p->arena, (size_t)scene->node_count + 1, sizeof *t->first);
  t->next = sbfi_arena_allocate(&t->p->arena, (size_t)scene->node_count + 1, sizeof *t->next);
  t->queue = sbfi_arena_allocate(&t->p->arena, (size_t)t->p->node_count + 1, sizeof *t->queue);
  if (!t->first || !t->next || !t->queue) return false;
  for (uint32_t i = 0; i < scene->node_count; i++) t->first[i] = t->next[i] = SBF_NONE;
  for (uint32_t i = scene->node_count; i-- > 1;) {
    int32_t parent = scene->nodes[i].parent;
    if (parent == SBF_NONE) continue;
    t->next[i] = t->first[parent];
    t->first[parent] = (int32_t)i;
  }
  return true;
}

/* Relates a list of glTF nodes to scene nodes from `first` on, and appends them to the queue. */
static void match_children(tree *t, const sbfi_json *numbers, int32_t first) {
  uint32_t number;
  for (uint32_t k = 0; numbers && numbers->type == SBFI_JSON_ARRAY && k < numbers->count; k++) {
    if (first == SBF_NONE) return;
    bool is_node = sbfi_json_u32(sbfi_json_at(numbers, k), &number) && number < t->p->node_count;
    if (is_node && t->p->nodes[number].scene_node == SBF_NONE) {
      t->p->nodes[number].scene_node = first;
      t->queue[t->count++] = number;
    }
    first = t->next[first];
  }
}

/* A scene's only node is the importer's root; for several nodes it adds a root. */
static bool match_scene(sbfi_physics *p, const sbfi_scene *scene) {
  tree t = {.p = p};
  uint32_t number = 0;
  for (uint32_t i = 0; i < p->node_count; i++) p->nodes[i].scene_node = SBF_NONE;
  if (!scene->node_count) return true;
  if (!list_children(&t, scene)) return no_memory(p);
  sbfi_json_u32(sbfi_json_get(p->file.root, "scene"), &number);
  const sbfi_json *tops = sbfi_json_get(sbfi_json_at(sbfi_json_get(p->file.root, "scenes"), number), "nodes");
  match_children(&t, tops, tops && tops->count == 1 ? 0 : t.first[0]);
  for (uint32_t i = 0; i < t.count; i++) {
    const sbfi_physics_node *node = &p->nodes[t.queue[i]];
    match_children(&t, sbfi_json_get(node->json, "children"), t.first[node->scene_node]);
  }
  return true;
}

/* ---- Roles of nodes ---- */

static void find_moving_nodes(sbfi_physics *p) {
  for (uint32_t i = 0; i < p->node_count; i++) {
    int32_t up = (int32_t)i;
    while (up != SBF_NONE && !sbfi_json_get(p->nodes[up].physics, "motion")) up = p->nodes[up].parent;
    p->nodes[i].moving_node = up;
    p->nodes[i].body = SBF_NONE;
  }
}

static void find_simulated(sbfi_physics *p, const sbfi_scene *scene) {
  bool any_motion = false, any_skin = false;
  for (uint32_t m = 0; m < scene->mesh_count; m++) any_skin |= scene->meshes[m].skin.joint_count > 0;
  for (uint32_t i = 0; i < p->node_count; i++) {
    const sbfi_json *motion = sbfi_json_get(p->nodes[i].physics, "motion");
    const sbfi_json *kinematic = sbfi_json_get(motion, "isKinematic");
    if (!motion || p->nodes[i].scene_node == SBF_NONE) continue;
    any_motion = true;
    p->is_simulated |= !kinematic || kinematic->type != SBFI_JSON_TRUE;
  }
  p->is_simulated |= !any_motion && !any_skin;
}

/* The other node of a joint, or SBF_NONE. */
static int32_t connected_node(const sbfi_physics *p, uint32_t node) {
  uint32_t other;
  const sbfi_json *joint = sbfi_json_get(p->nodes[node].physics, "joint");
  bool is_node = sbfi_json_u32(sbfi_json_get(joint, "connectedNode"), &other) && other < p->node_count;
  return is_node ? (int32_t)other : SBF_NONE;
}

/* A node without children that only places a joint is no bone. */
static void unmark_frame(const sbfi_physics *p, sbfi_scene_node *nodes, uint32_t node) {
  if (p->nodes[node].scene_node != SBF_NONE && !sbfi_json_get(p->nodes[node].json, "children"))
    nodes[p->nodes[node].scene_node].is_bone = false;
}

/* Bones of a simulated file are the nodes with a motion and, outside them or if there are clips, the joints
 * of skins: below a motion nothing else moves them. Bones that the importer guesses are none. */
static void mark_bones(sbfi_physics *p, sbfi_scene *scene) {
  sbfi_scene_node *nodes = (sbfi_scene_node *)(uintptr_t)scene->nodes; /* the scene is still being made */
  const sbfi_json *skins = list_of(p->file.root, "skins");
  for (uint32_t i = 0; p->is_simulated && i < scene->node_count; i++) nodes[i].is_bone = false;
  for (uint32_t s = 0; p->is_simulated && skins && s < skins->count; s++) {
    const sbfi_json *joints = list_of(sbfi_json_at(skins, s), "joints");
    for (uint32_t k = 0; joints && k < joints->count; k++) {
      uint32_t joint;
      bool is_node = sbfi_json_u32(sbfi_json_at(joints, k), &joint) && joint < p->node_count;
      if (!is_node || p->nodes[joint].scene_node == SBF_NONE) continue;
      if (p->nodes[joint].moving_node == SBF_NONE || scene->clip_count)
        nodes[p->nodes[joint].scene_node].is_bone = true;
    }
  }
  for (uint32_t i = 0; !p->is_simulated && i < p->node_count; i++) {
    int32_t other = connected_node(p, i);
    if (other == SBF_NONE) continue;
    unmark_frame(p, nodes, i);
    unmark_frame(p, nodes, (uint32_t)other);
  }
  for (uint32_t i = 0; i < p->node_count; i++)
    if (p->nodes[i].moving_node == (int32_t)i && p->nodes[i].scene_node != SBF_NONE)
      nodes[p->nodes[i].scene_node].is_bone = true;
}

static bool read(sbfi_physics *p, sbfi_scene *scene, const sbf_allocator *allocator, sbf_diagnostic *error) {
  const uint8_t *bytes = p->content.at;
  size_t size = p->content.size;
  bool binary = sbfi_glb_is_begun(bytes, size);
  sbf_status status =
      binary ? sbfi_glb_file_read(&p->file, bytes, size, &p->arena, error)
             : sbfi_glb_file_parse(&p->file, (const char *)bytes, size, NULL, 0, &p->arena, error);
  if (status != SBF_OK) return false;
  if (!binary && !read_buffer(p, scene->path, allocator)) return false;
  const sbfi_json *extension = extension_of(p->file.root, RIGID_BODIES);
  const sbfi_json *nodes = list_of(p->file.root, "nodes");
  p->shapes = list_of(extension_of(p->file.root, SHAPES), "shapes");
  p->materials = list_of(extension, "physicsMaterials");
  p->filters = list_of(extension, "collisionFilters");
  p->joints = list_of(extension, "physicsJoints");
  p->node_count = nodes ? nodes->count : 0;
  p->nodes = sbfi_arena_allocate(&p->arena, (size_t)p->node_count + 1, sizeof *p->nodes);
  if (!p->nodes) return no_memory(p);
  for (uint32_t i = 0; i < p->node_count; i++) {
    p->nodes[i].json = sbfi_json_at(nodes, i);
    p->nodes[i].physics = extension_of(p->nodes[i].json, RIGID_BODIES);
  }
  if (!find_parents(p) || !match_scene(p, scene)) return false;
  find_moving_nodes(p);
  find_simulated(p, scene);
  mark_bones(p, scene);
  return true;
}

static bool is_used(const sbfi_physics *p) {
  for (uint32_t i = 0; i < p->node_count; i++)
    if (p->nodes[i].physics && p->nodes[i].scene_node != SBF_NONE) return true;
  return false;
}

static bool is_gltf(const sbfi_scene *scene) {
  return strcmp(scene->format, "glb") == 0 || strcmp(scene->format, "gltf") == 0;
}

bool sbfi_physics_is_named(const sbfi_scene *scene, const sbf_allocator *allocator) {
  sbfi_file_content content;
  if (!is_gltf(scene) || sbfi_file_read(scene->path, (uint64_t)4 << 30, allocator, &content, NULL) != SBF_OK)
    return false;
  bool named = contains(&content, RIGID_BODIES);
  sbfi_file_content_free(&content);
  return named;
}

sbf_status sbfi_physics_read(
    sbfi_physics **physics, sbfi_scene *scene, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_file_content content;
  *physics = NULL;
  if (!is_gltf(scene)) return SBF_OK;
  sbf_status status = sbfi_file_read(scene->path, (uint64_t)4 << 30, allocator, &content, error);
  if (status != SBF_OK) return status;
  if (!contains(&content, RIGID_BODIES)) {
    sbfi_file_content_free(&content);
    return SBF_OK;
  }
  sbfi_arena arena;
  sbfi_arena_init(&arena, allocator, 0);
  sbfi_physics *p = sbfi_arena_allocate(&arena, 1, sizeof *p);
  if (!p) {
    sbfi_file_content_free(&content);
    sbfi_arena_free(&arena);
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for rigid bodies");
  }
  *p = (sbfi_physics){.arena = arena, .content = content, .scene = scene};
  bool good = read(p, scene, allocator, error);
  if (good && is_used(p))
    *physics = p;
  else
    sbfi_physics_free(p);
  return good ? SBF_OK : sbf_code_find(error->code)->fault;
}

void sbfi_physics_free(sbfi_physics *physics) {
  if (!physics) return;
  sbfi_arena arena = physics->arena; /* holds `physics` too */
  sbfi_file_content_free(&physics->content);
  sbfi_file_content_free(&physics->buffer);
  sbfi_arena_free(&arena);
}

/* ---- Transforms ---- */

sbfi_matrix sbfi_physics_world(const sbfi_conversion *c, uint32_t node) {
  const sbfi_physics_node *n = &c->physics->nodes[node];
  const sbfi_matrix own =
      n->scene_node == SBF_NONE ? sbfi_matrix_identity() : c->scene->nodes[n->scene_node].world;
  return sbfi_matrix_multiply(&c->to_asset, &own);
}

bool sbfi_physics_local(const sbfi_physics *p, uint32_t node, sbfi_matrix *local) {
  const sbfi_json *json = p->nodes[node].json;
  float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, t[3] = {0}, r[4] = {0, 0, 0, 1},
        s[3] = {1, 1, 1};
  if (!sbfi_physics_numbers(p, json, "matrix", 16, m) ||
      !sbfi_physics_numbers(p, json, "translation", 3, t) ||
      !sbfi_physics_numbers(p, json, "rotation", 4, r) || !sbfi_physics_numbers(p, json, "scale", 3, s))
    return false;
  if (sbfi_json_get(json, "matrix")) {
    for (int i = 0; i < 16; i++) local->at[i % 4][i / 4] = (double)m[i];
    return true;
  }
  sbfi_trs trs = {{t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]}};
  *local = sbfi_trs_compose(&trs);
  return true;
}
