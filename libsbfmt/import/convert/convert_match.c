/* Which bone carries which mesh, and what the section is called.
 *
 * A mesh that lies in the rig's own node tree hangs on the nearest bone above it. An object of another file
 * is first matched with a mesh node of the rig: names only say which object a node stands for, never which
 * bone it hangs on, because a section and a different bone may bear one name. */
#include <math.h>
#include <string.h>

#include "import/convert/conversion.h"

typedef struct place {
  double center[3];
} place;

static place center_of(const sbfi_scene_mesh *mesh, const sbfi_scene *scene, const sbfi_matrix *to_asset) {
  sbfi_matrix world = sbfi_scene_mesh_world(scene, mesh), m = sbfi_matrix_multiply(to_asset, &world);
  place p = {{0, 0, 0}};
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    sbf_vec3 at = sbfi_transform_point(&m, mesh->points[i]);
    p.center[0] += at.x;
    p.center[1] += at.y;
    p.center[2] += at.z;
  }
  for (int k = 0; k < 3 && mesh->point_count; k++) p.center[k] /= mesh->point_count;
  return p;
}

static double distance(place a, place b) {
  double d[3] = {a.center[0] - b.center[0], a.center[1] - b.center[1], a.center[2] - b.center[2]};
  return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/* How well an object's name stands for a mesh node of the rig; 0: not at all. Blender's OBJ names an object
 * `<object>_<data block>`. */
static int name_score(const char *object, const char *node, const char *data) {
  size_t length = strlen(node);
  if (strcmp(object, node) == 0) return 4;
  if (!*node || strncmp(object, node, length) != 0 || object[length] != '_') return 0;
  return strcmp(object + length + 1, data) == 0 ? 5 : 2;
}

/* The rig's mesh that an object stands for: the best name, of equals the nearest; -1 where none fits. */
static int32_t match_object(sbfi_conversion *c, const sbfi_scene_mesh *mesh, const place *rig_places) {
  const char *object = c->scene->nodes[mesh->node].name;
  place here = center_of(mesh, c->scene, &c->to_asset);
  int32_t best = -1;
  int best_score = 0;
  double best_distance = INFINITY;
  for (uint32_t i = 0; i < c->rig->mesh_count; i++) {
    const sbfi_scene_mesh *other = &c->rig->meshes[i];
    int score = name_score(object, c->rig->nodes[other->node].name, other->name);
    double away = distance(here, rig_places[i]);
    if (score == 0 || score < best_score || (score == best_score && away >= best_distance)) continue;
    best = (int32_t)i;
    best_score = score;
    best_distance = away;
  }
  return best;
}

/* The bone whose segment lies nearest to a point; of equals the last, for what lies beyond a bone's end is
 * its child's. */
static int32_t nearest_bone(const sbf_asset *asset, place p) {
  int32_t best = SBF_NONE;
  double best_squared = INFINITY;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *bone = &asset->bones.at[i];
    const sbf_quat q = bone->rotation;
    const double axis[3] = {
        2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
    const double head[3] = {bone->head.x, bone->head.y, bone->head.z};
    double along = 0, squared = 0;
    for (int k = 0; k < 3; k++) along += (p.center[k] - head[k]) * axis[k];
    along = fmin(fmax(along, 0), bone->length);
    for (int k = 0; k < 3; k++) squared += pow(p.center[k] - head[k] - along * axis[k], 2);
    if (squared > best_squared) continue;
    best_squared = squared;
    best = (int32_t)i;
  }
  return best;
}

static void match_own_tree(sbfi_conversion *c) {
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &c->scene->meshes[i];
    c->bone_of_mesh[i] = mesh->joint_count ? SBF_NONE : c->bone_of_node[mesh->node];
    c->name_of_mesh[i] = c->scene->nodes[mesh->node].name;
  }
}

static sbf_status match_other_file(sbfi_conversion *c) {
  place *places = NULL;
  if (c->rig->mesh_count) {
    places = sbfi_arena_allocate(&c->scratch, c->rig->mesh_count, sizeof *places);
    if (!places) return sbfi_convert_no_memory(c);
  }
  for (uint32_t i = 0; i < c->rig->mesh_count; i++)
    places[i] = center_of(&c->rig->meshes[i], c->rig, &c->rig_to_asset);
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &c->scene->meshes[i];
    const char *object = c->scene->nodes[mesh->node].name;
    int32_t other = match_object(c, mesh, places);
    c->name_of_mesh[i] = object;
    c->bone_of_mesh[i] = SBF_NONE;
    if (other >= 0) {
      c->bone_of_mesh[i] = c->bone_of_node[c->rig->meshes[other].node];
      c->name_of_mesh[i] = c->rig->nodes[c->rig->meshes[other].node].name;
    }
    if (c->bone_of_mesh[i] >= 0) continue;
    c->bone_of_mesh[i] = nearest_bone(c->asset, center_of(mesh, c->scene, &c->to_asset));
    sbfi_convert_warn(c, SBF_CODE_RIG_SECTION_GUESSED,
        "object '%s' hangs on no bone of the rig by name: it was given to the nearest, '%s'; name it as its "
        "node in "
        "the rig if that is wrong",
        object, c->asset->bones.at[c->bone_of_mesh[i]].name);
  }
  return SBF_OK;
}

sbf_status sbfi_match_sections(sbfi_conversion *c) {
  if (c->scene->mesh_count == 0) return SBF_OK;
  c->bone_of_mesh = sbfi_arena_allocate(&c->scratch, c->scene->mesh_count, sizeof *c->bone_of_mesh);
  c->name_of_mesh = sbfi_arena_allocate(&c->scratch, c->scene->mesh_count, sizeof *c->name_of_mesh);
  if (!c->bone_of_mesh || !c->name_of_mesh) return sbfi_convert_no_memory(c);
  if (c->asset->bones.count && c->rig != c->scene) return match_other_file(c);
  if (c->asset->bones.count) {
    match_own_tree(c);
    return SBF_OK;
  }
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    c->bone_of_mesh[i] = SBF_NONE;
    c->name_of_mesh[i] = c->scene->nodes[c->scene->meshes[i].node].name;
  }
  return SBF_OK;
}
