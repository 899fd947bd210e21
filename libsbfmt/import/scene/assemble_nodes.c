/* Assembles nodes of a scene; merges the nodes that an importer made of one node's pivots. */
#include <string.h>

#include "import/scene/assembly.h"
#include "model/bone_ends.h"

/* assimp splits the transform of an FBX node into a chain of helpers, one per pivot and offset. */
static const char pivot_mark[] = "_$AssimpFbx$_";
enum { LONGEST_PIVOT_CHAIN = 32 }; /* assimp creates 16 at most */

static bool contains(sbfi_span text, const char *part) {
  size_t length = strlen(part);
  for (size_t i = 0; i + length <= text.length; i++)
    if (memcmp(text.at + i, part, length) == 0) return true;
  return false;
}

bool sbfi_is_folded(const sbfi_assembly *a, uint32_t raw_node) {
  return a->new_from_old[raw_node] == SBF_NONE;
}

/* Requires a matching name and position, because other tools write leaves that are bones of their own. */
static void mark_ends(sbfi_assembly *a, uint32_t node_count) {
  for (uint32_t i = 0; i < node_count; i++) {
    sbfi_span name = a->raw->nodes[a->old_from_new[i]].name;
    a->nodes[i].is_end = sbfi_name_is_end(name.at, name.length);
  }
  for (uint32_t i = 0; i < node_count; i++)
    if (a->nodes[i].parent != SBF_NONE) a->nodes[a->nodes[i].parent].is_end = false;
}

static bool copy_limits(sbfi_assembly *a, sbfi_scene_node *node, const sbfi_scene_limit *limits) {
  bool good = true;
  for (int i = 0; i < SBFI_LIMITS; i++) {
    node->limits[i] = limits[i];
    if (!limits[i].stated || limits[i].min <= limits[i].max) continue;
    node->limits[i].stated = false;
    good = good && sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_IGNORED, 0,
                       "node \"%s\" states a joint limit from %g to %g, which limits nothing and is left out",
                       node->name, (double)limits[i].min, (double)limits[i].max);
  }
  return good;
}

/* Merges a helper's transform into every node below it. */
static bool fold(sbfi_assembly *a) {
  const sbfi_raw_scene *raw = a->raw;
  sbfi_matrix *above =
      sbfi_arena_allocate(&a->scratch, raw->node_count, sizeof *above); /* product of the helpers */
  int32_t *kept_parent = sbfi_arena_allocate(&a->scratch, raw->node_count, sizeof *kept_parent);
  /* number of consecutive helpers up to this node */
  uint8_t *chain = sbfi_arena_allocate(&a->scratch, raw->node_count, 1);
  if (!above || !kept_parent || !chain) return false;
  uint32_t count = 0;
  for (uint32_t i = 0; i < raw->node_count; i++) {
    const sbfi_raw_node *node = &raw->nodes[i];
    int32_t parent = node->parent;
    bool below_helper = parent != SBF_NONE && sbfi_is_folded(a, (uint32_t)parent);
    sbfi_matrix local = below_helper ? sbfi_matrix_multiply(&above[parent], &node->local) : node->local;
    int32_t kept = parent == SBF_NONE ? SBF_NONE
                   : below_helper     ? kept_parent[parent]
                                      : a->new_from_old[parent];
    uint8_t length = below_helper ? chain[parent] : 0;
    if (!node->mesh_count && length < LONGEST_PIVOT_CHAIN && contains(node->name, pivot_mark)) {
      a->new_from_old[i] = SBF_NONE;
      above[i] = local;
      kept_parent[i] = kept;
      chain[i] = (uint8_t)(length + 1);
      continue;
    }
    const char *name = sbfi_scene_string(a->scene, node->name);
    if (!name) return false;
    a->nodes[count] = (sbfi_scene_node){.name = name, .parent = kept, .local = local, .number = node->number};
    if (!copy_limits(a, &a->nodes[count], raw->nodes[i].limits)) return false;
    a->old_from_new[count] = i;
    a->new_from_old[i] = (int32_t)count++;
  }
  a->scene->node_count = count;
  return true;
}

bool sbfi_assemble_nodes(sbfi_assembly *a) {
  uint32_t count = a->raw->node_count;
  if (!count) return true;
  a->nodes = sbfi_arena_allocate(&a->scene->arena, count, sizeof *a->nodes);
  a->new_from_old = sbfi_arena_allocate(&a->scratch, count, sizeof *a->new_from_old);
  a->old_from_new = sbfi_arena_allocate(&a->scratch, count, sizeof *a->old_from_new);
  if (!a->nodes || !a->new_from_old || !a->old_from_new || !fold(a)) return false;
  sbfi_scene_set_worlds(a->nodes, a->scene->node_count);
  mark_ends(a, a->scene->node_count);
  a->scene->nodes = a->nodes;
  return true;
}

