/* Moves the origin of a character's numbers with the character, so that they stay precise at any distance
 * that it walks or its bodies fly. */
#include "coupling/ragdoll/ragdoll.h"
#include "math/vec3.h"
#include "soft/solvers/scheme.h"
#include "world/detail/detail_levels.h"
#include "world/step.h"

/* Distance in m from which on the origin follows, times step_of: smaller for small characters. */
static const float REBASE_AT_M = 4;

/* m, in the asset's units. Loose bodies farther than this from the root define the position of the character.
 * At 3 km from the origin, rounding strains a loose body of 1 m by 1 %. */
static const float LEFT_ROOT_M = 16;

/* Step of the origin in m: 1, or a power of two that is at most the character's scale. */
static float step_of(float scale) {
  float step = 1;
  while (step > scale && step > 1e-6f) step *= 0.5f;
  return step;
}

static float whole(float metres, float step) {
  float steps = metres / step;
  if (fabsf(steps) >= 0x1p23f) return metres; /* floats of this size are integers */
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
  float step = step_of(c->scale), threshold = REBASE_AT_M * step, max = 1e9f * step;
  if (fabsf(at.x) < threshold && fabsf(at.y) < threshold && fabsf(at.z) < threshold) return;
  if (!(fabsf(at.x) < max && fabsf(at.y) < max && fabsf(at.z) < max)) return;
  sbf_vec3 shift = {whole(at.x, step), whole(at.y, step), whole(at.z, step)};
  sbf_vec3 own_shift = sbri_scale(shift, 1 / c->scale);
  sbri_character_state *head = sbri_header(c);
  head->origin.x += (double)shift.x, head->origin.y += (double)shift.y, head->origin.z += (double)shift.z;
  sbri_gait_rebase(&model->rig, sbri_gait(c), shift);
  shift_frames(sbri_pose(c), model->frame_count, shift);
  shift_frames(sbri_previous_pose(c), model->frame_count, shift);
  sbri_rigid_rebase(c, own_shift);
  sbri_jiggles_rebase(c, own_shift);
  shift_points(sbri_positions(c), model->slot_count, own_shift);
  shift_points(sbri_previous_positions(c), model->slot_count, own_shift);
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    float *previous = sbri_velocities(c) + 3 * (size_t)island->first_slot;
    if (!island->scheme->forceless) continue;
    for (uint32_t k = 0; k < 3 * island->free_count; k++) {
      uint32_t axis = k / SBRI_BLOCK % 3;
      previous[k] -= axis == 0 ? own_shift.x : axis == 1 ? own_shift.y : own_shift.z;
    }
  }
}
