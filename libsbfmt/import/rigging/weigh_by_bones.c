/* Weights from the bones alone, for points that nothing else gives any. */
#include "build/weights/weights.h"
#include "import/rigging/weigh.h"
#include "motion/carried_motion.h"

static uint32_t (*triangles_of(const sbfi_scene_surface *s, sbfi_arena *arena, uint32_t *count))[3] {
  uint32_t(*triangles)[3] =
      sbfi_arena_allocate(arena, (size_t)s->mesh.polygon_points.count + 1, sizeof *triangles);
  *count = 0;
  for (uint32_t p = 0, at = 0; triangles && p < s->mesh.polygon_sizes.count;
       at += s->mesh.polygon_sizes.at[p++]) {
    const uint32_t *points = s->mesh.polygon_points.at + at;
    for (uint32_t k = 2; k < s->mesh.polygon_sizes.at[p]; k++) {
      uint32_t *to = triangles[(*count)++];
      to[0] = points[0];
      to[1] = points[k - 1];
      to[2] = points[k];
    }
  }
  return triangles;
}

/* Where the rig has skins, only bones that they name move anything. */
static bool *find_deforming(const sbfi_rigging *r) {
  bool any = false,
       *deforming = sbfi_arena_allocate(&r->c->scratch, r->c->asset->bones.count + 1, sizeof *deforming);
  for (uint32_t m = 0; deforming && m < r->rig.scene->mesh_count; m++)
    for (uint32_t i = r->rig.mesh_starts[m];
         r->rig.scene->meshes[m].joint_count && i < r->rig.mesh_starts[m + 1]; i++)
      for (uint32_t k = 0; k < SBFI_MOST_INFLUENCES && r->rig_weights[i].at[k].weight > 0; k++)
        any = deforming[r->c->bone_of_node[r->rig_weights[i].at[k].node]] = true;
  return any ? deforming : NULL;
}

/* Which limbs are left and right, by their names. */
static int8_t *find_sides(const sbfi_rigging *r) {
  const sbf_bone_list bones = r->c->asset->bones;
  int8_t *sides = sbfi_arena_allocate(&r->c->scratch, (size_t)bones.count + 1, sizeof *sides);
  for (uint32_t b = 0; sides && b < bones.count; b++) sides[b] = (int8_t)sbfi_name_side(bones.at[b].name);
  return sides;
}

sbf_status sbfi_weigh_by_bones(sbfi_rigging *r, const sbfi_scene_surface *moved) {
  sbfi_weights computed;
  sbfi_weights_input in = {.allocator = &r->c->scratch.allocator,
      .points = moved->mesh.positions.at,
      .point_count = moved->mesh.positions.count,
      .bones = r->c->asset->bones.at,
      .bone_count = r->c->asset->bones.count,
      .sides = find_sides(r),
      .is_deforming = find_deforming(r)};
  in.triangles = (const uint32_t(*)[3])triangles_of(moved, &r->c->scratch, &in.triangle_count);
  if (!in.triangles || !in.sides) return sbfi_convert_no_memory(r->c);
  sbf_status status = sbfi_compute_weights(&in, &computed, r->c->error);
  for (uint32_t i = 0; status == SBF_OK && i < in.point_count; i++) {
    if (r->sources[i] != SBFI_WEIGHTS_NONE) continue;
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
      sbfi_influences_add(
          &r->weights[i], r->c->node_of_bone[computed.joints[i][k]], (double)computed.weights[i][k]);
    sbfi_influences_finish(&r->weights[i]);
    r->sources[i] = SBFI_WEIGHTS_COMPUTED;
  }
  if (status == SBF_OK)
    sbfi_convert_warn(r->c, SBF_CODE_IMPORT_WEIGHTS_COMPUTED,
        "weights were computed from %u bones: %u of %u shells move with one bone each, %u bones hold no "
        "point; "
        "--shell gives one to another",
        in.bone_count, computed.figures.rigid_shell_count, computed.figures.shell_count,
        computed.figures.unused_bone_count);
  sbfi_weights_free(&computed);
  return status;
}