/* Rank of a node by how likely a skin or a clip refers to it among nodes with equal names. */
static int rank_of(const sbfi_assembly *a, uint32_t node) {
  const sbfi_raw_node *raw = &a->raw->nodes[a->old_from_new[node]];
  if (a->nodes[node].is_bone) return 3;
  return raw->kind == SBFI_STREAM_BONE ? 2 : raw->mesh_count == 0 ? 1 : 0;
}

static void choose(sbfi_assembly *a) {
  for (size_t i = 0; i < a->names.names.count; i++) a->node_of_name[i] = SBF_NONE;
  for (uint32_t node = 0; node < a->scene->node_count; node++) {
    int64_t name = sbfi_name_table_find(&a->names, a->raw->nodes[a->old_from_new[node]].name);
    int32_t *chosen = &a->node_of_name[name];
    int difference = *chosen == SBF_NONE ? 1 : rank_of(a, node) - rank_of(a, (uint32_t)*chosen);
    if (difference > 0) *chosen = (int32_t)node;
    a->ties[name] = difference > 0 ? 0 : a->ties[name] + (difference == 0);
  }
}

int32_t sbfi_assembly_find(sbfi_assembly *a, sbfi_span name, bool *good) {
  int64_t found = sbfi_name_table_find(&a->names, name);
  if (found < 0) return SBF_NONE;
  int32_t node = a->node_of_name[found];
  if (a->ties[found]) {
    if (!sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_NAME_AMBIGUOUS, 0,
            "%u nodes have the name \"%s\", to which a skin or a clip refers: the first is used; give each "
            "node its own name and export again",
            a->ties[found] + 1, a->nodes[node].name))
      *good = false;
    a->ties[found] = 0; /* one warning is enough */
  }
  return node;
}

static bool is_gltf(const char *format) {
  return strcmp(format, "glb") == 0 || strcmp(format, "gltf") == 0;
}

/* Lowest common ancestor of all bones; also counts the bones in each subtree. */
static int32_t common_ancestor(const sbfi_assembly *a, uint32_t *bones_below) {
  uint32_t all = 0;
  int32_t deepest = SBF_NONE;
  for (uint32_t i = a->scene->node_count; i-- > 0;) {
    bones_below[i] += a->nodes[i].is_bone;
    all += a->nodes[i].is_bone;
    if (a->nodes[i].parent != SBF_NONE) bones_below[a->nodes[i].parent] += bones_below[i];
  }
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    if (all && bones_below[i] == all) deepest = (int32_t)i;
  return deepest;
}

/* A glTF without a skin may still be a rig with rigidly attached meshes: marks the nodes without a mesh
 * below the common ancestor as bones if at least two of them carry a mesh. */
static void mark_rigid_rig(sbfi_assembly *a) {
  sbfi_scene_node *nodes = a->nodes;
  uint32_t count = a->scene->node_count, mesh_nodes = 0;
  int32_t last = SBF_NONE;
  for (uint32_t i = 0; i < count; i++) {
    if (nodes[i].is_bone) return;
    int32_t parent = nodes[i].parent;
    if (!a->raw->nodes[a->old_from_new[i]].mesh_count || parent == SBF_NONE || parent == last) continue;
    bool on_mesh = a->raw->nodes[a->old_from_new[parent]].mesh_count > 0;
    if (on_mesh || nodes[parent].parent == SBF_NONE) continue;
    mesh_nodes++;
    last = parent;
  }
  for (uint32_t i = 0; i < count && mesh_nodes >= 2; i++)
    nodes[i].is_bone = nodes[i].parent != SBF_NONE && !a->raw->nodes[a->old_from_new[i]].mesh_count;
}

static bool has_bones(const sbfi_assembly *a) {
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    if (a->nodes[i].is_bone) return true;
  return false;
}

static bool is_armature_name(const char *name) {
  static const char word[] = "armature";
  size_t i = 0;
  while (word[i] && (name[i] | 0x20) == word[i]) i++;
  return !word[i] && (!name[i] || name[i] == '.'); /* Armature.001 */
}

/* Formats in which programs export an armature without meshes. In other formats a file without meshes is
 * damaged. */
static bool may_be_armature(const char *format) {
  static const char *const forms[] = {"fbx", "dae", "x", "blend"};
  bool is_one = is_gltf(format);
  for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) is_one = is_one || strcmp(format, forms[i]) == 0;
  return is_one;
}

/* A file without meshes and declared joints: at least two nodes form a skeleton, from the first that is
 * not a frame around it. Frames are the root that importers add and an armature's own node. */
static void mark_unskinned_skeleton(sbfi_assembly *a) {
  sbfi_scene_node *nodes = a->nodes;
  uint32_t count = 0;
  for (uint32_t i = 0; i < a->scene->node_count; i++) {
    const sbfi_raw_node *raw = &a->raw->nodes[a->old_from_new[i]];
    int32_t parent = nodes[i].parent;
    bool below = parent != SBF_NONE && nodes[parent].is_bone;
    bool is_frame = (parent == SBF_NONE && !is_gltf(a->scene->format)) || is_armature_name(nodes[i].name) ||
                    strcmp(nodes[i].name, "ROOT") == 0;
    nodes[i].is_bone = raw->kind != SBFI_STREAM_NO_BONE && (below || !is_frame);
    count += nodes[i].is_bone;
  }
  for (uint32_t i = 0; count < 2 && i < a->scene->node_count; i++) nodes[i].is_bone = false;
}

