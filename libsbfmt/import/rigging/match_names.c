#include <math.h>
#include <string.h>

#include "import/rigging/weigh.h"

/* Score of an object's name as that of a mesh node of the rig; 0: no match. Blender's OBJ names an object
 * `<object>_<data block>`. */
static int name_score(const char *object, const char *node, const char *data) {
  size_t length = strlen(node);
  if (strcmp(object, node) == 0) return 4;
  if (!*node || strncmp(object, node, length) != 0 || object[length] != '_') return 0;
  return strcmp(object + length + 1, data) == 0 ? 5 : 2;
}

static void middle_of(
    const sbfi_scene_surface *s, uint32_t mesh, const sbfi_matrix *to_asset, double middle[3]) {
  uint32_t from = s->mesh_starts[mesh], to = s->mesh_starts[mesh + 1];
  middle[0] = middle[1] = middle[2] = 0;
  for (uint32_t i = from; i < to; i++) {
    sbf_vec3 p = sbfi_transform_point(to_asset, s->mesh.positions.at[i]);
    middle[0] += (double)p.x;
    middle[1] += (double)p.y;
    middle[2] += (double)p.z;
  }
  for (int k = 0; k < 3 && to > from; k++) middle[k] /= to - from;
}

/* Finds the rig's mesh with the best matching name, the nearest if equal; `*distance` is its distance.
 * SBF_NONE if none matches. */
static int32_t find_namesake(
    const sbfi_rigging *r, uint32_t mesh, const sbfi_matrix *to_asset, double *distance) {
  const sbfi_scene *rig = r->rig.scene;
  const char *object = r->input.scene->nodes[r->input.scene->meshes[mesh].node].name;
  sbfi_matrix same = sbfi_matrix_identity();
  double here[3], there[3];
  int best_score = 0;
  int32_t best = SBF_NONE;
  *distance = INFINITY;
  middle_of(&r->input, mesh, to_asset, here);
  for (uint32_t i = 0; i < rig->mesh_count; i++) {
    int score = name_score(object, rig->nodes[rig->meshes[i].node].name, rig->meshes[i].name);
    if (score == 0 || score < best_score) continue;
    middle_of(&r->rig, i, &same, there);
    double separation = hypot(hypot(here[0] - there[0], here[1] - there[1]), here[2] - there[2]);
    if (score == best_score && separation >= *distance) continue;
    best = (int32_t)i;
    best_score = score;
    *distance = separation;
  }
  return best;
}

int32_t sbfi_find_bone_node(const sbfi_rigging *r, const char *object) {
  const sbfi_scene *rig = r->rig.scene;
  for (uint32_t i = 0; i < rig->node_count; i++)
    if (rig->nodes[i].is_bone && strcmp(rig->nodes[i].name, object) == 0) return (int32_t)i;
  return SBF_NONE;
}

static void set_parent_node(sbfi_rigging *r, uint32_t mesh, int32_t node) {
  r->parent_nodes[mesh] = node;
  r->names[mesh] = r->rig.scene->nodes[node].name;
  for (uint32_t i = r->input.mesh_starts[mesh]; i < r->input.mesh_starts[mesh + 1]; i++)
    r->sources[i] = SBFI_WEIGHTS_NAMED;
}

/* A single object may be called Body or Hips and contain a whole character, so names of bones count only
 * if most objects have one. */
static void weigh_by_bones(sbfi_rigging *r) {
  const sbfi_scene *scene = r->input.scene;
  uint32_t named = 0;
  for (uint32_t m = 0; m < scene->mesh_count; m++)
    named += sbfi_find_bone_node(r, scene->nodes[scene->meshes[m].node].name) != SBF_NONE;
  if (named < 2 || 2 * named <= scene->mesh_count) return;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    int32_t bone = sbfi_find_bone_node(r, scene->nodes[scene->meshes[m].node].name);
    if (bone != SBF_NONE) set_parent_node(r, m, bone);
  }
}

double sbfi_names_distance(const sbfi_rigging *r, const sbfi_matrix *to_asset) {
  double sum = 0, distance;
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    if (find_namesake(r, m, to_asset, &distance) != SBF_NONE) sum += distance;
  return sum;
}

void sbfi_weigh_by_name(sbfi_rigging *r) {
  const sbfi_scene *rig = r->rig.scene;
  if (rig->mesh_count == 0) weigh_by_bones(r);
  for (uint32_t m = 0; rig->mesh_count && m < r->input.scene->mesh_count; m++) {
    double distance;
    int32_t other = find_namesake(r, m, &r->alignment.to_asset, &distance);
    if (other == SBF_NONE || rig->meshes[other].skin.joint_count) continue;
    if (r->c->bone_of_node[rig->meshes[other].node] != SBF_NONE)
      set_parent_node(r, m, rig->meshes[other].node);
  }
}
