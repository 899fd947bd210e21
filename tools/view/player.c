#include "view/player.h"

#include <stdlib.h>

#include "base/fault.h"
#include "sbrun/rigid.h"

static const float GRAVITY = 9.80665f;
/* radii relative to the character's size */
static const float BALL_FRACTION = 0.07f, FINGER_FRACTION = 0.04f;
static const sbf_quat UNTURNED = {0, 0, 0, 1};

static sbr_double3 to_world(sbf_vec3 v) {
  return (sbr_double3){(double)v.x, (double)v.y, (double)v.z};
}
static sbf_vec3 from_world(sbr_double3 v) {
  return v3((float)v.x, (float)v.y, (float)v.z);
}
static sbf_vec3 origin_of(const player *p) {
  return from_world(sbr_character_get_origin(p->s->world, p->s->character));
}

static sbf_status make_sphere(float radius, sbr_shape **shape, sbf_diagnostic *error) {
  sbr_shape_definition definition = sbr_default_shape_definition();
  definition.radius = radius;
  return sbr_shape_create(NULL, &definition, shape, error);
}

static sbf_status out_of_memory(sbf_diagnostic *error) {
  return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for what the visitor does");
}

sbf_status player_open(player *p, session *s, float size, sbf_diagnostic *error) {
  const sbf_asset *asset = s->asset;
  *p = (player){.s = s, .size = size, .pace = 0.5f, .dragged_rigid = -1};
  p->rigid_of = malloc((asset->bones.count + 1u) * sizeof *p->rigid_of);
  p->bones = malloc((asset->bones.count + 1u) * sizeof *p->bones);
  if (!p->rigid_of || !p->bones) return out_of_memory(error);
  for (uint32_t i = 0; i < asset->bones.count; i++) p->rigid_of[i] = -1;
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    int32_t bone = asset->rigid_bodies.at[i].bone;
    if (bone >= 0) p->rigid_of[bone] = (int32_t)i;
    p->mass += sbr_character_get_rigid_state(s->world, s->character, i).mass;
  }
  sbf_status status = make_sphere(BALL_FRACTION * size, &p->ball, error);
  return status == SBF_OK ? make_sphere(FINGER_FRACTION * size, &p->fingertip, error) : status;
}

void player_close(player *p) {
  player_release(p);
  for (uint32_t i = 0; i < p->ball_count; i++) sbr_collider_destroy(p->s->world, p->balls[i].collider);
  sbr_shape_destroy(p->ball);
  sbr_shape_destroy(p->fingertip);
  free(p->rigid_of);
  free(p->bones);
  *p = (player){.s = NULL};
}

static sbf_vec3 middle_of_points(const player *p) {
  enum { MAX = 1024 }; /* maximum per body: enough for an approximate centre */
  sbf_vec3 points[MAX];
  sbf_vec3 sum = {0, 0, 0};
  uint32_t count = 0;
  for (uint32_t b = 0; b < p->s->asset->soft_bodies.count; b++) {
    uint32_t here = sbr_character_get_points(p->s->world, p->s->character, b, points, MAX);
    for (uint32_t i = 0; i < here && i < MAX; i++, count++) sum = v3_add(sum, points[i]);
  }
  return v3_add(origin_of(p), v3_scale(sum, 1 / (float)(count ? count : 1)));
}

sbf_vec3 player_middle(const player *p) {
  const sbf_asset *asset = p->s->asset;
  uint32_t bones = asset->bones.count, count = 0;
  sbf_vec3 sum = {0, 0, 0};
  if (bones == 0) return middle_of_points(p);
  sbr_character_get_bones(p->s->world, p->s->character, p->bones, bones);
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    if (asset->soft_bodies.at[b].bone >= 0) {
      sum = v3_add(sum, p->bones[asset->soft_bodies.at[b].bone].position);
      count++;
    }
  if (count == 0)
    for (; count < bones; count++) sum = v3_add(sum, p->bones[count].position);
  return v3_add(origin_of(p), v3_scale(sum, 1 / (float)count));
}

