/* Swinging chains, as hair, tails and skirts: each bone is a pendulum about its head.
 *
 * The method is VRMC_springBone 1.0's, on the steps of 1/60 s for which its avatars are made: position Verlet
 * with the exact decay of the velocity, the length restored by projection, then collisions (VRM Consortium,
 * "SpringBone Algorithm"). Steps are at multiples of 1/60 s for any tick length. Between them the pose shows
 * a shorter step, which is not stored. So the motion does not depend on the tick. */
#include "animation/gait/gait_state.h"
#include "math/trig.h"

static const float STEP_S = 1.0f / 60;
static const float STEP_TOLERANCE = 1e-3f; /* fraction of a step by which a tick may miss it */
static const float STILL = 1e-6f;          /* fraction of the bone's length: a smaller displacement is none */

/* One pass over a chain. */
typedef struct swing {
  const sbri_rig *rig;
  const sbri_gait_input *input;
  const sbf_chain *chain;
  sbri_spring_end *ends;
  sbr_transform center;
  float step_s;
  sbr_transform *pose;
} swing;

static float number_of(const sbf_f32_list *list, uint32_t k) {
  return list->count > 1 ? list->at[k] : list->count ? list->at[0] : 0;
}

static sbf_vec3 gravity_of(const sbf_chain_spring *spring, uint32_t k) {
  const sbf_vec3_list *list = &spring->gravity;
  return list->count > 1 ? list->at[k] : list->count ? list->at[0] : sbri_vec3(0, 0, 0);
}

static sbf_vec3 to_world(const sbr_transform *frame, sbf_vec3 position) {
  return sbri_add(frame->position, sbri_rotate(frame->rotation, position));
}

static sbf_vec3 from_world(const sbr_transform *frame, sbf_vec3 position) {
  return sbri_rotate(sbri_quat_conjugate(frame->rotation), sbri_sub(position, frame->position));
}

static sbr_transform blend(const sbr_transform *a, const sbr_transform *b, float t) {
  return (sbr_transform){
      sbri_lerp(a->position, b->position, t), sbri_quat_blend(a->rotation, b->rotation, t)};
}

/* Vector from the nearest point of a shape's axis to `end`. `*depth` receives the penetration of `end`. */
static sbf_vec3 press(const sbri_chain_shape *shape, const sbr_transform *bone, float scale, sbf_vec3 end,
    float radius, float *depth) {
  const sbf_chain_collider *source = shape->source;
  sbf_vec3 offset = sbri_sub(end, to_world(bone, sbri_scale(shape->position, scale)));
  if (source->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE) {
    sbf_vec3 normal = sbri_rotate(bone->rotation, shape->normal);
    *depth = radius - sbri_dot(offset, normal);
    return normal;
  }
  if (source->shape == SBF_CHAIN_COLLIDER_SHAPE_CAPSULE) {
    sbf_vec3 axis = sbri_rotate(bone->rotation, sbri_scale(shape->axis, scale));
    float along = sbri_dot(axis, offset), squared = sbri_dot(axis, axis);
    float t = along <= 0 ? 0 : along >= squared ? 1 : along / squared;
    offset = sbri_add_scaled(offset, axis, -t);
  }
  float distance = sbri_length(offset), limit = source->radius * scale;
  *depth = source->inside ? distance + radius - limit : limit + radius - distance;
  if (!(distance > 1e-12f)) return sbri_vec3(0, 0, 0); /* in the middle no direction leads out */
  return sbri_scale(offset, (source->inside ? -1 : 1) / distance);
}

static sbf_vec3 at_length(sbf_vec3 head, sbf_vec3 end, sbf_vec3 along, float length) {
  return sbri_add_scaled(head, sbri_normalize(sbri_sub(end, head), along), length);
}

static sbf_vec3 collide(
    const swing *s, uint32_t k, sbf_vec3 head, sbf_vec3 end, sbf_vec3 along, float length) {
  const sbf_chain_spring *spring = s->chain->spring;
  float radius = number_of(&spring->radius, k) * s->input->scale, depth;
  for (uint32_t i = 0; i < spring->colliders.count; i++) {
    const sbri_chain_shape *shape = &s->rig->springs.shapes[spring->colliders.at[i]];
    sbf_vec3 out = press(shape, &s->pose[shape->source->bone], s->input->scale, end, radius, &depth);
    if (depth > 0) end = at_length(head, sbri_add_scaled(end, out, depth), along, length);
  }
  return end;
}

/* End of bone k after the step. `along`: direction of the bone in the pose. */
static sbf_vec3 next_end(const swing *s, uint32_t k, sbf_vec3 head, sbf_vec3 along, float length) {
  const sbf_chain_spring *spring = s->chain->spring;
  const sbri_spring_end *end = &s->ends[k];
  float drag = number_of(&spring->drag, k), h = s->step_s, kept = sbri_exp(-drag * h);
  float gained = drag * h > 1e-3f ? (1 - kept) / drag : h * (1 - 0.5f * drag * h); /* m/s per m/s^2 */
  sbf_vec3 shift = sbri_scale(sbri_sub(end->now, end->before), kept * h / STEP_S);
  sbf_vec3 next = to_world(&s->center, sbri_add(end->now, shift)), was = to_world(&s->center, end->now);
  sbf_vec3 acceleration = sbri_add_scaled(gravity_of(spring, k), along, number_of(&spring->stiffness, k));
  next = at_length(head, sbri_add_scaled(next, acceleration, gained * h), along, length);
  if (h > 0) next = collide(s, k, head, next, along, length);
  return sbri_length(sbri_sub(next, was)) < STILL * length ? was : next;
}

