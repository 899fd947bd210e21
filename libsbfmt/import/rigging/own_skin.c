/* Keeps the input's own skins if the rig has bones of the same names at about the same positions. */
#include <math.h>
#include <stdlib.h>

#include "import/rigging/similarity.h"
#include "import/rigging/weigh.h"

/* Distance of equally named joints as a fraction of the extent of the bones: from FAR the rig may be another
 * character's; if half of the joints are farther than GROSS, it is. */
static const double FAR = 0.03, GROSS = 0.12;

/* Copies weights of a skin if all joints have names of the rig's bones; false if one does not. */
static bool weigh_by_joints(sbfi_rigging *r, uint32_t mesh) {
  const sbfi_scene *scene = r->input.scene;
  const sbfi_scene_mesh *from = &scene->meshes[mesh];
  for (uint32_t i = 0; i < from->skin.starts[from->point_count]; i++)
    if (sbfi_find_bone_node(r, scene->nodes[from->skin.joints[from->skin.joint_index[i]].node].name) ==
        SBF_NONE)
      return false;
  for (uint32_t i = 0; i < from->point_count; i++) {
    sbfi_influences *to = &r->weights[r->input.mesh_starts[mesh] + i];
    for (uint32_t s = from->skin.starts[i]; s < from->skin.starts[i + 1]; s++) {
      int32_t bone =
          sbfi_find_bone_node(r, scene->nodes[from->skin.joints[from->skin.joint_index[s]].node].name);
      sbfi_influences_add(to, (uint32_t)bone, (double)from->skin.weights[s]);
    }
    sbfi_influences_finish(to);
    if (to->at[0].weight > 0) r->sources[r->input.mesh_starts[mesh] + i] = SBFI_WEIGHTS_NAMED;
  }
  return true;
}

/* --- Positions of the joints --------------------------------------------------------------------------- */

typedef struct joint_pair {
  int32_t input, rig; /* nodes */
  double distance;    /* fraction of the extent of the bones */
} joint_pair;

typedef struct joint_fit {
  joint_pair *pairs;
  uint32_t count;
  double input_m, rig_m; /* extents of the joints */
} joint_fit;

static int compare_distances(const void *a, const void *b) {
  double x = ((const joint_pair *)a)->distance, y = ((const joint_pair *)b)->distance;
  return (x > y) - (x < y);
}

static sbfi_d3 head_of(const sbfi_matrix *to_asset, const sbfi_scene_node *node) {
  const sbfi_matrix *m = &node->world;
  return sbfi_similarity_apply(to_asset, (sbfi_d3){m->at[0][3], m->at[1][3], m->at[2][3]});
}

static double extent_of(const sbfi_d3 *points, uint32_t count) {
  sbfi_d3 low = points[0], high = points[0];
  for (uint32_t i = 1; i < count; i++) {
    low = (sbfi_d3){fmin(low.x, points[i].x), fmin(low.y, points[i].y), fmin(low.z, points[i].z)};
    high = (sbfi_d3){fmax(high.x, points[i].x), fmax(high.y, points[i].y), fmax(high.z, points[i].z)};
  }
  return sbfi_d3_length(sbfi_d3_sub(high, low));
}

/* Compares the joints of the kept skins with the rig's bones of equal names, nearest first. */
static bool compare_joints(const sbfi_rigging *r, const bool *is_joint, joint_fit *fit) {
  const sbfi_scene *scene = r->input.scene;
  sbfi_arena *arena = &r->c->scratch;
  *fit = (joint_fit){.pairs = sbfi_arena_allocate(arena, (size_t)scene->node_count + 1, sizeof *fit->pairs)};
  sbfi_d3 *here = sbfi_arena_allocate(arena, (size_t)scene->node_count + 1, sizeof *here);
  sbfi_d3 *there = sbfi_arena_allocate(arena, (size_t)scene->node_count + 1, sizeof *there);
  if (!fit->pairs || !here || !there) return false;
  for (uint32_t n = 0; n < scene->node_count; n++) {
    int32_t bone = is_joint[n] ? sbfi_find_bone_node(r, scene->nodes[n].name) : SBF_NONE;
    if (bone == SBF_NONE) continue;
    here[fit->count] = head_of(&r->c->to_asset, &scene->nodes[n]);
    there[fit->count] = head_of(&r->c->rig_to_asset, &r->rig.scene->nodes[bone]);
    fit->pairs[fit->count++] = (joint_pair){(int32_t)n, bone, 0};
  }
  if (fit->count < 2) return true;
  fit->input_m = extent_of(here, fit->count);
  fit->rig_m = extent_of(there, fit->count);
  double size = fmax(fit->input_m, fit->rig_m);
  for (uint32_t i = 0; size > 0 && i < fit->count; i++)
    fit->pairs[i].distance = sbfi_d3_length(sbfi_d3_sub(here[i], there[i])) / size;
  qsort(fit->pairs, fit->count, sizeof *fit->pairs, compare_distances);
  return true;
}

static sbf_status check_joints(const sbfi_rigging *r, const bool *is_joint) {
  joint_fit fit;
  uint32_t far_count = 0;
  if (!compare_joints(r, is_joint, &fit)) return sbfi_convert_no_memory(r->c);
  if (fit.count < 2) return SBF_OK;
  for (uint32_t i = 0; i < fit.count; i++) far_count += fit.pairs[i].distance > FAR;
  const char *farthest = r->input.scene->nodes[fit.pairs[fit.count - 1].input].name;
  double max = 100 * fit.pairs[fit.count - 1].distance, median = fit.pairs[fit.count / 2].distance;
  if (median > GROSS)
    return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
        "the bones of %s have the names of the input's, but not their positions: half of them are farther "
        "off "
        "than %.0f %% of the extent, which is %.3g m in the input and %.3g m in the rig; leave out --rig, "
        "because the input has its own bones, or use this character's rig, or state --unit and --up",
        r->rig.scene->file, 100 * median, fit.input_m, fit.rig_m);
  if (far_count)
    sbfi_convert_warn(r->c, SBF_CODE_RIG_OTHER_MESH,
        "%u of %u bones of %s are not where the input has the bones of these names, '%.40s' by %.0f %% of "
        "the "
        "extent: the skin will bend beside its joints; if the rig belongs to another character or has "
        "another "
        "pose, leave out --rig, because the input has its own bones, or use this character's rig",
        far_count, fit.count, r->rig.scene->file, farthest, max);
  return SBF_OK;
}

sbf_status sbfi_weigh_by_own_skin(sbfi_rigging *r) {
  const sbfi_scene *scene = r->input.scene;
  bool *is_joint = sbfi_arena_allocate(&r->c->scratch, (size_t)scene->node_count + 1, sizeof *is_joint);
  if (!is_joint) return sbfi_convert_no_memory(r->c);
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    const sbfi_scene_skin *skin = &scene->meshes[m].skin;
    if (!skin->joint_count) continue;
    bool is_kept = weigh_by_joints(r, m);
    for (uint32_t j = 0; is_kept && j < skin->joint_count; j++) is_joint[skin->joints[j].node] = true;
    if (!is_kept)
      sbfi_convert_warn(r->c, SBF_CODE_IMPORT_IGNORED,
          "the skin of object '%s' names bones that the rig does not have, so its weights are left out",
          scene->nodes[scene->meshes[m].node].name);
  }
  return check_joints(r, is_joint);
}
