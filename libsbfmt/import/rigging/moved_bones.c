#include "import/rigging/moved_bones.h"

#include <math.h>
#include <string.h>

#include "import/rigging/similarity.h"
#include "motion/quatd.h"

static void quaternion_of(const sbfi_matrix *m, double to[4]) {
  double trace = m->at[0][0] + m->at[1][1] + m->at[2][2];
  double squares[4] = {
      1 + 2 * m->at[0][0] - trace, 1 + 2 * m->at[1][1] - trace, 1 + 2 * m->at[2][2] - trace, 1 + trace};
  int best = 0;
  for (int k = 1; k < 4; k++)
    if (squares[k] > squares[best]) best = k;
  double twice = sqrt(squares[best]); /* of the largest component */
  to[best] = twice / 2;
  for (int k = 0; k < 3; k++) {
    int next = (k + 1) % 3, last = (k + 2) % 3;
    double difference = (m->at[last][next] - m->at[next][last]) / (2 * twice);
    if (best == 3)
      to[k] = difference;
    else if (best == k)
      to[3] = difference;
    if (best < 3 && k != best) to[k] = (m->at[k][best] + m->at[best][k]) / (2 * twice);
  }
}

static void move_bones(const sbfi_matrix *motions, sbf_bone *bones, uint32_t count) {
  for (uint32_t b = 0; b < count; b++) {
    sbf_quat *q = &bones[b].rotation;
    double turn[4], rotation[4] = {(double)q->x, (double)q->y, (double)q->z, (double)q->w};
    quaternion_of(&motions[b], turn);
    sbfi_quatd_multiply(turn, rotation, rotation);
    *q = (sbf_quat){(float)rotation[0], (float)rotation[1], (float)rotation[2], (float)rotation[3]};
    bones[b].head = sbfi_d3_rounded(sbfi_similarity_apply(&motions[b], sbfi_d3_of(bones[b].head)));
  }
}

/* Whether the node belongs to a bone that moves differently from the parent node. */
static bool turns_itself(
    const sbfi_conversion *c, const sbfi_matrix *motions, const sbfi_scene_node *nodes, uint32_t node) {
  int32_t bone = c->bone_of_node[node], parent = nodes[node].parent;
  if (bone == SBF_NONE || c->node_of_bone[bone] != node) return false;
  int32_t above = parent == SBF_NONE ? SBF_NONE : c->bone_of_node[parent];
  return above == SBF_NONE || memcmp(&motions[bone], &motions[above], sizeof *motions) != 0;
}

/* Nodes of a bone move with it, others with their parent. */
static bool move_nodes(
    const sbfi_conversion *c, const sbfi_matrix *motions, sbfi_scene_node *nodes, uint32_t count) {
  sbfi_matrix to_scene, above;
  if (!sbfi_matrix_invert(&c->rig_to_asset, &to_scene)) return false;
  for (uint32_t n = 0; n < count; n++) {
    int32_t parent = nodes[n].parent;
    if (!turns_itself(c, motions, nodes, n)) {
      if (parent != SBF_NONE) nodes[n].world = sbfi_matrix_multiply(&nodes[parent].world, &nodes[n].local);
      continue;
    }
    sbfi_matrix motion = sbfi_matrix_multiply(&motions[c->bone_of_node[n]], &c->rig_to_asset);
    motion = sbfi_matrix_multiply(&to_scene, &motion);
    nodes[n].world = sbfi_matrix_multiply(&motion, &nodes[n].world);
    if (parent == SBF_NONE)
      nodes[n].local = nodes[n].world;
    else if (sbfi_matrix_invert(&nodes[parent].world, &above))
      nodes[n].local = sbfi_matrix_multiply(&above, &nodes[n].world);
  }
  return true;
}

bool sbfi_rig_move_bones(sbfi_rigging *r, const sbfi_matrix *motions) {
  sbfi_arena *arena = &r->c->scratch;
  const sbf_bone_list bones = r->c->asset->bones;
  sbfi_scene *scene = sbfi_arena_copy(arena, r->rig.scene, 1, sizeof *scene);
  if (!scene) return false;
  sbfi_scene_node *nodes = sbfi_arena_copy(arena, scene->nodes, scene->node_count, sizeof *nodes);
  if (!nodes) return false;
  /* a rig with a singular transform has no poses */
  if (!move_nodes(r->c, motions, nodes, scene->node_count)) return true;
  scene->nodes = nodes;
  r->c->rig = r->rig.scene = scene;
  move_bones(motions, (sbf_bone *)(uintptr_t)bones.at, bones.count); /* the conversion owns the asset */
  return true;
}

void sbfi_rig_turn(sbfi_rigging *r, const sbfi_matrix *turn) {
  sbf_bone_list bones = r->c->asset->bones;
  sbf_bone *at = (sbf_bone *)(uintptr_t)bones.at; /* the conversion owns the asset */
  for (uint32_t b = 0; b < bones.count; b++) move_bones(turn, &at[b], 1);
  r->c->rig_to_asset = sbfi_matrix_multiply(turn, &r->c->rig_to_asset);
  r->alignment.to_asset = sbfi_matrix_multiply(turn, &r->alignment.to_asset);
}