typedef enum swing_mode { SWING_STEP, SWING_POSE, SWING_RESET } swing_mode;

/* Moves a chain whose first bone has the frame `anchor` without swing. SWING_STEP stores the ends, SWING_POSE
 * rotates the bones of the pose, SWING_RESET stores the ends of the pose. Returns whether all ends rest. */
static bool swing_chain(const swing *s, sbr_transform anchor, swing_mode mode) {
  sbr_transform frame = anchor;
  bool still = true;
  for (uint32_t k = 0; k < s->chain->bones.count; k++) {
    uint32_t b = s->chain->bones.at[k];
    sbf_vec3 step = sbri_rotate(frame.rotation, sbri_chain_step(s->rig, s->chain, k, s->input->scale));
    float length = sbri_length(step);
    sbr_transform local = {{0, 0, 0}, {0, 0, 0, 1}};
    if (k + 1 < s->chain->bones.count) {
      const sbr_transform *next = &s->pose[s->chain->bones.at[k + 1]];
      local.position = from_world(&s->pose[b], next->position);
      local.rotation = sbri_quat_multiply(sbri_quat_conjugate(s->pose[b].rotation), next->rotation);
    }
    if (mode == SWING_RESET) {
      sbf_vec3 end = from_world(&s->center, sbri_add(frame.position, step));
      s->ends[k] = (sbri_spring_end){end, end};
    } else if (length > 0) {
      sbf_vec3 along = sbri_scale(step, 1 / length), end = next_end(s, k, frame.position, along, length);
      sbf_quat rotation = sbri_quat_between(along, sbri_normalize(sbri_sub(end, frame.position), along));
      if (mode == SWING_STEP) {
        end = from_world(&s->center, end);
        sbf_vec3 moved = sbri_sub(end, s->ends[k].now);
        if (sbri_length(moved) <= STILL * length)
          end = s->ends[k].now;
        else
          still = false;
        s->ends[k] = (sbri_spring_end){.now = end, .before = s->ends[k].now};
      } else {
        sbri_rig_rotate_bone(s->rig, b, rotation, s->pose);
      }
      frame.rotation = sbri_quat_normalize(sbri_quat_multiply(rotation, frame.rotation));
    }
    frame = (sbr_transform){to_world(&frame, local.position),
        sbri_quat_normalize(sbri_quat_multiply(frame.rotation, local.rotation))};
  }
  return still;
}

static bool is_same(const sbr_transform *a, const sbr_transform *b) {
  const sbf_quat p = a->rotation, q = b->rotation;
  return a->position.x == b->position.x && a->position.y == b->position.y && a->position.z == b->position.z &&
         p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
}

/* Steps that end in this tick, each with the frames of its moment. */
static void tick_chain(swing *s, sbri_spring_clock *clock, sbr_transform anchor, sbr_transform center) {
  float pending = clock->pending_s + s->input->tick_s;
  bool still = is_same(&anchor, &clock->anchor) && is_same(&center, &clock->center), stepped = false;
  while (pending > STEP_S * (1 - STEP_TOLERANCE)) {
    pending -= STEP_S;
    if (fabsf(pending) < STEP_S * STEP_TOLERANCE) pending = 0;
    float t = sbri_clamp(1 - pending / s->input->tick_s, 0, 1);
    s->center = t < 1 ? blend(&clock->center, &center, t) : center;
    s->step_s = STEP_S;
    still = swing_chain(s, t < 1 ? blend(&clock->anchor, &anchor, t) : anchor, SWING_STEP) && still;
    stepped = true;
  }
  if (still && stepped) pending = 0; /* a character at rest can fall asleep */
  *clock = (sbri_spring_clock){pending, anchor, center};
}

void sbri_springs_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose) {
  for (uint32_t c = 0; c < rig->springs.chains.count; c++) {
    const sbri_bone_chain *chain = &rig->springs.chains.at[c];
    const sbf_chain *source = chain->source;
    sbri_spring_clock *clock = &sbri_spring_clocks(rig, state)[c];
    sbr_transform anchor = pose[source->bones.at[0]], center = {{0, 0, 0}, {0, 0, 0, 1}};
    if (source->spring->center >= 0) center = pose[source->spring->center];
    swing s = {rig, input, source, sbri_spring_ends(rig, state) + chain->first_state, center, 0, pose};
    if (advance == SBRI_ADVANCE_RESET) {
      *clock = (sbri_spring_clock){0, anchor, center};
      swing_chain(&s, anchor, SWING_RESET);
      continue;
    }
    if (advance == SBRI_ADVANCE_TICK) tick_chain(&s, clock, anchor, center);
    s.center = center;
    s.step_s = clock->pending_s;
    swing_chain(&s, anchor, SWING_POSE);
  }
}

void sbri_springs_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift) {
  for (uint32_t c = 0; c < rig->springs.chains.count; c++) {
    const sbri_bone_chain *chain = &rig->springs.chains.at[c];
    sbri_spring_clock *clock = &sbri_spring_clocks(rig, state)[c];
    sbri_spring_end *ends = sbri_spring_ends(rig, state) + chain->first_state;
    clock->anchor.position = sbri_sub(clock->anchor.position, shift);
    if (chain->source->spring->center >= 0) {
      clock->center.position = sbri_sub(clock->center.position, shift);
      continue;
    }
    for (uint32_t k = 0; k < chain->source->bones.count; k++) {
      ends[k].now = sbri_sub(ends[k].now, shift);
      ends[k].before = sbri_sub(ends[k].before, shift);
    }
  }
}