/* ---- Dragging ---- */

static sbf_vec3 center_of(const player *p, const sbr_rigid_state *state) {
  return v3_add(origin_of(p), state->center);
}

static sbr_rigid_state state_of(const player *p, int32_t rigid) {
  return sbr_character_get_rigid_state(p->s->world, p->s->character, (uint32_t)rigid);
}

/* The rigid body that was hit, or the one of the hit soft body's bone; -1: none. */
static int32_t rigid_behind(const player *p, const sbr_hit *hit) {
  if (hit->object.rigid_body >= 0) return hit->object.rigid_body;
  int32_t bone = hit->object.soft_body >= 0 ? p->s->asset->soft_bodies.at[hit->object.soft_body].bone : -1;
  return bone >= 0 ? p->rigid_of[bone] : -1;
}

static bool set_sphere(player *p, const sbr_shape *shape, sbf_vec3 at, sbr_collider_id *collider) {
  sbr_collider_definition definition = sbr_default_collider_definition();
  sbf_diagnostic error;
  definition.shape = shape;
  definition.position = to_world(at);
  return sbr_collider_create(p->s->world, &definition, collider, &error) == SBF_OK;
}

bool player_grab(player *p, sbf_vec3 eye, sbf_vec3 direction, float reach, sbf_vec3 *position) {
  sbr_hit hit;
  if (!sbr_world_cast_ray(p->s->world, to_world(eye), direction, (double)reach, NULL, &hit) ||
      hit.object.character.value == 0)
    return false;
  player_release(p);
  *position = p->target = from_world(hit.position);
  p->dragged_rigid = p->mass > 0 ? rigid_behind(p, &hit) : -1;
  p->holds = true;
  if (p->dragged_rigid < 0) {
    if (!set_sphere(p, p->fingertip, p->target, &p->finger)) p->holds = false;
    return p->holds;
  }
  player_knock(p);
  sbr_rigid_state state = state_of(p, p->dragged_rigid);
  sbf_quat q = state.frame.rotation, back = {-q.x, -q.y, -q.z, q.w};
  p->dragged_local = v3_rotate(back, v3_sub(p->target, center_of(p, &state)));
  return true;
}

static float ground_below(const player *p, sbf_vec3 at) {
  const sbr_ground *ground = &p->s->ground;
  sbf_vec3 normal;
  return (float)ground->height(ground, (double)at.x, (double)at.z, &normal);
}

void player_drag(player *p, sbf_vec3 target) {
  p->target = target;
  p->target.y = fmaxf(target.y, ground_below(p, target) + 0.02f * p->size);
}

void player_release(player *p) {
  if (p->holds && p->dragged_rigid < 0) sbr_collider_destroy(p->s->world, p->finger);
  p->holds = false;
}

/* Pulls the grabbed object towards the pointer, strongly enough to lift all of it: limits the speed, and
 * impulses to what this body and most of the weight attached to it can take. */
static void pull(player *p, float seconds) {
  if (!p->holds) return;
  if (p->dragged_rigid < 0) {
    sbr_collider_move(p->s->world, p->finger, to_world(p->target), UNTURNED);
    return;
  }
  if (sbr_character_get_posture(p->s->world, p->s->character) != SBR_POSTURE_FALLING) player_knock(p);
  sbr_rigid_state state = state_of(p, p->dragged_rigid);
  sbf_vec3 position = v3_add(center_of(p, &state), v3_rotate(state.frame.rotation, p->dragged_local));
  sbf_vec3 wanted = v3_scale(v3_sub(p->target, position), 9);
  float fastest = 3 * sqrtf(GRAVITY * p->size), length = v3_length(wanted);
  if (length > fastest) wanted = v3_scale(wanted, fastest / length);
  sbf_vec3 impulse = v3_scale(v3_sub(wanted, state.velocity), 1.5f * state.mass);
  if (wanted.y > 0) impulse.y += 0.9f * p->mass * GRAVITY * seconds;
  sbr_character_apply_rigid_impulse(
      p->s->world, p->s->character, (uint32_t)p->dragged_rigid, to_world(position), impulse);
}

