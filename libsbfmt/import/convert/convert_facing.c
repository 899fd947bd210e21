/* Rotates the asset so that the character faces +Z. */
#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"
#include "motion/quatd.h"

/* These functions undo a rotation of `quarters` quarter turns about +Y. */
static void rotate_points(uint32_t quarters, const sbf_vec3_list list) {
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)list.at; /* the conversion owns the asset */
  const sbfi_gait_draft draft = {.turns = quarters};
  for (uint32_t i = 0; i < list.count; i++) at[i] = sbfi_draft_seen(&draft, at[i]);
}

static void rotate_bone(uint32_t quarters, const sbf_bone *bone) {
  static const double h = 0.70710678118654752; /* sine and cosine of 45 degrees */
  static const double back[4][4] = {{0, 0, 0, 1}, {0, -h, 0, h}, {0, -1, 0, 0}, {0, h, 0, h}};
  sbf_quat *r = (sbf_quat *)(uintptr_t)&bone->rotation;
  double q[4] = {(double)r->x, (double)r->y, (double)r->z, (double)r->w};
  sbfi_quatd_multiply(back[quarters], q, q);
  *r = (sbf_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
  rotate_points(quarters, (sbf_vec3_list){&bone->head, 1});
}

/* Later passes use these matrices, so they are rotated too. */
static void rotate_matrix(uint32_t quarters, sbfi_matrix *m) {
  static const double cosine[4] = {1, 0, -1, 0}, sine[4] = {0, -1, 0, 1};
  double c = cosine[quarters], s = sine[quarters];
  sbfi_matrix back = {{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}, {0, 0, 0, 1}}};
  *m = sbfi_matrix_multiply(&back, m);
}

static void rotate_asset(uint32_t quarters, const sbf_asset *a) {
  for (uint32_t i = 0; i < a->bones.count; i++) rotate_bone(quarters, &a->bones.at[i]);
  for (uint32_t i = 0; i < a->soft_bodies.count; i++)
    rotate_points(quarters, a->soft_bodies.at[i].surface.positions);
  for (uint32_t i = 0; i < a->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &a->render_meshes.at[i];
    if (!sbfi_is_of_section(a, mesh->mesh.positions)) rotate_points(quarters, mesh->mesh.positions);
    rotate_points(quarters, mesh->normals);
    for (uint32_t k = 0; k < mesh->shape_keys.count; k++)
      rotate_points(quarters, mesh->shape_keys.at[k].offsets);
  }
}

sbf_status sbfi_face_ahead(sbfi_conversion *c) {
  static const char *const directions[4] = {"+Z", "+X", "-Z", "-X"};
  uint32_t quarters = 0;
  if (c->asset->bones.count == 0) return SBF_OK;
  const sbfi_locomotion *moves = c->locomotion;
  bool good = !moves || moves->kind == SBFI_LOCOMOTION_WALK
                  ? sbfi_draft_facing(c->asset, &c->scratch, &quarters)
                  : sbfi_front_turns(c->asset, moves->turns, moves->kind, &c->scratch, &quarters);
  if (!good) return sbfi_convert_no_memory(c);
  if (quarters == 0) return SBF_OK;
  rotate_asset(quarters, c->asset);
  rotate_matrix(quarters, &c->to_asset);
  rotate_matrix(quarters, &c->rig_to_asset);
  sbfi_convert_warn(
      c, SBF_CODE_IMPORT_FACING, "the character faced %s and was rotated to face +Z", directions[quarters]);
  return SBF_OK;
}
