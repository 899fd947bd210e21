/* The origin that a character's numbers are relative to goes with it, so that they stay exact however far it
 * walks, or its bodies are thrown. */
#include "detail/detail_levels.h"
#include "math/vec3.h"
#include "ragdoll/ragdoll.h"
#include "solvers/scheme.h"
#include "step/step.h"

/* The origin follows when the character is this far from it, in m; small ones keep their digits as well. */
static const float REBASE_AT_M = 4;

/* m, in the asset's units: loose bodies so far from their root define where the character is. 3 km from the
 * origin rounding strains a loose body of 1 m by a hundredth. */
static const float LEFT_ROOT_M = 16;

/* m, a power of two: what the origin goes by, a metre or a character's scale if that is less. */
static float step_of(float scale) {
  float step = 1;
  while (step > scale && step > 1e-6f) step *= 0.5f;
  return step;
}

static float whole(float metres, float step) {
  float steps = metres / step;
  if (fabsf(steps) >= 0x1p23f) return metres; /* floats of this size are whole */
  return step * (float)(int32_t)(steps < 0 ? steps - 0.5f : steps + 0.5f);
}

static sbf_vec3 position_of(const sbri_character *c) {
  sbf_vec3 root = sbri_pose(c)[sbri_root_frame(c->model)].position;
  if (!c->model->island_count || !c->model->slot_count) return root;
  const sbri_point *p = &sbri_positions(c)[c->model->islands[0].first_slot];
  sbf_vec3 soft_point = sbri_scale((sbf_vec3){p->x, p->y, p->z}, c->scale);
  return sbri_length(sbri_sub(soft_point, root)) > LEFT_ROOT_M * c->scale ? soft_point : root;
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
  sbf_vec3 at = position_of(c);
  float step = step_of(c->scale), near = REBASE_AT_M * step, far = 1e9f * step;
  if (fabsf(at.x) < near && fabsf(at.y) < near && fabsf(at.z) < near) return;
  if (!(fabsf(at.x) < far && fabsf(at.y) < far && fabsf(at.z) < far)) return;
  sbf_vec3 shift = {whole(at.x, step), whole(at.y, step), whole(at.z, step)};
  sbf_vec3 own = sbri_scale(shift, 1 / c->scale);
  sbri_character_state *head = sbri_header(c);
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