/* Blender writes a skeleton of several roots as a BVH under a root "__0" at the origin, which is no bone. */
static bool is_invented_root(const sbfi_scene_node *nodes, uint32_t count, uint32_t node) {
  const char *digits = nodes[node].name + 2;
  uint32_t children = 0;
  if (strncmp(nodes[node].name, "__", 2) != 0 || !*digits || digits[strspn(digits, "0123456789")])
    return false;
  for (int row = 0; row < 3; row++)
    if (nodes[node].local.at[row][3] != 0) return false;
  for (uint32_t i = node + 1; i < count; i++) children += nodes[i].parent == (int32_t)node;
  return children > 1;
}

/* glTF lists the joints of a skin, and FBX marks limbs. In other formats only joints with points are
 * known: adds nodes that connect them and their descendants, but never the root of the file. In a BVH
 * every node is a joint. */
static bool mark_bones(sbfi_assembly *a) {
  const char *format = a->scene->format;
  sbfi_scene_node *nodes = a->nodes;
  uint32_t count = a->scene->node_count;
  bool declared = false;
  for (uint32_t i = 0; i < count; i++)
    if (a->raw->nodes[a->old_from_new[i]].kind == SBFI_STREAM_BONE) declared = nodes[i].is_bone = true;
  if (is_gltf(format)) mark_rigid_rig(a);
  if (!a->raw->mesh_count && may_be_armature(format) && !has_bones(a)) mark_unskinned_skeleton(a);
  if (is_gltf(format) || strcmp(format, "fbx") == 0 || (declared && !a->raw->mesh_count)) return true;
  uint32_t *bones_below = sbfi_arena_allocate(&a->scratch, count, sizeof *bones_below);
  if (!bones_below) return false;
  int32_t top = common_ancestor(a, bones_below);
  bool all = strcmp(format, "bvh") == 0, invented = sbfi_is_invented(a);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_raw_node *raw = &a->raw->nodes[a->old_from_new[i]];
    bool has_parent = nodes[i].parent != SBF_NONE;
    bool below = has_parent && nodes[nodes[i].parent].is_bone;
    bool joins = has_parent && (int32_t)i >= top && bones_below[i] > 0;
    bool may = (raw->mesh_count == 0 || invented) && raw->kind != SBFI_STREAM_NO_BONE &&
               !sbfi_span_begins(raw->name, "EndSite") && !(all && is_invented_root(nodes, count, i));
    if (may && (all || below || joins)) nodes[i].is_bone = true;
  }
  return true;
}

/* assimp identifies the joints of a skin by name. Several equal ones are two armatures of one origin: a
 * single warning reports it and the effect on their skins. */
static bool report_equal_armatures(sbfi_assembly *a) {
  uint32_t count = 0;
  const char *example = NULL;
  for (int pass = 0; pass < 2 && count != 1; pass++) /* counts them, then removes their own warnings */
    for (uint32_t m = 0; m < a->raw->mesh_count; m++)
      for (uint32_t b = 0; b < a->raw->meshes[m].bone_count; b++) {
        int64_t name = sbfi_name_table_find(&a->names, a->raw->meshes[m].bones[b].name);
        if (name < 0 || !a->ties[name]) continue;
        const char *text = a->nodes[a->node_of_name[name]].name;
        if (!example) example = text;
        count += pass == 0 && (count == 0 || strcmp(text, example) != 0);
        if (pass) a->ties[name] = 0;
      }
  return count < 2 ||
         sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_NAME_AMBIGUOUS, 0,
             "several nodes have the name \"%s\", and other joints too, as in two armatures with "
             "equal names: the skins of all follow the first one, and lie on it; give the bones "
             "of each armature their own names, or export each character to its own file",
             example);
}

bool sbfi_assemble_bones(sbfi_assembly *a) {
  sbfi_name_table_init(&a->names, a->allocator);
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    if (sbfi_name_table_add(&a->names, a->raw->nodes[a->old_from_new[i]].name) < 0) return false;
  size_t name_count = a->names.names.count;
  if (!name_count) return true;
  a->node_of_name = sbfi_arena_allocate(&a->scratch, name_count, sizeof *a->node_of_name);
  a->ties = sbfi_arena_allocate(&a->scratch, name_count, sizeof *a->ties);
  if (!a->node_of_name || !a->ties) return false;
  choose(a);
  bool good = report_equal_armatures(a);
  for (uint32_t m = 0; m < a->raw->mesh_count && good; m++)
    for (uint32_t b = 0; b < a->raw->meshes[m].bone_count && good; b++) {
      int32_t node = sbfi_assembly_find(a, a->raw->meshes[m].bones[b].name, &good);
      if (node != SBF_NONE) a->nodes[node].is_bone = true;
    }
  if (!good || !mark_bones(a)) return false;
  choose(a);
  return true;
}
