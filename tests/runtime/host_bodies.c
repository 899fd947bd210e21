#include "host_bodies.h"

#include <check.h>
#include <math.h>

#include "math/quat.h"

static const double TICK_S = 1.0 / 60, G = 9.81;

host_body host_body_make(
    scene *s, sbr_shape_definition form, double mass, const sbf_vec3 *arms, uint32_t parts, sbr_double3 at) {
  host_body b = {
      .shape = collision_shape(form), .mass = mass, .weight = G, .rotation = {0, 0, 0, 1}, .parts = parts};
  sbf_vec3 h = form.half_sizes;
  const double half[3] = {(double)h.x, (double)h.y, (double)h.z};
  for (int k = 0; k < 3; k++) {
    double y = half[(k + 1) % 3], z = half[(k + 2) % 3], r = (double)form.radius;
    b.inertia[k] = form.kind == SBR_SHAPE_SPHERE ? 0.4 * mass * r * r : mass * (y * y + z * z) / 3;
  }
  b.at[0] = at.x, b.at[1] = at.y, b.at[2] = at.z;
  for (uint32_t i = 0; i < parts; i++) {
    sbr_collider_definition d = sbr_default_collider_definition();
    b.arms[i] = arms ? arms[i] : (sbf_vec3){0, 0, 0};
    d.shape = b.shape, d.friction = 0.5f, d.restitution = 0, d.position = at;
    d.inertia = (sbf_vec3){(float)b.inertia[0], (float)b.inertia[1], (float)b.inertia[2]};
    d.centre = (sbf_vec3){-b.arms[i].x, -b.arms[i].y, -b.arms[i].z};
    if (i > 0)
      d.part_of = b.ids[0];
    else
      d.mass = (float)mass;
    ck_assert(sbr_collider_create(s->world, &d, &b.ids[i], NULL) == SBF_OK);
  }
  return b;
}

static sbf_vec3 single(const double v[3]) {
  return sbri_vec3((float)v[0], (float)v[1], (float)v[2]);
}

void host_body_tell(scene *s, host_body *b) {
  for (uint32_t i = 0; i < b->parts; i++) {
    sbf_vec3 arm = sbri_rotate(b->rotation, b->arms[i]);
    sbr_collider_motion m = {
        .position = {b->at[0] + (double)arm.x, b->at[1] + (double)arm.y, b->at[2] + (double)arm.z},
        .rotation = b->rotation,
        .velocity = sbri_add(single(b->velocity), sbri_cross(single(b->angular_velocity), arm)),
        .angular_velocity = single(b->angular_velocity),
        .acceleration = {0, (float)-b->weight, 0},
        .since_s = b->is_reported ? (float)TICK_S : 0};
    sbr_collider_set_motion(s->world, b->ids[i], &m);
  }
  b->is_reported = true;
}

/* Applies the impulse and gravity, then moves the body. `floor`: minimum height of its middle. */
static void take(scene *s, host_body *b, double floor) {
  b->velocity[1] -= b->weight * TICK_S;
  for (uint32_t i = 0; i < b->parts; i++) {
    sbr_collider_impulse push = sbr_collider_take_impulse(s->world, b->ids[i]);
    sbf_vec3 turn = sbri_add(push.moment, sbri_cross(sbri_rotate(b->rotation, b->arms[i]), push.impulse));
    /* Angular impulses act about the body's own axes. That suffices for balls, and for crates that hardly
     * rotate. */
    const float j[3] = {push.impulse.x, push.impulse.y, push.impulse.z}, l[3] = {turn.x, turn.y, turn.z};
    for (int k = 0; k < 3; k++) {
      b->velocity[k] += (double)j[k] / b->mass;
      b->angular_velocity[k] += (double)l[k] / b->inertia[k];
    }
  }
  if (b->at[1] + TICK_S * b->velocity[1] < floor) {
    b->velocity[1] = (floor - b->at[1]) / TICK_S;
    for (int k = 0; k < 3; k++) b->angular_velocity[k] = 0;
  }
  for (int k = 0; k < 3; k++) b->at[k] += TICK_S * b->velocity[k];
  sbf_vec3 half = sbri_scale(single(b->angular_velocity), (float)TICK_S / 2);
  b->rotation = sbri_quat_normalize(sbri_quat_multiply((sbf_quat){half.x, half.y, half.z, 1}, b->rotation));
}

void host_body_go(scene *s, host_body *b, uint32_t ticks, double floor) {
  for (uint32_t i = 0; i < ticks; i++) {
    host_body_tell(s, b);
    scene_ticks(s, 1);
    take(s, b, floor);
  }
}

double host_body_speed(const host_body *b) {
  const double *v = b->velocity;
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Maximum speed over the given number of ticks. */
double host_body_fastest(scene *s, host_body *b, uint32_t ticks) {
  double max = 0;
  for (uint32_t i = 0; i < ticks; i++) {
    host_body_go(s, b, 1, -10);
    max = host_body_speed(b) > max ? host_body_speed(b) : max;
  }
  return max;
}
