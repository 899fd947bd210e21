/* The origin that a character's numbers are relative to goes with it, so that they stay exact however far it
 * walks. */
#include "detail/rungs.h"
#include "math/vec3.h"
#include "ragdoll/ragdoll.h"
#include "solvers/scheme.h"
#include "step/step.h"

/* The origin follows when the character is this far from it, in m. */
static const float REBASE_AT_M = 4;

static float whole(float metres) {
  return (float)(int32_t)(metres < 0 ? metres - 0.5f : metres + 0.5f);
}

static void shift_frames(sbr_transform *pose, uint32_t count, sbf_vec3 shift) {
  for (uint32_t f = 0; f < count; f++) pose[f].position = sbri_sub(pose[f].position, shift);
}

static void shift_points(sbri_point *points, uint32_t count, sbf_vec3 shift) {
  for (uint32_t i = 0; i < count; i++)
    points[i] = (sbri_point){points[i].x - shift.x, points[i].y - shift.y, points[i].z - shift.z, 0};
}

void sbri_character_rebase(sbri_character *c) {
  const sbr_model *model = c->model;
  sbf_vec3 at = sbri_pose(c)[sbri_root_frame(model)].position;
  if (fabsf(at.x) < REBASE_AT_M && fabsf(at.y) < REBASE_AT_M && fabsf(at.z) < REBASE_AT_M) return;
  if (!(fabsf(at.x) < 1e9f && fabsf(at.y) < 1e9f && fabsf(at.z) < 1e9f)) return;
  sbf_vec3 shift = {whole(at.x), whole(at.y), whole(at.z)}, own = sbri_scale(shift, 1 / c->scale);
  sbri_character_state *head = sbri_head(c);
  head->origin.x += (double)shift.x, head->origin.y += (double)shift.y, head->origin.z += (double)shift.z;
  sbri_gait_rebase(&model->rig, sbri_gait(c), shift);
  shift_frames(sbri_pose(c), model->frame_count, shift);
  shift_frames(sbri_previous_pose(c), model->frame_count, shift);
  sbri_rigid_rebase(c, own);
  sbri_jiggles_rebase(c, own);
  shift_points(sbri_positions(c), model->slot_count, own);
  shift_points(sbri_previous_positions(c), model->slot_count, own);
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    float *before = sbri_velocities(c) + 3 * (size_t)island->first_slot;
    if (!island->scheme->forceless) continue;
    for (uint32_t k = 0; k < 3 * island->free_count; k++) {
      uint32_t axis = k / SBRI_BLOCK % 3;
      before[k] -= axis == 0 ? own.x : axis == 1 ? own.y : own.z;
    }
  }
}
