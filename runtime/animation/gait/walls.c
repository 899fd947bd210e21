/* Walls: colliders that are too high to step on keep the body out.
 *
 * The balls of the rig's wall_volume are pushed out of colliders one after the other: horizontally for a
 * character on the ground, in any direction for a swimmer or flier. The remaining velocity is along the wall.
 * Slopes that can be walked on are not walls; overhangs are walls for swimmers and fliers only. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "math/quat.h"
#include "math/trig.h"

static const float WALKABLE =
    0.6f;                          /* cosine of the steepest slope that is ground: animation/gait/footing.c */
static const float CEILING = 0.9f; /* the same for ceilings */
static const float DEEPEST = 2;    /* radii; points deeper inside triangles are behind them */
enum { PASSES = 4, MAX_PARTS = 16 };

typedef struct body_move {
  const sbri_rig *rig;
  sbri_gait_state *state;
  const sbri_gait_input *input;
  sbf_quat rotation; /* of the spheres about the body's position */
  bool afloat, any;
} body_move;

/* Removes the part of the speed that goes into a wall. */
static void remove_inward_velocity(body_move *m, sbf_vec3 normal) {
  sbri_gait_state *state = m->state;
  sbf_vec3 v = sbri_body_velocity(state);
  float into = sbri_dot(v, normal);
  if (into >= 0) return;
  v = sbri_world_to_body(state, sbri_add_scaled(v, normal, -into));
  state->motion.forward = v.z, state->motion.sideways = v.x;
}

/* Resolves the penetration of a sphere and one collider. */
static bool resolve_collider(body_move *m, sbf_vec3 position, float radius, const sbri_collider *c) {
  sbri_gait_state *state = m->state;
  sbri_collider_frame frame = sbri_collider_frame_of(c, m->input->origin, 1);
  sbri_nearest found;
  if (!sbri_shape_nearest(
          c->shape, sbri_into_shape(&frame, position, true), radius, DEEPEST * radius, &found))
    return false;
  sbf_vec3 n = sbri_rotate(c->rotation_to, found.normal);
  float deep = radius - found.gap;
  if (!m->afloat) {
    if (n.y >= WALKABLE || n.y <= -CEILING) return false;
    float level = sqrtf(n.x * n.x + n.z * n.z);
    deep /= level;
    n = sbri_vec3(n.x / level, 0, n.z / level);
  }
  if (!(deep > 0)) return false;
  if (deep > radius) deep = radius; /* the rest in the next iteration */
  state->motion.position = sbri_add_scaled(state->motion.position, n, deep);
  remove_inward_velocity(m, n);
  return true;
}

/* Position of the asset's origin. */
static sbf_vec3 middle_of(const sbri_gait_state *state) {
  return sbri_vec3(
      state->motion.position.x, state->fall.level + state->motion.position.y, state->motion.position.z);
}

static void resolve_colliders(body_move *m) {
  const sbri_surroundings *around = m->input->surroundings;
  const sbri_wall_volume *wall_volume = &m->rig->wall_volume;
  bool resolved = true;
  for (int pass = 0; pass < PASSES && resolved; pass++) {
    resolved = false;
    for (uint32_t b = 0; b < wall_volume->wall_sphere_count; b++) {
      float radius = wall_volume->wall_spheres[b].radius * m->input->scale;
      sbf_vec3 arm =
          sbri_rotate(m->rotation, sbri_scale(wall_volume->wall_spheres[b].position, m->input->scale));
      sbf_vec3 middle = middle_of(m->state);
      sbri_box box = sbri_box_grown(sbri_box_of_point(sbri_add(middle, arm)), radius);
      sbri_bounds_walk walk;
      uint32_t i;
      sbri_bounds_walk_begin(&walk, &around->colliders->tree, sbri_box_in_world(box, m->input->origin, 1));
      while (sbri_bounds_walk_next(&walk, &i)) {
        uint32_t number = around->colliders->listed[i];
        if (!sbri_surroundings_has(around, number)) continue;
        resolved =
            resolve_collider(m, sbri_add(middle_of(m->state), arm), radius, &around->colliders->at[number]) ||
            resolved;
      }
    }
    m->any = m->any || resolved;
  }
}

static float smallest(const sbri_wall_volume *wall_volume) {
  float radius = wall_volume->wall_spheres[0].radius;
  for (uint32_t b = 1; b < wall_volume->wall_sphere_count; b++)
    radius = wall_volume->wall_spheres[b].radius < radius ? wall_volume->wall_spheres[b].radius : radius;
  return radius;
}

bool sbri_walls_resolve(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 from, float turned) {
  if (!input->surroundings || !input->surroundings->colliders) return false;
  float s, c;
  sbri_sincos(0.5f * turned, &s, &c);
  body_move m = {rig, state, input, sbri_quat_multiply((sbf_quat){0, s, 0, c}, state->posture.root.rotation),
      sbri_is_afloat(rig), false};
  /* Substeps of at most a sphere's size, so that no sphere passes through a wall. */
  sbf_vec3 displacement = sbri_sub(state->motion.position, from);
  float parts = sbri_length(displacement) / (smallest(&rig->wall_volume) * input->scale) + 1;
  int count = parts < MAX_PARTS ? (int)parts : MAX_PARTS;
  state->motion.position = from;
  for (int k = 0; k < count; k++) {
    state->motion.position = sbri_add_scaled(state->motion.position, displacement, 1 / (float)count);
    resolve_colliders(&m);
  }
  return m.any;
}