void player_knock(player *p) {
  const sbr_fall_definition fall = sbr_default_fall_definition();
  sbr_character_knock_over(p->s->world, p->s->character, &fall);
}

/* ---- Balls ---- */

void player_throw(player *p, sbf_vec3 from) {
  sbf_vec3 displacement = v3_sub(player_middle(p), from);
  float seconds = v3_length(displacement) / (1.8f * sqrtf(GRAVITY * p->size));
  player_ball one = {.position = from};
  if (!(seconds > 0)) return;
  one.velocity = v3_scale(displacement, 1 / seconds);
  one.velocity.y += 0.5f * GRAVITY * seconds;
  if (p->ball_count == PLAYER_BALLS) {
    sbr_collider_destroy(p->s->world, p->balls[0].collider);
    for (uint32_t i = 1; i < PLAYER_BALLS; i++) p->balls[i - 1] = p->balls[i];
    p->ball_count--;
  }
  if (!set_sphere(p, p->ball, from, &one.collider)) return;
  p->balls[p->ball_count++] = one;
  p->thrown++;
}

float player_ball_radius(const player *p) {
  return BALL_FRACTION * p->size;
}

/* A ball that hits the character transfers its impulse and bounces back. */
static void collide(player *p, player_ball *one, const sbr_hit *hit) {
  sbf_vec3 change = v3_scale(hit->normal, -1.4f * v3_dot(one->velocity, hit->normal));
  int32_t rigid = p->mass > 0 ? rigid_behind(p, hit) : -1;
  one->velocity = v3_add(one->velocity, change);
  p->hits++;
  if (rigid < 0) return;
  player_knock(p);
  sbr_character_apply_rigid_impulse(
      p->s->world, p->s->character, (uint32_t)rigid, hit->position, v3_scale(change, -0.03f * p->mass));
}

static void fly(player *p, player_ball *one, float seconds) {
  float radius = player_ball_radius(p);
  sbr_hit hit;
  one->velocity.y -= GRAVITY * seconds;
  sbf_vec3 displacement = v3_scale(one->velocity, seconds);
  float length = v3_length(displacement);
  if (length > 1e-6f &&
      sbr_world_cast_ray(
          p->s->world, to_world(one->position), displacement, (double)(length + radius), NULL, &hit) &&
      hit.object.character.value && v3_dot(hit.normal, one->velocity) < 0)
    collide(p, one, &hit);
  one->position = v3_add(one->position, v3_scale(one->velocity, seconds));
  float min = ground_below(p, one->position) + radius;
  if (one->position.y < min) {
    one->position.y = min;
    one->velocity = v3(0.97f * one->velocity.x, 0.55f * fabsf(one->velocity.y), 0.97f * one->velocity.z);
  }
  sbr_collider_move(p->s->world, one->collider, to_world(one->position), UNTURNED);
}

/* ---- Time ---- */

bool player_step(player *p, double seconds) {
  if (p->steered && !p->s->recording.bytes) {
    float speed = p->pace * p->size, travel = p->forward < 0 ? 0.5f * p->forward : p->forward;
    sbr_character_set_drive(
        p->s->world, p->s->character, travel * speed, 0.5f * p->side * speed, 0.9f * p->turn);
    sbr_character_set_vertical_speed(p->s->world, p->s->character, 0.5f * p->up * speed);
  }
  pull(p, (float)seconds);
  for (uint32_t i = 0; i < p->ball_count; i++) fly(p, &p->balls[i], (float)seconds);
  return session_step_by(p->s, seconds);
}
